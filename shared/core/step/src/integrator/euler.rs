//! Explicit Euler: x += v dt, then v += a dt, with a from the start of the tick. First order; gains energy.

use super::Scheme;
use crate::Vec2;
use crate::force::{Acceleration, Body};

pub(super) struct Euler;

impl Scheme for Euler {
    fn advance<A: Acceleration>(acceleration: &A, time: f64, dt: f64, body: Body) -> (Vec2, Vec2) {
        let a = acceleration.at(time, &body);
        (body.position + body.velocity * dt, body.velocity + a * dt)
    }
}
