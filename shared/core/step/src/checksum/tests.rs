use super::*;
use proptest::prelude::*;

/// Each of the four sums of each lane, as they are before they are mixed.
fn sums(bytes: &[u8]) -> [[u64; 2]; 4] {
    let mut sum = Checksum::new();
    let mut whole = bytes.to_vec();
    whole.resize(bytes.len().next_multiple_of(ROW), 0);
    sum.rows(&whole);
    [sum.words, sum.words_again, sum.upper, sum.upper_again].map(|sum| sum.to_array())
}

fn word(at: usize) -> std::ops::Range<usize> {
    8 * at..8 * at + 8
}

/// Numbers like those of balls, whose signs and exponents are often all that differs.
fn numbers() -> impl Strategy<Value = Vec<u8>> {
    let number = prop_oneof![
        (-4i8..4).prop_map(f64::from),
        any::<f64>(),
        any::<u64>().prop_map(f64::from_bits)
    ];
    prop::collection::vec(number, 2..60)
        .prop_map(|numbers| numbers.iter().flat_map(|number| number.to_le_bytes()).collect())
}

#[test]
fn each_bit_counts() {
    // Some rows and a part of one.
    let bytes: Vec<u8> = (0..=255).chain(0..45).collect();
    let sum = checksum(&bytes);
    for bit in 0..bytes.len() * 8 {
        let mut other = bytes.clone();
        other[bit / 8] ^= 1 << (bit % 8);
        assert_ne!(checksum(&other), sum, "bit {bit}");
    }
}

#[test]
fn each_two_bits_count() {
    let bytes: Vec<u8> = (0..80).collect();
    let sum = checksum(&bytes);
    for first in 0..bytes.len() * 8 {
        for second in 0..first {
            let mut other = bytes.clone();
            other[first / 8] ^= 1 << (first % 8);
            other[second / 8] ^= 1 << (second % 8);
            assert_ne!(checksum(&other), sum, "bits {first} and {second}");
        }
    }
}

#[test]
fn it_is_the_same_everywhere() {
    let bytes: Vec<u8> = (0..=255).chain(0..45).collect();
    // Computed by itself, with integers of any size.
    assert_eq!(checksum(&bytes), 0x67c6_18c4_d979_7eff);
    assert_eq!(checksum(&[]), 0x456d_cf2a_d2ec_ef78);
}

#[test]
fn bytes_that_are_missing_or_too_many_count() {
    let bytes = [0; 100];
    let all: std::collections::HashSet<u64> = (0..=bytes.len()).map(|len| checksum(&bytes[..len])).collect();
    assert_eq!(all.len(), bytes.len() + 1);
}

proptest! {
    #[test]
    fn words_that_change_places_count(bytes in numbers(), one in any::<prop::sample::Index>(), other in any::<prop::sample::Index>()) {
        let count = bytes.len() / 8;
        let (one, other) = (word(one.index(count)), word(other.index(count)));
        prop_assume!(bytes[one.clone()] != bytes[other.clone()]);
        let mut changed = bytes.clone();
        changed[one.clone()].copy_from_slice(&bytes[other.clone()]);
        changed[other].copy_from_slice(&bytes[one]);
        prop_assert_ne!(sums(&changed), sums(&bytes));
        prop_assert_ne!(checksum(&changed), checksum(&bytes));
    }

    #[test]
    fn damage_within_two_words_counts_whatever_it_is(
        bytes in numbers(),
        places in any::<[prop::sample::Index; 2]>(),
        // Bits near each end of a word are where sums lose something.
        bits in prop::collection::vec((0usize..2, prop_oneof![0u32..3, 29u32..35, 61u32..64]), 1..6),
    ) {
        let mut changed = bytes.clone();
        for (which, bit) in bits {
            let at = places[which].index(bytes.len() / 8);
            changed[8 * at + bit as usize / 8] ^= 1 << (bit % 8);
        }
        prop_assume!(changed != bytes);
        prop_assert_ne!(sums(&changed), sums(&bytes));
        prop_assert_ne!(checksum(&changed), checksum(&bytes));
    }
}
