//! The balls, as a structure of arrays. Their order in memory means nothing: see [`order`](crate::order).

mod arrange;
mod finite;
mod new_ball;
mod told;

use crate::order::Order;
use crate::{Error, Vec2};

pub(crate) use finite::are_finite;
pub use new_ball::NewBall;

/// Radius and mass that all balls share; where there is one, hot loops read neither array.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uniform {
    /// The common radius.
    pub radius: f64,
    /// The common mass.
    pub mass: f64,
}

/// All balls of a world, in an order of which nothing but speed may depend.
#[derive(Debug, Default)]
pub struct Balls {
    /// Centres.
    pub position: Vec<Vec2>,
    /// Velocities.
    pub velocity: Vec<Vec2>,
    /// Radii.
    pub radius: Vec<f64>,
    /// Masses; infinite for fixed balls.
    pub mass: Vec<f64>,
    /// Ids, never used twice.
    pub id: Vec<u64>,
    pub(crate) order: Order,
    uniform: Option<Uniform>,
}

impl PartialEq for Balls {
    fn eq(&self, other: &Balls) -> bool {
        let all = |balls: &Balls, index: usize| {
            (
                (balls.id[index], balls.position[index], balls.velocity[index]),
                (balls.radius[index], balls.mass[index]),
            )
        };
        self.len() == other.len()
            && self
                .by_id()
                .zip(other.by_id())
                .all(|(here, there)| all(self, here) == all(other, there))
    }
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
            order: self.order.clone(),
            uniform: self.uniform,
        }
    }

    fn clone_from(&mut self, source: &Balls) {
        let alike = source.uniform.is_some() && self.uniform == source.uniform && self.len() == source.len();
        self.position.clone_from(&source.position);
        self.velocity.clone_from(&source.velocity);
        if !alike {
            self.radius.clone_from(&source.radius);
            self.mass.clone_from(&source.mass);
        }
        self.id.clone_from(&source.id);
        self.order.clone_from(&source.order);
        self.uniform = source.uniform;
    }
}

impl Balls {
    /// Balls in the order of their ids, which ascend.
    ///
    /// # Errors
    /// [`Error::Scene`] naming the ball and its number that is out of bounds.
    pub(crate) fn from_columns(
        position: Vec<Vec2>,
        velocity: Vec<Vec2>,
        radius: Vec<f64>,
        mass: Vec<f64>,
        id: Vec<u64>,
    ) -> Result<Balls, Error> {
        let mut balls = Balls {
            position,
            velocity,
            radius,
            mass,
            id,
            ..Balls::default()
        };
        for (index, id) in balls.id.iter().enumerate() {
            (balls.ball(index).check()).map_err(|error| Error::Scene(format!("ball {id}: {error}")))?;
        }
        balls.uniform = balls.find_uniform();
        Ok(balls)
    }

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
        debug_assert!(self.by_id().next_back().is_none_or(|last| self.id[last] < id));
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
        self.order.push(self.id.len());
        self.id.push(id);
    }

    /// Removes the ball at `index`; those behind it move up.
    pub fn remove(&mut self, index: usize) {
        self.position.remove(index);
        self.velocity.remove(index);
        self.radius.remove(index);
        self.mass.remove(index);
        self.id.remove(index);
        self.order.remove(index);
        self.uniform = self.find_uniform();
    }

    fn ball(&self, index: usize) -> NewBall {
        NewBall {
            position: self.position[index],
            velocity: self.velocity[index],
            radius: self.radius[index],
            mass: self.mass[index],
        }
    }

    /// All indices, in the order of the ids.
    pub fn by_id(&self) -> impl DoubleEndedIterator<Item = usize> + ExactSizeIterator + Clone + '_ {
        (0..self.len()).map(|rank| self.order.index(rank))
    }

    /// The same, where index order is not id order.
    pub(crate) fn indices_by_id(&self) -> Option<&[u32]> {
        self.order.indices()
    }

    /// Whether index order is id order.
    #[must_use]
    pub fn is_by_id(&self) -> bool {
        self.order.is_by_id()
    }

    /// Two indices, that of the lower id first.
    #[inline]
    pub(crate) fn in_id_order(&self, first: usize, second: usize) -> (usize, usize) {
        let swap = if self.is_by_id() {
            first > second
        } else {
            self.id[first] > self.id[second]
        };
        // Without a branch: which of two neighbours is the older, no processor foresees.
        let flip = (first ^ second) & usize::from(swap).wrapping_neg();
        (first ^ flip, second ^ flip)
    }

    /// Where the ball with this id is stored.
    #[must_use]
    pub fn index_of(&self, id: u64) -> Option<usize> {
        let (mut low, mut high) = (0, self.len());
        while low < high {
            let middle = low.midpoint(high);
            if self.id[self.order.index(middle)] < id {
                low = middle + 1;
            } else {
                high = middle;
            }
        }
        (low < self.len())
            .then(|| self.order.index(low))
            .filter(|&index| self.id[index] == id)
    }

    /// Whether some ball is fixed.
    #[must_use]
    pub fn any_fixed(&self) -> bool {
        match self.uniform {
            Some(shape) => shape.mass.is_infinite(),
            None => self.mass.iter().any(|mass| mass.is_infinite()),
        }
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
