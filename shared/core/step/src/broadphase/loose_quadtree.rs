//! The loose quadtree, without pointers: levels of cells, each level's discs in the order of its cells.
//!
//! A disc lies in the level whose cells are at least as wide as it is, in the cell that holds its centre; so two
//! discs of one level overlap only if their cells touch, and a disc meets a wider level's discs only in the cells
//! around its own place there (Ulrich, "Loose octrees", Game Programming Gems 1, 2000: looseness 2). Each level's
//! cells double those of the level below. A table of offsets per cell, filled by a counting sort, stands for the tree.
//! Centres outside the bounds count to the nearest cell, which keeps neighbours neighbours.

mod locate;
mod search;

use super::cell_order::{CellOrder, Input};
use super::lanes::Scale;
use super::level::Level;
use super::levels::Levels;
use super::places::Span;
use super::relocated::Relocated;
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

    /// The sorted discs of a level.
    fn slots(&self, level: &Level) -> (usize, usize) {
        (
            self.offsets[level.first] as usize,
            self.offsets[level.end()] as usize,
        )
    }
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
