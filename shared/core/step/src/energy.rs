//! Energy and momentum of the balls that can move. Sums run in id order.

use crate::force::{Body, HeldNow};
use crate::{Rules, State, Vec2};

fn bodies(state: &State) -> impl Iterator<Item = Body> + '_ {
    let balls = &state.balls;
    balls
        .by_id()
        .map(|index| Body {
            index,
            mass: balls.mass[index],
            position: balls.position[index],
            velocity: balls.velocity[index],
        })
        .filter(|body| body.mass.is_finite())
}

/// Sum of m v^2 / 2.
pub(crate) fn kinetic(state: &State) -> f64 {
    bodies(state)
        .map(|body| 0.5 * body.mass * body.velocity.square())
        .sum()
}

/// Potential energy in the forces that have one.
pub(crate) fn potential(rules: &Rules, state: &State) -> f64 {
    if rules.forces().is_empty() {
        return 0.0;
    }
    let held = HeldNow::of(state);
    let of = |body: Body| {
        rules
            .forces()
            .iter()
            .map(|force| force.potential(&body, &held))
            .sum::<f64>()
    };
    bodies(state).map(of).sum()
}

/// Sum of m v.
pub(crate) fn momentum(state: &State) -> Vec2 {
    bodies(state).fold(Vec2::ZERO, |sum, body| sum + body.velocity * body.mass)
}
