//! Where discs are, block by block: what a sort by cell goes by.

use std::ops::Range;

use crate::team::Divide;

/// Discs that are passed over together.
pub(super) const BLOCK: usize = 1024;

/// The least and the greatest cell of a block.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Span {
    least: u32,
    greatest: u32,
}

impl Span {
    /// For a sort in one piece, which looks at every block anyway.
    pub(super) const ALL: Span = Span {
        least: 0,
        greatest: u32::MAX,
    };

    pub(super) fn of(cells: &[u32]) -> Span {
        let (mut least, mut greatest) = (u32::MAX, 0);
        for &cell in cells {
            least = least.min(cell);
            greatest = greatest.max(cell);
        }
        Span { least, greatest }
    }

    /// Whether a disc of the block may be in one of these cells.
    #[inline]
    pub(super) fn meets(&self, cells: &Range<u32>) -> bool {
        self.least < cells.end && self.greatest >= cells.start
    }
}

/// What is to be found out about discs: their cells, the spans of their blocks, their coordinates in cells.
pub(super) struct Places<'a> {
    pub(super) cells: &'a mut [u32],
    pub(super) spans: &'a mut [Span],
    pub(super) across: &'a mut [[f32; 2]],
}

impl<'a> Places<'a> {
    /// The same, block by block.
    pub(super) fn blocks(self) -> impl Iterator<Item = (&'a mut [u32], &'a mut Span, &'a mut [[f32; 2]])> {
        let across = self
            .across
            .chunks_mut(BLOCK)
            .chain(std::iter::repeat_with(Default::default));
        (self.cells.chunks_mut(BLOCK))
            .zip(self.spans)
            .zip(across)
            .map(|((cells, span), across)| (cells, span, across))
    }
}

impl Divide for Places<'_> {
    fn length(&self) -> usize {
        self.cells.len()
    }

    fn divide(self, at: usize) -> (Self, Self) {
        let (cells, noted) = (self.cells.split_at_mut(at), at.min(self.across.len()));
        let across = self.across.split_at_mut(noted);
        let spans = self.spans.split_at_mut(at.div_ceil(BLOCK));
        (
            Places {
                cells: cells.0,
                spans: spans.0,
                across: across.0,
            },
            Places {
                cells: cells.1,
                spans: spans.1,
                across: across.1,
            },
        )
    }
}
