//! Morton order: cells of a square numbered so that the four quarters of any node follow one another.

/// Spreads the lower 16 bits over the even bits.
#[inline]
fn spread(value: u32) -> u32 {
    let mut v = value & 0xffff;
    v = (v | (v << 8)) & 0x00ff_00ff;
    v = (v | (v << 4)) & 0x0f0f_0f0f;
    v = (v | (v << 2)) & 0x3333_3333;
    (v | (v << 1)) & 0x5555_5555
}

/// Gathers the even bits.
#[inline]
fn gather(value: u32) -> u32 {
    let mut v = value & 0x5555_5555;
    v = (v | (v >> 1)) & 0x3333_3333;
    v = (v | (v >> 2)) & 0x0f0f_0f0f;
    v = (v | (v >> 4)) & 0x00ff_00ff;
    (v | (v >> 8)) & 0xffff
}

/// Cells of a row (or column) of squares of 2^bits x 2^bits cells, Morton order inside each square: a long box needs
/// no more cells than it has area.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Curve {
    bits: u32,
    tall: bool,
}

impl Curve {
    /// For a grid of so many columns and rows; returns the curve and the number of cells that it numbers.
    pub(super) fn new(columns: u32, rows: u32) -> (Curve, usize) {
        let bits = u32::BITS - (columns.min(rows).max(1) - 1).leading_zeros();
        let curve = Curve {
            bits,
            tall: rows > columns,
        };
        let squares = (columns.max(rows) - 1) >> bits;
        (curve, (squares as usize + 1) << (2 * bits))
    }

    #[inline]
    pub(super) fn cell(self, column: u32, row: u32) -> usize {
        let mask = (1u32 << self.bits) - 1;
        let square = (if self.tall { row } else { column }) >> self.bits;
        let inside = spread(column & mask) | (spread(row & mask) << 1);
        ((square as usize) << (2 * self.bits)) | inside as usize
    }

    pub(super) fn place(self, cell: usize) -> (u32, u32) {
        let square = (cell >> (2 * self.bits)) as u32;
        let inside = (cell & ((1usize << (2 * self.bits)) - 1)) as u32;
        let (mut column, mut row) = (gather(inside), gather(inside >> 1));
        *(if self.tall { &mut row } else { &mut column }) += square << self.bits;
        (column, row)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn each_place_has_a_cell_of_its_own(columns in 1u32..70, rows in 1u32..70) {
            let (curve, cells) = Curve::new(columns, rows);
            let mut seen = vec![false; cells];
            for column in 0..columns {
                for row in 0..rows {
                    let cell = curve.cell(column, row);
                    prop_assert!(!std::mem::replace(&mut seen[cell], true));
                    prop_assert_eq!(curve.place(cell), (column, row));
                }
            }
        }

        #[test]
        fn a_node_holds_its_quarters_in_a_row(column in 0u32..1 << 14, row in 0u32..1 << 14, level in 0u32..8) {
            let (curve, _) = Curve::new(1 << 14, 1 << 14);
            let node = (column >> level << level, row >> level << level);
            let first = curve.cell(node.0, node.1);
            let cell = curve.cell(column, row);
            prop_assert!(first <= cell && cell < first + (1 << (2 * level)));
        }
    }
}
