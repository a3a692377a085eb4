//! The checksum at the end of snapshots, rules and recordings, to find damage (not to resist an attacker).
//!
//! Fletcher's checksum (J. G. Fletcher, An Arithmetic Checksum for Serial Transmissions, 1982) over words of 64 bits,
//! little-endian, in two lanes: the first words of all rows, and the second. Each lane has the sum of its words and the
//! sum of those sums, wrapping, and both once more of the upper halves alone: what a sum of sums would lose above its
//! highest bit, if two sign bits change an even number of rows apart, the halves have room for.
//!
//! So damage within two words, whatever it is, changes the sums for certain, and two different words that changed places
//! are such damage; that the 64 bits made of the sums are the same all the same has a chance of 2^-64, as has other damage
//! by chance. Bytes that are missing at the end change the length, which is taken in as well.
//!
//! Additions, and no multiplications, are what every x86-64 does in two lanes at once, and what hides behind the wait for
//! the memory of balls that are written in id order.

use wide::u64x2;

use crate::hash;

/// Bytes of a row: a word for each lane.
pub(crate) const ROW: usize = 16;

const START: [u64; 2] = [0x9e37_79b9_7f4a_7c15, 0xd1b5_4a32_d192_ed03];

/// Sums so far.
#[derive(Clone, Copy)]
pub(crate) struct Checksum {
    words: u64x2,
    words_again: u64x2,
    upper: u64x2,
    upper_again: u64x2,
}

impl Checksum {
    pub(crate) fn new() -> Checksum {
        let start = u64x2::new(START);
        Checksum {
            words: start,
            words_again: start,
            upper: start,
            upper_again: start,
        }
    }

    /// Takes a row in.
    #[inline(always)]
    pub(crate) fn row(&mut self, words: [u64; 2]) {
        let words = u64x2::new(words);
        self.words += words;
        self.words_again += self.words;
        self.upper += words >> 32_u32;
        self.upper_again += self.upper;
    }

    /// Takes in as many rows as there are; what is left is less than one.
    pub(crate) fn rows<'a>(&mut self, bytes: &'a [u8]) -> &'a [u8] {
        let (rows, rest) = bytes.as_chunks::<ROW>();
        // A copy, which stays in registers.
        let mut sum = *self;
        for row in rows {
            sum.row(words(row));
        }
        *self = sum;
        rest
    }

    /// The checksum of `bytes` bytes, of which `rest` were in no row.
    pub(crate) fn end(mut self, rest: &[u8], bytes: usize) -> u64 {
        let mut last = [0; ROW];
        last[..rest.len()].copy_from_slice(rest);
        self.row(words(&last));
        [self.words, self.words_again, self.upper, self.upper_again]
            .iter()
            .flat_map(|sum| sum.to_array())
            .fold(bytes as u64, hash::mixed)
    }
}

/// Of bytes that are all there.
#[must_use]
pub(crate) fn checksum(bytes: &[u8]) -> u64 {
    let mut sum = Checksum::new();
    let rest = sum.rows(bytes);
    sum.end(rest, bytes.len())
}

fn words(row: &[u8; ROW]) -> [u64; 2] {
    let (words, _) = row.as_chunks::<8>();
    [0, 1].map(|at| u64::from_le_bytes(words[at]))
}

#[cfg(test)]
mod tests;
