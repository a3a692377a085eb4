//! Who belongs to which group: taking in, putting back, taking over.

use std::ops::Range;

use super::super::queue::Event;
use super::actors::{DEFERRED, EARLY, NONE, WAITING};
use super::chains::slots;
use super::ground::{Beyond, Ground};
use super::set::{Done, Group, Groups};

impl Groups {
    /// The number of the group that runs.
    pub(super) fn running(&self) -> u32 {
        self.groups.len() as u32
    }

    /// Takes an actor into the group, with all that hang together with it by predicted events.
    pub(super) fn claim(&mut self, ground: &Ground<'_>, slot: usize) {
        let running = self.running();
        if self.actors.all[slot].group == running {
            return;
        }
        let mut at = self.own.len();
        self.join(ground, slot);
        while at < self.own.len() {
            let actor = self.actors.all[self.own[at] as usize];
            for event in self.chains.of(&actor) {
                for slot in slots(event) {
                    let other = &mut self.actors.all[slot];
                    if other.group != running {
                        debug_assert!(matches!(other.group, WAITING | EARLY));
                        other.group = running;
                        self.own.push(slot as u32);
                        self.is_early |= ground.paths.center[other.ball as usize].y >= self.known;
                    }
                }
            }
            at += 1;
        }
    }

    pub(super) fn join(&mut self, ground: &Ground<'_>, slot: usize) {
        let running = self.running();
        let actor = &mut self.actors.all[slot];
        actor.group = running;
        self.own.push(slot as u32);
        self.is_early |= ground.paths.center[actor.ball as usize].y >= self.known;
    }

    /// Begins a group.
    pub(super) fn begin_own(&mut self) {
        self.own.clear();
        self.is_early = false;
    }

    /// Leaves the group for when more is known.
    pub(super) fn wait(&mut self, ground: &Ground<'_>) {
        self.put_back_own(ground);
        for &slot in &self.own {
            let actor = &mut self.actors.all[slot as usize];
            if actor.links != NONE {
                actor.group = EARLY;
                self.early.push(slot);
            }
        }
    }

    /// Puts the group back to the start of the substep; all that is left of it are those that have predicted events.
    pub(super) fn put_back_own(&mut self, ground: &Ground<'_>) {
        let mut own = std::mem::take(&mut self.own);
        own.retain(|&slot| self.put_back(ground, slot as usize));
        self.own = own;
    }

    /// Puts an actor back to the start of the substep. False if it is none any more.
    pub(super) fn put_back(&mut self, ground: &Ground<'_>, slot: usize) -> bool {
        self.actors.put_back(ground.paths, ground.balls, slot);
        let actor = &self.actors.all[slot];
        let stays = actor.links != NONE || actor.crosses;
        if !stays {
            ground.whereabouts.set(actor.ball as usize, NONE);
        }
        stays
    }

    /// The group, which has been put back, begins again together with that of an actor.
    pub(super) fn merge(&mut self, ground: &Ground<'_>, slot: usize) {
        self.seeds.append(&mut self.own);
        self.begin_own();
        match self.actors.all[slot].group {
            WAITING | EARLY => self.seeds.push(slot as u32),
            number => {
                for at in self.reopen(number) {
                    let slot = self.members[at];
                    if self.put_back(ground, slot as usize) {
                        self.seeds.push(slot);
                    }
                }
            }
        }
        self.claim_seeds(ground);
    }

    /// The same with a group of another strip, whose predicted events these take over.
    pub(super) fn merge_from(
        &mut self,
        ground: &Ground<'_>,
        beyond: &mut Beyond<'_>,
        strip: usize,
        slot: usize,
    ) {
        let Beyond::Open(_, strips) = beyond else { return };
        let other = &mut strips[strip];
        self.seeds.append(&mut self.own);
        self.begin_own();
        for at in other.reopen(other.actors.all[slot].group) {
            let slot = other.members[at] as usize;
            other.put_back(ground, slot);
            for event in other.events_of_balls(slot) {
                self.take(ground, &event);
                self.seeds
                    .extend(self.chains.events.last().map(|event| event.first));
            }
        }
        self.claim_seeds(ground);
    }

    pub(super) fn claim_seeds(&mut self, ground: &Ground<'_>) {
        while let Some(slot) = self.seeds.pop() {
            self.claim(ground, slot as usize);
        }
    }

    /// The predicted events of which an actor is the first, as events of balls.
    pub(super) fn events_of_balls(&self, slot: usize) -> impl Iterator<Item = Event> {
        let ball = |slot: usize| self.actors.all[slot].ball as usize;
        (self.chains.of(&self.actors.all[slot]))
            .filter(move |event| event.first as usize == slot)
            .map(move |event| event.between(ball(slot), event.partner.as_ball().map(ball)))
    }

    /// Opens a closed group again: where its members are. It did nothing.
    pub(super) fn reopen(&mut self, number: u32) -> Range<usize> {
        let group = &mut self.groups[number as usize];
        let (begin, end) = std::mem::take(&mut group.members);
        group.done = Done::default();
        begin as usize..end as usize
    }

    /// Closes the group that ran.
    pub(super) fn close(&mut self, done: Done) {
        let begin = self.members.len() as u32;
        self.members.append(&mut self.own);
        self.groups.push(Group {
            members: (begin, self.members.len() as u32),
            done,
        });
    }

    /// Leaves the group for after the strips.
    pub(super) fn defer(&mut self, ground: &Ground<'_>) {
        self.put_back_own(ground);
        for at in 0..self.own.len() {
            let slot = self.own[at] as usize;
            self.actors.all[slot].group = DEFERRED;
            let mut deferred = std::mem::take(&mut self.deferred);
            deferred.extend(self.events_of_balls(slot));
            self.deferred = deferred;
        }
    }
}
