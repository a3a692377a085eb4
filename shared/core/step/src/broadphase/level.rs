//! One level of the loose quadtree: a grid of cells.
//!
//! Cells are numbered by rows, not along a Morton curve: three neighbours in a row are then one run of discs, which
//! was measured to find pairs more than twice as fast. A level has an empty column on either side and an empty row on
//! top, so that no cell lacks a neighbour.

use std::ops::Range;

use super::lanes::{LANES, Scale};
use super::slack;
use crate::Vec2;

/// Added and taken away again, it leaves the nearest whole number: half way between 2^52 and 2^53, numbers are whole.
const WHOLE: f64 = 6_755_399_441_055_744.0;

/// Cells on a side at the finest level: few enough that rounding in a cell number stays far below the margin.
pub(super) const MOST_CELLS: f64 = 32768.0;
/// How much wider than its discs a cell is, to make up for that rounding.
pub(super) const MARGIN: f64 = 1.0 + 1e-9;

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
    pub(super) fn new(origin: Vec2, extent: Vec2, size: f64, first: usize) -> Level {
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
    pub(super) fn takes(&self, reach: f64) -> bool {
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
