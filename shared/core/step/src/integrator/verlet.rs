//! Velocity Verlet (Swope et al. 1982, doi 10.1063/1.442716). Second order, symplectic for forces of position.
//!
//! For a force that depends on velocity, the second acceleration is taken at the velocity that the first one predicts.

use super::Scheme;
use crate::Vec2;
use crate::force::{Acceleration, Body};

pub(super) struct Verlet;

impl Scheme for Verlet {
    fn advance<A: Acceleration>(acceleration: &A, time: f64, dt: f64, body: Body) -> (Vec2, Vec2) {
        let a = acceleration.at(time, &body);
        let position = body.position + body.velocity * dt + a * (0.5 * dt * dt);
        let ahead = Body {
            position,
            velocity: body.velocity + a * dt,
            ..body
        };
        let b = acceleration.at(time + dt, &ahead);
        (position, body.velocity + (a + b) * (0.5 * dt))
    }
}
