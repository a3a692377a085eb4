//! Putting discs in the order of their cells: a counting sort whose pieces can be done at once.
//!
//! A piece is a range of cells, and so of places in the sorted arrays. It looks through all discs for its own; blocks
//! of discs that have none of its cells are passed over, and as neighbours are kept near each other in memory most
//! blocks are. Discs of one cell stay in index order, whatever the pieces.

use std::ops::Range;

use super::sorted::{Sorted, Tag};
use crate::Vec2;
use crate::team::{Divide, Team};

/// Discs that are passed over together.
pub(super) const BLOCK: usize = 1024;

/// What the sort knows of a disc.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Located {
    pub(super) x: f32,
    pub(super) y: f32,
    pub(super) cell: u32,
}

impl Located {
    #[inline(always)]
    pub(super) fn at(across: Vec2, cell: u32) -> Located {
        Located {
            x: across.x as f32,
            y: across.y as f32,
            cell,
        }
    }
}

/// The least and the greatest cell of a block.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Span {
    least: u32,
    greatest: u32,
}

impl Span {
    pub(super) fn of(block: &[Located]) -> Span {
        let (mut least, mut greatest) = (u32::MAX, 0);
        for located in block {
            least = least.min(located.cell);
            greatest = greatest.max(located.cell);
        }
        Span { least, greatest }
    }
}

/// Discs and the spans of their blocks, to be filled.
pub(super) struct Blocks<'a> {
    pub(super) located: &'a mut [Located],
    pub(super) spans: &'a mut [Span],
}

impl<'a> Blocks<'a> {
    /// Block by block, with its span.
    pub(super) fn each(self) -> impl Iterator<Item = (&'a mut [Located], &'a mut Span)> {
        self.located.chunks_mut(BLOCK).zip(self.spans)
    }
}

impl Divide for Blocks<'_> {
    fn length(&self) -> usize {
        self.located.len()
    }

    fn divide(self, at: usize) -> (Self, Self) {
        let (located, spans) = (
            self.located.split_at_mut(at),
            self.spans.split_at_mut(at.div_ceil(BLOCK)),
        );
        (
            Blocks {
                located: located.0,
                spans: spans.0,
            },
            Blocks {
                located: located.1,
                spans: spans.1,
            },
        )
    }
}

/// The discs of the sort.
#[derive(Clone, Copy)]
pub(super) struct Input<'a> {
    pub(super) located: &'a [Located],
    pub(super) spans: &'a [Span],
    /// In the units of the sorted arrays; empty if all discs share it.
    pub(super) reach: &'a [f32],
}

impl<'a> Input<'a> {
    /// Blocks, with the index of their first disc, that may have discs in these cells.
    fn blocks(self, cells: &Range<u32>) -> impl DoubleEndedIterator<Item = (usize, &'a [Located])> {
        let cells = cells.clone();
        (self.spans.iter().zip(self.located.chunks(BLOCK)).enumerate())
            .filter(move |(_, (span, _))| span.least < cells.end && span.greatest >= cells.start)
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
        let count = input.located.len();
        sorted.resize(count, !input.reach.is_empty());
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
            tag: &mut sorted.tag[..count],
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
                for located in block {
                    // What is below the first cell wraps round to beyond the last.
                    if let Some(offset) = offsets.get_mut(located.cell.wrapping_sub(first) as usize) {
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
    tag: &'a mut [Tag],
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
        let tag = self.tag.split_at_mut(discs);
        (
            Placing {
                pieces: pieces.0,
                offsets: offsets.0,
                x: x.0,
                y: y.0,
                reach: reach.0,
                tag: tag.0,
            },
            Placing {
                pieces: pieces.1,
                offsets: offsets.1,
                x: x.1,
                y: y.1,
                reach: reach.1,
                tag: tag.1,
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
        let Piece {
            cells: (first, end),
            discs: (begin, _),
        } = self.pieces[0];
        // From the last to the first, so that each offset ends up at the first disc of its cell.
        for (start, block) in input.blocks(&(first..end)).rev() {
            for (index, located) in (start..start + block.len()).zip(block).rev() {
                let Some(offset) = self.offsets.get_mut(located.cell.wrapping_sub(first) as usize) else {
                    continue;
                };
                *offset -= 1;
                let slot = *offset as usize;
                self.x[slot] = located.x;
                self.y[slot] = located.y;
                self.tag[slot] = Tag {
                    index: index as u32,
                    cell: located.cell,
                };
                if !self.reach.is_empty() {
                    self.reach[slot] = input.reach[index];
                }
            }
        }
        if begin > 0 {
            for offset in self.offsets {
                *offset += begin;
            }
        }
    }
}
