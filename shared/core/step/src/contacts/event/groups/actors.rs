//! The balls of collisions, with all that happens to them in a substep. They are few, and near each other in memory; the
//! balls of the world are left alone until the substep ends, so that whatever was done can be done again.

use std::sync::atomic::{AtomicU32, Ordering};

use super::super::paths::Paths;
use super::super::piece::{Piece, Start};
use super::super::predict;
use super::super::queue::Party;
use crate::Balls;

pub(super) const NONE: u32 = u32::MAX;
/// No group has this number: it has not run yet.
pub(super) const WAITING: u32 = u32::MAX;
/// Nor this one: it is left for after the strips.
pub(super) const DEFERRED: u32 = u32::MAX - 1;
/// Nor this one: it waits for events that are not yet known.
pub(super) const EARLY: u32 = u32::MAX - 2;

/// For each ball, its actor. A strip's threads write to the places of the balls in it, and take what others write for
/// nothing.
#[derive(Default)]
pub(super) struct Whereabouts(Vec<AtomicU32>);

impl Whereabouts {
    pub(super) fn resize(&mut self, balls: usize) {
        self.0.resize_with(balls, || AtomicU32::new(NONE));
    }

    pub(super) fn all(&self) -> &[AtomicU32] {
        &self.0
    }

    #[inline]
    pub(super) fn get(&self, ball: usize) -> u32 {
        self.0[ball].load(Ordering::Relaxed)
    }

    #[inline]
    pub(super) fn set(&self, ball: usize, actor: u32) {
        self.0[ball].store(actor, Ordering::Relaxed);
    }
}

/// Takes a ball back among those that are no actors; says which it was.
#[inline]
pub(super) fn leave(place: &AtomicU32) -> u32 {
    let actor = place.load(Ordering::Relaxed);
    if actor != NONE {
        place.store(NONE, Ordering::Relaxed);
    }
    actor
}

/// One of them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Actor {
    /// Of the piece of path that it is on now.
    start: Start,
    /// How far from the centre of its first disc it was taken to be, when it was relocated; 0 before.
    pub(super) far: f64,
    id: u64,
    pub(super) ball: u32,
    pub(super) group: u32,
    /// The first of its predicted events.
    pub(super) links: u32,
    /// Its last ended piece, the first one apart.
    ended: u32,
    /// It has events with balls beyond the strip.
    pub(super) crosses: bool,
}

impl Actor {
    /// The piece of path that it is on now.
    #[inline]
    pub(super) fn piece(&self, paths: &Paths) -> Piece {
        self.start.bent(paths.curvature(self.ball as usize))
    }
}

/// A piece of path that has ended.
#[derive(Clone, Copy, Debug)]
struct Ended {
    start: Start,
    until: f64,
    /// The one before it.
    before: u32,
}

#[derive(Default)]
pub(super) struct Actors {
    pub(super) all: Vec<Actor>,
    /// How often each was hit.
    pub(super) hits: Vec<u32>,
    ended: Vec<Ended>,
}

impl Actors {
    pub(super) fn clear(&mut self) {
        self.all.clear();
        self.hits.clear();
        self.ended.clear();
    }

    /// Makes a ball an actor.
    pub(super) fn enlist(&mut self, paths: &Paths, balls: &Balls, ball: usize) -> usize {
        self.all.push(Actor {
            start: paths.first_piece(balls, ball).start(),
            far: 0.0,
            id: balls.id[ball],
            ball: ball as u32,
            group: WAITING,
            links: NONE,
            ended: NONE,
            crosses: false,
        });
        self.hits.push(0);
        self.all.len() - 1
    }

    /// One of them, as its events see it.
    #[inline]
    pub(super) fn party(&self, slot: usize) -> Party {
        Party {
            index: slot,
            id: self.all[slot].id,
            hits: self.hits[slot],
        }
    }

    /// Begins a new piece of path.
    pub(super) fn turn(&mut self, slot: usize, piece: &Piece) {
        let (actor, hits) = (&mut self.all[slot], &mut self.hits[slot]);
        if *hits > 0 {
            let ended = Ended {
                start: actor.start,
                until: piece.since,
                before: actor.ended,
            };
            actor.ended = self.ended.len() as u32;
            self.ended.push(ended);
        }
        actor.start = piece.start();
        *hits = hits.wrapping_add(1);
    }

    /// Takes back all that has happened to it.
    pub(super) fn put_back(&mut self, paths: &Paths, balls: &Balls, slot: usize) {
        let actor = &mut self.all[slot];
        if self.hits[slot] > 0 {
            actor.start = paths.first_piece(balls, actor.ball as usize).start();
            actor.ended = NONE;
            self.hits[slot] = 0;
        }
        actor.group = WAITING;
    }

    /// Whether the piece of path that a ball is on now meets any piece of this one's path. The first one counts whole,
    /// though a hit has cut it: should that be taken back, nobody would look at the rest again.
    pub(super) fn meet(&self, paths: &Paths, balls: &Balls, now: (usize, &Piece), slot: usize) -> bool {
        let actor = &self.all[slot];
        let ball = actor.ball as usize;
        let curvature = paths.curvature(ball);
        let meets = |start: &Start| meeting(paths, balls, now, (ball, &start.bent(curvature)));
        if meets(&paths.first_piece(balls, ball).start()).is_some() {
            return true;
        }
        if self.hits[slot] == 0 {
            return false;
        }
        if meets(&actor.start).is_some() {
            return true;
        }
        let mut at = actor.ended;
        while at != NONE {
            let ended = &self.ended[at as usize];
            if ended.until < now.1.since {
                return false;
            }
            if meets(&ended.start).is_some_and(|time| time <= ended.until) {
                return true;
            }
            at = ended.before;
        }
        false
    }
}

/// When two balls on these pieces of path meet, in whatever order they are given.
#[inline]
pub(super) fn meeting(
    paths: &Paths,
    balls: &Balls,
    one: (usize, &Piece),
    other: (usize, &Piece),
) -> Option<f64> {
    // Between equal accelerations the order does not show in the time, and ids are far away in memory.
    let swap = one.1.curvature != other.1.curvature && balls.in_id_order(one.0, other.0).0 != one.0;
    let (first, second) = if swap { (other, one) } else { (one, other) };
    predict::pieces_of(paths, balls, (first.0, second.0), (first.1, second.1))
}
