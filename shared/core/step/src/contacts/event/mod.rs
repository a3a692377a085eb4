//! `event`: every collision inside the tick at its own time, in time order (event-driven hard discs, after Alder &
//! Wainwright 1959, doi 10.1063/1.1730376, cut at the ticks so that nothing but the state outlives one).
//!
//! Without forces, or under a constant acceleration, balls move along parabolas and all is exact but for rounding.
//! Under other forces a tick is kick - drift with collisions - kick; a hit at time t of a tick of length h exchanges
//! the velocities v + a (t - h/2) that the balls have there, which keeps second order across hits.
//!
//! Equal times are taken in order of (lower id, higher id), walls behind balls. What rounding leaves overlapping
//! collides at once if it approaches and is left alone if it recedes (Bannerman et al., arXiv 1211.6718). Contacts at
//! rest and collapse below restitution 1: see [`contact`].

mod contact;
mod paths;
mod predict;
mod queue;
mod rest;

use super::{Contacts, EVENT_LIMIT, Substep};
use crate::broadphase::{Discs, Found, Pair, Reach};
use crate::force::{Acceleration, Body, Field};
use crate::walls::Walls;
use crate::{Balls, Error, Vec2};

use contact::Law;
use paths::{Motion, Paths};
use queue::{Event, Queue};

#[derive(Default)]
pub(super) struct EventDriven {
    paths: Paths,
    queue: Queue,
    /// What is predicted at the start, by pieces of the work.
    predicted: Vec<Vec<Event>>,
    found: Found,
    near: Vec<u32>,
    /// Balls that the last event gave new paths.
    changed: Vec<usize>,
}

impl Contacts for EventDriven {
    fn advance(&mut self, substep: &mut Substep<'_>) -> Result<(), Error> {
        self.begin(substep);
        self.predict_all(substep);
        self.run(substep)?;
        self.end(substep);
        Ok(())
    }
}

impl EventDriven {
    fn begin(&mut self, substep: &mut Substep<'_>) {
        let balls = &mut *substep.balls;
        let (dt, elastic) = (substep.dt, substep.rules.restitution() == 1.0);
        match substep.field {
            Field::None(_) => self
                .paths
                .begin(balls, dt, Motion::Straight, elastic, |_| Vec2::ZERO),
            Field::Constant(field) => self.paths.begin(balls, dt, Motion::Curved, elastic, |_| field.0),
            Field::Sum(field) => {
                // Constant for all but fixed balls: still exact, by the slower roots.
                let motion = if field.is_constant() {
                    Motion::Curved
                } else {
                    Motion::Kicked
                };
                self.paths
                    .begin(balls, dt, motion, elastic, |body| field.at(substep.time, &body));
            }
        }
        if self.paths.motion == Motion::Kicked {
            for (velocity, acceleration) in balls.velocity.iter_mut().zip(&self.paths.acceleration) {
                *velocity += *acceleration * (0.5 * substep.dt);
            }
        }
        self.paths.sweep(balls, substep.team);
    }

    fn predict_all(&mut self, substep: &mut Substep<'_>) {
        let balls = &*substep.balls;
        let walls = Walls::of(substep.rules);
        let discs = Discs {
            center: &self.paths.center,
            reach: Reach::Each(&self.paths.reach),
        };
        substep.broadphase.build(&discs, substep.team);
        substep.broadphase.pairs(&discs, substep.team, &mut self.found);
        if self.paths.notes_touches() {
            for (first, second) in self.found.iter() {
                self.paths.note_touch(balls, first as usize, second as usize);
            }
        }
        let (paths, lists) = (&self.paths, self.found.lists());
        self.predicted.resize_with(lists.len(), Vec::new);
        let pieces = (&mut self.predicted[..], lists, 0..lists.len());
        let (count, parts) = (balls.len(), lists.len());
        substep.team.each(pieces, 1, &|(predicted, lists, parts_here)| {
            for ((events, list), part) in predicted.iter_mut().zip(lists).zip(parts_here) {
                predict_pairs(paths, balls, list, events);
                if let Some(walls) = &walls {
                    for index in count * part / parts..count * (part + 1) / parts {
                        if !walls.hold(paths.center[index], paths.reach[index]) {
                            predict_walls(paths, balls, walls, index, |event| events.push(event));
                        }
                    }
                }
            }
        });
        self.queue.begin(&mut self.predicted);
    }

    fn run(&mut self, substep: &mut Substep<'_>) -> Result<(), Error> {
        spend(substep, self.found.count())?;
        let walls = Walls::of(substep.rules);
        let law = Law::new(substep.rules.restitution(), substep.dt);
        let mut count = 0;
        while let Some(event) = self.queue.next(&self.paths.hits) {
            count += 1;
            if count + self.paths.supports.sweeps() > EVENT_LIMIT {
                return Err(event_limit(substep, &event));
            }
            spend(substep, 1)?;
            let first = event.first as usize;
            self.changed.clear();
            match event.partner.as_ball() {
                Some(second) => {
                    let (paths, changed) = (&mut self.paths, &mut self.changed);
                    let hit = law.pair(paths, substep.balls, (first, second), event.time, changed);
                    substep.counters.collisions += u64::from(hit);
                }
                None => {
                    let Some(wall) = walls.as_ref().map(|walls| walls.wall(event.partner.as_wall())) else {
                        continue;
                    };
                    let (paths, changed) = (&mut self.paths, &mut self.changed);
                    let hit = law.wall(paths, substep.balls, first, &wall, event.time, changed);
                    substep.counters.wall_hits += u64::from(hit);
                }
            }
            for at in 0..self.changed.len() {
                self.predict_again(substep, walls.as_ref(), self.changed[at]);
                spend(substep, self.near.len())?;
            }
        }
        Ok(())
    }

    /// Puts a ball that was hit elsewhere in the tree and predicts its next collisions.
    fn predict_again(&mut self, substep: &mut Substep<'_>, walls: Option<&Walls>, index: usize) {
        let balls = &*substep.balls;
        self.paths.sweep_one(balls, index);
        let (center, reach) = (self.paths.center[index], self.paths.reach[index]);
        substep.broadphase.relocate(index, center, reach);
        self.near.clear();
        substep.broadphase.query(center, reach, &mut self.near);
        for &other in &self.near {
            let other = other as usize;
            if other == index {
                continue;
            }
            let (first, second) = balls.in_id_order(index, other);
            if let Some(time) = predict::pair(&self.paths, balls, first, second) {
                let event = Event::of_pair(time, first, second, balls, &self.paths.hits);
                self.queue.push(event);
            }
        }
        if let Some(walls) = walls
            && !walls.hold(center, reach)
        {
            let queue = &mut self.queue;
            predict_walls(&self.paths, balls, walls, index, |event| queue.push(event));
        }
    }

    fn end(&mut self, substep: &mut Substep<'_>) {
        let balls = &mut *substep.balls;
        self.paths.end(balls, substep.team);
        if let (Motion::Kicked, Field::Sum(field)) = (self.paths.motion, substep.field) {
            let (time, half) = (substep.time + substep.dt, 0.5 * substep.dt);
            for index in 0..balls.len() {
                let first = self.paths.kicks[index];
                let kept = self.paths.acceleration[index];
                // As in velocity Verlet: a force of velocity sees the velocity that the first kick predicts.
                let body = Body {
                    index,
                    mass: balls.mass[index],
                    position: balls.position[index],
                    velocity: balls.velocity[index] + kept * half,
                };
                // What a resting contact has taken from the first kick, it takes from the second.
                let taken = first - kept;
                balls.velocity[index] += (field.at(time, &body) - taken) * half;
            }
            for &(index, velocity) in &self.paths.deferred {
                balls.velocity[index] += velocity;
            }
        }
    }
}

fn predict_walls(paths: &Paths, balls: &Balls, walls: &Walls, index: usize, mut add: impl FnMut(Event)) {
    for number in 0..4 {
        if let Some(time) = predict::wall(paths, balls, index, &walls.wall(number)) {
            add(Event::of_wall(time, index, number, balls, &paths.hits));
        }
    }
}

fn predict_pairs(paths: &Paths, balls: &Balls, pairs: &[Pair], events: &mut Vec<Event>) {
    for &(first, second) in pairs {
        let (first, second) = balls.in_id_order(first as usize, second as usize);
        if let Some(time) = predict::pair(paths, balls, first, second) {
            events.push(Event::of_pair(time, first, second, balls, &paths.hits));
        }
    }
}

/// Takes so many pairs from what the tick was given.
fn spend(substep: &mut Substep<'_>, pairs: usize) -> Result<(), Error> {
    match substep.budget.checked_sub(pairs as u64) {
        Some(left) => {
            *substep.budget = left;
            Ok(())
        }
        None => Err(Error::Budget { tick: substep.tick }),
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
