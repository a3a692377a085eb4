//! Regions: the balls whose centre lies in one node of a quadtree of fixed depth, packed to few bytes each.
//!
//! This is what a server says to those who look at a part of the box. It is no part of the step: numbers are rounded
//! here, to a bound that is told ([`Quanta`]).

#![forbid(unsafe_code)]

mod bits;
mod columns;
mod gather;
mod grid;
mod pack;
mod shapes;
mod unpack;

pub use gather::{Gathered, Gatherer};
pub use grid::{Grid, MOST_DEPTH};
pub use pack::pack;
pub use shapes::{MOST_SHAPES, Shape, Shapes};
pub use unpack::{Unpacked, unpack};

use std::fmt;

/// Steps of the grids that positions and velocities are rounded to: each coordinate is at most half a step off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quanta {
    /// In metres.
    pub position: f64,
    /// In metres per second.
    pub velocity: f64,
}

impl Quanta {
    /// Checked.
    ///
    /// # Errors
    /// [`Error`] for a step that is not above 0 and finite.
    pub fn new(position: f64, velocity: f64) -> Result<Quanta, Error> {
        for (name, step) in [("position", position), ("velocity", velocity)] {
            if !(step.is_normal() && step > 0.0) {
                return Err(Error(format!(
                    "{name} quantum {step}: must be above 0 and finite"
                )));
            }
        }
        Ok(Quanta { position, velocity })
    }
}

/// Why bytes are no region, or numbers no grid: names the thing, the value and the bound.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error(pub String);

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Error {}
