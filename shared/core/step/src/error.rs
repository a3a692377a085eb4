//! The one error type. Each variant says what is wrong, the value, and the bound.

use std::fmt;

/// Why a world could not be made, restored or stepped. A world that fails a step stays at its last whole tick.
#[derive(Clone, Debug, PartialEq)]
pub enum Error {
    /// Rules or initial balls are out of bounds.
    Scene(String),
    /// A method is not registered, or two methods cannot be paired.
    Model(String),
    /// An input record is malformed.
    Input(String),
    /// Bytes of a snapshot, of rules or of a recording cannot be read.
    Snapshot(String),
    /// A position or velocity left the range of f64: the method is unstable in this scene.
    Diverged {
        /// The tick that could not be completed.
        tick: u64,
        /// Id of the lowest ball concerned.
        ball: u64,
    },
    /// One tick holds more collisions than [`crate::contacts::EVENT_LIMIT`] allows.
    EventLimit {
        /// The tick that could not be completed.
        tick: u64,
        /// The pair of ids that collided last; equal ids stand for a ball and a wall.
        pair: (u64, u64),
        /// Seconds into the tick.
        time: f64,
        /// The bound.
        limit: u64,
    },
    /// A tick wanted to look at more pairs than the caller gave it: the same tick everywhere.
    Budget {
        /// The tick that was not completed.
        tick: u64,
    },
}

/// A number as a message shows it: with an exponent where it would be a row of zeros.
pub(crate) struct Shown(pub f64);

impl fmt::Display for Shown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let size = self.0.abs();
        if size == 0.0 || (1e-4..1e6).contains(&size) || !size.is_finite() {
            write!(f, "{}", self.0)
        } else {
            write!(f, "{:e}", self.0)
        }
    }
}

impl Error {
    /// Name of the class that stands for this error in `kuglice.errors`.
    #[must_use]
    pub fn class(&self) -> &'static str {
        match self {
            Error::Scene(_) => "SceneError",
            Error::Model(_) => "ModelError",
            Error::Input(_) => "InputError",
            Error::Snapshot(_) => "SnapshotError",
            Error::Diverged { .. } => "DivergedError",
            Error::EventLimit { .. } => "EventLimitError",
            Error::Budget { .. } => "BudgetError",
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Error::Scene(what) | Error::Model(what) | Error::Input(what) | Error::Snapshot(what) => {
                f.write_str(what)
            }
            Error::Diverged { tick, ball } => write!(
                f,
                "tick {tick}: the position or velocity of ball {ball} is no longer finite; \
                 the method is unstable in this scene, take a shorter tick, more substeps or another integrator"
            ),
            Error::Budget { tick } => write!(
                f,
                "tick {tick}: its collisions have more pairs to look at than the budget of this step"
            ),
            Error::EventLimit {
                tick,
                pair: (low, high),
                time,
                limit,
            } => {
                let what = if low == high {
                    format!("ball {low} and a wall")
                } else {
                    format!("balls {low} and {high}")
                };
                write!(
                    f,
                    "tick {tick}: more than {limit} collisions, and sweeps over contacts at rest, in one tick, \
                     the last of {what} {} s into it",
                    Shown(*time)
                )
            }
        }
    }
}

impl std::error::Error for Error {}

#[cfg(test)]
mod tests {
    use super::Error;
    use crate::{NewBall, Vec2};

    #[test]
    fn tiny_and_huge_numbers_are_shown_with_an_exponent() {
        let ball = |mass| NewBall {
            position: Vec2::new(0.0, 0.0),
            velocity: Vec2::new(0.0, 0.0),
            radius: 1.0,
            mass,
        };
        for (mass, shown) in [
            (5e-320, "mass is 5e-320,"),
            (-1e300, "mass is -1e300,"),
            (0.0, "mass is 0,"),
            (-2.5, "mass is -2.5,"),
        ] {
            let told = ball(mass).check().unwrap_err().to_string();
            assert!(told.contains(shown), "{told}");
        }
    }

    #[test]
    fn a_time_within_a_tick_is_shown_briefly() {
        let at = |time| {
            Error::EventLimit {
                tick: 3,
                pair: (1, 1),
                time,
                limit: 9,
            }
            .to_string()
        };
        assert!(at(2.5e-12).ends_with("the last of ball 1 and a wall 2.5e-12 s into it"));
        assert!(at(0.0125).ends_with("0.0125 s into it"));
    }
}
