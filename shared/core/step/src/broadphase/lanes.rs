//! Four distance tests at once, in plain code that the compiler turns into vector instructions.

/// Candidates that are tested side by side.
pub(super) const LANES: usize = 4;

/// A bit for each lane whose point lies nearer to (`x`, `y`) than the root of its `square`: the sign of a difference,
/// because comparisons were measured to stay scalar. Where both sides are infinite a bit may be set in vain.
#[inline]
pub(super) fn near(xs: &[f64; LANES], ys: &[f64; LANES], x: f64, y: f64, squares: &[f64; LANES]) -> u32 {
    let mut signs = [0; LANES];
    for lane in 0..LANES {
        let (dx, dy) = (xs[lane] - x, ys[lane] - y);
        signs[lane] = (dx * dx + dy * dy - squares[lane]).to_bits() >> 63;
    }
    (signs[0] | (signs[1] << 1) | (signs[2] << 2) | (signs[3] << 3)) as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn one_by_one(xs: &[f64; LANES], ys: &[f64; LANES], x: f64, y: f64, squares: &[f64; LANES]) -> u32 {
        (0..LANES).fold(0, |bits, lane| {
            let (dx, dy) = (xs[lane] - x, ys[lane] - y);
            bits | (u32::from(dx * dx + dy * dy < squares[lane]) << lane)
        })
    }

    proptest! {
        #[test]
        fn no_near_point_is_missed(
            xs in prop::array::uniform4(any::<f64>()), ys in prop::array::uniform4(any::<f64>()),
            x in any::<f64>(), y in any::<f64>(), squares in prop::array::uniform4(0.0..f64::MAX),
        ) {
            let exact = one_by_one(&xs, &ys, x, y, &squares);
            prop_assert_eq!(near(&xs, &ys, x, y, &squares) & exact, exact);
        }

        #[test]
        fn neighbours_are_told_exactly(
            xs in prop::array::uniform4(-1.0..1.0f64), ys in prop::array::uniform4(-1.0..1.0f64),
        ) {
            let squares = [1.0, 0.5, 0.25, xs[3] * xs[3] + ys[3] * ys[3]];
            prop_assert_eq!(near(&xs, &ys, 0.0, 0.0, &squares), one_by_one(&xs, &ys, 0.0, 0.0, &squares));
        }
    }
}
