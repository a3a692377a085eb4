//! The last whole tick, for a step that fails to go back to.
//!
//! A tick without inputs changes nothing but counters, positions and velocities. Whoever moves the balls may keep
//! those as he goes, while they are in the nearest cache; and where no force acts, only the velocities that he replaces.

use crate::order::Order;
use crate::team::{Divide, GRAIN, Team};
use crate::{Balls, State, Vec2};

/// How much of the last tick is kept.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Kept {
    #[default]
    Counters,
    /// Positions, and the velocities that were replaced.
    Positions,
    Motion,
    Whole,
}

#[derive(Default)]
pub(crate) struct Last {
    state: State,
    kept: Kept,
    /// Index and velocity, the oldest first; a ball may be there more than once.
    replaced: Vec<(u32, Vec2)>,
}

/// Memory for what a tick is about to change.
pub(crate) struct Keeping<'a> {
    pub(crate) position: &'a mut [Vec2],
    /// Empty if velocities need not be kept.
    pub(crate) velocity: &'a mut [Vec2],
}

impl Divide for Keeping<'_> {
    fn length(&self) -> usize {
        self.position.len()
    }

    fn divide(self, at: usize) -> (Self, Self) {
        let position = self.position.split_at_mut(at);
        let velocity = self.velocity.split_at_mut(at.min(self.velocity.len()));
        (
            Keeping {
                position: position.0,
                velocity: velocity.0,
            },
            Keeping {
                position: position.1,
                velocity: velocity.1,
            },
        )
    }
}

impl Last {
    /// A tick begins: keeps all of the state, or for now only the counters.
    pub(crate) fn begin(&mut self, state: &State, whole: bool) {
        self.replaced.clear();
        if whole {
            self.state.clone_from(state);
            self.kept = Kept::Whole;
        } else {
            self.state.counters = state.counters;
            self.kept = Kept::Counters;
        }
    }

    /// Keeps all positions and velocities.
    pub(crate) fn keep(&mut self, balls: &Balls, team: &Team) {
        let Some(keeping) = self.lend(balls.len(), true) else {
            return;
        };
        let positions = (keeping.position, &balls.position[..]);
        let velocities = (keeping.velocity, &balls.velocity[..]);
        team.each((positions, velocities), GRAIN, &|(positions, velocities)| {
            positions.0.copy_from_slice(positions.1);
            velocities.0.copy_from_slice(velocities.1);
        });
    }

    /// Lends memory to whoever is about to move the balls, to be filled with the positions, and the `velocities` if all
    /// of them are going to change. None if they are kept already.
    pub(crate) fn lend(&mut self, count: usize, velocities: bool) -> Option<Keeping<'_>> {
        if self.kept != Kept::Counters {
            return None;
        }
        let to = &mut self.state.balls;
        to.position.resize(count, Vec2::ZERO);
        if velocities {
            self.kept = Kept::Motion;
            to.velocity.resize(count, Vec2::ZERO);
        } else {
            self.kept = Kept::Positions;
        }
        Some(Keeping {
            position: &mut to.position,
            velocity: if velocities { &mut to.velocity } else { &mut [] },
        })
    }

    /// The velocity of a ball is about to be replaced.
    #[inline]
    pub(crate) fn replaces(&mut self, index: usize, velocity: Vec2) {
        if self.kept == Kept::Positions {
            self.replaced.push((index as u32, velocity));
        }
    }

    /// Makes `state`, which was changed since the tick began, what it was.
    pub(crate) fn go_back(&mut self, state: &mut State) {
        if self.kept == Kept::Whole {
            std::mem::swap(state, &mut self.state);
            return;
        }
        state.counters = self.state.counters;
        let (balls, last) = (&mut state.balls, &mut self.state.balls);
        if self.kept != Kept::Counters {
            std::mem::swap(&mut balls.position, &mut last.position);
        }
        if self.kept == Kept::Motion {
            std::mem::swap(&mut balls.velocity, &mut last.velocity);
        }
        for (index, velocity) in self.replaced.drain(..).rev() {
            balls.velocity[index as usize] = velocity;
        }
    }

    /// Memory for anybody, between ticks.
    pub(crate) fn spare(&mut self) -> (&mut Vec<Vec2>, &mut Order) {
        let balls = &mut self.state.balls;
        (&mut balls.position, &mut balls.order)
    }
}
