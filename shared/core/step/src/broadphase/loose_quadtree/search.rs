//! The search for pairs in a loose quadtree.

use std::ops::Range;

use super::LooseQuadtree;
use crate::broadphase::level::Level;
use crate::broadphase::runs::{Row, some_near};
use crate::broadphase::sorted::Probe;
use crate::broadphase::{Discs, Pair};

impl LooseQuadtree {
    /// Pairs inside one level. A disc is tested against what follows it in its cell and the cell to the right, and
    /// against the three cells above: two runs of the sorted arrays.
    fn pairs_in_level<const EACH: bool>(&self, level: &Level, slots: Range<usize>, found: &mut Vec<Pair>) {
        let row = Row {
            offsets: &self.offsets,
            stride: level.stride,
        };
        let reach = match self.same {
            Some(reach) => self.scale.probing(reach) + self.scale.probed(reach),
            None => self.scale.probing(0.0),
        };
        // First a bit for each disc that may be near another, then a look at those: a branch per disc would cost more,
        // as no processor foresees which balls touch.
        for begin in slots.clone().step_by(u64::BITS as usize) {
            let slots = begin..slots.end.min(begin + u64::BITS as usize);
            let mut some = some_near::<EACH>(&self.sorted, &row, reach, slots);
            while some != 0 {
                let slot = begin + some.trailing_zeros() as usize;
                some &= some - 1;
                let (beside, above) = row.runs(slot, self.sorted.cell[slot]);
                let index = self.sorted.index[slot];
                Probe::<EACH>::of(&self.sorted, slot, reach).each_of_two(beside, above, |other| {
                    found.push(pair(index, self.sorted.index[other]));
                });
            }
        }
    }

    /// Pairs of discs of one level with those of another one.
    fn pairs_across(&self, other: &Level, slots: Range<usize>, discs: &Discs<'_>, found: &mut Vec<Pair>) {
        let margin = self.scale.probing(0.0);
        for slot in slots {
            let index = self.sorted.index[slot];
            let (center, reach) = (discs.center[index as usize], discs.reach.of(index as usize));
            let probe = Probe::<true>::of(&self.sorted, slot, margin);
            for run in other.runs(center, reach) {
                let run = self.offsets[run.start] as usize..self.offsets[run.end] as usize;
                probe.each(run, |other| found.push(pair(index, self.sorted.index[other])));
            }
        }
    }

    /// Pairs whose first disc, in cell order, is in these slots.
    pub(super) fn search(&self, slots: &Range<usize>, discs: &Discs<'_>, found: &mut Vec<Pair>) {
        let levels = self.levels.all();
        for (at, level) in levels.iter().enumerate() {
            let (first, end) = self.slots(level);
            let slots = slots.start.max(first)..slots.end.min(end);
            if slots.is_empty() {
                continue;
            }
            if self.same.is_some() {
                self.pairs_in_level::<false>(level, slots.clone(), found);
            } else {
                self.pairs_in_level::<true>(level, slots.clone(), found);
            }
            for (other_at, other) in levels.iter().enumerate() {
                if other_at != at && other.population > 0 && looks(levels, at, other_at) {
                    self.pairs_across(other, slots.clone(), discs, found);
                }
            }
        }
    }
}

/// Whether the discs of a level look among those of the other, and not the other way round: many small discs would
/// look in vain for a few large ones.
fn looks(levels: &[Level], at: usize, other: usize) -> bool {
    let (narrow, wide) = (&levels[at.min(other)], &levels[at.max(other)]);
    let narrow_looks = narrow.cost_of_looking_in(wide) <= wide.cost_of_looking_in(narrow);
    narrow_looks == (at < other)
}

/// Two discs as a pair.
#[inline]
fn pair(first: u32, second: u32) -> Pair {
    (first.min(second), first.max(second))
}
