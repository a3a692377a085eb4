//! A piece of a ball's path, from one hit to the next.

use super::paths::Motion;
use crate::{Balls, Vec2};

/// Where a piece of path begins, and how it goes on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    /// Time of the substep at which it begins.
    pub(super) since: f64,
    pub(super) position: Vec2,
    pub(super) velocity: Vec2,
    /// Acceleration along it: zero unless it is curved.
    pub(super) curvature: Vec2,
}

/// Where a piece of path begins. How it bends is the same for all pieces of a ball's path that a group knows of.
#[derive(Clone, Copy, Debug)]
pub(super) struct Start {
    since: f64,
    position: Vec2,
    velocity: Vec2,
}

impl Start {
    /// The whole piece.
    #[inline]
    pub(super) fn bent(&self, curvature: Vec2) -> Piece {
        Piece {
            since: self.since,
            position: self.position,
            velocity: self.velocity,
            curvature,
        }
    }
}

impl Piece {
    /// Where it begins.
    #[inline]
    pub(super) fn start(&self) -> Start {
        Start {
            since: self.since,
            position: self.position,
            velocity: self.velocity,
        }
    }

    /// Place and velocity at a time of the substep.
    #[inline]
    pub(super) fn at(&self, motion: Motion, time: f64) -> (Vec2, Vec2) {
        let s = time - self.since;
        if motion == Motion::Curved {
            let a = self.curvature;
            return (
                self.position + self.velocity * s + a * (0.5 * s * s),
                self.velocity + a * s,
            );
        }
        (self.position + self.velocity * s, self.velocity)
    }

    /// A disc around a ball of that radius, from the beginning of the piece to a time of the substep.
    #[inline]
    pub(super) fn disc(&self, motion: Motion, until: f64, radius: f64) -> (Vec2, f64) {
        let (end, _) = self.at(motion, until);
        let left = until - self.since;
        // A parabola leaves its chord by at most |a| t^2 / 8.
        let sag = self.curvature.length() * (left * left * 0.125);
        (
            (self.position + end) * 0.5,
            widen(radius, (end - self.position).length() * 0.5 + sag),
        )
    }
}

/// A little more than both, so that rounding leaves no touch outside the disc.
#[inline]
pub(super) fn widen(radius: f64, travel: f64) -> f64 {
    (radius + travel) * (1.0 + 1e-9)
}

/// Radius of a ball; reads no array if all balls are alike.
#[inline]
pub(super) fn radius(balls: &Balls, index: usize) -> f64 {
    balls
        .uniform()
        .map_or_else(|| balls.radius[index], |shape| shape.radius)
}

/// Mass of a ball; reads no array if all balls are alike.
#[inline]
pub(super) fn mass(balls: &Balls, index: usize) -> f64 {
    balls
        .uniform()
        .map_or_else(|| balls.mass[index], |shape| shape.mass)
}
