//! Running the groups of a strip, or what the strips have left, one after the other.

use super::super::contact::Fate;
use super::super::first::List;
use super::super::piece::{Piece, radius};
use super::super::predict_walls;
use super::super::queue::{Event, Queue};
use super::actors::{Actors, Chains, DEFERRED, NONE, WAITING, meeting, slots};
use super::ground::{Beyond, Ground};
use super::strips::Strip;
use crate::contacts::exchange::normal;

/// Events that are done, again or not, for each that was predicted, before the order of all times costs less.
const PATIENCE: u64 = 3;
/// The same, whatever was predicted.
const LEAST_PATIENCE: u64 = 1000;

/// Why a group did not run to the end.
enum Halt {
    /// It met another group: that of this actor.
    Met(usize),
    /// It met this actor of another strip.
    MetElsewhere(usize, usize),
    /// It leaves the strip.
    Leaves,
    /// A contact is about to rest, or there are too many events: that is for the order of all times.
    Stuck,
}

/// What groups did; counted once nobody can take it back.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Tally {
    pub(super) events: u64,
    /// Events and pairs that were looked at.
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

struct Group {
    members: (u32, u32),
    tally: Tally,
}

/// The groups of a strip.
pub(super) struct Groups {
    strip: Strip,
    number: usize,
    /// In whereabouts, set in the numbers of these actors.
    mark: u32,
    pub(super) actors: Actors,
    chains: Chains,
    groups: Vec<Group>,
    members: Vec<u32>,
    /// Members of the group that runs.
    own: Vec<u32>,
    /// Actors that the group is built from again.
    seeds: Vec<u32>,
    queue: Queue,
    near: Vec<u32>,
    /// Events, of balls, that are left for after the strips.
    pub(super) deferred: Vec<Event>,
    /// How many more events may be done.
    patience: u64,
    /// Events that were done, and pairs that were looked at, taken back or not.
    looked_at: u64,
    /// The order of all times has to do it.
    pub(super) stuck: bool,
}

/// The mark of what the strips have left.
pub(super) const LEFT: u32 = 1 << 31;

impl Default for Groups {
    fn default() -> Groups {
        Groups {
            strip: Strip::ALL,
            number: 0,
            mark: 0,
            actors: Actors::default(),
            chains: Chains::default(),
            groups: Vec::new(),
            members: Vec::new(),
            own: Vec::new(),
            seeds: Vec::new(),
            queue: Queue::default(),
            near: Vec::new(),
            deferred: Vec::new(),
            patience: 0,
            looked_at: 0,
            stuck: false,
        }
    }
}

impl Groups {
    pub(super) fn begin(&mut self, strip: Strip, number: usize, mark: u32) {
        (self.strip, self.number, self.mark) = (strip, number, mark);
        self.actors.clear();
        self.chains.clear();
        self.groups.clear();
        self.members.clear();
        self.deferred.clear();
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

    /// Takes in all predicted events of this strip.
    pub(super) fn take_all(&mut self, ground: &Ground<'_>, predicted: &[List]) {
        for list in predicted {
            if self.strip.meets(list.low, list.high) {
                for event in &list.events {
                    self.take(ground, event);
                }
            }
        }
    }

    /// Whether a ball stays in the strip, however it is hit, unless it is relocated.
    #[inline]
    fn holds(&self, ground: &Ground<'_>, ball: usize) -> bool {
        let reach = ground.paths.reach[ball] + ground.strips.slack;
        self.strip.holds(ground.paths.center[ball].y, reach)
    }

    /// The actor of a ball, if it is one of these.
    #[inline]
    fn find(&self, ground: &Ground<'_>, ball: usize) -> Option<usize> {
        let at = ground.whereabouts.get(ball);
        let is_own = at != NONE && at & LEFT == self.mark && self.holds(ground, ball);
        is_own.then_some((at & !LEFT) as usize)
    }

    fn find_or_enlist(&mut self, ground: &Ground<'_>, ball: usize) -> usize {
        if let Some(slot) = self.find(ground, ball) {
            return slot;
        }
        let slot = self.actors.enlist(ground.paths, ground.balls, ball);
        ground.whereabouts.set(ball, slot as u32 | self.mark);
        slot
    }

    /// Runs all groups.
    pub(super) fn run(&mut self, ground: &Ground<'_>, beyond: &mut Beyond<'_>) {
        if self.stuck {
            return;
        }
        self.patience = LEAST_PATIENCE + PATIENCE * self.chains.events.len() as u64;
        let mut number = 0;
        while number < self.chains.events.len() {
            let first = self.chains.events[number].first as usize;
            number += 1;
            if self.actors.all[first].group != WAITING {
                continue;
            }
            self.own.clear();
            self.claim(first);
            loop {
                let mut tally = Tally::default();
                match self.run_group(ground, beyond, &mut tally) {
                    Ok(()) => {
                        self.close(tally);
                        break;
                    }
                    Err(Halt::Met(slot)) => {
                        self.put_back_own(ground);
                        self.merge(ground, slot);
                    }
                    Err(Halt::MetElsewhere(strip, slot)) => {
                        self.put_back_own(ground);
                        self.merge_from(ground, beyond, strip, slot);
                    }
                    Err(Halt::Leaves) if matches!(beyond, Beyond::Closed(..)) => {
                        self.defer(ground);
                        break;
                    }
                    Err(Halt::Leaves | Halt::Stuck) => {
                        self.stuck = true;
                        return;
                    }
                }
            }
        }
    }

    /// The number of the group that runs.
    fn running(&self) -> u32 {
        self.groups.len() as u32
    }

    /// Takes an actor into the group, with all that hang together with it by predicted events.
    fn claim(&mut self, slot: usize) {
        let running = self.running();
        if self.actors.all[slot].group == running {
            return;
        }
        let mut at = self.own.len();
        self.join(slot);
        while at < self.own.len() {
            let actor = self.actors.all[self.own[at] as usize];
            for event in self.chains.of(&actor) {
                for slot in slots(event) {
                    let other = &mut self.actors.all[slot].group;
                    if *other != running {
                        debug_assert_eq!(*other, WAITING);
                        *other = running;
                        self.own.push(slot as u32);
                    }
                }
            }
            at += 1;
        }
    }

    fn join(&mut self, slot: usize) {
        self.actors.all[slot].group = self.running();
        self.own.push(slot as u32);
    }

    /// Puts the group back to the start of the substep; all that is left of it are those that have predicted events.
    fn put_back_own(&mut self, ground: &Ground<'_>) {
        let mut own = std::mem::take(&mut self.own);
        own.retain(|&slot| self.put_back(ground, slot as usize));
        self.own = own;
    }

    /// Puts an actor back to the start of the substep. False if it is none any more.
    fn put_back(&mut self, ground: &Ground<'_>, slot: usize) -> bool {
        self.actors.put_back(ground.paths, ground.balls, slot);
        let actor = &self.actors.all[slot];
        let stays = actor.links != NONE || actor.crosses;
        if !stays {
            ground.whereabouts.set(actor.ball as usize, NONE);
        }
        stays
    }

    /// The group, which has been put back, begins again together with that of an actor.
    fn merge(&mut self, ground: &Ground<'_>, slot: usize) {
        self.seeds.append(&mut self.own);
        match self.actors.all[slot].group {
            WAITING => self.seeds.push(slot as u32),
            number => {
                for at in self.reopen(number) {
                    let slot = self.members[at];
                    if self.put_back(ground, slot as usize) {
                        self.seeds.push(slot);
                    }
                }
            }
        }
        self.claim_seeds();
    }

    /// The same with a group of another strip, whose predicted events these take over.
    fn merge_from(&mut self, ground: &Ground<'_>, beyond: &mut Beyond<'_>, strip: usize, slot: usize) {
        let Beyond::Open(_, strips) = beyond else { return };
        let other = &mut strips[strip];
        self.seeds.append(&mut self.own);
        for at in other.reopen(other.actors.all[slot].group) {
            let slot = other.members[at] as usize;
            other.put_back(ground, slot);
            for event in other.events_of_balls(slot) {
                self.take(ground, &event);
                self.seeds
                    .extend(self.chains.events.last().map(|event| event.first));
            }
        }
        self.claim_seeds();
    }

    fn claim_seeds(&mut self) {
        while let Some(slot) = self.seeds.pop() {
            self.claim(slot as usize);
        }
    }

    /// The predicted events of which an actor is the first, as events of balls.
    fn events_of_balls(&self, slot: usize) -> impl Iterator<Item = Event> {
        let ball = |slot: usize| self.actors.all[slot].ball as usize;
        (self.chains.of(&self.actors.all[slot]))
            .filter(move |event| event.first as usize == slot)
            .map(move |event| event.between(ball(slot), event.partner.as_ball().map(ball)))
    }

    /// Opens a closed group again: where its members are. It did nothing.
    fn reopen(&mut self, number: u32) -> std::ops::Range<usize> {
        let group = &mut self.groups[number as usize];
        let (begin, end) = std::mem::take(&mut group.members);
        group.tally = Tally::default();
        begin as usize..end as usize
    }

    /// Closes the group that ran.
    fn close(&mut self, tally: Tally) {
        let begin = self.members.len() as u32;
        self.members.append(&mut self.own);
        self.groups.push(Group {
            members: (begin, self.members.len() as u32),
            tally,
        });
    }

    /// Leaves the group for after the strips.
    fn defer(&mut self, ground: &Ground<'_>) {
        self.put_back_own(ground);
        for at in 0..self.own.len() {
            let slot = self.own[at] as usize;
            self.actors.all[slot].group = DEFERRED;
            let mut deferred = std::mem::take(&mut self.deferred);
            deferred.extend(self.events_of_balls(slot));
            self.deferred = deferred;
        }
    }

    /// What all groups did together.
    pub(super) fn total(&self) -> Tally {
        let mut total = Tally {
            pairs: self.looked_at,
            ..Tally::default()
        };
        for group in &self.groups {
            total.add(&group.tally);
        }
        total
    }

    fn run_group(
        &mut self,
        ground: &Ground<'_>,
        beyond: &mut Beyond<'_>,
        tally: &mut Tally,
    ) -> Result<(), Halt> {
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
            tally.events += 1;
            self.patience = self.patience.checked_sub(1).ok_or(Halt::Stuck)?;
            let first = event.first as usize;
            match event.partner.as_ball() {
                Some(second) => {
                    if let Some(hit) = self.bounce(ground, first, second, event.time)? {
                        tally.collisions += u64::from(hit);
                        self.follow(ground, beyond, first)?;
                        self.follow(ground, beyond, second)?;
                    }
                }
                None => {
                    if let Some(hit) = self.bounce_off(ground, first, &event)? {
                        tally.wall_hits += u64::from(hit);
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
        let (p1, v1) = one.piece.at(motion, time);
        let (p2, v2) = another.piece.at(motion, time);
        let hits = (self.actors.hits[first], self.actors.hits[second]);
        let bodies = [
            ground.body(one.ball as usize, &one.piece, v1, hits.0, time),
            ground.body(another.ball as usize, &another.piece, v2, hits.1, time),
        ];
        let Some(outcome) = ground.law.of_pair(normal(p1, p2), &bodies[0], &bodies[1]) else {
            return Ok(None);
        };
        if !matches!(outcome.fate, Fate::Bounce(_)) {
            return Err(Halt::Stuck);
        }
        let [w1, w2] = outcome.velocities;
        for (slot, position, velocity) in [(first, p1, w1), (second, p2, w2)] {
            let curvature = self.actors.all[slot].piece.curvature;
            let piece = Piece {
                since: time,
                position,
                velocity,
                curvature,
            };
            self.actors.turn(slot, piece);
        }
        Ok(Some(outcome.hit))
    }

    /// A ball meets a wall; the rest is as for a pair.
    fn bounce_off(&mut self, ground: &Ground<'_>, slot: usize, event: &Event) -> Result<Option<bool>, Halt> {
        let Some(walls) = &ground.walls else {
            return Ok(None);
        };
        let actor = &self.actors.all[slot];
        let (position, velocity) = actor.piece.at(ground.paths.motion, event.time);
        let hits = self.actors.hits[slot];
        let body = ground.body(actor.ball as usize, &actor.piece, velocity, hits, event.time);
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
            curvature: actor.piece.curvature,
        };
        self.actors.turn(slot, piece);
        Ok(Some(outcome.hit))
    }

    /// Predicts the next collisions of an actor that was hit, and finds out whom it meets.
    fn follow(&mut self, ground: &Ground<'_>, beyond: &mut Beyond<'_>, slot: usize) -> Result<(), Halt> {
        let (paths, balls) = (ground.paths, ground.balls);
        let (ball, piece) = (self.actors.all[slot].ball as usize, self.actors.all[slot].piece);
        let (center, reach) = piece.disc(paths.motion, paths.length, radius(balls, ball));
        self.stay(
            ground,
            beyond,
            slot,
            (center - paths.center[ball]).length() + reach,
        )?;
        self.near.clear();
        beyond.query(center, reach + ground.strips.slack, &mut self.near);
        self.looked_at += 1 + self.near.len() as u64;
        if self.looked_at > ground.budget {
            return Err(Halt::Stuck);
        }
        for at in 0..self.near.len() {
            let other = self.near[at] as usize;
            if other != ball {
                self.face(ground, beyond, (slot, ball, &piece), other)?;
            }
        }
        if let Some(walls) = &ground.walls
            && !walls.hold(center, reach)
        {
            let path = (&piece, self.actors.party(slot));
            predict_walls(paths, balls, walls, ball, path, |event| self.queue.push(event));
        }
        Ok(())
    }

    /// Sees to it that an actor is found where it is now: so far from the centre of its first disc, at the most.
    fn stay(
        &mut self,
        ground: &Ground<'_>,
        beyond: &mut Beyond<'_>,
        slot: usize,
        far: f64,
    ) -> Result<(), Halt> {
        let actor = &mut self.actors.all[slot];
        let ball = actor.ball as usize;
        if far <= actor.far || far <= ground.paths.reach[ball] + ground.strips.slack {
            return Ok(());
        }
        match beyond {
            Beyond::Closed(_) => Err(Halt::Leaves),
            Beyond::Open(broadphase, _) => {
                actor.far = far;
                broadphase.relocate(ball, ground.paths.center[ball], far);
                Ok(())
            }
        }
    }

    /// Finds out whether an actor, on its new piece of path, meets a ball, and what follows.
    fn face(
        &mut self,
        ground: &Ground<'_>,
        beyond: &Beyond<'_>,
        (slot, ball, piece): (usize, usize, &Piece),
        other: usize,
    ) -> Result<(), Halt> {
        let (paths, balls) = (ground.paths, ground.balls);
        let partner = if let Some(partner) = self.find(ground, other) {
            let group = self.actors.all[partner].group;
            if group != self.running() && group != WAITING && group != DEFERRED {
                let meets = self.actors.meet(paths, balls, (ball, piece), partner);
                return if meets { Err(Halt::Met(partner)) } else { Ok(()) };
            }
            Some(partner)
        } else {
            if let Beyond::Open(_, strips) = beyond {
                let at = ground.whereabouts.get(other);
                if at != NONE {
                    let (strip, at) = (ground.strips.of(paths.center[other].y), at as usize);
                    let meets = strips[strip].actors.meet(paths, balls, (ball, piece), at);
                    return if meets {
                        Err(Halt::MetElsewhere(strip, at))
                    } else {
                        Ok(())
                    };
                }
            }
            None
        };
        let theirs = match partner {
            Some(partner) => self.actors.all[partner].piece,
            None => paths.first_piece(balls, other),
        };
        let Some(time) = meeting(paths, balls, (ball, piece), (other, &theirs)) else {
            return Ok(());
        };
        let partner = match partner {
            Some(partner) => match self.actors.all[partner].group {
                WAITING => return Err(Halt::Met(partner)),
                DEFERRED => return Err(Halt::Leaves),
                _ => partner,
            },
            None if !self.holds(ground, other) => return Err(Halt::Leaves),
            None => {
                let partner = self.find_or_enlist(ground, other);
                self.join(partner);
                partner
            }
        };
        let (first, second) = if balls.in_id_order(ball, other).0 == ball {
            (slot, partner)
        } else {
            (partner, slot)
        };
        let event = Event::of_pair(time, self.actors.party(first), self.actors.party(second));
        self.queue.push(event);
        Ok(())
    }

    /// The piece of path that an actor is on in the end.
    pub(super) fn last_piece(&self, slot: usize) -> Piece {
        self.actors.all[slot].piece
    }

    /// Puts all balls that are actors back among the others.
    pub(super) fn dismiss(&self, ground: &Ground<'_>) {
        for actor in &self.actors.all {
            ground.whereabouts.set(actor.ball as usize, NONE);
        }
    }
}
