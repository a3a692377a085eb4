//! The sum of a scene's forces for one tick, in the cheapest form that it has: none, constant, or a sum per ball.

use std::sync::Arc;

use super::{Body, Force, HeldNow};
use crate::{Balls, Vec2};

/// The acceleration that an integrator asks for; the compiler makes each integrator anew for each form.
pub trait Acceleration: Sync {
    /// Whether it is 0 always.
    const ZERO: bool;

    /// Acceleration of a ball.
    fn at(&self, time: f64, body: &Body) -> Vec2;
}

/// No force: integrators compile to a drift.
pub struct NoForce;

impl Acceleration for NoForce {
    const ZERO: bool = true;

    #[inline]
    fn at(&self, _time: f64, _body: &Body) -> Vec2 {
        Vec2::ZERO
    }
}

/// The same acceleration for all balls.
pub struct Constant(pub Vec2);

impl Acceleration for Constant {
    const ZERO: bool = false;

    #[inline]
    fn at(&self, _time: f64, _body: &Body) -> Vec2 {
        self.0
    }
}

/// The sum of the forces that act, in the order of the scene. Fixed balls feel none.
pub struct Sum {
    forces: Vec<Arc<dyn Force>>,
    held: HeldNow,
    constant: bool,
    elsewhere: Option<Constant>,
}

impl Sum {
    /// Whether every ball that is not fixed feels the same, everywhere and at all times.
    #[must_use]
    pub fn is_constant(&self) -> bool {
        self.constant
    }

    /// Balls that players thrust, by index, and the sum for all others, if that is the same for them all: to the bit,
    /// as what starts at 0 and has 0 added to it stays what it is.
    pub(crate) fn constant_but_for(&self) -> Option<(impl Iterator<Item = usize> + use<'_>, &Constant)> {
        let thrust = self.held.thrust.iter().map(|&(index, _)| index);
        self.elsewhere.as_ref().map(|elsewhere| (thrust, elsewhere))
    }
}

impl Acceleration for Sum {
    const ZERO: bool = false;

    #[inline]
    fn at(&self, time: f64, body: &Body) -> Vec2 {
        if body.mass.is_infinite() {
            return Vec2::ZERO;
        }
        self.forces.iter().fold(Vec2::ZERO, |sum, force| {
            sum + force.acceleration(time, body, &self.held)
        })
    }
}

/// The field of one tick.
pub enum Field {
    /// Nothing acts.
    None(NoForce),
    /// A constant acts on all balls, none of which is fixed.
    Constant(Constant),
    /// Anything else.
    Sum(Sum),
}

impl Field {
    /// The cheapest form for these forces, balls and held inputs: a function of the state, so that every machine
    /// chooses the same.
    #[must_use]
    pub fn new(forces: &[Arc<dyn Force>], balls: &Balls, held: HeldNow) -> Field {
        let acting: Vec<_> = forces.iter().filter(|force| force.acts(&held)).cloned().collect();
        if acting.is_empty() {
            return Field::None(NoForce);
        }
        let sum = |of: fn(&dyn Force) -> Option<Vec2>| {
            acting
                .iter()
                .try_fold(Vec2::ZERO, |sum, force| of(&**force).map(|one| sum + one))
        };
        let constant = sum(|force| force.constant());
        match constant {
            Some(acceleration) if !balls.any_fixed() => Field::Constant(Constant(acceleration)),
            _ => Field::Sum(Sum {
                constant: constant.is_some(),
                elsewhere: sum(|force| force.constant_elsewhere())
                    .filter(|_| !balls.any_fixed())
                    .map(Constant),
                forces: acting,
                held,
            }),
        }
    }
}
