//! Putting discs in the order of their cells: a counting sort whose pieces can be done at once.
//!
//! A piece is a range of cells, and so of places in the sorted arrays. It looks through all discs for its own; blocks
//! of discs that have none of its cells are passed over, and as neighbours are kept near each other in memory most
//! blocks are. Discs of one cell stay in index order, whatever the pieces.

use std::ops::Range;

use super::lanes::Scale;
use super::level::Level;
use super::places::{BLOCK, Span};
use super::sorted::Sorted;
use super::{Discs, Reach};
use crate::team::{Divide, Team};

/// The discs of the sort.
#[derive(Clone, Copy)]
pub(super) struct Input<'a> {
    pub(super) cells: &'a [u32],
    pub(super) spans: &'a [Span],
    /// Where all discs share their reach; empty where they do not: there coordinates come of the discs again, as fast, and
    /// take no memory.
    pub(super) across: &'a [[f32; 2]],
    pub(super) discs: &'a Discs<'a>,
    /// In whose cells coordinates are counted.
    pub(super) finest: Level,
    pub(super) scale: Scale,
}

impl<'a> Input<'a> {
    /// Blocks, with the index of their first disc, that may have discs in these cells.
    fn blocks(self, cells: &Range<u32>) -> impl DoubleEndedIterator<Item = (usize, &'a [u32])> {
        let cells = cells.clone();
        (self.spans.iter().zip(self.cells.chunks(BLOCK)).enumerate())
            .filter(move |(_, (span, _))| span.meets(&cells))
            .map(|(number, (_, block))| (number * BLOCK, block))
    }
}

#[derive(Clone, Copy, Default)]
struct Piece {
    cells: (u32, u32),
    discs: (u32, u32),
}

/// Scratch memory of the sort.
#[derive(Default)]
pub(super) struct CellOrder {
    pieces: Vec<Piece>,
}

impl CellOrder {
    /// Sorts by cell. `offsets` gets, for each of the `cells`, where its discs begin, and behind them how many there are.
    pub(super) fn sort(
        &mut self,
        input: Input<'_>,
        cells: usize,
        team: &Team,
        offsets: &mut Vec<u32>,
        sorted: &mut Sorted,
    ) {
        let count = input.cells.len();
        sorted.resize(count, matches!(input.discs.reach, Reach::Each(_)));
        offsets.resize(cells + 1, 0);
        let parts = team.pieces();
        self.pieces.clear();
        self.pieces.extend((0..parts).map(|part| Piece {
            cells: ((cells * part / parts) as u32, (cells * (part + 1) / parts) as u32),
            discs: (0, 0),
        }));
        let counting = Counting {
            pieces: &mut self.pieces,
            offsets: &mut offsets[..cells],
        };
        team.each(counting, 1, &|work| work.count(input));
        let mut begin = 0;
        for piece in &mut self.pieces {
            piece.discs = (begin, begin + piece.discs.1);
            begin = piece.discs.1;
        }
        let each = sorted.reach.len().min(count);
        let placing = Placing {
            pieces: &self.pieces,
            offsets: &mut offsets[..cells],
            x: &mut sorted.x[..count],
            y: &mut sorted.y[..count],
            reach: &mut sorted.reach[..each],
            cell: &mut sorted.cell,
            index: &mut sorted.index,
        };
        team.each(placing, 1, &|work| work.place(input));
        offsets[cells] = count as u32;
    }
}

/// Counts the discs of each cell, and of each piece.
struct Counting<'a> {
    pieces: &'a mut [Piece],
    offsets: &'a mut [u32],
}

impl Divide for Counting<'_> {
    fn length(&self) -> usize {
        self.pieces.len()
    }

    fn divide(self, at: usize) -> (Self, Self) {
        let cells = (self.pieces[at].cells.0 - self.pieces[0].cells.0) as usize;
        let (pieces, offsets) = (self.pieces.split_at_mut(at), self.offsets.split_at_mut(cells));
        (
            Counting {
                pieces: pieces.0,
                offsets: offsets.0,
            },
            Counting {
                pieces: pieces.1,
                offsets: offsets.1,
            },
        )
    }
}

impl Counting<'_> {
    /// Leaves in `offsets`, for each cell, the count of its piece's discs up to its end.
    fn count(self, input: Input<'_>) {
        let mut rest = self.offsets;
        for piece in self.pieces {
            let (first, end) = piece.cells;
            let offsets;
            (offsets, rest) = rest.split_at_mut((end - first) as usize);
            offsets.fill(0);
            for (_, block) in input.blocks(&(first..end)) {
                for cell in block {
                    // What is below the first cell wraps round to beyond the last.
                    if let Some(offset) = offsets.get_mut(cell.wrapping_sub(first) as usize) {
                        *offset += 1;
                    }
                }
            }
            let mut sum = 0;
            for offset in offsets {
                sum += *offset;
                *offset = sum;
            }
            piece.discs.1 = sum;
        }
    }
}

/// Puts the discs of each piece in their places.
struct Placing<'a> {
    pieces: &'a [Piece],
    offsets: &'a mut [u32],
    x: &'a mut [f32],
    y: &'a mut [f32],
    reach: &'a mut [f32],
    cell: &'a mut [u32],
    index: &'a mut [u32],
}

impl Divide for Placing<'_> {
    fn length(&self) -> usize {
        self.pieces.len()
    }

    fn divide(self, at: usize) -> (Self, Self) {
        let cells = (self.pieces[at].cells.0 - self.pieces[0].cells.0) as usize;
        let discs = (self.pieces[at].discs.0 - self.pieces[0].discs.0) as usize;
        let pieces = self.pieces.split_at(at);
        let offsets = self.offsets.split_at_mut(cells);
        let (x, y) = (self.x.split_at_mut(discs), self.y.split_at_mut(discs));
        let reach = self.reach.split_at_mut(discs.min(self.reach.len()));
        let (cell, index) = (self.cell.split_at_mut(discs), self.index.split_at_mut(discs));
        (
            Placing {
                pieces: pieces.0,
                offsets: offsets.0,
                x: x.0,
                y: y.0,
                reach: reach.0,
                cell: cell.0,
                index: index.0,
            },
            Placing {
                pieces: pieces.1,
                offsets: offsets.1,
                x: x.1,
                y: y.1,
                reach: reach.1,
                cell: cell.1,
                index: index.1,
            },
        )
    }
}

impl Placing<'_> {
    fn place(mut self, input: Input<'_>) {
        while self.pieces.len() > 1 {
            let (first, rest) = self.divide(1);
            first.place_one(input);
            self = rest;
        }
        self.place_one(input);
    }

    fn place_one(self, input: Input<'_>) {
        match input.discs.reach {
            Reach::Same(_) => self.scatter(input, |index, _, _| input.across[index]),
            Reach::Each(all) => self.scatter(input, |index, slot, reaches| {
                reaches[slot] = input.scale.probed(all[index]);
                let across = input.finest.across(input.discs.center[index]);
                [across.x as f32, across.y as f32]
            }),
        }
    }

    /// `note` gives a disc's coordinates, and notes its reach in a slot.
    #[inline(always)]
    fn scatter(self, input: Input<'_>, note: impl Fn(usize, usize, &mut [f32]) -> [f32; 2]) {
        let Piece {
            cells: (first, end),
            discs: (begin, _),
        } = self.pieces[0];
        // From the last to the first, so that each offset ends up at the first disc of its cell.
        for (start, block) in input.blocks(&(first..end)).rev() {
            for (at, &cell) in block.iter().enumerate().rev() {
                let Some(offset) = self.offsets.get_mut(cell.wrapping_sub(first) as usize) else {
                    continue;
                };
                *offset -= 1;
                let (slot, index) = (*offset as usize, start + at);
                [self.x[slot], self.y[slot]] = note(index, slot, self.reach);
                self.cell[slot] = cell;
                self.index[slot] = index as u32;
            }
        }
        if begin > 0 {
            for offset in self.offsets {
                *offset += begin;
            }
        }
    }
}

#[cfg(test)]
mod tests;
