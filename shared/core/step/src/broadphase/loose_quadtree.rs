//! The loose quadtree, without pointers: levels of cells, each level's discs in the order of its cells.
//!
//! A disc lies in the level whose cells are at least as wide as it is, in the cell that holds its centre; so two
//! discs of one level overlap only if their cells touch, and a disc meets a wider level's discs only in the cells
//! around its own place there (Ulrich, "Loose octrees", Game Programming Gems 1, 2000: looseness 2). Each level's
//! cells double those of the level below. A table of offsets per cell, filled by a counting sort, stands for the tree.
//! Centres outside the bounds count to the nearest cell, which keeps neighbours neighbours.

use std::ops::Range;

use super::cell_order::{BLOCK, Blocks, CellOrder, Input, Located, Span};
use super::lanes::{LANES, Scale, all_beyond};
use super::levels::{Level, Levels};
use super::relocated::Relocated;
use super::sorted::{Probe, Sorted};
use super::{Broadphase, Discs, Found, Pair, Reach, Settings};
use crate::{Team, Vec2};

pub(super) struct LooseQuadtree {
    root: [f64; 4],
    levels: Levels,
    scale: Scale,
    located: Vec<Located>,
    spans: Vec<Span>,
    reach: Vec<f32>,
    cell_order: CellOrder,
    /// For each cell, where its discs begin in the sorted arrays; the number behind the last cell ends the table.
    offsets: Vec<u32>,
    sorted: Sorted,
    count: usize,
    same: Option<f64>,
    relocated: Relocated,
    order: Vec<u32>,
}

impl LooseQuadtree {
    pub(super) fn new(settings: &Settings) -> LooseQuadtree {
        LooseQuadtree {
            root: settings.root,
            levels: Levels::default(),
            scale: Scale::default(),
            located: Vec::new(),
            spans: Vec::new(),
            reach: Vec::new(),
            cell_order: CellOrder::default(),
            offsets: Vec::new(),
            sorted: Sorted::default(),
            count: 0,
            same: None,
            relocated: Relocated::default(),
            order: Vec::new(),
        }
    }

    /// Finds the cell of each disc, and its coordinates in cells of the finest level.
    fn locate(&mut self, discs: &Discs<'_>, team: &Team) {
        self.located.resize(discs.len(), Located::default());
        self.spans.resize(discs.len().div_ceil(BLOCK), Span::default());
        let each = matches!(discs.reach, Reach::Each(_));
        self.reach.resize(if each { discs.len() } else { 0 }, 0.0);
        let (levels, scale) = (&self.levels, self.scale);
        let blocks = Blocks {
            located: &mut self.located,
            spans: &mut self.spans,
        };
        match discs.reach {
            Reach::Same(_) => {
                let level = levels.finest();
                team.each((blocks, discs.center), BLOCK, &|(blocks, centers)| {
                    for ((block, span), centers) in blocks.each().zip(centers.chunks(BLOCK)) {
                        for (located, &center) in block.iter_mut().zip(centers) {
                            *located = Located::at(level.across(center), level.cell_at(center));
                        }
                        *span = Span::of(block);
                    }
                });
            }
            Reach::Each(all) => {
                let whole = (blocks, discs.center, all, &mut self.reach[..]);
                team.each(whole, BLOCK, &|(blocks, centers, all, narrow)| {
                    for (narrow, &reach) in narrow.iter_mut().zip(all) {
                        *narrow = scale.probed(reach);
                    }
                    let finest = levels.finest();
                    let discs = centers.chunks(BLOCK).zip(all.chunks(BLOCK));
                    for ((block, span), (centers, all)) in blocks.each().zip(discs) {
                        for ((located, &center), &reach) in block.iter_mut().zip(centers).zip(all) {
                            *located = Located::at(finest.across(center), levels.of(reach).cell_at(center));
                        }
                        *span = Span::of(block);
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
    #[inline(never)] // Alone, its loop keeps what it needs in registers.
    fn pairs_in_level<const EACH: bool>(&self, level: &Level, slots: Range<usize>, found: &mut Vec<Pair>) {
        let sum = self
            .same
            .map_or(0.0, |reach| self.scale.probing(reach) + self.scale.probed(reach));
        let margin = self.scale.probing(0.0);
        let (offsets, stride) = (&self.offsets[..], level.stride);
        for slot in slots {
            let cell = self.sorted.tag[slot].cell as usize;
            let beside = slot + 1..offsets[cell + 2] as usize;
            let above = offsets[cell + stride - 1] as usize..offsets[cell + stride + 2] as usize;
            let reach = if EACH {
                self.sorted.reach[slot] + margin
            } else {
                sum
            };
            let probe = Probe::<EACH>::of(&self.sorted, slot, reach);
            // One branch for the usual case: at most a few candidates, none of which is near. The lanes behind a run
            // belong to cells further off, where next to nothing is near.
            if !all_beyond(probe.beyond(beside.start), probe.beyond(above.start))
                || beside.len().max(above.len()) > LANES
            {
                report::<EACH>(&self.sorted, slot, reach, [beside, above], found);
            }
        }
    }

    /// Pairs of discs of one level with those of a wider one.
    fn pairs_across(&self, wider: &Level, slots: Range<usize>, discs: &Discs<'_>, found: &mut Vec<Pair>) {
        let margin = self.scale.probing(0.0);
        for slot in slots {
            let index = self.sorted.tag[slot].index;
            let (center, reach) = (discs.center[index as usize], discs.reach.of(index as usize));
            let probe = Probe::<true>::of(&self.sorted, slot, self.sorted.reach[slot] + margin);
            for run in wider.runs(center, reach) {
                let run = self.offsets[run.start] as usize..self.offsets[run.end] as usize;
                probe.each(run, |other| found.push(pair(index, self.sorted.tag[other].index)));
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
            for wider in levels[at + 1..].iter().filter(|level| level.population > 0) {
                self.pairs_across(wider, slots.clone(), discs, found);
            }
        }
    }
}

/// Two discs as a pair.
#[inline]
fn pair(first: u32, second: u32) -> Pair {
    (first.min(second), first.max(second))
}

/// Adds the pairs of a sorted disc with those of two runs.
#[inline(never)]
fn report<const EACH: bool>(
    sorted: &Sorted,
    slot: usize,
    reach: f32,
    runs: [Range<usize>; 2],
    found: &mut Vec<Pair>,
) {
    let probe = Probe::<EACH>::of(sorted, slot, reach);
    let index = sorted.tag[slot].index;
    for run in runs {
        probe.each(run, |other| found.push(pair(index, sorted.tag[other].index)));
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
            located: &self.located,
            spans: &self.spans,
            reach: &self.reach,
        };
        let cells = self.levels.cells();
        self.cell_order
            .sort(input, cells, team, &mut self.offsets, &mut self.sorted);
        self.levels.populate(&self.offsets);
    }

    fn pairs(&mut self, discs: &Discs<'_>, team: &Team, found: &mut Found) {
        let lists = found.begin(team);
        let (tree, pieces) = (&*self, lists.len());
        team.each((lists, 0..pieces), 1, &|(lists, numbers)| {
            for (list, number) in lists.iter_mut().zip(numbers) {
                let slots = tree.count * number / pieces..tree.count * (number + 1) / pieces;
                tree.search(&slots, discs, list);
            }
        });
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
        let across = self.levels.finest().across(center);
        for level in self.levels.all().iter().filter(|level| level.population > 0) {
            for run in level.runs(center, reach) {
                let (start, end) = (self.offsets[run.start] as usize, self.offsets[run.end] as usize);
                let mut show = |slot: usize| {
                    let index = self.sorted.tag[slot].index;
                    if !self.relocated.holds(index) {
                        found.push(index);
                    }
                };
                match self.same {
                    Some(same) => Probe::<false> {
                        sorted: &self.sorted,
                        x: across.x as f32,
                        y: across.y as f32,
                        reach: self.scale.probing(reach) + self.scale.probed(same),
                    }
                    .each(start..end, &mut show),
                    None => Probe::<true> {
                        sorted: &self.sorted,
                        x: across.x as f32,
                        y: across.y as f32,
                        reach: self.scale.probing(reach),
                    }
                    .each(start..end, &mut show),
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

    fn order(&mut self) -> Option<&[u32]> {
        self.order.clear();
        self.order
            .extend(self.sorted.tag[..self.count].iter().map(|tag| tag.index));
        Some(&self.order)
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
