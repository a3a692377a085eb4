//! Integrators: how balls move in a tick if nothing is in their way. One file each, one signature, one table.

mod euler;
mod rk4;
mod symplectic_euler;
mod verlet;

use crate::force::{Acceleration, Body, Constant, Field, Sum};
use crate::team::{GRAIN, Team};
use crate::{Balls, Vec2};

/// A scheme moves one ball over `dt` seconds.
trait Scheme {
    /// Position and velocity after `dt`.
    fn advance<A: Acceleration>(acceleration: &A, time: f64, dt: f64, body: Body) -> (Vec2, Vec2);
}

/// Balls that stand side by side in memory.
pub struct Bodies<'a> {
    /// The index of the first.
    pub start: usize,
    /// Centres.
    pub position: &'a mut [Vec2],
    /// Velocities.
    pub velocity: &'a mut [Vec2],
    /// Masses.
    pub mass: &'a [f64],
}

impl<'a> Bodies<'a> {
    /// Those before `index`, which is among these or just behind them, and the rest.
    fn split_at(self, index: usize) -> (Bodies<'a>, Bodies<'a>) {
        let middle = index - self.start;
        let (position, position_rest) = self.position.split_at_mut(middle);
        let (velocity, velocity_rest) = self.velocity.split_at_mut(middle);
        let (mass, mass_rest) = self.mass.split_at(middle);
        let first = Bodies {
            start: self.start,
            position,
            velocity,
            mass,
        };
        let rest = Bodies {
            start: index,
            position: position_rest,
            velocity: velocity_rest,
            mass: mass_rest,
        };
        (first, rest)
    }

    fn end(&self) -> usize {
        self.start + self.position.len()
    }
}

/// Moves balls from `time` by `dt` seconds.
pub type Advance = fn(bodies: Bodies<'_>, field: &Field, time: f64, dt: f64);

/// A registered integrator.
pub struct Integrator {
    /// Its name.
    pub name: &'static str,
    /// What it does.
    pub advance: Advance,
}

impl Integrator {
    /// Moves all balls of a world.
    pub fn advance_all(&self, balls: &mut Balls, field: &Field, time: f64, dt: f64, team: &Team) {
        let count = balls.len();
        let whole = (
            &mut balls.position[..],
            &mut balls.velocity[..],
            &balls.mass[..],
            0..count,
        );
        team.each(whole, GRAIN, &|(position, velocity, mass, indices)| {
            let bodies = Bodies {
                start: indices.start,
                position,
                velocity,
                mass,
            };
            (self.advance)(bodies, field, time, dt);
        });
    }
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

fn advance<S: Scheme>(bodies: Bodies<'_>, field: &Field, time: f64, dt: f64) {
    match field {
        Field::None(none) => each::<S, _>(bodies, none, time, dt),
        Field::Constant(constant) => each::<S, _>(bodies, constant, time, dt),
        Field::Sum(sum) => match sum.constant_but_for() {
            Some((thrust, elsewhere)) => all_but::<S>(thrust, bodies, (sum, elsewhere), time, dt),
            None => each::<S, _>(bodies, sum, time, dt),
        },
    }
}

/// The balls of `few`, by index, feel the sum, all others what is the same for them.
fn all_but<S: Scheme>(
    few: impl Iterator<Item = usize>,
    mut bodies: Bodies<'_>,
    (sum, elsewhere): (&Sum, &Constant),
    time: f64,
    dt: f64,
) {
    for index in few {
        if index < bodies.start {
            continue;
        }
        if index >= bodies.end() {
            break;
        }
        let (before, rest) = bodies.split_at(index);
        let (one, rest) = rest.split_at(index + 1);
        each::<S, _>(before, elsewhere, time, dt);
        each::<S, _>(one, sum, time, dt);
        bodies = rest;
    }
    each::<S, _>(bodies, elsewhere, time, dt);
}

fn each<S: Scheme, A: Acceleration>(bodies: Bodies<'_>, acceleration: &A, time: f64, dt: f64) {
    let moving = bodies.position.iter_mut().zip(bodies.velocity);
    if A::ZERO {
        // All schemes agree on a straight line, and this loop reads no masses.
        for (position, velocity) in moving {
            *position += *velocity * dt;
        }
        return;
    }
    for (((position, velocity), &mass), index) in moving.zip(bodies.mass).zip(bodies.start..) {
        let body = Body {
            index,
            mass,
            position: *position,
            velocity: *velocity,
        };
        (*position, *velocity) = S::advance(acceleration, time, dt, body);
    }
}

#[cfg(test)]
mod tests;
