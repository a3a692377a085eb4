//! `event`: every collision inside the tick at its own time, in time order (event-driven hard discs, after Alder &
//! Wainwright 1959, doi 10.1063/1.1730376, cut at the ticks so that nothing but the state outlives one).
//!
//! Without forces, or under a constant acceleration, balls move along parabolas and all is exact but for rounding.
//! Under other forces they move along the parabolas of what they feel at the start, and at the end half of what has
//! changed since is made up for: velocity Verlet, with collisions on the way.
//!
//! Equal times are taken in order of (lower id, higher id), walls behind balls. What rounding leaves overlapping
//! collides at once if it approaches and is left alone if it recedes (Bannerman et al., arXiv 1211.6718). Contacts at
//! rest and collapse below restitution 1: see [`contact`].

mod budget;
mod collide;
mod contact;
mod first;
mod groups;
mod paths;
mod piece;
mod predict;
mod queue;
mod rest;
mod sequence;
mod strike;
mod sweep;
#[cfg(test)]
mod tests;

use super::{Contacts, EVENT_LIMIT, Substep};
use crate::force::{Acceleration, Body, Field};
use crate::team::GRAIN;
use crate::walls::Walls;
use crate::{Balls, Error, Vec2};

use budget::Budget;
use first::First;
use groups::Grouped;
use paths::{Paths, Pull};
use piece::{Piece, radius};
use queue::{Event, Party};
use sequence::Sequence;

pub(super) struct EventDriven {
    paths: Paths,
    first: First,
    /// None: all in sequence.
    grouped: Option<Grouped>,
    sequence: Sequence,
}

impl Default for EventDriven {
    fn default() -> EventDriven {
        EventDriven::new(Some(Grouped::default()))
    }
}

impl Contacts for EventDriven {
    fn keeps_last(&self) -> bool {
        true
    }

    fn spare(&mut self) -> Option<&mut Vec<Vec2>> {
        Some(&mut self.paths.center)
    }

    fn advance(&mut self, substep: &mut Substep<'_>) -> Result<(), Error> {
        self.begin(substep);
        self.first.prepare(&mut self.paths, substep);
        if self.paths.varies {
            substep.last.keep(substep.balls, substep.team);
        }
        if let Some(grouped) = &mut self.grouped
            && grouped.run(&self.paths, substep, self.first.walls())
        {
            *substep.finite = !self.paths.varies;
            self.make_up(substep);
            return Ok(());
        }
        *substep.finite = false;
        self.first.predict(&mut self.paths, substep);
        let mut budget = Budget::new(substep.tick, substep.budget);
        budget.spend(self.first.overlapping(&self.paths))?;
        if let Some(grouped) = &mut self.grouped {
            grouped.note(substep.balls.len(), self.first.events());
        }
        substep.last.keep(substep.balls, substep.team);
        self.sequence
            .run(&mut self.paths, substep, &mut budget, self.first.lists_mut())?;
        self.paths.end(substep.balls, substep.team);
        self.make_up(substep);
        Ok(())
    }
}

impl EventDriven {
    fn new(grouped: Option<Grouped>) -> EventDriven {
        EventDriven {
            paths: Paths::default(),
            first: First::default(),
            grouped,
            sequence: Sequence::default(),
        }
    }

    fn begin(&mut self, substep: &mut Substep<'_>) {
        let balls = &*substep.balls;
        let (dt, elastic, team) = (substep.dt, substep.rules.restitution() == 1.0, substep.team);
        match substep.field {
            Field::None(_) => self
                .paths
                .begin(balls, (dt, elastic), Pull::None, team, |_| Vec2::ZERO),
            Field::Constant(field) => {
                self.paths
                    .begin(balls, (dt, elastic), Pull::Common(field.0), team, |_| field.0)
            }
            Field::Sum(field) => {
                // Constant for all but fixed balls: still exact, by the slower roots.
                let pull = if field.is_constant() {
                    Pull::Constant
                } else {
                    Pull::Varying
                };
                self.paths.begin(balls, (dt, elastic), pull, team, |body| {
                    field.at(substep.time, &body)
                });
            }
        }
    }

    /// Gives balls that have come to the end half of what their accelerations have changed by.
    fn make_up(&self, substep: &mut Substep<'_>) {
        let (true, Field::Sum(field)) = (self.paths.varies, substep.field) else {
            return;
        };
        let (time, half) = (substep.time + substep.dt, 0.5 * substep.dt);
        let balls = &mut *substep.balls;
        let whole = (&mut balls.velocity[..], 0..balls.position.len());
        let (positions, masses) = (&balls.position[..], &balls.mass[..]);
        substep.team.each(whole, GRAIN, &|(velocities, indices)| {
            for (velocity, index) in velocities.iter_mut().zip(indices) {
                // A force of velocity sees the one that its own start predicts.
                let body = Body {
                    index,
                    mass: masses[index],
                    position: positions[index],
                    velocity: *velocity,
                };
                *velocity += (field.at(time, &body) - self.paths.pulls[index]) * half;
            }
        });
    }
}

/// Shows the collisions of a ball on this piece of path with the walls.
fn predict_walls(
    paths: &Paths,
    balls: &Balls,
    walls: &Walls,
    index: usize,
    (piece, party): (&Piece, Party),
    mut show: impl FnMut(Event),
) {
    for number in 0..4 {
        let wall = walls.wall(number);
        if let Some(time) = predict::wall(paths.length, radius(balls, index), piece, &wall) {
            show(Event::of_wall(time, party, number));
        }
    }
}

#[cold]
fn event_limit(substep: &Substep<'_>, event: &Event) -> Error {
    let id = &substep.balls.id;
    let first = id[event.first as usize];
    let second = event.partner.as_ball().map_or(first, |second| id[second]);
    Error::EventLimit {
        tick: substep.tick,
        pair: (first, second),
        time: event.time,
        limit: EVENT_LIMIT,
    }
}
