//! The exchange of normal velocities between two balls.

use crate::{Balls, Vec2};

/// The normal of two balls with coincident centres points from the lower id to the higher, to the right.
const COINCIDENT_NORMAL: Vec2 = Vec2::new(1.0, 0.0);

/// What each of two balls takes of their approach: (1 + e) m2 / (m1 + m2) and (1 + e) m1 / (m1 + m2).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Shares {
    pub(super) first: f64,
    pub(super) second: f64,
}

impl Shares {
    /// An infinite mass takes nothing, so the other ball bounces off it; two infinite masses do not touch each other.
    #[inline]
    pub(super) fn new(first: f64, second: f64, restitution: f64) -> Option<Shares> {
        let whole = 1.0 + restitution;
        match (first.is_finite(), second.is_finite()) {
            (true, true) => {
                let sum = first + second;
                Some(Shares {
                    first: whole * (second / sum),
                    second: whole * (first / sum),
                })
            }
            (true, false) => Some(Shares {
                first: whole,
                second: 0.0,
            }),
            (false, true) => Some(Shares {
                first: 0.0,
                second: whole,
            }),
            (false, false) => None,
        }
    }
}

/// Shares and reach of any pair of a world: computed once if all balls are alike.
pub(super) struct SharesOf {
    restitution: f64,
    alike: Option<Option<Shares>>,
    diameter: Option<f64>,
}

impl SharesOf {
    pub(super) fn new(balls: &Balls, restitution: f64) -> SharesOf {
        let alike = balls
            .uniform()
            .map(|shape| Shares::new(shape.mass, shape.mass, restitution));
        SharesOf {
            restitution,
            alike,
            diameter: balls.uniform().map(|shape| shape.radius + shape.radius),
        }
    }

    /// The distance at which two balls touch.
    #[inline]
    pub(super) fn reach(&self, balls: &Balls, first: usize, second: usize) -> f64 {
        self.diameter
            .unwrap_or_else(|| balls.radius[first] + balls.radius[second])
    }

    #[inline]
    pub(super) fn pair(&self, balls: &Balls, first: usize, second: usize) -> Option<Shares> {
        self.alike
            .unwrap_or_else(|| Shares::new(balls.mass[first], balls.mass[second], self.restitution))
    }
}

/// From the first centre to the second, of any length but 0.
#[inline]
pub(super) fn normal(first: Vec2, second: Vec2) -> Vec2 {
    let between = second - first;
    if has_direction(between) {
        between
    } else {
        COINCIDENT_NORMAL
    }
}

/// Whether the centres are far enough apart to say where one is, seen from the other.
#[inline]
pub(super) fn has_direction(between: Vec2) -> bool {
    between.square() >= f64::MIN_POSITIVE
}

/// The velocities of a pair after an exchange along `normal`; `approach` is (v1 - v2) . normal.
///
/// With n the unit normal and u1, u2 the velocities along it, u1' = (u1 (m1 - e m2) + (1 + e) m2 u2) / (m1 + m2),
/// and the same with the balls swapped; the tangential parts stay. Written as u1' = u1 - s1 (u1 - u2), which needs
/// no unit vector (d (d . w) / d^2 = n (n . w)) and gives both balls the same impulse but for one rounding each.
#[inline]
pub(super) fn transfer(
    normal: Vec2,
    approach: f64,
    shares: Shares,
    first: Vec2,
    second: Vec2,
) -> (Vec2, Vec2) {
    let along = normal * (approach / normal.square());
    (first - along * shares.first, second + along * shares.second)
}

/// Exchanges the velocities of an approaching pair; false if the pair does not approach.
#[inline]
pub(super) fn exchange(normal: Vec2, shares: Shares, first: &mut Vec2, second: &mut Vec2) -> bool {
    let approach = (*first - *second).dot(normal);
    if approach > 0.0 {
        (*first, *second) = transfer(normal, approach, shares, *first, *second);
        return true;
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn vector() -> impl Strategy<Value = Vec2> {
        (-10.0..10.0f64, -10.0..10.0f64).prop_map(|(x, y)| Vec2::new(x, y))
    }

    fn after(d: Vec2, m1: f64, m2: f64, e: f64, v1: Vec2, v2: Vec2) -> Option<(Vec2, Vec2)> {
        let (mut w1, mut w2) = (v1, v2);
        let shares = Shares::new(m1, m2, e)?;
        exchange(normal(Vec2::ZERO, d), shares, &mut w1, &mut w2).then_some((w1, w2))
    }

    fn cross(a: Vec2, b: Vec2) -> f64 {
        a.x * b.y - a.y * b.x
    }

    proptest! {
        #[test]
        fn elastic_exchange_conserves_momentum_energy_and_angular_momentum(
            d in vector(), v1 in vector(), v2 in vector(), m1 in 0.01..100.0f64, m2 in 0.01..100.0f64,
        ) {
            prop_assume!(d.square() > 1e-6);
            let Some((w1, w2)) = after(d, m1, m2, 1.0, v1, v2) else { return Ok(()) };
            let bound = 1e-12 * (m1 + m2);
            let momentum = (w1 * m1 + w2 * m2) - (v1 * m1 + v2 * m2);
            prop_assert!(momentum.x.abs() < 10.0 * bound && momentum.y.abs() < 10.0 * bound);
            let energy = m1 * w1.square() + m2 * w2.square() - m1 * v1.square() - m2 * v2.square();
            prop_assert!(energy.abs() < 400.0 * bound);
            // About the first centre; an exchange along the tangent, a known slip, would break this one.
            let angular = cross(d, w2 * m2) - cross(d, v2 * m2);
            prop_assert!(angular.abs() < 200.0 * bound);
        }

        #[test]
        fn agrees_with_the_textbook_formula(
            d in vector(), v1 in vector(), v2 in vector(), m1 in 0.01..100.0f64, m2 in 0.01..100.0f64,
        ) {
            prop_assume!(d.square() > 1e-6);
            let Some((w1, w2)) = after(d, m1, m2, 1.0, v1, v2) else { return Ok(()) };
            let n = d * (1.0 / d.length());
            let (u1, u2) = (v1.dot(n), v2.dot(n));
            let u1_after = (u1 * (m1 - m2) + 2.0 * m2 * u2) / (m1 + m2);
            let u2_after = (u2 * (m2 - m1) + 2.0 * m1 * u1) / (m1 + m2);
            prop_assert!((w1.dot(n) - u1_after).abs() < 1e-11 && (w2.dot(n) - u2_after).abs() < 1e-11);
        }

        #[test]
        fn relative_normal_velocity_shrinks_by_restitution(
            d in vector(), v1 in vector(), v2 in vector(), e in 0.0..1.0f64, m1 in 0.01..100.0f64,
        ) {
            prop_assume!(d.square() > 1e-6);
            let Some((w1, w2)) = after(d, m1, 1.0, e, v1, v2) else { return Ok(()) };
            let n = d * (1.0 / d.length());
            prop_assert!(((w2 - w1).dot(n) - e * (v1 - v2).dot(n)).abs() < 1e-11);
        }
    }

    #[test]
    fn a_ball_bounces_off_a_fixed_one() {
        let (w1, w2) = after(
            Vec2::new(2.0, 0.0),
            1.0,
            f64::INFINITY,
            1.0,
            Vec2::new(3.0, 1.0),
            Vec2::new(0.5, 0.0),
        )
        .unwrap();
        assert_eq!((w1, w2), (Vec2::new(2.0 * 0.5 - 3.0, 1.0), Vec2::new(0.5, 0.0)));
        assert_eq!(Shares::new(f64::INFINITY, f64::INFINITY, 1.0), None);
    }

    #[test]
    fn coincident_centres_have_a_normal() {
        assert_eq!(
            normal(Vec2::new(3.0, 4.0), Vec2::new(3.0, 4.0)),
            Vec2::new(1.0, 0.0)
        );
    }
}
