//! The balls, as a structure of arrays in id order.

use crate::{Error, Vec2};

/// Radius and mass that all balls share; where there is one, hot loops read neither array.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uniform {
    /// The common radius.
    pub radius: f64,
    /// The common mass.
    pub mass: f64,
}

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
                self.radius
            )));
        }
        if !(self.mass > 0.0 && (self.mass.is_normal() || self.mass.is_infinite())) {
            return Err(Error::Scene(format!(
                "a ball's mass is {}, it must be above 0 (infinite = fixed)",
                self.mass
            )));
        }
        Ok(())
    }
}

/// All balls of a world. Index order is id order.
#[derive(Debug, Default, PartialEq)]
pub struct Balls {
    /// Centres.
    pub position: Vec<Vec2>,
    /// Velocities.
    pub velocity: Vec<Vec2>,
    /// Radii.
    pub radius: Vec<f64>,
    /// Masses; infinite for fixed balls.
    pub mass: Vec<f64>,
    /// Ids, ascending, never used twice.
    pub id: Vec<u64>,
    uniform: Option<Uniform>,
}

// Written out so that clone_from keeps the memory that is there: rollback copies a world many times a second.
impl Clone for Balls {
    fn clone(&self) -> Balls {
        Balls {
            position: self.position.clone(),
            velocity: self.velocity.clone(),
            radius: self.radius.clone(),
            mass: self.mass.clone(),
            id: self.id.clone(),
            uniform: self.uniform,
        }
    }

    fn clone_from(&mut self, source: &Balls) {
        self.position.clone_from(&source.position);
        self.velocity.clone_from(&source.velocity);
        self.radius.clone_from(&source.radius);
        self.mass.clone_from(&source.mass);
        self.id.clone_from(&source.id);
        self.uniform = source.uniform;
    }
}

impl Balls {
    /// Number of balls.
    #[must_use]
    pub fn len(&self) -> usize {
        self.id.len()
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.id.is_empty()
    }

    /// The common radius and mass, if all balls share them.
    #[must_use]
    pub fn uniform(&self) -> Option<Uniform> {
        self.uniform
    }

    /// Adds a ball; `id` must be above all ids present.
    pub fn push(&mut self, id: u64, ball: NewBall) {
        debug_assert!(self.id.last().is_none_or(|&last| last < id));
        let shape = Uniform {
            radius: ball.radius,
            mass: ball.mass,
        };
        if self.is_empty() {
            self.uniform = Some(shape);
        } else if self.uniform != Some(shape) {
            self.uniform = None;
        }
        self.position.push(ball.position);
        self.velocity.push(ball.velocity);
        self.radius.push(ball.radius);
        self.mass.push(ball.mass);
        self.id.push(id);
    }

    /// Removes the ball at `index`, keeping id order.
    pub fn remove(&mut self, index: usize) {
        self.position.remove(index);
        self.velocity.remove(index);
        self.radius.remove(index);
        self.mass.remove(index);
        self.id.remove(index);
        self.uniform = self.find_uniform();
    }

    /// Where the ball with this id is stored.
    #[must_use]
    pub fn index_of(&self, id: u64) -> Option<usize> {
        self.id.binary_search(&id).ok()
    }

    /// Whether some ball is fixed.
    #[must_use]
    pub fn any_fixed(&self) -> bool {
        match self.uniform {
            Some(shape) => shape.mass.is_infinite(),
            None => self.mass.iter().any(|mass| mass.is_infinite()),
        }
    }

    /// Id of the first ball whose position or velocity is not finite.
    #[must_use]
    pub fn first_not_finite(&self) -> Option<u64> {
        let both = |all: &[Vec2]| {
            all.iter()
                .fold(true, |fine, v| fine & v.x.is_finite() & v.y.is_finite())
        };
        if both(&self.position) && both(&self.velocity) {
            return None;
        }
        (0..self.len())
            .find(|&i| !(self.position[i].is_finite() && self.velocity[i].is_finite()))
            .map(|i| self.id[i])
    }

    fn find_uniform(&self) -> Option<Uniform> {
        let shape = Uniform {
            radius: *self.radius.first()?,
            mass: *self.mass.first()?,
        };
        let same =
            self.radius.iter().all(|&r| r == shape.radius) && self.mass.iter().all(|&m| m == shape.mass);
        same.then_some(shape)
    }
}
