//! The levels of the loose quadtree: grids of cells, each twice as wide as those of the level before.
//!
//! Cells are numbered by rows, not along a Morton curve: three neighbours in a row are then one run of discs, which
//! was measured to find pairs more than twice as fast. A level has an empty column on either side and an empty row on
//! top, so that no cell lacks a neighbour.

use std::ops::Range;

use super::lanes::{LANES, Scale};
use super::{Discs, Reach, slack};
use crate::Vec2;

/// Added and taken away again, it leaves the nearest whole number: half way between 2^52 and 2^53, numbers are whole.
const WHOLE: f64 = 6_755_399_441_055_744.0;

/// Cells on a side at the finest level: few enough that rounding in a cell number stays far below the margin.
const MOST_CELLS: f64 = 32768.0;
/// How much wider than its discs a cell is, to make up for that rounding.
const MARGIN: f64 = 1.0 + 1e-9;
/// Cells per disc, at the most: more than balls at any packing that collide often can use.
const CELLS_PER_DISC: f64 = 6.0;
const MOST_LEVELS: usize = 16;
/// Cells that need be no more than so many times as wide to hold all discs are made as wide as that.
const NEARLY: f64 = 1.5;

/// One level.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Level {
    origin: Vec2,
    size: f64,
    /// Cells per metre.
    inverse: f64,
    /// Bounds of a place in the grid; see [`Level::across`].
    most: Vec2,
    rows: u32,
    /// Numbers from a cell to the one above it.
    pub(super) stride: u32,
    /// The number of this level's first cell.
    pub(super) first: usize,
    /// Discs in it, or more.
    pub(super) population: u32,
}

impl Level {
    fn new(origin: Vec2, extent: Vec2, size: f64, first: usize) -> Level {
        let inverse = 1.0 / size;
        // Where the discs are spread over more than f64 can count, one cell holds them all.
        let most =
            |length: f64| Some(length * inverse - 0.5).filter(|most| (0.0..=MOST_CELLS).contains(most));
        let most = Vec2::new(most(extent.x).unwrap_or(-0.5), most(extent.y).unwrap_or(-0.5));
        let stride = whole(most.x) + 3;
        Level {
            origin,
            size,
            inverse,
            most,
            rows: whole(most.y) + 1,
            stride,
            first,
            population: 0,
        }
    }

    /// The number behind this level's last cell.
    pub(super) fn end(&self) -> usize {
        self.first + (self.rows as usize + 1) * self.stride as usize
    }

    /// How many cells a place is from the middle of the first, across and up. What is outside the bounds counts to the
    /// nearest cell: that takes no two places further apart.
    #[inline(always)]
    pub(super) fn across(&self, point: Vec2) -> Vec2 {
        Vec2::new(
            bounded((point.x - self.origin.x) * self.inverse - 0.5, self.most.x),
            bounded((point.y - self.origin.y) * self.inverse - 0.5, self.most.y),
        )
    }

    /// The cell in whose middle, or nearest to it, such a place is. In f64, where it is exact, so that it vectorises.
    #[inline(always)]
    pub(super) fn cell(&self, across: Vec2) -> u32 {
        let (column, row) = ((across.x + WHOLE) - WHOLE, (across.y + WHOLE) - WHOLE);
        whole(row * f64::from(self.stride) + column + (self.first + 1) as f64)
    }

    /// The cell that holds a point.
    #[inline]
    pub(super) fn cell_at(&self, point: Vec2) -> u32 {
        self.cell(self.across(point))
    }

    /// Between these heights, at least, lie the centres of the discs in these cells and in the row above.
    pub(super) fn heights(&self, first: usize, last: usize) -> (f64, f64) {
        let row = |cell: usize| (cell - self.first) / self.stride as usize;
        let height = |row: f64| self.origin.y + row * self.size;
        let (low, high) = (row(first), row(last) + 1);
        // A row more makes up for rounding. The outermost ones have all that is beyond them.
        let bottom = if low == 0 {
            f64::NEG_INFINITY
        } else {
            height(low as f64 - 1.0)
        };
        let top = if high + 1 >= self.rows as usize {
            f64::INFINITY
        } else {
            height(high as f64 + 2.0)
        };
        (bottom, top)
    }

    /// How wide a cell is.
    pub(super) fn size(&self) -> f64 {
        self.size
    }

    /// How this level's coordinates become f32.
    pub(super) fn scale(&self) -> Scale {
        Scale {
            inverse: self.inverse,
            most: self.most.x.max(self.most.y).max(0.5),
        }
    }

    /// Whether discs of that reach fit the cells.
    #[inline]
    fn takes(&self, reach: f64) -> bool {
        2.0 * reach * MARGIN <= self.size
    }

    /// The cells whose discs could meet a disc, row by row.
    pub(super) fn runs(&self, center: Vec2, reach: f64) -> impl Iterator<Item = Range<usize>> + use<> {
        let far = reach + slack(center, reach) + 0.5 * self.size;
        let low = self.across(Vec2::new(center.x - far, center.y - far));
        let high = self.across(Vec2::new(center.x + far, center.y + far));
        let level = *self;
        (whole(low.y)..=whole(high.y)).map(move |row| {
            let cell = |column: f64| level.cell(Vec2::new(column, f64::from(row))) as usize;
            cell(low.x)..cell(high.x) + 1
        })
    }

    /// About what it costs to look among the discs of `other` for those that meet the discs of this level: runs and what
    /// is compared in them.
    pub(super) fn cost_of_looking_in(&self, other: &Level) -> f64 {
        let rows = self.size / other.size + 2.0;
        let cells = f64::from(other.rows) * f64::from(other.stride);
        let compared = rows * f64::from(other.population) / cells / LANES as f64;
        f64::from(self.population) * rows * (1.0 + compared)
    }

    /// The rectangle (left, bottom, right, top) of a cell.
    pub(super) fn rectangle(&self, cell: usize) -> [f64; 4] {
        let (row, column) = (
            (cell - self.first) / self.stride as usize,
            (cell - self.first) % self.stride as usize - 1,
        );
        let left = self.origin.x + column as f64 * self.size;
        let bottom = self.origin.y + row as f64 * self.size;
        [left, bottom, left + self.size, bottom + self.size]
    }
}

/// The nearest whole number, of a number from -0.5 to 2^32 - 1.
#[inline(always)]
fn whole(number: f64) -> u32 {
    (number + WHOLE).to_bits() as u32
}

/// A number from -0.5 to `most`. Written so that it becomes two instructions, and gives one of the bounds for NaN.
#[inline(always)]
fn bounded(number: f64, most: f64) -> f64 {
    let number = if number < most { number } else { most };
    if number > -0.5 { number } else { -0.5 }
}

/// All levels, the finest first.
#[derive(Debug, Default)]
pub(super) struct Levels {
    all: Vec<Level>,
}

impl Levels {
    pub(super) fn all(&self) -> &[Level] {
        &self.all
    }

    /// The finest one.
    pub(super) fn finest(&self) -> &Level {
        &self.all[0]
    }

    /// Counts the discs of each level, given where those of each cell begin.
    pub(super) fn populate(&mut self, offsets: &[u32]) {
        for level in &mut self.all {
            level.population = offsets[level.end()] - offsets[level.first];
        }
    }

    /// How many cells there are, borders included.
    pub(super) fn cells(&self) -> usize {
        self.all.last().map_or(0, Level::end)
    }

    /// The finest level that takes discs of that reach, if one does.
    #[inline]
    pub(super) fn find_mut(&mut self, reach: f64) -> Option<&mut Level> {
        self.all.iter_mut().find(|level| level.takes(reach))
    }

    /// The same for a disc of the layout, which always has one.
    #[inline]
    pub(super) fn of(&self, reach: f64) -> &Level {
        let found = self.all.iter().find(|level| level.takes(reach));
        found.unwrap_or(&self.all[self.all.len() - 1])
    }

    /// Lays the levels out for these discs: over the root, or over the discs alone if they fill little of it.
    pub(super) fn lay_out(&mut self, discs: &Discs<'_>, root: [f64; 4]) {
        self.all.clear();
        let Reaches { finest, most } = Reaches::of(discs);
        let most_cells = CELLS_PER_DISC * discs.len() as f64 + 16.0;
        let [left, bottom, right, top] = root;
        let mut origin = Vec2::new(left, bottom);
        let mut extent = Vec2::new(right - left, top - bottom);
        let mut wanted = 2.0 * finest * MARGIN;
        if extent.x * extent.y > wanted * wanted * most_cells || extent.x.max(extent.y) > wanted * most_cells
        {
            (origin, extent) = bounds(discs);
        }
        if finest < most {
            // Each level is one more place to look: where a cell of the next one would hold a disc or so, start there.
            wanted = wanted.max((extent.x * extent.y / discs.len() as f64).sqrt());
            let widest = 2.0 * most * MARGIN;
            if wanted * NEARLY >= widest {
                wanted = widest;
            }
        }
        let longest = extent.x.max(extent.y);
        let mut size = wanted
            .max((extent.x * extent.y / most_cells).sqrt())
            .max(longest / most_cells)
            .max(longest / MOST_CELLS)
            .max(f64::MIN_POSITIVE);
        loop {
            if self.all.len() + 1 == MOST_LEVELS {
                size = size.max(2.0 * most * MARGIN);
            }
            let level = Level::new(origin, extent, size, self.cells());
            self.all.push(level);
            if level.takes(most) || self.all.len() == MOST_LEVELS {
                return;
            }
            size *= 2.0;
        }
    }
}

/// What the reaches of the discs ask of the levels.
struct Reaches {
    /// The reach that the finest level is made for.
    finest: f64,
    most: f64,
}

impl Reaches {
    /// Discs that differ little share the finest level: it takes up to a quarter more than the mean, but at the most
    /// twice the least.
    fn of(discs: &Discs<'_>) -> Reaches {
        match discs.reach {
            Reach::Same(reach) => Reaches {
                finest: reach,
                most: reach,
            },
            Reach::Each([]) => Reaches {
                finest: 1.0,
                most: 1.0,
            },
            Reach::Each(all) => {
                let (mut least, mut most, mut sum) = ([f64::INFINITY; LANES], [0.0; LANES], [0.0; LANES]);
                let (fours, rest) = all.as_chunks::<LANES>();
                for four in fours {
                    for lane in 0..LANES {
                        least[lane] = if four[lane] < least[lane] {
                            four[lane]
                        } else {
                            least[lane]
                        };
                        most[lane] = if four[lane] > most[lane] {
                            four[lane]
                        } else {
                            most[lane]
                        };
                        sum[lane] += four[lane];
                    }
                }
                let least = least
                    .iter()
                    .chain(rest)
                    .fold(f64::INFINITY, |least, &reach| reach.min(least));
                let most = most
                    .iter()
                    .chain(rest)
                    .fold(0.0, |most: f64, &reach| reach.max(most));
                let mean = sum.iter().chain(rest).sum::<f64>() / all.len() as f64;
                Reaches {
                    finest: (1.25 * mean).min(2.0 * least).min(most),
                    most,
                }
            }
        }
    }
}

/// Origin and extent of the centres.
fn bounds(discs: &Discs<'_>) -> (Vec2, Vec2) {
    let Some(&start) = discs.center.first() else {
        return (Vec2::ZERO, Vec2::ZERO);
    };
    let (low, high) = discs.center.iter().fold((start, start), |(low, high), center| {
        (
            Vec2::new(low.x.min(center.x), low.y.min(center.y)),
            Vec2::new(high.x.max(center.x), high.y.max(center.y)),
        )
    });
    (low, high - low)
}

#[cfg(test)]
mod tests;
