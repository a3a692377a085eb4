//! Rectangles, as the nodes of a quadtree are.

use crate::Vec2;

/// A part of the plane, its bounds included.
#[derive(Clone, Copy)]
pub(super) struct Rectangle {
    pub(super) left: f64,
    pub(super) bottom: f64,
    pub(super) right: f64,
    pub(super) top: f64,
}

impl Rectangle {
    pub(super) fn around(center: Vec2, reach: f64) -> Rectangle {
        Rectangle {
            left: center.x - reach,
            bottom: center.y - reach,
            right: center.x + reach,
            top: center.y + reach,
        }
    }

    pub(super) fn contains(&self, other: &Rectangle) -> bool {
        self.left <= other.left
            && other.right <= self.right
            && self.bottom <= other.bottom
            && other.top <= self.top
    }

    pub(super) fn touches(&self, other: &Rectangle) -> bool {
        self.left <= other.right
            && other.left <= self.right
            && self.bottom <= other.top
            && other.bottom <= self.top
    }

    /// Lower left, lower right, upper left, upper right.
    pub(super) fn quarters(&self) -> [Rectangle; 4] {
        let x = 0.5 * (self.left + self.right);
        let y = 0.5 * (self.bottom + self.top);
        [
            Rectangle {
                right: x,
                top: y,
                ..*self
            },
            Rectangle {
                left: x,
                top: y,
                ..*self
            },
            Rectangle {
                right: x,
                bottom: y,
                ..*self
            },
            Rectangle {
                left: x,
                bottom: y,
                ..*self
            },
        ]
    }
}
