//! Integrators: how balls move in a tick if nothing is in their way. One file each, one signature, one table.

mod euler;
mod rk4;
mod symplectic_euler;
mod verlet;

use crate::force::{Acceleration, Body, Field};
use crate::team::{GRAIN, Team};
use crate::{Balls, Vec2};

/// A scheme moves one ball over `dt` seconds.
trait Scheme {
    /// Position and velocity after `dt`.
    fn advance<A: Acceleration>(acceleration: &A, time: f64, dt: f64, body: Body) -> (Vec2, Vec2);
}

/// Moves all balls from `time` by `dt` seconds.
pub type Advance = fn(balls: &mut Balls, field: &Field, time: f64, dt: f64, team: &Team);

/// A registered integrator.
pub struct Integrator {
    /// Its name.
    pub name: &'static str,
    /// What it does.
    pub advance: Advance,
}

/// All integrators.
pub static TABLE: [Integrator; 4] = [
    Integrator {
        name: "euler",
        advance: advance::<euler::Euler>,
    },
    Integrator {
        name: "symplectic_euler",
        advance: advance::<symplectic_euler::SymplecticEuler>,
    },
    Integrator {
        name: "verlet",
        advance: advance::<verlet::Verlet>,
    },
    Integrator {
        name: "rk4",
        advance: advance::<rk4::RungeKutta4>,
    },
];

fn advance<S: Scheme>(balls: &mut Balls, field: &Field, time: f64, dt: f64, team: &Team) {
    match field {
        Field::None(none) => each::<S, _>(balls, none, time, dt, team),
        Field::Constant(constant) => each::<S, _>(balls, constant, time, dt, team),
        Field::Sum(sum) => each::<S, _>(balls, sum, time, dt, team),
    }
}

fn each<S: Scheme, A: Acceleration>(balls: &mut Balls, acceleration: &A, time: f64, dt: f64, team: &Team) {
    let count = balls.len();
    if A::ZERO {
        // All schemes agree on a straight line, and this loop reads no masses.
        let whole = (&mut balls.position[..], &balls.velocity[..]);
        team.each(whole, GRAIN, &|(positions, velocities)| {
            for (position, velocity) in positions.iter_mut().zip(velocities) {
                *position += *velocity * dt;
            }
        });
        return;
    }
    let whole = (
        &mut balls.position[..],
        &mut balls.velocity[..],
        &balls.mass[..],
        0..count,
    );
    team.each(whole, GRAIN, &|(positions, velocities, masses, indices)| {
        let moving = positions.iter_mut().zip(velocities).zip(masses).zip(indices);
        for (((position, velocity), &mass), index) in moving {
            let body = Body {
                index,
                mass,
                position: *position,
                velocity: *velocity,
            };
            (*position, *velocity) = S::advance(acceleration, time, dt, body);
        }
    });
}
