//! The first time at which a polynomial of degree 4 or less falls below zero, by `+ - * /` alone.
//!
//! The roots of each derivative cut the interval into pieces on which the next one is monotone; on each of these a
//! sign change is closed in on by halving until no f64 lies between. Slow, and never wrong by more than the rounding
//! of the polynomial itself.
//!
//! Most are convex all the way, as the distance of two balls is that bend little in a substep. Newton's method from 0 then
//! comes ever nearer to the first root and never beyond it, or to a place from which there is no way down.

const DEGREE: usize = 4;
/// Newton steps after which a root is so nearly a double one that halving is quicker.
const MOST_STEPS: u32 = 10;

/// Coefficients, the constant first.
pub(super) type Polynomial = [f64; DEGREE + 1];

fn value(p: &Polynomial, t: f64) -> f64 {
    p.iter()
        .rev()
        .fold(0.0, |sum, &coefficient| sum * t + coefficient)
}

fn derivative(p: &Polynomial) -> Polynomial {
    [p[1], 2.0 * p[2], 3.0 * p[3], 4.0 * p[4], 0.0]
}

/// Where a monotone polynomial changes its sign between two times at which the signs differ.
fn halve(p: &Polynomial, mut low: f64, mut high: f64) -> f64 {
    let falls = value(p, low) >= 0.0;
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return high;
        }
        if (value(p, middle) >= 0.0) == falls {
            low = middle;
        } else {
            high = middle;
        }
    }
}

/// Times in (0, end) at which the sign changes, ascending; `degree` bounds their number.
fn sign_changes(p: &Polynomial, degree: usize, end: f64, found: &mut [f64; DEGREE]) -> usize {
    if degree == 0 {
        return 0;
    }
    let mut turns = [0.0; DEGREE];
    let count = sign_changes(&derivative(p), degree - 1, end, &mut turns);
    let mut changes = 0;
    let mut low = 0.0;
    for &high in turns[..count].iter().chain([end].iter()) {
        if (value(p, low) >= 0.0) != (value(p, high) >= 0.0) {
            found[changes] = halve(p, low, high);
            changes += 1;
        }
        low = high;
    }
    changes
}

/// The first time in (0, end] at which a polynomial that is not below 0 at 0 goes below it.
pub(super) fn first_fall(p: &Polynomial, end: f64) -> Option<f64> {
    let convex = p[2] > 3.0 * end * p[3].abs() && p[4] >= 0.0;
    if convex && p[0] > 0.0 {
        descend(p, end).unwrap_or_else(|| search(p, end))
    } else {
        search(p, end)
    }
}

/// The same where the polynomial is above 0 at 0 and convex; None if that takes too many steps.
fn descend(p: &Polynomial, end: f64) -> Option<Option<f64>> {
    let slope = derivative(p);
    let mut time = 0.0;
    for _ in 0..MOST_STEPS {
        let (height, fall) = (value(p, time), -value(&slope, time));
        if fall <= 0.0 {
            return Some(None);
        }
        if height <= 0.0 {
            return Some(Some(time));
        }
        let next = time + height / fall;
        if next > end {
            return Some(None);
        }
        if next <= time {
            return Some(Some(time));
        }
        time = next;
    }
    None
}

/// The same of any polynomial that is not below 0 at 0.
fn search(p: &Polynomial, end: f64) -> Option<f64> {
    let mut found = [0.0; DEGREE];
    let count = sign_changes(p, DEGREE, end, &mut found);
    found[..count].iter().copied().find(|&time| value(p, time) < 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn with_roots(roots: [f64; 4]) -> Polynomial {
        let mut p = [1.0, 0.0, 0.0, 0.0, 0.0];
        for (degree, root) in roots.into_iter().enumerate() {
            for power in (0..=degree).rev() {
                p[power + 1] += p[power];
                p[power] *= -root;
            }
        }
        p
    }

    proptest! {
        #[test]
        fn finds_the_first_root_of_a_product(mut roots in prop::array::uniform4(0.05..2.0f64)) {
            roots.sort_by(f64::total_cmp);
            prop_assume!(roots.windows(2).all(|pair| pair[1] - pair[0] > 0.02));
            let time = first_fall(&with_roots(roots), 3.0).unwrap();
            prop_assert!((time - roots[0]).abs() < 1e-9, "{} against {:?}", time, roots);
        }

        #[test]
        fn finds_nothing_before_the_first_root(mut roots in prop::array::uniform4(0.5..2.0f64)) {
            roots.sort_by(f64::total_cmp);
            prop_assert_eq!(first_fall(&with_roots(roots), 0.49), None);
        }
    }

    proptest! {
        /// Of two balls that bend a little: d, w and b of `predict::bent`.
        #[test]
        fn descends_to_where_the_search_ends(
            gap in 1e-9..1.0f64, slope in -20.0..0.1f64, speed in 0.5..10.0f64, turn in -0.9..0.9f64, bend in 0.0..3.0f64,
        ) {
            let second = speed * speed;
            let p = [gap, slope, second, turn * second / 3.0, 0.25 * bend * bend];
            let (quick, slow) = (first_fall(&p, 1.0), search(&p, 1.0));
            let lowest = (0..=1000).map(|at| value(&p, f64::from(at) / 1000.0)).fold(f64::INFINITY, f64::min);
            // Which of both sees a root that is nearly double is a matter of rounding.
            prop_assume!(lowest.abs() > 1e-6 && value(&p, 1.0).abs() > 1e-9);
            prop_assert_eq!(quick.is_some(), slow.is_some(), "{:?} against {:?}", quick, slow);
            if let (Some(quick), Some(slow)) = (quick, slow) {
                prop_assert!((quick - slow).abs() < 1e-9, "{} against {}", quick, slow);
            }
        }
    }

    #[test]
    fn a_polynomial_that_only_touches_zero_does_not_fall() {
        assert_eq!(first_fall(&[1.0, -2.0, 1.0, 0.0, 0.0], 3.0), None);
    }
}
