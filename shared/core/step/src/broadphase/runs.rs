//! The runs of sorted discs that a disc of the same level may meet, and the search for those that have anybody near.

use std::ops::Range;

use super::lanes::{LANES, all_beyond, beyond, lanes_at, sums};
use super::sorted::Sorted;

/// How the cells of a level lie in the table of offsets.
pub(super) struct Row<'a> {
    pub(super) offsets: &'a [u32],
    /// Numbers from a cell to the one above it.
    pub(super) stride: u32,
}

impl Row<'_> {
    /// What follows a disc in its cell and the cell to the right, and the three cells above.
    #[inline(always)]
    pub(super) fn runs(&self, slot: usize, cell: u32) -> (Range<usize>, Range<usize>) {
        let (cell, stride) = (cell as usize, self.stride as usize);
        let offset = |cell: usize| self.offsets[cell] as usize;
        let above = offset(cell + stride - 1)..offset(cell + stride + 2);
        (slot + 1..offset(cell + 2), above)
    }
}

/// A bit for each of up to 64 discs: whether another may be near it in its runs, or there are too many to tell.
#[inline(never)] // Alone, its loop keeps what it needs in registers.
pub(super) fn some_near<const EACH: bool>(
    sorted: &Sorted,
    row: &Row<'_>,
    reach: f32,
    slots: Range<usize>,
) -> u64 {
    let length = sorted.x.len();
    // Of one length, so that one check does for all.
    let (x, y) = (&sorted.x[..length], &sorted.y[..length]);
    let reaches = if EACH { &sorted.reach[..length] } else { &[] };
    let mut some = 0;
    for (bit, (slot, &cell)) in slots.clone().zip(&sorted.cell[slots]).enumerate() {
        let (beside, above) = row.runs(slot, cell);
        let own = if EACH { reaches[slot] + reach } else { reach };
        let (from_x, from_y) = (x[slot], y[slot]);
        let [first, second] = [beside.start, above.start].map(|start| {
            let sums = sums::<EACH>(reaches, start, own);
            beyond(lanes_at(x, start), lanes_at(y, start), from_x, from_y, &sums)
        });
        // The lanes behind a run belong to cells further off, where next to nothing is near.
        let none = all_beyond(first, second);
        let many = (beside.end - beside.start > LANES) | (above.end - above.start > LANES);
        some |= u64::from(!none | many) << bit;
    }
    some
}
