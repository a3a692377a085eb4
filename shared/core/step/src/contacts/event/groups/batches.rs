//! Predicted events, batch by batch from the bottom up: those of a part of the broadphase's search, or those with walls.

use super::super::first::List;
use super::super::paths::Paths;
use super::ground::{Beyond, Ground};
use super::set::Groups;
use crate::broadphase::{Broadphase, Part};
use crate::contacts::Substep;

/// Discs of a batch: what is known of them, and of as many again, mostly fits the second cache.
pub(super) const BATCH: usize = 4096;

/// Where the events of a batch come from.
#[derive(Clone, Copy, Debug)]
enum Source {
    /// This part of the search.
    Search(Part),
    /// This list of events with walls.
    Walls(usize),
}

#[derive(Clone, Copy, Debug)]
struct Batch {
    /// Between these heights the balls' discs have their centres.
    low: f64,
    high: f64,
    source: Source,
}

/// All batches of a substep, the lowest first.
#[derive(Default)]
pub(super) struct Batches {
    /// Discs of each, at least.
    grain: usize,
    all: Vec<Batch>,
}

impl Batches {
    /// Batches of so many discs, at least.
    pub(super) fn of(grain: usize) -> Batches {
        Batches {
            grain,
            all: Vec::new(),
        }
    }

    pub(super) fn lay_out(&mut self, paths: &Paths, substep: &Substep<'_>, walls: &[List]) {
        let of = substep.balls.len().div_ceil(self.grain).max(1);
        self.all.clear();
        self.all.extend((0..of).map(|number| {
            let part = Part { number, of };
            let (low, high) = substep.broadphase.heights(part);
            let source = Source::Search(part);
            Batch { low, high, source }
        }));
        self.all.extend(walls.iter().enumerate().map(|(number, list)| {
            let (low, high) = list.heights(paths);
            let source = Source::Walls(number);
            Batch { low, high, source }
        }));
        self.all.retain(|batch| batch.low <= batch.high);
        self.all
            .sort_unstable_by(|one, other| one.low.total_cmp(&other.low));
    }

    /// Takes what concerns the strip of these groups, and runs them.
    pub(super) fn run(
        &self,
        groups: &mut Groups,
        ground: &Ground<'_>,
        broadphase: &dyn Broadphase,
        walls: &[List],
    ) {
        let mut beyond = Beyond::Closed(broadphase);
        let strip = groups.strip;
        let mut here = (self.all.iter())
            .filter(|batch| strip.meets(batch.low, batch.high))
            .peekable();
        while let Some(batch) = here.next() {
            match batch.source {
                Source::Search(part) => groups.search(ground, broadphase, part),
                Source::Walls(number) => groups.take_all(ground, &walls[number]),
            }
            groups.known = here.peek().map_or(f64::INFINITY, |next| next.low);
            groups.run(ground, &mut beyond);
            if groups.stuck {
                // All of it is taken back; the rest would be looked for in vain.
                return;
            }
        }
    }
}
