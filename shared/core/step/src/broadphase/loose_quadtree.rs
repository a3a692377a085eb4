//! The loose quadtree, without pointers: levels of cells, each level's discs in Morton order.
//!
//! A disc lies in the level whose cells are at least as wide as it is, in the cell that holds its centre; so two
//! discs of one level overlap only if their cells touch, and a disc meets a wider level's discs only in the cells
//! around its own place there (Ulrich, "Loose octrees", Game Programming Gems 1, 2000: looseness 2). Each level's
//! cells double those of the level below. A table of offsets per cell, filled by a counting sort, stands for the tree.
//! Centres outside the bounds count to the nearest cell, which keeps neighbours neighbours.

use super::morton::Curve;
use super::{Broadphase, Discs, Pair, slack};
use crate::Vec2;

/// Cells on a side at the finest level: few enough that rounding in a cell number stays far below the margin.
const MOST_CELLS: f64 = 32768.0;
/// How much wider than its discs a cell is, to make up for that rounding.
const MARGIN: f64 = 1.0 + 1e-9;
const MOST_LEVELS: usize = 16;
const NOWHERE: u32 = u32::MAX;

#[derive(Clone, Copy, Default)]
struct Level {
    /// Cells per metre.
    inverse: f64,
    size: f64,
    columns: u32,
    rows: u32,
    curve: Curve,
    /// Where this level begins in the table of offsets.
    first: usize,
    population: u32,
}

impl Level {
    #[inline]
    fn column(&self, x: f64) -> u32 {
        // The cast sends what is below 0 to 0; the minimum keeps what is beyond the last cell in it.
        ((x * self.inverse) as u32).min(self.columns - 1)
    }

    #[inline]
    fn row(&self, y: f64) -> u32 {
        ((y * self.inverse) as u32).min(self.rows - 1)
    }

    #[inline]
    fn cell(&self, column: u32, row: u32) -> usize {
        self.first + self.curve.cell(column, row)
    }
}

#[derive(Clone, Copy)]
struct Entry {
    center: Vec2,
    reach: f64,
    index: u32,
    level: u32,
}

#[derive(Default)]
pub(super) struct LooseQuadtree {
    origin: Vec2,
    levels: Vec<Level>,
    /// For each cell, where its discs begin among the entries; one more number ends the last.
    offsets: Vec<u32>,
    entries: Vec<Entry>,
    cells: Vec<u32>,
    /// Where each disc stands among the entries.
    slots: Vec<u32>,
    /// Discs that were relocated, in chains that begin at their new cell.
    heads: Vec<u32>,
    moved: Vec<Moved>,
    moved_slots: Vec<u32>,
    /// Relocated discs that are wider than the widest cell.
    wide: Vec<u32>,
}

#[derive(Clone, Copy)]
struct Moved {
    center: Vec2,
    reach: f64,
    index: u32,
    next: u32,
    cell: u32,
}

impl LooseQuadtree {
    fn lay_out(&mut self, discs: &Discs<'_>) {
        let (mut low, mut high) = (discs.center[0], discs.center[0]);
        for center in discs.center {
            low = Vec2::new(low.x.min(center.x), low.y.min(center.y));
            high = Vec2::new(high.x.max(center.x), high.y.max(center.y));
        }
        let (mut least, mut most) = (f64::INFINITY, 0.0f64);
        for index in 0..discs.len() {
            let reach = discs.reach.of(index);
            least = least.min(reach);
            most = most.max(reach);
        }
        self.origin = low;
        let (width, height) = (high.x - low.x, high.y - low.y);
        // No more than about two cells a disc, whatever the box and the smallest disc.
        let fewest = (width * height / (2.0 * discs.len() as f64)).sqrt();
        let longest = width.max(height);
        let mut size = (2.0 * least * MARGIN)
            .max(fewest)
            .max(longest / (2.0 * discs.len() as f64 + 4.0))
            .max(longest / MOST_CELLS)
            .max(f64::MIN_POSITIVE);
        self.levels.clear();
        let mut first = 0;
        loop {
            let columns = (width / size) as u32 + 1;
            let rows = (height / size) as u32 + 1;
            let (curve, cells) = Curve::new(columns, rows);
            let inverse = 1.0 / size;
            self.levels.push(Level {
                inverse,
                size,
                columns,
                rows,
                curve,
                first,
                population: 0,
            });
            first += cells;
            if size >= 2.0 * most * MARGIN || self.levels.len() == MOST_LEVELS {
                break;
            }
            size *= 2.0;
        }
        if let Some(last) = self.levels.last_mut()
            && last.size < 2.0 * most * MARGIN
        {
            // The levels ran out: one cell holds all that is wider than any of them.
            let (curve, _) = Curve::new(1, 1);
            let cells = last.first;
            *last = Level {
                inverse: 0.0,
                size: f64::INFINITY,
                columns: 1,
                rows: 1,
                curve,
                first: cells,
                population: 0,
            };
            first = cells + 1;
        }
        self.offsets.clear();
        self.offsets.resize(first + 1, 0);
    }

    /// The finest level whose cells are wide enough; None if none is.
    #[inline]
    fn level_for(&self, reach: f64) -> Option<usize> {
        if self.levels.len() == 1 && 2.0 * reach * MARGIN <= self.levels[0].size {
            return Some(0);
        }
        self.levels
            .iter()
            .position(|level| 2.0 * reach * MARGIN <= level.size)
    }

    /// Pairs of a disc with those of its own level that come later: in its cell, and in four of the eight around it.
    #[inline]
    fn pairs_in_level(&self, slot: usize, entry: &Entry, found: &mut Vec<Pair>) {
        let level = &self.levels[entry.level as usize];
        let place = entry.center - self.origin;
        let (column, row) = (level.column(place.x), level.row(place.y));
        let own = level.cell(column, row);
        self.test(entry, slot + 1, self.offsets[own + 1] as usize, found);
        if column + 1 < level.columns {
            self.test_cell(entry, level.cell(column + 1, row), found);
        }
        if row + 1 < level.rows {
            if column > 0 {
                self.test_cell(entry, level.cell(column - 1, row + 1), found);
            }
            self.test_cell(entry, level.cell(column, row + 1), found);
            if column + 1 < level.columns {
                self.test_cell(entry, level.cell(column + 1, row + 1), found);
            }
        }
    }

    #[inline]
    fn test_cell(&self, entry: &Entry, cell: usize, found: &mut Vec<Pair>) {
        self.test(
            entry,
            self.offsets[cell] as usize,
            self.offsets[cell + 1] as usize,
            found,
        );
    }

    #[inline]
    fn test(&self, entry: &Entry, from: usize, to: usize, found: &mut Vec<Pair>) {
        for other in &self.entries[from..to] {
            let sum = entry.reach + other.reach;
            if (entry.center - other.center).square() < sum * sum {
                found.push((entry.index.min(other.index), entry.index.max(other.index)));
            }
        }
    }

    /// The cells of a level whose discs could meet a disc of that reach, as columns and rows, both ends included.
    #[inline]
    fn around(&self, level: &Level, center: Vec2, reach: f64) -> [u32; 4] {
        if level.size.is_infinite() {
            return [0, 0, 0, 0];
        }
        let far = reach + slack(center, reach) + 0.5 * level.size;
        let low = center - self.origin - Vec2::new(far, far);
        let high = center - self.origin + Vec2::new(far, far);
        [
            level.column(low.x),
            level.row(low.y),
            level.column(high.x),
            level.row(high.y),
        ]
    }
}

impl Broadphase for LooseQuadtree {
    fn build(&mut self, discs: &Discs<'_>) {
        self.heads.clear();
        self.moved.clear();
        self.moved_slots.clear();
        self.wide.clear();
        self.entries.clear();
        if discs.is_empty() {
            self.levels.clear();
            return;
        }
        self.lay_out(discs);
        self.cells.clear();
        for (index, &center) in discs.center.iter().enumerate() {
            // The last level takes whatever no level is wide enough for.
            let at = self
                .level_for(discs.reach.of(index))
                .unwrap_or(self.levels.len() - 1);
            let level = &mut self.levels[at];
            level.population += 1;
            let place = center - self.origin;
            let cell = level.cell(level.column(place.x), level.row(place.y));
            self.offsets[cell] += 1;
            self.cells.push(cell as u32);
        }
        let mut sum = 0;
        for offset in &mut self.offsets {
            sum += *offset;
            *offset = sum;
        }
        let nothing = Entry {
            center: Vec2::ZERO,
            reach: 0.0,
            index: 0,
            level: 0,
        };
        self.entries.resize(discs.len(), nothing);
        self.slots.resize(discs.len(), 0);
        // From the last to the first, so that each cell's discs end up in index order and its offset at its first.
        for index in (0..discs.len()).rev() {
            let cell = self.cells[index] as usize;
            let slot = self.offsets[cell] - 1;
            self.offsets[cell] = slot;
            self.slots[index] = slot;
            let reach = discs.reach.of(index);
            let level = self.levels.partition_point(|level| level.first <= cell) - 1;
            self.entries[slot as usize] = Entry {
                center: discs.center[index],
                reach,
                index: index as u32,
                level: level as u32,
            };
        }
    }

    fn pairs(&mut self, discs: &Discs<'_>, found: &mut Vec<Pair>) {
        debug_assert_eq!(discs.len(), self.entries.len());
        for (slot, entry) in self.entries.iter().enumerate() {
            self.pairs_in_level(slot, entry, found);
            for level in &self.levels[entry.level as usize + 1..] {
                if level.population == 0 {
                    continue;
                }
                let [left, bottom, right, top] = self.around(level, entry.center, entry.reach);
                for row in bottom..=top {
                    for column in left..=right {
                        self.test_cell(entry, level.cell(column, row), found);
                    }
                }
            }
        }
    }

    fn relocate(&mut self, index: usize, center: Vec2, reach: f64) {
        if self.moved_slots.is_empty() {
            self.moved_slots.resize(self.entries.len(), NOWHERE);
            self.heads.resize(self.offsets.len(), NOWHERE);
        }
        let old = self.moved_slots[index];
        let at = if old == NOWHERE {
            let at = self.moved.len() as u32;
            self.moved_slots[index] = at;
            self.moved.push(Moved {
                center,
                reach,
                index: index as u32,
                next: NOWHERE,
                cell: NOWHERE,
            });
            at
        } else {
            self.unchain(old);
            old
        };
        let cell = self.level_for(reach).map(|level| {
            let level = &mut self.levels[level];
            // Never counted down: a level that was once used may be visited in vain, no more.
            level.population += 1;
            let place = center - self.origin;
            level.cell(level.column(place.x), level.row(place.y))
        });
        let entry = &mut self.moved[at as usize];
        entry.center = center;
        entry.reach = reach;
        if let Some(cell) = cell {
            entry.cell = cell as u32;
            entry.next = self.heads[cell];
            self.heads[cell] = at;
        } else {
            entry.cell = NOWHERE;
            entry.next = NOWHERE;
            self.wide.push(at);
        }
    }

    fn query(&self, center: Vec2, reach: f64, found: &mut Vec<u32>) {
        let near = |other: Vec2, far: f64| {
            let sum = reach + far;
            (center - other).square() <= sum * sum * (1.0 + 1e-9)
        };
        for level in self.levels.iter().filter(|level| level.population > 0) {
            let [left, bottom, right, top] = self.around(level, center, reach);
            for row in bottom..=top {
                for column in left..=right {
                    let cell = level.cell(column, row);
                    let range = self.offsets[cell] as usize..self.offsets[cell + 1] as usize;
                    for entry in &self.entries[range] {
                        let stays =
                            self.moved_slots.is_empty() || self.moved_slots[entry.index as usize] == NOWHERE;
                        if stays && near(entry.center, entry.reach) {
                            found.push(entry.index);
                        }
                    }
                    if self.heads.is_empty() {
                        continue;
                    }
                    let mut at = self.heads[cell];
                    while at != NOWHERE {
                        let moved = &self.moved[at as usize];
                        if near(moved.center, moved.reach) {
                            found.push(moved.index);
                        }
                        at = moved.next;
                    }
                }
            }
        }
        for &at in &self.wide {
            let moved = &self.moved[at as usize];
            if near(moved.center, moved.reach) {
                found.push(moved.index);
            }
        }
    }

    fn nodes(&self) -> Vec<[f64; 4]> {
        let mut nodes = Vec::new();
        for (at, level) in self
            .levels
            .iter()
            .enumerate()
            .filter(|(_, level)| level.size.is_finite())
        {
            let end = self
                .levels
                .get(at + 1)
                .map_or(self.offsets.len() - 1, |next| next.first);
            for cell in level.first..end {
                if self.offsets[cell] < self.offsets[cell + 1] {
                    let (column, row) = level.curve.place(cell - level.first);
                    let left = self.origin.x + f64::from(column) * level.size;
                    let bottom = self.origin.y + f64::from(row) * level.size;
                    nodes.push([left, bottom, left + level.size, bottom + level.size]);
                }
            }
        }
        nodes
    }
}

impl LooseQuadtree {
    fn unchain(&mut self, at: u32) {
        let Moved { cell, next, .. } = self.moved[at as usize];
        if cell == NOWHERE {
            self.wide.retain(|&other| other != at);
            return;
        }
        let mut link = self.heads[cell as usize];
        if link == at {
            self.heads[cell as usize] = next;
            return;
        }
        while link != NOWHERE {
            let following = self.moved[link as usize].next;
            if following == at {
                self.moved[link as usize].next = next;
                return;
            }
            link = following;
        }
    }
}
