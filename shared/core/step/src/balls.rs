//! The balls, as a structure of arrays. Their order in memory means nothing: see [`order`](crate::order).

use crate::order::Order;
use crate::team::{GRAIN, Team};
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

    /// Takes the balls `gone` out and puts `told` in, or right where they are already there; ids ascend in both. Balls that
    /// stay keep their place in memory as long as none comes and none goes.
    pub(crate) fn replace(&mut self, gone: &[u64], told: &[(u64, NewBall)]) {
        let missing = |&&(id, _): &&(u64, NewBall)| self.index_of(id).is_none();
        let comes = told.iter().any(|one| missing(&one));
        if comes || gone.iter().any(|&id| self.index_of(id).is_some()) {
            *self = self.merged(gone, told);
            return;
        }
        let mut same_shapes = true;
        for &(id, ball) in told {
            let index = self.index_of(id).expect("none is missing");
            self.position[index] = ball.position;
            self.velocity[index] = ball.velocity;
            same_shapes &= self.radius[index] == ball.radius && self.mass[index] == ball.mass;
            self.radius[index] = ball.radius;
            self.mass[index] = ball.mass;
        }
        if !same_shapes {
            self.uniform = self.find_uniform();
        }
    }

    /// A copy in id order, with `gone` taken out and `told` put in.
    fn merged(&self, gone: &[u64], told: &[(u64, NewBall)]) -> Balls {
        let mut merged = Balls::default();
        let mut told = told.iter().copied().peekable();
        let mut gone = gone.iter().copied().peekable();
        for index in self.by_id() {
            let id = self.id[index];
            while let Some((new, ball)) = told.next_if(|&(new, _)| new < id) {
                merged.push(new, ball);
            }
            while gone.next_if(|&other| other < id).is_some() {}
            let leaves = gone.peek() == Some(&id);
            if let Some((_, ball)) = told.next_if(|&(new, _)| new == id) {
                merged.push(id, ball);
            } else if !leaves {
                merged.push(id, self.ball(index));
            }
        }
        for (new, ball) in told {
            merged.push(new, ball);
        }
        merged
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

    /// Moves the balls in memory: the one from index `order[i]` is at index i afterwards. `spare` and `back` lend their
    /// memory.
    pub(crate) fn arrange(&mut self, order: &[u32], spare: &mut Vec<Vec2>, back: &mut Order, team: &Team) {
        debug_assert_eq!(order.len(), self.len());
        spare.resize(order.len(), Vec2::ZERO);
        for vectors in [&mut self.position, &mut self.velocity] {
            gather(spare, order, team, |index| vectors[index]);
            std::mem::swap(vectors, spare);
        }
        // In halves, which an f64 holds exactly, an id needs no memory of another kind.
        gather(spare, order, team, |index| {
            let id = self.id[index];
            Vec2::new(f64::from((id >> 32) as u32), f64::from(id as u32))
        });
        team.each((&mut self.id[..], &spare[..]), GRAIN, &|(ids, halves)| {
            for (id, half) in ids.iter_mut().zip(halves) {
                *id = (half.x as u64) << 32 | half.y as u64;
            }
        });
        if self.uniform.is_none() {
            gather(spare, order, team, |index| {
                Vec2::new(self.radius[index], self.mass[index])
            });
            let shapes = (&mut self.radius[..], &mut self.mass[..], &spare[..]);
            team.each(shapes, GRAIN, &|(radii, masses, shapes)| {
                for ((radius, mass), shape) in radii.iter_mut().zip(masses).zip(shapes) {
                    (*radius, *mass) = (shape.x, shape.y);
                }
            });
        }
        self.order.moved(back.invert(order), team);
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
    pub fn first_not_finite(&self, team: &Team) -> Option<u64> {
        let chunks = (&self.position[..], &self.velocity[..]);
        let fine =
            |(positions, velocities): (&[Vec2], &[Vec2])| are_finite(positions) & are_finite(velocities);
        if team.share(chunks, GRAIN, &fine, &|left, right| left & right) {
            return None;
        }
        self.by_id()
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

/// Puts what is at index `order[i]` into place i.
fn gather(places: &mut [Vec2], order: &[u32], team: &Team, from: impl Fn(usize) -> Vec2 + Sync) {
    team.each((places, order), GRAIN, &|(places, order)| {
        for (place, &index) in places.iter_mut().zip(order) {
            *place = from(index as usize);
        }
    });
}

/// Whether no number is infinite or NaN: 0 times such a one is NaN, and a sum with NaN is NaN.
pub(crate) fn are_finite(all: &[Vec2]) -> bool {
    let mut sums = [Vec2::ZERO; 4];
    let (fours, rest) = all.as_chunks::<4>();
    for four in fours {
        for (sum, &vector) in sums.iter_mut().zip(four) {
            *sum += vector * 0.0;
        }
    }
    let sum = rest
        .iter()
        .map(|&vector| vector * 0.0)
        .chain(sums)
        .fold(Vec2::ZERO, |a, b| a + b);
    sum.x == 0.0 && sum.y == 0.0
}
