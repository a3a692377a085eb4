//! Semi-implicit (symplectic) Euler: v += a dt, then x += v dt. First order; energy stays bounded below omega dt = 2.

use super::Scheme;
use crate::Vec2;
use crate::force::{Acceleration, Body};

pub(super) struct SymplecticEuler;

impl Scheme for SymplecticEuler {
    fn advance<A: Acceleration>(acceleration: &A, time: f64, dt: f64, body: Body) -> (Vec2, Vec2) {
        let velocity = body.velocity + acceleration.at(time, &body) * dt;
        (body.position + velocity * dt, velocity)
    }
}
