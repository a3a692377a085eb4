//! The discs of a loose quadtree in the order of its cells, and the test of one disc against runs of them.

use super::Pair;
use super::lanes::{LANES, near};
use crate::Vec2;

#[derive(Clone, Copy, Default)]
pub(super) struct Tag {
    pub(super) index: u32,
    pub(super) cell: u32,
}

/// The discs, sorted by cell; the arrays go on for a few lanes behind the last disc.
#[derive(Default)]
pub(super) struct Sorted {
    pub(super) x: Vec<f64>,
    pub(super) y: Vec<f64>,
    /// Unused if all discs share their reach.
    pub(super) reach: Vec<f64>,
    pub(super) tag: Vec<Tag>,
}

impl Sorted {
    pub(super) fn resize(&mut self, count: usize, with_reach: bool) {
        self.x.resize(count + LANES, 0.0);
        self.y.resize(count + LANES, 0.0);
        self.reach.resize(if with_reach { count + LANES } else { 0 }, 0.0);
        self.tag.resize(count + LANES, Tag::default());
    }
}

/// One disc, compared with others.
pub(super) struct Probe<'a, const EACH: bool> {
    sorted: &'a Sorted,
    x: f64,
    y: f64,
    reach: f64,
    index: u32,
}

impl<'a, const EACH: bool> Probe<'a, EACH> {
    #[inline]
    pub(super) fn new(sorted: &'a Sorted, slot: usize, reach: f64) -> Probe<'a, EACH> {
        let reach = if EACH { sorted.reach[slot] } else { reach };
        Probe {
            sorted,
            x: sorted.x[slot],
            y: sorted.y[slot],
            reach,
            index: sorted.tag[slot].index,
        }
    }

    /// A disc that is not among the sorted ones.
    #[inline]
    pub(super) fn at(sorted: &'a Sorted, center: Vec2, reach: f64) -> Probe<'a, EACH> {
        Probe {
            sorted,
            x: center.x,
            y: center.y,
            reach,
            index: u32::MAX,
        }
    }

    /// A bit for each of the discs from `start` on that overlaps this one.
    #[inline(always)]
    pub(super) fn lanes(&self, start: usize) -> u32 {
        let squares = if EACH {
            lanes_at(&self.sorted.reach, start).map(|reach| {
                let sum = self.reach + reach;
                sum * sum
            })
        } else {
            let sum = self.reach + self.reach;
            [sum * sum; LANES]
        };
        near(
            lanes_at(&self.sorted.x, start),
            lanes_at(&self.sorted.y, start),
            self.x,
            self.y,
            &squares,
        )
    }

    #[inline]
    pub(super) fn report(&self, mut hits: u32, start: usize, found: &mut Vec<Pair>) {
        while hits != 0 {
            let slot = start + hits.trailing_zeros() as usize;
            hits &= hits - 1;
            let (dx, dy) = (self.sorted.x[slot] - self.x, self.sorted.y[slot] - self.y);
            let sum = self.reach + if EACH { self.sorted.reach[slot] } else { self.reach };
            if dx * dx + dy * dy < sum * sum {
                let other = self.sorted.tag[slot].index;
                found.push((self.index.min(other), self.index.max(other)));
            }
        }
    }

    /// What a run holds beyond its first lanes.
    #[cold]
    pub(super) fn rest(&self, run: std::ops::Range<usize>, found: &mut Vec<Pair>) {
        let mut start = run.start + LANES;
        while start < run.end {
            self.report(self.lanes(start) & lanes_of(run.end - start), start, found);
            start += LANES;
        }
    }
}

/// The numbers from `start` on, as many as there are lanes.
#[inline]
pub(super) fn lanes_at(numbers: &[f64], start: usize) -> &[f64; LANES] {
    numbers[start..]
        .first_chunk()
        .expect("the arrays go on behind the last disc")
}

/// A bit for each lane that a run of that length fills.
#[inline]
pub(super) fn lanes_of(length: usize) -> u32 {
    (1 << length.min(LANES)) - 1
}
