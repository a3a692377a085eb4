//! Predicted collisions, the earliest first.
//!
//! A ball's count of hits stands in each of its events: one that was predicted before its last hit is void. Equal times
//! are ordered by ids, so that neither memory order nor the order of prediction can show.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

use crate::Balls;

/// What a ball meets: another ball, or one of the four walls, which come behind all balls at equal times.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Partner(u32);

const FIRST_WALL: u32 = u32::MAX - 3;

impl Partner {
    pub(super) fn as_ball(self) -> Option<usize> {
        (self.0 < FIRST_WALL).then_some(self.0 as usize)
    }

    pub(super) fn as_wall(self) -> u32 {
        self.0 - FIRST_WALL
    }
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Event {
    pub(super) time: f64,
    /// Index of the ball; of the one with the lower id, if there are two.
    pub(super) first: u32,
    pub(super) partner: Partner,
    hits: (u32, u32),
    /// The lower id, and the higher one or the wall behind all ids.
    ids: (u64, u64),
}

impl Event {
    /// Two balls meet; `first` has the lower id.
    pub(super) fn of_pair(time: f64, first: usize, second: usize, balls: &Balls, hits: &[u32]) -> Event {
        Event {
            time,
            first: first as u32,
            partner: Partner(second as u32),
            hits: (hits[first], hits[second]),
            ids: (balls.id[first], balls.id[second]),
        }
    }

    /// A ball meets a wall.
    pub(super) fn of_wall(time: f64, ball: usize, wall: u32, balls: &Balls, hits: &[u32]) -> Event {
        Event {
            time,
            first: ball as u32,
            partner: Partner(FIRST_WALL + wall),
            hits: (hits[ball], 0),
            ids: (balls.id[ball], u64::MAX - 3 + u64::from(wall)),
        }
    }

    fn is_void(&self, hits: &[u32]) -> bool {
        let of_partner = self.partner.as_ball().map_or(0, |second| hits[second]);
        self.hits != (hits[self.first as usize], of_partner)
    }
}

impl Ord for Event {
    fn cmp(&self, other: &Event) -> Ordering {
        let key = |event: &Event| (event.ids, event.hits);
        (self.time.total_cmp(&other.time)).then_with(|| key(self).cmp(&key(other)))
    }
}

impl PartialOrd for Event {
    fn partial_cmp(&self, other: &Event) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Event {
    fn eq(&self, other: &Event) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Event {}

/// What is predicted at the start is sorted once, which costs less than a heap; what hits add later goes into one.
#[derive(Default)]
pub(super) struct Queue {
    /// The latest first.
    sorted: Vec<Event>,
    later: BinaryHeap<Reverse<Event>>,
}

impl Queue {
    /// Begins with the events of these lists, which it empties.
    pub(super) fn begin(&mut self, predicted: &mut [Vec<Event>]) {
        self.sorted.clear();
        self.later.clear();
        for events in predicted {
            self.sorted.append(events);
        }
        self.sorted.sort_unstable_by(|first, second| second.cmp(first));
    }

    pub(super) fn push(&mut self, event: Event) {
        self.later.push(Reverse(event));
    }

    /// Takes the earliest event that still stands.
    pub(super) fn next(&mut self, hits: &[u32]) -> Option<Event> {
        loop {
            let later_first = match (self.sorted.last(), self.later.peek()) {
                (Some(sorted), Some(Reverse(later))) => later < sorted,
                (sorted, _) => sorted.is_none(),
            };
            let event = if later_first {
                self.later.pop()?.0
            } else {
                self.sorted.pop()?
            };
            if !event.is_void(hits) {
                return Some(event);
            }
        }
    }
}
