//! The loose quadtree, without pointers: levels of cells, each level's discs in the order of its cells.
//!
//! A disc lies in the level whose cells are at least as wide as it is, in the cell that holds its centre; so two
//! discs of one level overlap only if their cells touch, and a disc meets a wider level's discs only in the cells
//! around its own place there (Ulrich, "Loose octrees", Game Programming Gems 1, 2000: looseness 2). Each level's
//! cells double those of the level below. A table of offsets per cell, filled by a counting sort, stands for the tree.
//! Centres outside the bounds count to the nearest cell, which keeps neighbours neighbours.

use super::lanes::LANES;
use super::levels::{Level, Levels};
use super::relocated::Relocated;
use super::sorted::{Probe, Sorted, Tag, lanes_of};
use super::{Broadphase, Discs, Pair, Reach, Settings};
use crate::Vec2;

pub(super) struct LooseQuadtree {
    root: [f64; 4],
    levels: Levels,
    /// For each cell, where its discs begin in the sorted arrays; the numbers behind the last cell end the table.
    offsets: Vec<u32>,
    cells: Vec<u32>,
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
            offsets: Vec::new(),
            cells: Vec::new(),
            sorted: Sorted::default(),
            count: 0,
            same: None,
            relocated: Relocated::default(),
        }
    }

    /// The cell of each disc.
    fn assign(&mut self, discs: &Discs<'_>) {
        self.cells.clear();
        if let ([level], Reach::Same(_)) = (self.levels.all_mut(), discs.reach) {
            level.population = self.count as u32;
            let level = &*level;
            self.cells
                .extend(discs.center.iter().map(|&center| level.cell_at(center)));
            return;
        }
        for (index, &center) in discs.center.iter().enumerate() {
            let level = self.levels.of_mut(discs.reach.of(index));
            level.population += 1;
            self.cells.push(level.cell_at(center));
        }
    }

    /// A counting sort by cell. Discs of one cell stay in index order.
    fn sort(&mut self, discs: &Discs<'_>) {
        self.offsets.clear();
        self.offsets.resize(self.levels.cells() + 1, 0);
        for &cell in &self.cells {
            self.offsets[cell as usize] += 1;
        }
        let mut sum = 0;
        for offset in &mut self.offsets {
            sum += *offset;
            *offset = sum;
        }
        let each = matches!(discs.reach, Reach::Each(_));
        self.sorted.resize(self.count, each);
        // From the last to the first, so that each offset ends up at the first disc of its cell.
        for (index, (&cell, &center)) in self.cells.iter().zip(discs.center).enumerate().rev() {
            let offset = &mut self.offsets[cell as usize];
            *offset -= 1;
            let slot = *offset as usize;
            self.sorted.x[slot] = center.x;
            self.sorted.y[slot] = center.y;
            self.sorted.tag[slot] = Tag {
                index: index as u32,
                cell,
            };
            if each {
                self.sorted.reach[slot] = discs.reach.of(index);
            }
        }
    }

    /// Pairs inside one level. A disc is tested against what follows it in its cell and the cell to the right, and
    /// against the three cells above: two runs of the sorted arrays.
    fn pairs_in_level<const EACH: bool>(&self, level: &Level, reach: f64, found: &mut Vec<Pair>) {
        let (first, end) = (
            self.offsets[level.first] as usize,
            self.offsets[level.end()] as usize,
        );
        for slot in first..end {
            let cell = self.sorted.tag[slot].cell as usize;
            let beside = slot + 1..self.offsets[cell + 2] as usize;
            let above = self.offsets[cell + level.stride - 1] as usize
                ..self.offsets[cell + level.stride + 2] as usize;
            let probe = Probe::<EACH>::new(&self.sorted, slot, reach);
            let hits = probe.lanes(beside.start) & lanes_of(beside.len());
            let hits_above = probe.lanes(above.start) & lanes_of(above.len());
            // One branch for the usual case: at most a few candidates, none of which is hit.
            if hits | hits_above != 0 {
                probe.report(hits, beside.start, found);
                probe.report(hits_above, above.start, found);
            }
            if beside.len().max(above.len()) > LANES {
                probe.rest(beside, found);
                probe.rest(above, found);
            }
        }
    }

    /// Pairs of the discs of one level with those of a wider one.
    fn pairs_across(&self, level: &Level, wider: &Level, found: &mut Vec<Pair>) {
        let (first, end) = (
            self.offsets[level.first] as usize,
            self.offsets[level.end()] as usize,
        );
        for slot in first..end {
            let center = Vec2::new(self.sorted.x[slot], self.sorted.y[slot]);
            let probe = Probe::<true>::new(&self.sorted, slot, 0.0);
            for run in wider.runs(center, self.sorted.reach[slot]) {
                let run = self.offsets[run.start] as usize..self.offsets[run.end] as usize;
                probe.report(probe.lanes(run.start) & lanes_of(run.len()), run.start, found);
                probe.rest(run, found);
            }
        }
    }
}

impl Broadphase for LooseQuadtree {
    fn build(&mut self, discs: &Discs<'_>) {
        self.relocated.clear();
        self.count = discs.len();
        self.same = match discs.reach {
            Reach::Same(reach) => Some(reach),
            Reach::Each(_) => None,
        };
        self.levels.lay_out(discs, self.root);
        self.assign(discs);
        self.sort(discs);
    }

    fn pairs(&mut self, _discs: &Discs<'_>, found: &mut Vec<Pair>) {
        let levels = self.levels.all();
        for (at, level) in levels
            .iter()
            .enumerate()
            .filter(|(_, level)| level.population > 0)
        {
            match self.same {
                Some(reach) => self.pairs_in_level::<false>(level, reach, found),
                None => self.pairs_in_level::<true>(level, 0.0, found),
            }
            for wider in levels[at + 1..].iter().filter(|level| level.population > 0) {
                self.pairs_across(level, wider, found);
            }
        }
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
        for level in self.levels.all().iter().filter(|level| level.population > 0) {
            for run in level.runs(center, reach) {
                let (start, end) = (self.offsets[run.start] as usize, self.offsets[run.end] as usize);
                for first in (start..end).step_by(LANES) {
                    let mut hits = lanes_of(end - first)
                        & match self.same {
                            Some(same) => {
                                Probe::<false>::at(&self.sorted, center, 0.5 * (reach + same)).lanes(first)
                            }
                            None => Probe::<true>::at(&self.sorted, center, reach).lanes(first),
                        };
                    while hits != 0 {
                        let index = self.sorted.tag[first + hits.trailing_zeros() as usize].index;
                        hits &= hits - 1;
                        if !self.relocated.holds(index) {
                            found.push(index);
                        }
                    }
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
        self.cells.clear();
        self.cells
            .extend(self.sorted.tag[..self.count].iter().map(|tag| tag.index));
        Some(&self.cells)
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
