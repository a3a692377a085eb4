//! The quadtree of a fixed depth over a box: which node a point lies in.

use kuglice_step::Vec2;

use crate::Error;

/// Levels of nodes below the box, at the most: 65,536 nodes.
pub const MOST_DEPTH: u32 = 8;

/// Nodes are numbered by their path from the root, two bits a level: 0 left bottom, 1 right bottom, 2 left top, 3 right
/// top. A point outside of the box belongs to the nearest node at its edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    origin: Vec2,
    /// Nodes per metre.
    inverse: Vec2,
    depth: u32,
}

impl Grid {
    /// `bounds` are left, bottom, right, top.
    ///
    /// # Errors
    /// [`Error`] for bounds that are no box, or a depth above [`MOST_DEPTH`].
    pub fn new(bounds: [f64; 4], depth: u32) -> Result<Grid, Error> {
        let [left, bottom, right, top] = bounds;
        if !(bounds.iter().all(|side| side.is_finite()) && left < right && bottom < top) {
            return Err(Error(format!(
                "box {bounds:?}: must be finite with left < right and bottom < top"
            )));
        }
        if depth > MOST_DEPTH {
            return Err(Error(format!("depth {depth}: at most {MOST_DEPTH}")));
        }
        let side = f64::from(1u32 << depth);
        Ok(Grid {
            origin: Vec2::new(left, bottom),
            inverse: Vec2::new(side / (right - left), side / (top - bottom)),
            depth,
        })
    }

    /// Left and bottom of the box.
    #[must_use]
    pub fn origin(&self) -> Vec2 {
        self.origin
    }

    /// Number of nodes.
    #[must_use]
    pub fn nodes(&self) -> usize {
        1 << (2 * self.depth)
    }

    /// Where a point stands row by row, which costs less than its path.
    #[inline]
    pub(crate) fn cell(&self, point: Vec2) -> usize {
        let last = (1u32 << self.depth) - 1;
        // Conversion saturates: below is 0, and so is what is no number.
        let column = (((point.x - self.origin.x) * self.inverse.x) as u32).min(last);
        let row = (((point.y - self.origin.y) * self.inverse.y) as u32).min(last);
        ((row << self.depth) | column) as usize
    }

    /// The cell of a node.
    pub(crate) fn cell_of(&self, node: u32) -> usize {
        ((evens(node >> 1) << self.depth) | evens(node)) as usize
    }

    /// The node that a point lies in.
    #[must_use]
    pub fn node(&self, point: Vec2) -> u32 {
        let cell = self.cell(point) as u32;
        let last = (1u32 << self.depth) - 1;
        spread(cell & last) | spread(cell >> self.depth) << 1
    }
}

/// Bits 0, 2, 4, ... side by side.
fn evens(number: u32) -> u32 {
    (0..=MOST_DEPTH).fold(0, |sum, bit| sum | (number >> (2 * bit) & 1) << bit)
}

/// Bits side by side to places 0, 2, 4, ...
fn spread(number: u32) -> u32 {
    (0..=MOST_DEPTH).fold(0, |sum, bit| sum | (number >> bit & 1) << (2 * bit))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_node_is_a_path_of_quarters() {
        let grid = Grid::new([0.0, 0.0, 8.0, 4.0], 2).unwrap();
        assert_eq!(grid.node(Vec2::new(0.1, 0.1)), 0);
        assert_eq!(grid.node(Vec2::new(7.9, 3.9)), 0b1111);
        assert_eq!(grid.node(Vec2::new(4.1, 0.1)), 0b0100);
        assert_eq!(grid.node(Vec2::new(0.1, 1.1)), 0b0010);
        for node in 0..16 {
            let cell = grid.cell_of(node);
            let middle = Vec2::new(2.0 * (cell % 4) as f64 + 1.0, (cell / 4) as f64 + 0.5);
            assert_eq!(grid.node(middle), node);
            assert_eq!(grid.cell(middle), cell);
        }
    }

    #[test]
    fn what_is_outside_belongs_to_the_nearest_node() {
        let grid = Grid::new([-1.0, -1.0, 1.0, 1.0], 8).unwrap();
        assert_eq!(grid.node(Vec2::new(-1e300, -5.0)), 0);
        assert_eq!(grid.node(Vec2::new(f64::INFINITY, 1.0)), 0xFFFF);
        assert_eq!(grid.node(Vec2::new(1.0, -2.0)), 0x5555);
    }

    #[test]
    fn what_is_no_box_is_refused() {
        assert!(Grid::new([0.0, 0.0, 0.0, 1.0], 1).is_err());
        assert!(Grid::new([0.0, 0.0, f64::NAN, 1.0], 1).is_err());
        assert!(Grid::new([0.0, 0.0, 1.0, 1.0], 9).is_err());
    }
}
