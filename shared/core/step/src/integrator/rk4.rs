//! Classical Runge-Kutta 4 on the state S = (p, v): S' = S + dt (k1 + 2 k2 + 2 k3 + k4) / 6. Fourth order; loses a
//! little energy on oscillations, of order (omega dt)^6 a step.

use super::Scheme;
use crate::Vec2;
use crate::force::{Acceleration, Body};

pub(super) struct RungeKutta4;

impl Scheme for RungeKutta4 {
    fn advance<A: Acceleration>(acceleration: &A, time: f64, dt: f64, body: Body) -> (Vec2, Vec2) {
        let slope = |t: f64, position: Vec2, velocity: Vec2| {
            (
                velocity,
                acceleration.at(
                    t,
                    &Body {
                        position,
                        velocity,
                        ..body
                    },
                ),
            )
        };
        let (p, v) = (body.position, body.velocity);
        let half = 0.5 * dt;
        let k1 = slope(time, p, v);
        let k2 = slope(time + half, p + k1.0 * half, v + k1.1 * half);
        let k3 = slope(time + half, p + k2.0 * half, v + k2.1 * half);
        let k4 = slope(time + dt, p + k3.0 * dt, v + k3.1 * dt);
        let sixth = dt / 6.0;
        (
            p + (k1.0 + k2.0 * 2.0 + k3.0 * 2.0 + k4.0) * sixth,
            v + (k1.1 + k2.1 * 2.0 + k3.1 * 2.0 + k4.1) * sixth,
        )
    }
}
