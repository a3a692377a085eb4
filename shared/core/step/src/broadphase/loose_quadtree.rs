//! The loose quadtree, without pointers: levels of cells, each level's discs in the order of its cells.
//!
//! A disc lies in the level whose cells are at least as wide as it is, in the cell that holds its centre; so two
//! discs of one level overlap only if their cells touch, and a disc meets a wider level's discs only in the cells
//! around its own place there (Ulrich, "Loose octrees", Game Programming Gems 1, 2000: looseness 2). Each level's
//! cells double those of the level below. A table of offsets per cell, filled by a counting sort, stands for the tree.
//! Centres outside the bounds count to the nearest cell, which keeps neighbours neighbours.

use std::ops::Range;

use super::cell_order::{BLOCK, CellOrder, Input, Places, Span};
use super::lanes::Scale;
use super::levels::{Level, Levels};
use super::relocated::Relocated;
use super::runs::{Row, some_near};
use super::sorted::{Probe, Sorted};
use super::{Broadphase, Discs, Pair, Part, Reach, Settings};
use crate::{Team, Vec2};

pub(super) struct LooseQuadtree {
    root: [f64; 4],
    levels: Levels,
    scale: Scale,
    cells: Vec<u32>,
    spans: Vec<Span>,
    /// Coordinates in cells of the finest level, where all discs share their reach.
    across: Vec<[f32; 2]>,
    cell_order: CellOrder,
    /// For each cell, where its discs begin in the sorted arrays; the number behind the last cell ends the table.
    offsets: Vec<u32>,
    sorted: Sorted,
    count: usize,
    same: Option<f64>,
    relocated: Relocated,
}

impl LooseQuadtree {
    pub(super) fn new(settings: &Settings) -> LooseQuadtree {
        LooseQuadtree {
            root: settings.root,
            levels: Levels::default(),
            scale: Scale::default(),
            cells: Vec::new(),
            spans: Vec::new(),
            across: Vec::new(),
            cell_order: CellOrder::default(),
            offsets: Vec::new(),
            sorted: Sorted::default(),
            count: 0,
            same: None,
            relocated: Relocated::default(),
        }
    }

    /// Finds the cell of each disc, and its coordinates in cells of the finest level where they are kept.
    fn locate(&mut self, discs: &Discs<'_>, team: &Team) {
        let count = discs.len();
        self.cells.resize(count, 0);
        self.spans.resize(count.div_ceil(BLOCK), Span::ALL);
        let each = matches!(discs.reach, Reach::Each(_));
        self.across.resize(if each { 0 } else { count }, [0.0; 2]);
        let levels = &self.levels;
        let finest = *levels.finest();
        let places = Places {
            cells: &mut self.cells,
            spans: &mut self.spans,
            across: &mut self.across,
        };
        let span = |cells: &[u32]| {
            if team.pieces() == 1 {
                Span::ALL
            } else {
                Span::of(cells)
            }
        };
        match discs.reach {
            Reach::Same(_) => team.each((places, discs.center), BLOCK, &|(places, centers)| {
                for ((cells, covered, narrow), centers) in places.blocks().zip(centers.chunks(BLOCK)) {
                    for ((cell, narrow), &center) in cells.iter_mut().zip(narrow).zip(centers) {
                        let across = finest.across(center);
                        *cell = finest.cell(across);
                        *narrow = [across.x as f32, across.y as f32];
                    }
                    *covered = span(cells);
                }
            }),
            Reach::Each(all) => {
                let whole = (places, discs.center, all);
                team.each(whole, BLOCK, &|(places, centers, all)| {
                    let discs = centers.chunks(BLOCK).zip(all.chunks(BLOCK));
                    for ((cells, covered, _), (centers, all)) in places.blocks().zip(discs) {
                        let discs = centers.iter().zip(all);
                        for (cell, (&center, &reach)) in cells.iter_mut().zip(discs) {
                            *cell = levels.of(reach).cell_at(center);
                        }
                        *covered = span(cells);
                    }
                });
            }
        }
    }

    /// The sorted discs of a level.
    fn slots(&self, level: &Level) -> (usize, usize) {
        (
            self.offsets[level.first] as usize,
            self.offsets[level.end()] as usize,
        )
    }

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
    fn search(&self, slots: &Range<usize>, discs: &Discs<'_>, found: &mut Vec<Pair>) {
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

impl Broadphase for LooseQuadtree {
    fn build(&mut self, discs: &Discs<'_>, team: &Team) {
        self.relocated.clear();
        self.count = discs.len();
        self.same = match discs.reach {
            Reach::Same(reach) => Some(reach),
            Reach::Each(_) => None,
        };
        self.levels.lay_out(discs, self.root);
        self.scale = self.levels.finest().scale();
        self.locate(discs, team);
        let input = Input {
            cells: &self.cells,
            spans: &self.spans,
            across: &self.across,
            discs,
            finest: *self.levels.finest(),
            scale: self.scale,
        };
        let cells = self.levels.cells();
        self.cell_order
            .sort(input, cells, team, &mut self.offsets, &mut self.sorted);
        self.levels.populate(&self.offsets);
    }

    fn pairs_of(&self, discs: &Discs<'_>, part: Part, found: &mut Vec<Pair>) {
        self.search(&part.range(self.count), discs, found);
    }

    fn heights(&self, part: Part) -> (f64, f64) {
        let slots = part.range(self.count);
        let levels = self.levels.all();
        let mut occupied = levels.iter().filter(|level| level.population > 0);
        // A disc of another level is no further off than both cells reach.
        let across = if occupied.clone().count() > 1 {
            occupied.next_back().map_or(0.0, Level::size)
        } else {
            0.0
        };
        levels.iter().fold(Part::NOWHERE, |(low, high), level| {
            let (first, end) = self.slots(level);
            let slots = slots.start.max(first)..slots.end.min(end);
            if slots.is_empty() {
                return (low, high);
            }
            let cells = (self.sorted.cell[slots.start], self.sorted.cell[slots.end - 1]);
            let (bottom, top) = level.heights(cells.0 as usize, cells.1 as usize);
            (low.min(bottom - across), high.max(top + across))
        })
    }

    fn relocate(&mut self, index: usize, center: Vec2, reach: f64) {
        let cell = self.levels.find_mut(reach).map(|level| {
            // Never counted down: a level that was once used may be visited in vain, no more.
            level.population += 1;
            level.cell_at(center)
        });
        self.relocated
            .put(index, center, reach, cell, self.count, self.levels.cells());
    }

    fn query(&self, center: Vec2, reach: f64, found: &mut Vec<u32>) {
        // Generous by a rounding or two: what is found in vain is looked at again.
        let reach = reach * (1.0 + 1e-9);
        let touches = |other: Vec2, far: f64| {
            let sum = reach + far;
            (center - other).square() <= sum * sum
        };
        let (across, narrow) = (self.levels.finest().across(center), self.scale.probing(reach));
        for level in self.levels.all().iter().filter(|level| level.population > 0) {
            for run in level.runs(center, reach) {
                let (start, end) = (self.offsets[run.start] as usize, self.offsets[run.end] as usize);
                let mut show = |slot: usize| {
                    let index = self.sorted.index[slot];
                    if !self.relocated.holds(index) {
                        found.push(index);
                    }
                };
                match self.same {
                    Some(same) => {
                        let sum = narrow + self.scale.probed(same);
                        Probe::<false>::at(&self.sorted, across, sum).each(start..end, &mut show);
                    }
                    None => Probe::<true>::at(&self.sorted, across, narrow).each(start..end, &mut show),
                }
                self.relocated.in_cells(run, |index, other, far| {
                    if touches(other, far) {
                        found.push(index);
                    }
                });
            }
        }
        self.relocated.in_no_cell(|index, other, far| {
            if touches(other, far) {
                found.push(index);
            }
        });
    }

    fn order(&self) -> Option<&[u32]> {
        Some(&self.sorted.index)
    }

    fn nodes(&self) -> Vec<[f64; 4]> {
        let mut nodes = Vec::new();
        for level in self.levels.all() {
            let cells = level.first..level.end();
            nodes.extend(
                cells
                    .filter(|&cell| self.offsets[cell] < self.offsets[cell + 1])
                    .map(|cell| level.rectangle(cell)),
            );
        }
        nodes
    }
}
