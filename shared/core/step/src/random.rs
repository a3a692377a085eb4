//! A counter-based random generator: number k of a stream is a function of (seed, stream, k), nothing is carried.

/// SplitMix64's finaliser (Steele, Lea, Flood 2014, doi 10.1145/2660193.2660195).
fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// Number `counter` of a stream, in [0, 1), with 53 random bits.
#[must_use]
#[expect(clippy::cast_precision_loss, reason = "53 bits are exact")]
pub fn uniform(seed: u64, stream: u64, counter: u64) -> f64 {
    const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;
    let key = mix(mix(seed.wrapping_add(GOLDEN)) ^ stream.wrapping_mul(GOLDEN));
    let bits = mix(key.wrapping_add(counter.wrapping_add(1).wrapping_mul(GOLDEN)));
    (bits >> 11) as f64 * (1.0 / 9_007_199_254_740_992.0)
}

#[cfg(test)]
mod tests {
    use super::uniform;

    #[test]
    fn is_uniform_and_its_streams_differ() {
        let mean = (0..10_000).map(|k| uniform(1, 0, k)).sum::<f64>() / 10_000.0;
        assert!((mean - 0.5).abs() < 0.01);
        let same = (0..1_000)
            .filter(|&k| uniform(1, 0, k) == uniform(1, 1, k) || uniform(2, 0, k) == uniform(1, 0, k));
        assert_eq!(same.count(), 0);
    }

    #[test]
    fn is_the_same_on_every_platform() {
        assert_eq!(uniform(1, 2, 3).to_bits(), 4_591_843_174_807_375_304);
    }
}
