//! The discs of a loose quadtree in the order of its cells, and the test of one disc against runs of them.

use std::ops::Range;

use super::lanes::{LANES, beyond, lanes_at, lanes_of, near, sums};
use crate::Vec2;

/// The discs, sorted by cell; the arrays go on for a few lanes behind the last disc.
#[derive(Default)]
pub(super) struct Sorted {
    pub(super) x: Vec<f32>,
    pub(super) y: Vec<f32>,
    /// Unused if all discs share their reach.
    pub(super) reach: Vec<f32>,
    /// The cell of each.
    pub(super) cell: Vec<u32>,
    /// Which disc it is.
    pub(super) index: Vec<u32>,
}

impl Sorted {
    pub(super) fn resize(&mut self, count: usize, with_reach: bool) {
        self.x.resize(count + LANES, 0.0);
        self.y.resize(count + LANES, 0.0);
        self.reach.resize(if with_reach { count + LANES } else { 0 }, 0.0);
        self.cell.resize(count, 0);
        self.index.resize(count, 0);
    }
}

/// One disc, compared with others: those have a reach each, or all the same, which is then in `reach`.
pub(super) struct Probe<'a, const EACH: bool> {
    sorted: &'a Sorted,
    x: f32,
    y: f32,
    reach: f32,
}

impl<'a, const EACH: bool> Probe<'a, EACH> {
    /// One of the sorted discs. `reach` is its own if all share it, else what is added to its own.
    #[inline(always)]
    pub(super) fn of(sorted: &'a Sorted, slot: usize, reach: f32) -> Probe<'a, EACH> {
        Probe {
            sorted,
            x: sorted.x[slot],
            y: sorted.y[slot],
            reach: if EACH { sorted.reach[slot] + reach } else { reach },
        }
    }

    /// One that need not be among them; `across` is where it is in cells of the finest level.
    #[inline(always)]
    pub(super) fn at(sorted: &'a Sorted, across: Vec2, reach: f32) -> Probe<'a, EACH> {
        Probe {
            sorted,
            x: across.x as f32,
            y: across.y as f32,
            reach,
        }
    }

    /// For each of the discs from `start` on, bits of which the highest is set if it is not near this one.
    #[inline(always)]
    pub(super) fn beyond(&self, start: usize) -> [u32; LANES] {
        let sums = sums::<EACH>(&self.sorted.reach, start, self.reach);
        beyond(
            lanes_at(&self.sorted.x, start),
            lanes_at(&self.sorted.y, start),
            self.x,
            self.y,
            &sums,
        )
    }

    /// Shows the slots of all near discs in two runs.
    #[inline(always)]
    pub(super) fn each_of_two(&self, first: Range<usize>, second: Range<usize>, mut show: impl FnMut(usize)) {
        if first.len().max(second.len()) > LANES {
            self.each(first, &mut show);
            self.each(second, &mut show);
            return;
        }
        let mut hits = (near(self.beyond(first.start)) & lanes_of(first.len()))
            | (near(self.beyond(second.start)) & lanes_of(second.len())) << LANES;
        while hits != 0 {
            let lane = hits.trailing_zeros() as usize;
            hits &= hits - 1;
            show(if lane < LANES {
                first.start + lane
            } else {
                second.start + lane - LANES
            });
        }
    }

    /// Shows the slots of all near discs in a run.
    #[inline(never)]
    pub(super) fn each(&self, run: Range<usize>, mut show: impl FnMut(usize)) {
        let mut start = run.start;
        while start < run.end {
            let mut hits = near(self.beyond(start)) & lanes_of(run.end - start);
            while hits != 0 {
                show(start + hits.trailing_zeros() as usize);
                hits &= hits - 1;
            }
            start += LANES;
        }
    }
}
