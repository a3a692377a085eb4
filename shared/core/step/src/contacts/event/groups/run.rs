//! Running the groups of a strip, or what the strips have left, one after the other.

use super::super::contact::Fate;
use super::super::piece::Piece;
use super::super::queue::Event;
use super::actors::{EARLY, WAITING};
use super::ground::{Beyond, Ground};
use super::set::{Done, Groups};
use crate::contacts::exchange::normal;

/// Why a group did not run to the end.
pub(super) enum Halt {
    /// It met another group: that of this actor.
    Met(usize),
    /// It met this actor of another strip.
    MetElsewhere(usize, usize),
    /// It has a ball that events which are not yet known may concern.
    Early,
    /// It leaves the strip.
    Leaves,
    /// A contact is about to rest, a number grows beyond all bounds, or there are too many events: that is for the order of
    /// all times.
    Stuck,
}

impl Groups {
    /// Runs all groups whose balls' events are known, and have not been seen to.
    pub(super) fn run(&mut self, ground: &Ground<'_>, beyond: &mut Beyond<'_>) {
        let mut woken = std::mem::take(&mut self.woken);
        std::mem::swap(&mut self.early, &mut woken);
        for &slot in &woken {
            let group = &mut self.actors.all[slot as usize].group;
            if *group == EARLY {
                *group = WAITING;
            }
        }
        for slot in woken.drain(..) {
            self.run_group_of(ground, beyond, slot as usize);
        }
        self.woken = woken;
        while self.seen < self.chains.events.len() {
            let first = self.chains.events[self.seen].first as usize;
            self.seen += 1;
            self.run_group_of(ground, beyond, first);
        }
    }

    /// Runs the group of an actor to its end, with all that it meets, unless it has run or waits.
    fn run_group_of(&mut self, ground: &Ground<'_>, beyond: &mut Beyond<'_>, first: usize) {
        if self.stuck || self.actors.all[first].group != WAITING {
            return;
        }
        self.begin_own();
        self.claim(ground, first);
        loop {
            let mut done = Done::default();
            match self.run_group(ground, beyond, &mut done) {
                Ok(()) => return self.close(done),
                Err(Halt::Met(slot)) => {
                    self.put_back_own(ground);
                    self.merge(ground, slot);
                }
                Err(Halt::MetElsewhere(strip, slot)) => {
                    self.put_back_own(ground);
                    self.merge_from(ground, beyond, strip, slot);
                }
                Err(Halt::Early) => return self.wait(ground),
                Err(Halt::Leaves) if matches!(beyond, Beyond::Closed(..)) => return self.defer(ground),
                Err(Halt::Leaves | Halt::Stuck) => {
                    self.stuck = true;
                    return;
                }
            }
        }
    }

    fn run_group(
        &mut self,
        ground: &Ground<'_>,
        beyond: &mut Beyond<'_>,
        done: &mut Done,
    ) -> Result<(), Halt> {
        if self.is_early {
            return Err(Halt::Early);
        }
        self.queue.clear();
        for &slot in &self.own {
            let actor = &self.actors.all[slot as usize];
            if actor.crosses {
                return Err(Halt::Leaves);
            }
            // The event of a pair is in two chains: it is taken from that of its first ball.
            for event in self.chains.of(actor).filter(|event| event.first == slot) {
                self.queue.push(*event);
            }
        }
        while let Some(event) = self.queue.next(&self.actors.hits) {
            done.events += 1;
            self.patience = self.patience.checked_sub(1).ok_or(Halt::Stuck)?;
            let first = event.first as usize;
            match event.partner.as_ball() {
                Some(second) => {
                    if let Some(hit) = self.bounce(ground, first, second, event.time)? {
                        done.collisions += u32::from(hit);
                        self.follow(ground, beyond, first)?;
                        self.follow(ground, beyond, second)?;
                    }
                }
                None => {
                    if let Some(hit) = self.bounce_off(ground, first, &event)? {
                        done.wall_hits += u32::from(hit);
                        self.follow(ground, beyond, first)?;
                    }
                }
            }
        }
        Ok(())
    }

    /// Two balls meet. None: nothing comes of it; else whether an impulse passes.
    fn bounce(
        &mut self,
        ground: &Ground<'_>,
        first: usize,
        second: usize,
        time: f64,
    ) -> Result<Option<bool>, Halt> {
        let (one, another) = (&self.actors.all[first], &self.actors.all[second]);
        let motion = ground.paths.motion;
        let pieces = (one.piece(ground.paths), another.piece(ground.paths));
        let (p1, v1) = pieces.0.at(motion, time);
        let (p2, v2) = pieces.1.at(motion, time);
        let hits = (self.actors.hits[first], self.actors.hits[second]);
        let bodies = [
            ground.body(one.ball as usize, &pieces.0, v1, hits.0, time),
            ground.body(another.ball as usize, &pieces.1, v2, hits.1, time),
        ];
        let Some(outcome) = ground.law.of_pair(normal(p1, p2), &bodies[0], &bodies[1]) else {
            return Ok(None);
        };
        if !matches!(outcome.fate, Fate::Bounce(_)) {
            return Err(Halt::Stuck);
        }
        let [w1, w2] = outcome.velocities;
        let after = [(first, p1, w1, &pieces.0), (second, p2, w2, &pieces.1)];
        for (slot, position, velocity, before) in after {
            let piece = Piece {
                since: time,
                position,
                velocity,
                curvature: before.curvature,
            };
            self.actors.turn(slot, &piece);
        }
        Ok(Some(outcome.hit))
    }

    /// A ball meets a wall; the rest is as for a pair.
    fn bounce_off(&mut self, ground: &Ground<'_>, slot: usize, event: &Event) -> Result<Option<bool>, Halt> {
        let Some(walls) = &ground.walls else {
            return Ok(None);
        };
        let actor = &self.actors.all[slot];
        let before = actor.piece(ground.paths);
        let (position, velocity) = before.at(ground.paths.motion, event.time);
        let hits = self.actors.hits[slot];
        let body = ground.body(actor.ball as usize, &before, velocity, hits, event.time);
        let wall = walls.wall(event.partner.as_wall());
        // Whether a ball touches no other decides about rest alone, which groups know nothing of.
        let Some(outcome) = ground.law.of_wall(&wall, &body, false) else {
            return Ok(None);
        };
        if !matches!(outcome.fate, Fate::Bounce(_)) {
            return Err(Halt::Stuck);
        }
        let piece = Piece {
            since: event.time,
            position,
            velocity: outcome.velocities,
            curvature: before.curvature,
        };
        self.actors.turn(slot, &piece);
        Ok(Some(outcome.hit))
    }
}
