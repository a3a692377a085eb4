//! Four distance tests at once, in plain code that the compiler turns into vector instructions.
//!
//! The tests are coarse: f32, so that four fit the narrowest vectors there are. Reaches are widened by more than the
//! rounding (see [`Scale`]), so no disc that overlaps is missed; what is found in vain is looked at again in f64.

/// Candidates that are tested side by side.
pub(super) const LANES: usize = 4;

/// Widens reaches by more than all relative rounding: that of the reach, of the difference, of the squares.
const RELATIVE: f64 = 1.0 + 1.0 / (1 << 19) as f64;
/// Widens a reach by more than the rounding of two coordinates, as a part of the largest.
const ABSOLUTE: f64 = 1.0 / (1 << 22) as f64;

/// How coordinates and reaches become f32: counted in cells, from a corner.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Scale {
    /// Cells per metre.
    pub(super) inverse: f64,
    /// The largest coordinate, in cells.
    pub(super) most: f64,
}

impl Scale {
    /// A reach of the one that is compared with others.
    #[inline]
    pub(super) fn probing(&self, reach: f64) -> f32 {
        (reach * self.inverse * RELATIVE + self.most * ABSOLUTE) as f32
    }

    /// A reach of one of the others.
    #[inline]
    pub(super) fn probed(&self, reach: f64) -> f32 {
        (reach * self.inverse * RELATIVE) as f32
    }
}

/// For each lane, bits of which the highest is set if its point lies further from (`x`, `y`) than its `sum`. The sign of
/// a difference tells: comparisons were measured to stay scalar.
#[inline(always)]
pub(super) fn beyond(
    xs: &[f32; LANES],
    ys: &[f32; LANES],
    x: f32,
    y: f32,
    sums: &[f32; LANES],
) -> [u32; LANES] {
    let mut beyond = [0; LANES];
    for lane in 0..LANES {
        let (dx, dy) = (xs[lane] - x, ys[lane] - y);
        beyond[lane] = (sums[lane] * sums[lane] - (dx * dx + dy * dy)).to_bits();
    }
    beyond
}

/// What the distances of the discs from `start` on are compared with: `own` with the reach of each, or as it is where
/// all share theirs.
#[inline(always)]
pub(super) fn sums<const EACH: bool>(reaches: &[f32], start: usize, own: f32) -> [f32; LANES] {
    if EACH {
        lanes_at(reaches, start).map(|reach| own + reach)
    } else {
        [own; LANES]
    }
}

/// Whether all of two times as many lanes are beyond.
#[inline(always)]
pub(super) fn all_beyond(first: [u32; LANES], second: [u32; LANES]) -> bool {
    let mut both = [0; LANES];
    for lane in 0..LANES {
        both[lane] = first[lane] & second[lane];
    }
    ((both[0] & both[1]) & (both[2] & both[3])) >> 31 == 1
}

/// A bit for each lane that is not beyond.
#[inline(always)]
pub(super) fn near(beyond: [u32; LANES]) -> u32 {
    let sign = beyond.map(|bits| bits >> 31);
    (sign[0] | (sign[1] << 1) | (sign[2] << 2) | (sign[3] << 3)) ^ 0b1111
}

/// The numbers from `start` on, as many as there are lanes.
#[inline(always)]
pub(super) fn lanes_at(numbers: &[f32], start: usize) -> &[f32; LANES] {
    numbers[start..]
        .first_chunk()
        .expect("the arrays go on behind the last disc")
}

/// A bit for each lane that a run of that length fills.
#[inline(always)]
pub(super) fn lanes_of(length: usize) -> u32 {
    (1 << length.min(LANES)) - 1
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The test as the tree makes it, for two discs at coordinates of up to `most` cells.
    fn found(most: f64, first: (f64, f64, f64), second: (f64, f64, f64)) -> bool {
        let scale = Scale { inverse: 1.0, most };
        let all = |number: f64| [number as f32; LANES];
        let sum = scale.probing(first.2) + scale.probed(second.2);
        let (xs, ys) = (all(second.0), all(second.1));
        near(beyond(&xs, &ys, first.0 as f32, first.1 as f32, &[sum; LANES])) == 0b1111
    }

    fn overlap(first: (f64, f64, f64), second: (f64, f64, f64)) -> bool {
        let (dx, dy, sum) = (first.0 - second.0, first.1 - second.1, first.2 + second.2);
        dx * dx + dy * dy < sum * sum
    }

    proptest! {
        #[test]
        fn no_overlap_is_missed(
            most in 1.0..40_000.0f64, x in 0.0..1.0f64, y in 0.0..1.0f64, angle in -1.0..1.0f64,
            reach in 1e-12..1e3f64, other in 1e-12..1e3f64, near in 0.0..1.0f64,
        ) {
            // Touching but for the last bits is where a coarse test could err.
            let far = (reach + other) * (1.0 - near * near * near * 1e-3);
            let first = (x * most, y * most, reach);
            let second = (first.0 + far * angle, first.1 + far * (1.0 - angle * angle).sqrt(), other);
            let inside = |v: f64| (0.0..=most).contains(&v);
            prop_assume!(inside(second.0) && inside(second.1) && overlap(first, second));
            prop_assert!(found(most, first, second));
        }

        #[test]
        fn little_is_found_in_vain(x in 0.0..900.0f64, y in 0.0..900.0f64, angle in -1.0..1.0f64) {
            let first = (x, y, 0.5);
            let second = (x + 1.01 * angle, y + 1.01 * (1.0 - angle * angle).sqrt(), 0.5);
            prop_assert!(!found(1000.0, first, second));
        }
    }

    #[test]
    fn each_lane_answers_for_itself() {
        let xs = [0.0, 3.0, 0.0, 1.0];
        let ys = [0.0, 0.0, 3.0, 1.0];
        let some = beyond(&xs, &ys, 0.0, 0.0, &[2.0, 2.0, 4.0, 1.0]);
        let none = beyond(&xs, &ys, -9.0, 0.0, &[1.0; LANES]);
        assert_eq!((near(some), near(none)), (0b0101, 0));
        assert!(all_beyond(none, none) && !all_beyond(some, none) && !all_beyond(none, some));
        assert_eq!([0, 1, 3, 4, 9].map(lanes_of), [0, 0b1, 0b111, 0b1111, 0b1111]);
    }
}
