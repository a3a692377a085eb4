//! Predicted collisions, the earliest first.
//!
//! A ball's count of hits stands in each of its events: one that was predicted before its last hit is void.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// What a ball meets: another ball, or one of the four walls, which come behind all balls at equal times.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Partner(u32);

const FIRST_WALL: u32 = u32::MAX - 3;

impl Partner {
    pub(super) fn ball(index: u32) -> Partner {
        Partner(index)
    }

    pub(super) fn wall(number: u32) -> Partner {
        Partner(FIRST_WALL + number)
    }

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
    pub(super) first: u32,
    pub(super) partner: Partner,
    hits: (u32, u32),
}

impl Event {
    pub(super) fn new(time: f64, first: u32, partner: Partner, hits: &[u32]) -> Event {
        let of_partner = partner.as_ball().map_or(0, |second| hits[second]);
        Event {
            time,
            first,
            partner,
            hits: (hits[first as usize], of_partner),
        }
    }

    fn is_void(&self, hits: &[u32]) -> bool {
        let of_partner = self.partner.as_ball().map_or(0, |second| hits[second]);
        self.hits != (hits[self.first as usize], of_partner)
    }
}

// The greatest of a heap comes first: the order is turned round.
impl Ord for Event {
    fn cmp(&self, other: &Event) -> Ordering {
        let key = |event: &Event| (event.first, event.partner, event.hits);
        other
            .time
            .total_cmp(&self.time)
            .then_with(|| key(other).cmp(&key(self)))
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

/// A heap whose first events are taken in all at once, which costs less than one by one.
#[derive(Default)]
pub(super) struct Queue {
    unsettled: Vec<Event>,
    heap: BinaryHeap<Event>,
    settled: bool,
}

impl Queue {
    pub(super) fn clear(&mut self) {
        self.unsettled = std::mem::take(&mut self.heap).into_vec();
        self.unsettled.clear();
        self.settled = false;
    }

    pub(super) fn push(&mut self, event: Event) {
        if self.settled {
            self.heap.push(event);
        } else {
            self.unsettled.push(event);
        }
    }

    /// Puts all events so far in order; none can be taken before.
    pub(super) fn settle(&mut self) {
        self.heap = BinaryHeap::from(std::mem::take(&mut self.unsettled));
        self.settled = true;
    }

    /// Takes the earliest event that still stands.
    pub(super) fn next(&mut self, hits: &[u32]) -> Option<Event> {
        loop {
            let event = self.heap.pop()?;
            if !event.is_void(hits) {
                return Some(event);
            }
        }
    }
}
