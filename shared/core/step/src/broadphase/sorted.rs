//! The discs of a loose quadtree in the order of its cells, and the test of one disc against runs of them.

use std::ops::Range;

use super::lanes::{LANES, beyond, lanes_at, lanes_of, near};

#[derive(Clone, Copy, Default)]
pub(super) struct Tag {
    pub(super) index: u32,
    pub(super) cell: u32,
}

/// The discs, sorted by cell; the arrays go on for a few lanes behind the last disc.
#[derive(Default)]
pub(super) struct Sorted {
    pub(super) x: Vec<f32>,
    pub(super) y: Vec<f32>,
    /// Unused if all discs share their reach.
    pub(super) reach: Vec<f32>,
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

/// One disc, compared with others: those have a reach each, or all the same, which is then in `reach`.
pub(super) struct Probe<'a, const EACH: bool> {
    pub(super) sorted: &'a Sorted,
    pub(super) x: f32,
    pub(super) y: f32,
    pub(super) reach: f32,
}

impl<'a, const EACH: bool> Probe<'a, EACH> {
    /// One of the sorted discs.
    #[inline(always)]
    pub(super) fn of(sorted: &'a Sorted, slot: usize, reach: f32) -> Probe<'a, EACH> {
        Probe {
            sorted,
            x: sorted.x[slot],
            y: sorted.y[slot],
            reach,
        }
    }

    /// For each of the discs from `start` on, bits of which the highest is set if it is not near this one.
    #[inline(always)]
    pub(super) fn beyond(&self, start: usize) -> [u32; LANES] {
        let sums = if EACH {
            lanes_at(&self.sorted.reach, start).map(|reach| self.reach + reach)
        } else {
            [self.reach; LANES]
        };
        beyond(
            lanes_at(&self.sorted.x, start),
            lanes_at(&self.sorted.y, start),
            self.x,
            self.y,
            &sums,
        )
    }

    /// Shows the slots of all near discs in a run.
    #[inline]
    pub(super) fn each(&self, run: Range<usize>, mut show: impl FnMut(usize)) {
        for start in run.clone().step_by(LANES) {
            let mut hits = near(self.beyond(start)) & lanes_of(run.end - start);
            while hits != 0 {
                show(start + hits.trailing_zeros() as usize);
                hits &= hits - 1;
            }
        }
    }
}
