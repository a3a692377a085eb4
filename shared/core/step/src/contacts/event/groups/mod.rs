//! Contact groups: collisions that share no ball do not wait for each other.
//!
//! Event order matters only between events that share a ball. So predicted events are taken in the order in which they
//! were found, that of the plane and of the memory, each with all that hang together with it: a group runs to the end of
//! the substep in time order, by a queue of its own. Where a new piece of path of one group meets any piece of path of
//! another, the two are not independent: both are put back to the start of the substep and run again as one. The result
//! is that of the order of all times, because a collision time is computed from two pieces of path alone.
//!
//! Batches of pairs are looked for, and predicted, just before the groups that begin with them run: what one reads, the
//! next finds in the cache. A group with a ball that later batches may know of waits for those.
//!
//! Strips of the plane run at once. In a strip are the balls that stay in it, however they are hit, unless they get
//! beyond a slack around the discs of their first paths; so balls of two strips never meet. Groups that need other balls
//! or more slack are left, and run after the strips, when they may meet, and take over, any group of theirs.

mod actors;
mod batches;
mod chains;
mod follow;
mod ground;
mod membership;
mod run;
mod set;
mod strips;

use super::contact::Law;
use super::first::List;
use super::paths::{Motion, Paths};
use super::piece::Piece;
use crate::contacts::{EVENT_LIMIT, Substep};
use crate::team::GRAIN;
use crate::walls::Walls;

use actors::{NONE, Whereabouts};
use batches::{BATCH, Batches};
use ground::{Beyond, Ground};
use set::{Groups, LEFT, Tally};
use strips::{Strip, Strips};

/// Balls of a strip, at least: narrow ones leave too much to be run after them.
const STRIP_GRAIN: usize = 4 * GRAIN;

/// Balls for each predicted event, at least: where there are fewer, groups meet so often that running them again costs
/// more than the order of all times.
const LEAST_ROOM: usize = 4;

/// The collisions of a substep, group by group.
pub(super) struct Grouped {
    /// Balls of a strip, at least.
    grain: usize,
    least_room: usize,
    /// There was too little room when somebody last looked. It decides about time alone, as both ways give the same.
    crowded: bool,
    strips: Strips,
    batches: Batches,
    whereabouts: Whereabouts,
    groups: Vec<Groups>,
    left: Groups,
}

impl Default for Grouped {
    fn default() -> Grouped {
        Grouped {
            least_room: LEAST_ROOM,
            batches: Batches::of(BATCH),
            ..Grouped::with_strips_of(STRIP_GRAIN)
        }
    }
}

impl Grouped {
    /// With strips of so many balls, at least, and for crowds, too.
    pub(super) fn with_strips_of(grain: usize) -> Grouped {
        Grouped {
            grain,
            least_room: 0,
            crowded: false,
            batches: Batches::of(grain.div_ceil(4)),
            strips: Strips::default(),
            whereabouts: Whereabouts::default(),
            groups: Vec::new(),
            left: Groups::default(),
        }
    }

    /// Runs all groups, to the end of the substep. False if the order of all times has to do it, for which nothing has
    /// changed: contacts at rest make everything hang together. Where it is true, all balls have finite places and
    /// velocities.
    pub(super) fn run(&mut self, paths: &Paths, substep: &mut Substep<'_>, walls: &[List]) -> bool {
        let suits = paths.motion == Motion::Straight || substep.rules.restitution() == 1.0;
        let count = substep.balls.len();
        if !suits || !paths.is_moderate || self.crowded || count >= LEFT as usize {
            return false;
        }
        let strips = substep.team.pieces().min(count.div_ceil(self.grain)).max(1);
        self.batches.lay_out(paths, substep, walls);
        let tally = self.run_strips(strips, paths, substep, walls);
        if let Some(tally) = tally {
            let events: usize = self.groups.iter().map(Groups::predicted).sum();
            self.note(count, events);
            substep.counters.collisions += tally.collisions;
            substep.counters.wall_hits += tally.wall_hits;
            self.end(paths, substep);
        }
        tally.is_some()
    }

    /// Notes how many collisions were predicted among so many balls.
    pub(super) fn note(&mut self, balls: usize, events: usize) {
        self.crowded = balls < self.least_room * events;
    }

    /// What the groups did, in so many strips; None if it was taken back.
    fn run_strips(
        &mut self,
        count: usize,
        paths: &Paths,
        substep: &mut Substep<'_>,
        walls: &[List],
    ) -> Option<Tally> {
        let balls = &*substep.balls;
        self.strips.lay_out(paths, balls, count);
        self.whereabouts.resize(balls.len());
        self.groups.resize_with(count, Groups::default);
        let ground = Ground {
            paths,
            balls,
            walls: Walls::of(substep.rules),
            law: Law::new(paths, substep.rules.restitution()),
            strips: &self.strips,
            whereabouts: &self.whereabouts,
            budget: substep.budget,
        };
        let broadphase = &*substep.broadphase;
        let batches = &self.batches;
        let whole = (&mut self.groups[..], 0..count);
        substep.team.each(whole, 1, &|(groups, numbers)| {
            for (groups, number) in groups.iter_mut().zip(numbers) {
                groups.begin(ground.strips.strip(number), number, 0);
                batches.run(groups, &ground, broadphase, walls);
            }
        });
        self.left.begin(Strip::ALL, count, LEFT);
        let mut stuck = self.groups.iter().any(|groups| groups.stuck);
        let mut tally = Tally::default();
        if !stuck {
            for groups in &self.groups {
                for event in &groups.deferred {
                    self.left.take(&ground, event);
                }
            }
            let mut beyond = Beyond::Open(&mut *substep.broadphase, &mut self.groups);
            self.left.run(&ground, &mut beyond);
            for groups in self.groups.iter().chain([&self.left]) {
                tally.add(&groups.total());
            }
            stuck = self.left.stuck || tally.events > EVENT_LIMIT || tally.pairs > substep.budget;
        }
        if stuck {
            for groups in self.groups.iter().chain([&self.left]) {
                groups.dismiss(&ground);
            }
        }
        (!stuck).then_some(tally)
    }

    /// Moves all balls to the end of the substep.
    fn end(&mut self, paths: &Paths, substep: &mut Substep<'_>) {
        let (strips, groups, left) = (&self.strips, &self.groups[..], &self.left);
        let last_piece = |ball: usize, actor: u32| -> Piece {
            if actor & LEFT != 0 {
                left.last_piece(paths, (actor & !LEFT) as usize)
            } else {
                groups[strips.of(paths.center[ball].y)].last_piece(paths, actor as usize)
            }
        };
        let balls = &mut *substep.balls;
        let indices = 0..balls.len();
        let state = (&mut balls.position[..], &mut balls.velocity[..]);
        let whole = (state, self.whereabouts.all(), indices);
        substep
            .team
            .each(whole, GRAIN, &|((positions, velocities), actors, indices)| {
                let balls = positions.iter_mut().zip(velocities);
                for (((position, velocity), actor), index) in balls.zip(actors).zip(indices) {
                    let at = actors::leave(actor);
                    let piece = if at == NONE {
                        paths.first_piece_of(index, *position, *velocity)
                    } else {
                        last_piece(index, at)
                    };
                    (*position, *velocity) = piece.at(paths.motion, paths.length);
                }
            });
    }
}
