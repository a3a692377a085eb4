//! Forces: what makes the acceleration a(t, S). One file each, one signature, one table.
//!
//! Each force acts on one ball at a time, so an integrator can carry a ball through all its stages at once.

mod attract;
mod attractor;
mod drag;
mod field;
mod gravity;
mod spring;
mod thrust;

pub use field::{Acceleration, Constant, Field, NoForce, Sum};

use std::fmt::Debug;
use std::sync::Arc;

use crate::error::Shown;
use crate::{Error, State, Vec2};

/// The ball that a force acts on.
#[derive(Clone, Copy, Debug)]
pub struct Body {
    /// Its index.
    pub index: usize,
    /// Its mass.
    pub mass: f64,
    /// Where it is.
    pub position: Vec2,
    /// How fast it moves.
    pub velocity: Vec2,
}

/// What the held inputs of this tick do.
#[derive(Clone, Debug, Default)]
pub struct HeldNow {
    /// (index of the ball, force), by index.
    pub thrust: Vec<(usize, Vec2)>,
    /// (point, strength).
    pub attract: Vec<(Vec2, f64)>,
}

impl HeldNow {
    /// Reads the held inputs of a state.
    #[must_use]
    pub fn of(state: &State) -> HeldNow {
        let mut now = HeldNow::default();
        for held in &state.held {
            match held.kind {
                crate::HeldKind::Thrust => {
                    if let Some(index) = state.own_ball(held.client) {
                        now.thrust.push((index, held.vector));
                    }
                }
                crate::HeldKind::Attract => now.attract.push((held.vector, held.strength)),
            }
        }
        now.thrust.sort_unstable_by_key(|&(index, _)| index);
        now
    }
}

/// A force of a scene.
pub trait Force: Debug + Send + Sync {
    /// Acceleration of a ball of finite mass at time `time`.
    fn acceleration(&self, time: f64, body: &Body, held: &HeldNow) -> Vec2;

    /// The same acceleration for every ball, everywhere, at all times; None if it is not.
    fn constant(&self) -> Option<Vec2> {
        None
    }

    /// The same for every ball but those of `HeldNow::thrust`; None if it is not.
    fn constant_elsewhere(&self) -> Option<Vec2> {
        self.constant()
    }

    /// Whether it can act at all while these inputs are held.
    fn acts(&self, _held: &HeldNow) -> bool {
        true
    }

    /// Potential energy of a ball; 0 where a force has none.
    fn potential(&self, _body: &Body, _held: &HeldNow) -> f64 {
        0.0
    }
}

type Make = fn(&[f64]) -> Result<Arc<dyn Force>, Error>;

/// A registered kind of force.
pub struct Kind {
    /// Its name.
    pub name: &'static str,
    /// Names of its numbers, in order.
    pub numbers: &'static [&'static str],
    make: Make,
}

/// All kinds of force.
pub const KINDS: [Kind; 6] = [
    gravity::KIND,
    drag::KIND,
    attractor::KIND,
    spring::KIND,
    thrust::KIND,
    attract::KIND,
];

/// Makes a force of the named kind.
///
/// # Errors
/// [`Error::Scene`] for an unknown kind, a wrong count of numbers, or a number out of bounds.
pub fn make(name: &str, numbers: &[f64]) -> Result<Arc<dyn Force>, Error> {
    let kind = KINDS.iter().find(|kind| kind.name == name).ok_or_else(|| {
        let known: Vec<_> = KINDS.iter().map(|kind| kind.name).collect();
        Error::Scene(format!(
            "force {name:?} is unknown; there are {}",
            known.join(", ")
        ))
    })?;
    if numbers.len() != kind.numbers.len() {
        return Err(Error::Scene(format!(
            "force {name:?} takes {} numbers ({}), {} were given",
            kind.numbers.len(),
            kind.numbers.join(", "),
            numbers.len()
        )));
    }
    if let Some((value, what)) = numbers
        .iter()
        .zip(kind.numbers)
        .find(|(value, _)| !value.is_finite())
    {
        return Err(Error::Scene(format!(
            "force {name:?}: {what} is {}, it must be finite",
            Shown(*value)
        )));
    }
    (kind.make)(numbers)
}

fn at_least_zero(force: &str, what: &str, value: f64) -> Result<f64, Error> {
    if value >= 0.0 {
        return Ok(value);
    }
    Err(Error::Scene(format!(
        "force {force:?}: {what} is {}, it must be at least 0",
        Shown(value)
    )))
}
