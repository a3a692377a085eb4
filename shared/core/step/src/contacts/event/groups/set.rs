//! The groups of a strip, and what they are made of.

use super::super::first::List;
use super::super::paths::Paths;
use super::super::piece::Piece;
use super::super::queue::{Event, Queue};
use super::actors::{Actors, NONE};
use super::chains::Chains;
use super::ground::Ground;
use super::strips::Strip;
use crate::broadphase::{Broadphase, Pair, Part};

/// The mark of what the strips have left.
pub(super) const LEFT: u32 = 1 << 31;

/// Events that are done, again or not, for each that was predicted, before the order of all times costs less.
const PATIENCE: u64 = 3;
/// The same, whatever was predicted.
const LEAST_PATIENCE: u64 = 1000;

/// What groups did; counted once nobody can take it back.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Tally {
    pub(super) events: u64,
    /// No fewer than events were done, and pairs looked at, by the count of [`super::super::budget`].
    pub(super) pairs: u64,
    pub(super) collisions: u64,
    pub(super) wall_hits: u64,
}

impl Tally {
    pub(super) fn add(&mut self, other: &Tally) {
        self.events += other.events;
        self.pairs += other.pairs;
        self.collisions += other.collisions;
        self.wall_hits += other.wall_hits;
    }
}

/// What a single group did: there are as many as a tenth of all balls.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Done {
    /// No more than the patience of all.
    pub(super) events: u32,
    pub(super) collisions: u32,
    pub(super) wall_hits: u32,
}

/// One of them.
pub(super) struct Group {
    /// Where its members are.
    pub(super) members: (u32, u32),
    pub(super) done: Done,
}

/// The groups of a strip.
#[derive(Default)]
pub(super) struct Groups {
    pub(super) strip: Strip,
    pub(super) number: usize,
    /// In whereabouts, set in the numbers of these actors.
    pub(super) mark: u32,
    pub(super) actors: Actors,
    pub(super) chains: Chains,
    pub(super) groups: Vec<Group>,
    pub(super) members: Vec<u32>,
    /// Members of the group that runs.
    pub(super) own: Vec<u32>,
    /// Actors that the group is built from again.
    pub(super) seeds: Vec<u32>,
    pub(super) queue: Queue,
    pub(super) near: Vec<u32>,
    /// Events, of balls, that are left for after the strips.
    pub(super) deferred: Vec<Event>,
    /// All events of balls below this height are among the predicted ones.
    pub(super) known: f64,
    /// The group that runs has a ball above it.
    pub(super) is_early: bool,
    /// How many of the predicted events have been seen to.
    pub(super) seen: usize,
    /// Actors of groups that wait for what is not yet known.
    pub(super) early: Vec<u32>,
    pub(super) woken: Vec<u32>,
    /// What a batch found, and predicted.
    found: Vec<Pair>,
    list: List,
    /// How many more events may be done.
    pub(super) patience: u64,
    /// Pairs that were looked at, taken back or not.
    pub(super) looked_at: u64,
    /// The order of all times has to do it.
    pub(super) stuck: bool,
}

impl Groups {
    pub(super) fn begin(&mut self, strip: Strip, number: usize, mark: u32) {
        (self.strip, self.number, self.mark) = (strip, number, mark);
        self.actors.clear();
        self.chains.clear();
        self.groups.clear();
        self.members.clear();
        self.deferred.clear();
        self.early.clear();
        self.known = f64::INFINITY;
        self.seen = 0;
        self.patience = LEAST_PATIENCE;
        self.looked_at = 0;
        self.stuck = false;
    }

    /// Takes in a predicted event of balls, if it is one of this strip.
    pub(super) fn take(&mut self, ground: &Ground<'_>, event: &Event) {
        let (first, second) = (event.first as usize, event.partner.as_ball());
        let number = self.number;
        let is_here = |ball: usize| ground.strips.of(ground.paths.center[ball].y) == number;
        let is_marked = self.mark == LEFT;
        if !is_marked && !is_here(first) && !second.is_some_and(is_here) {
            return;
        }
        let whole = self.holds(ground, first) && second.is_none_or(|ball| self.holds(ground, ball));
        if whole {
            let first = self.find_or_enlist(ground, first);
            let second = second.map(|ball| self.find_or_enlist(ground, ball));
            self.chains.add(event.between(first, second), &mut self.actors);
            self.patience = (self.patience + PATIENCE).min(u64::from(u32::MAX));
            return;
        }
        if is_marked {
            // Not a place at all.
            self.stuck = true;
            return;
        }
        for ball in std::iter::once(first).chain(second) {
            if self.holds(ground, ball) {
                let slot = self.find_or_enlist(ground, ball);
                self.actors.all[slot].crosses = true;
            }
        }
        if is_here(first) {
            self.deferred.push(*event);
        }
    }

    /// Takes in those events of a list that are of this strip.
    pub(super) fn take_all(&mut self, ground: &Ground<'_>, list: &List) {
        for event in &list.events {
            self.take(ground, event);
        }
    }

    /// The same for what a part of the search finds.
    pub(super) fn search(&mut self, ground: &Ground<'_>, broadphase: &dyn Broadphase, part: Part) {
        let mut list = std::mem::take(&mut self.list);
        self.found.clear();
        broadphase.pairs_of(&ground.paths.discs(), part, &mut self.found);
        self.looked_at += self.found.len() as u64;
        list.predict(ground.paths, ground.balls, &self.found);
        self.take_all(ground, &list);
        self.list = list;
    }

    /// How many events were predicted.
    pub(super) fn predicted(&self) -> usize {
        self.chains.events.len() + self.deferred.len()
    }

    /// Whether a ball stays in the strip, however it is hit, unless it is relocated.
    #[inline]
    pub(super) fn holds(&self, ground: &Ground<'_>, ball: usize) -> bool {
        let reach = ground.paths.reach[ball] + ground.strips.slack;
        self.strip.holds(ground.paths.center[ball].y, reach)
    }

    /// The actor of a ball, if it is one of these.
    #[inline]
    pub(super) fn find(&self, ground: &Ground<'_>, ball: usize) -> Option<usize> {
        let at = ground.whereabouts.get(ball);
        if at == NONE || at & LEFT != self.mark {
            return None;
        }
        // It may be what another strip's thread has written of a ball that these do not hold.
        let slot = (at & !LEFT) as usize;
        let is_own = (self.actors.all.get(slot)).is_some_and(|actor| actor.ball as usize == ball);
        is_own.then_some(slot)
    }

    pub(super) fn find_or_enlist(&mut self, ground: &Ground<'_>, ball: usize) -> usize {
        if let Some(slot) = self.find(ground, ball) {
            return slot;
        }
        let slot = self.actors.enlist(ground.paths, ground.balls, ball);
        ground.whereabouts.set(ball, slot as u32 | self.mark);
        slot
    }

    /// What all groups did together.
    pub(super) fn total(&self) -> Tally {
        let mut total = Tally::default();
        for group in &self.groups {
            total.events += u64::from(group.done.events);
            total.collisions += u64::from(group.done.collisions);
            total.wall_hits += u64::from(group.done.wall_hits);
        }
        total.pairs = self.looked_at + total.events;
        total
    }

    /// The piece of path that an actor is on in the end.
    pub(super) fn last_piece(&self, paths: &Paths, slot: usize) -> Piece {
        self.actors.all[slot].piece(paths)
    }

    /// Puts all balls that are actors back among the others.
    pub(super) fn dismiss(&self, ground: &Ground<'_>) {
        for actor in &self.actors.all {
            ground.whereabouts.set(actor.ball as usize, NONE);
        }
    }
}
