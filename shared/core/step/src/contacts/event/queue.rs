//! Predicted collisions, the earliest first.
//!
//! A ball's count of hits stands in each of its events: one that was predicted before its last hit is void. Equal times
//! are ordered by ids, so that neither memory order nor the order of prediction can show.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

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

/// A ball, as an event sees it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Party {
    pub(super) index: usize,
    pub(super) id: u64,
    /// How often it was hit when the event was predicted.
    pub(super) hits: u32,
}

impl Event {
    /// Two balls meet; `first` has the lower id.
    pub(super) fn of_pair(time: f64, first: Party, second: Party) -> Event {
        Event {
            time,
            first: first.index as u32,
            partner: Partner(second.index as u32),
            hits: (first.hits, second.hits),
            ids: (first.id, second.id),
        }
    }

    /// A ball meets a wall.
    pub(super) fn of_wall(time: f64, ball: Party, wall: u32) -> Event {
        Event {
            time,
            first: ball.index as u32,
            partner: Partner(FIRST_WALL + wall),
            hits: (ball.hits, 0),
            ids: (ball.id, u64::MAX - 3 + u64::from(wall)),
        }
    }

    /// The same event of balls that are counted otherwise.
    pub(super) fn between(&self, first: usize, second: Option<usize>) -> Event {
        Event {
            first: first as u32,
            partner: second.map_or(self.partner, |second| Partner(second as u32)),
            ..*self
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
    pub(super) fn begin<'a>(&mut self, lists: impl Iterator<Item = &'a mut Vec<Event>>) {
        self.clear();
        for events in lists {
            self.sorted.append(events);
        }
        self.sorted.sort_unstable_by(|first, second| second.cmp(first));
    }

    /// Forgets all events.
    pub(super) fn clear(&mut self) {
        self.sorted.clear();
        self.later.clear();
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
