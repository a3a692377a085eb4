//! Contact treatments: what is done about balls that meet in a tick. One file each, one trait, one table.
//!
//! A treatment moves the balls over one substep, from its start to its end: where the collisions are put in time is
//! what treatments differ in.

mod backtrack;
mod event;
mod exchange;
mod overlap;
mod pairs;
mod root;

use crate::broadphase::Broadphase;
use crate::force::Field;
use crate::integrator::Integrator;
use crate::last::Last;
use crate::{Balls, Counters, Error, Rules, Team, Vec2};

pub(crate) use pairs::Pairs;
use pairs::Rule;

/// Most collisions in one tick; see [`Error::EventLimit`]. Unit tests jam balls on purpose, and have no time for as many.
pub const EVENT_LIMIT: u64 = if cfg!(test) { 40_000 } else { 4_000_000 };

/// All that a treatment works on.
pub struct Substep<'a> {
    /// The constants of the world.
    pub rules: &'a Rules,
    /// The balls.
    pub balls: &'a mut Balls,
    /// The counters.
    pub counters: &'a mut Counters,
    /// The forces.
    pub field: &'a Field,
    /// Moves the balls freely.
    pub integrator: &'static Integrator,
    /// Finds pairs.
    pub broadphase: &'a mut dyn Broadphase,
    /// Who does the work.
    pub team: &'a Team,
    /// The tick being made.
    pub tick: u64,
    /// Simulated time at the start.
    pub time: f64,
    /// Length in seconds.
    pub dt: f64,
    /// Pairs that `event` may look at in this substep; see [`Error::Budget`].
    pub budget: u64,
    /// Keeps what a failed tick goes back to.
    pub(crate) last: &'a mut Last,
    /// Set by a treatment that knows every number to be finite; else the world looks for itself.
    pub finite: &'a mut bool,
}

/// A contact treatment; what it keeps is scratch memory.
pub trait Contacts: Send + Sync {
    /// Whether it keeps the last tick itself, as it moves the balls; else that is done before.
    fn keeps_last(&self) -> bool {
        false
    }

    /// A vector per ball that nobody needs between ticks, where it has such memory.
    fn spare(&mut self) -> Option<&mut Vec<Vec2>> {
        None
    }

    /// Moves the balls over one substep, collisions included.
    ///
    /// # Errors
    /// [`Error::EventLimit`] or [`Error::Budget`]; the state is then to be thrown away.
    fn advance(&mut self, substep: &mut Substep<'_>) -> Result<(), Error>;
}

/// A registered treatment.
pub struct Kind {
    /// Its name.
    pub name: &'static str,
    /// Makes one.
    pub make: fn() -> Box<dyn Contacts>,
    /// The integrators that it can be paired with; None: all.
    pub integrators: Option<&'static [&'static str]>,
    /// Why not with others.
    pub reason: &'static str,
}

/// All treatments.
pub static TABLE: [Kind; 3] = [
    Kind {
        name: "overlap",
        make: || Box::new(overlap::Overlap::default()),
        integrators: None,
        reason: "",
    },
    Kind {
        name: "backtrack",
        make: || Box::new(backtrack::Backtrack::default()),
        integrators: None,
        reason: "",
    },
    Kind {
        name: "event",
        make: || Box::new(event::EventDriven::default()),
        integrators: Some(&["verlet"]),
        reason: "its path between collisions is the parabola of velocity Verlet",
    },
];
