//! A ball before it is one of a world.

use crate::error::Shown;
use crate::{Error, Vec2};

/// A ball that is about to be added.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NewBall {
    /// Centre.
    pub position: Vec2,
    /// Velocity.
    pub velocity: Vec2,
    /// Radius, above zero.
    pub radius: f64,
    /// Mass, above zero; infinite for a fixed ball.
    pub mass: f64,
}

impl NewBall {
    /// Checks what every ball must satisfy.
    ///
    /// # Errors
    /// [`Error::Scene`] naming the number that is out of bounds.
    pub fn check(&self) -> Result<(), Error> {
        if !self.position.is_finite() || !self.velocity.is_finite() {
            return Err(Error::Scene(format!(
                "a ball's position {:?} and velocity {:?} must be finite",
                self.position, self.velocity
            )));
        }
        if !(self.radius > 0.0 && self.radius.is_finite()) {
            return Err(Error::Scene(format!(
                "a ball's radius is {}, it must be above 0 and finite",
                Shown(self.radius)
            )));
        }
        if !(self.mass > 0.0 && (self.mass.is_normal() || self.mass.is_infinite())) {
            return Err(Error::Scene(format!(
                "a ball's mass is {}, it must be above 0 and not subnormal (infinite = fixed)",
                Shown(self.mass)
            )));
        }
        Ok(())
    }
}
