//! Numbers of a given count of bits, one after the other, the lowest bit first; and varints (LEB128).

use crate::Error;

/// Bits of one number, at the most.
pub(crate) const MOST_BITS: u32 = 64;
const HALF_BITS: u32 = 32;
const HALF_MASK: u64 = (1 << HALF_BITS) - 1;

/// Appends `width` bits of each number, and fills up the last byte with zeros.
pub(crate) fn write_bits(out: &mut Vec<u8>, numbers: impl Iterator<Item = u64>, width: u32) {
    let (mut waiting, mut count) = (0u64, 0);
    let mut write = |number: u64, width: u32| {
        waiting |= number << count;
        count += width;
        while count >= 8 {
            out.push(waiting as u8);
            waiting >>= 8;
            count -= 8;
        }
    };
    for number in numbers {
        if width <= HALF_BITS {
            write(number, width);
        } else {
            // Fewer than eight bits wait, so a half always fits beside them.
            write(number & HALF_MASK, HALF_BITS);
            write(number >> HALF_BITS, width - HALF_BITS);
        }
    }
    if count > 0 {
        out.push(waiting as u8);
    }
}

/// Bits that a number needs.
pub(crate) fn width(largest: u64) -> u32 {
    u64::BITS - largest.leading_zeros()
}

/// Appends a varint.
pub(crate) fn write_varint(out: &mut Vec<u8>, mut number: u64) {
    while number > 0x7F {
        out.push(number as u8 | 0x80);
        number >>= 7;
    }
    out.push(number as u8);
}

/// Appends a varint of either sign, those near 0 short (zigzag).
pub(crate) fn write_signed(out: &mut Vec<u8>, number: i64) {
    write_varint(out, (number << 1 ^ number >> 63) as u64);
}

/// Takes bytes off the front.
#[derive(Debug)]
pub(crate) struct Reader<'a> {
    left: &'a [u8],
}

impl<'a> Reader<'a> {
    pub(crate) fn new(bytes: &'a [u8]) -> Reader<'a> {
        Reader { left: bytes }
    }

    pub(crate) fn take(&mut self, count: usize) -> Result<&'a [u8], Error> {
        let (taken, left) = self
            .left
            .split_at_checked(count)
            .ok_or_else(|| Error(format!("{count} more bytes wanted, {} left", self.left.len())))?;
        self.left = left;
        Ok(taken)
    }

    pub(crate) fn byte(&mut self) -> Result<u8, Error> {
        Ok(self.take(1)?[0])
    }

    pub(crate) fn varint(&mut self) -> Result<u64, Error> {
        let mut number = 0;
        for place in 0..10 {
            let byte = self.byte()?;
            if place == 9 && byte > 1 {
                break;
            }
            number |= u64::from(byte & 0x7F) << (7 * place);
            if byte < 0x80 {
                return Ok(number);
            }
        }
        Err(Error("a number of more than 64 bits".into()))
    }

    pub(crate) fn signed(&mut self) -> Result<i64, Error> {
        let number = self.varint()?;
        Ok((number >> 1) as i64 ^ -((number & 1) as i64))
    }

    /// A width of at most `most` bits.
    pub(crate) fn width(&mut self, most: u32) -> Result<u32, Error> {
        let width = u32::from(self.byte()?);
        if width > most {
            return Err(Error(format!("numbers of {width} bits, at most {most}")));
        }
        Ok(width)
    }

    /// What `write_bits` wrote.
    pub(crate) fn bits(&mut self, count: usize, width: u32) -> Result<Vec<u64>, Error> {
        debug_assert!(width <= MOST_BITS);
        let bytes = self.take((count * width as usize).div_ceil(8))?;
        let mut rest = bytes.iter();
        let (mut waiting, mut held) = (0u128, 0);
        let mask = (1u128 << width) - 1;
        let mut numbers = Vec::with_capacity(count);
        for _ in 0..count {
            while held < width {
                waiting |= u128::from(*rest.next().unwrap_or(&0)) << held;
                held += 8;
            }
            numbers.push((waiting & mask) as u64);
            waiting >>= width;
            held -= width;
        }
        Ok(numbers)
    }

    pub(crate) fn end(&self) -> Result<(), Error> {
        match self.left.len() {
            0 => Ok(()),
            left => Err(Error(format!("{left} bytes too many"))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn bits_come_back(numbers in prop::collection::vec(any::<u64>(), 0..50), shift in 0u32..64) {
            let numbers: Vec<u64> = numbers.iter().map(|number| number >> shift).collect();
            let wide = width(numbers.iter().copied().max().unwrap_or(0));
            let mut out = Vec::new();
            write_bits(&mut out, numbers.iter().copied(), wide);
            prop_assert_eq!(out.len(), (numbers.len() * wide as usize).div_ceil(8));
            let mut reader = Reader::new(&out);
            prop_assert_eq!(reader.bits(numbers.len(), wide).unwrap(), numbers);
            reader.end().unwrap();
        }

        #[test]
        fn varints_come_back(number in any::<u64>(), signed in any::<i64>()) {
            let mut out = Vec::new();
            write_varint(&mut out, number);
            write_signed(&mut out, signed);
            let mut reader = Reader::new(&out);
            prop_assert_eq!((reader.varint().unwrap(), reader.signed().unwrap()), (number, signed));
            reader.end().unwrap();
        }
    }
}
