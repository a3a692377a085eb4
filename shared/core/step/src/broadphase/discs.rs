//! The discs that a broadphase works on.

use crate::Vec2;

/// Reach (radius) of the discs.
#[derive(Clone, Copy, Debug)]
pub enum Reach<'a> {
    /// All discs share it: no array is read.
    Same(f64),
    /// One each.
    Each(&'a [f64]),
}

impl Reach<'_> {
    /// Reach of one disc.
    #[inline]
    #[must_use]
    pub fn of(&self, index: usize) -> f64 {
        match self {
            Reach::Same(reach) => *reach,
            Reach::Each(reach) => reach[index],
        }
    }
}

/// Discs of the plane.
#[derive(Clone, Copy, Debug)]
pub struct Discs<'a> {
    /// Centres.
    pub center: &'a [Vec2],
    /// Reaches.
    pub reach: Reach<'a>,
}

impl Discs<'_> {
    /// Number of discs.
    #[must_use]
    pub fn len(&self) -> usize {
        self.center.len()
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.center.is_empty()
    }

    /// The definition of overlap: |p1 - p2| < r1 + r2, without a square root.
    #[inline]
    #[must_use]
    pub fn overlap(&self, first: usize, second: usize) -> bool {
        let sum = self.reach.of(first) + self.reach.of(second);
        (self.center[first] - self.center[second]).square() < sum * sum
    }
}
