//! Collision times. A pair whose accelerations are equal, and every wall, is a quadratic root.

use super::paths::Paths;
use super::piece::{Piece, mass, radius, widen};
use crate::contacts::root::first_fall;
use crate::walls::Wall;
use crate::{Balls, Vec2};

/// When two balls collide next, if they do before the substep ends.
#[inline]
pub(super) fn pair(paths: &Paths, balls: &Balls, first: usize, second: usize) -> Option<f64> {
    let pieces = (&paths.piece(balls, first), &paths.piece(balls, second));
    pieces_of(paths, balls, (first, second), pieces)
}

/// When two balls on these pieces of path collide next, if they do before the substep ends.
#[inline]
pub(super) fn pieces_of(
    paths: &Paths,
    balls: &Balls,
    (first, second): (usize, usize),
    (one, another): (&Piece, &Piece),
) -> Option<f64> {
    if mass(balls, first).is_infinite() && mass(balls, second).is_infinite() {
        return None;
    }
    let reach = radius(balls, first) + radius(balls, second);
    let start = one.since.max(another.since);
    let (p1, v1) = one.at(paths.motion, start);
    let (p2, v2) = another.at(paths.motion, start);
    let (between, relative) = (p2 - p1, v2 - v1);
    let left = paths.length - start;
    let bend = another.curvature - one.curvature;
    let wait = if bend == Vec2::ZERO {
        straight(between, relative, reach)?
    } else {
        bent(between, relative, bend, reach, left)?
    };
    (wait <= left).then_some(start + wait)
}

/// The smaller root of |d + w t| = R, in the form that does not cancel.
#[inline]
fn straight(between: Vec2, relative: Vec2, reach: f64) -> Option<f64> {
    let approach = -between.dot(relative);
    if approach <= 0.0 {
        return None;
    }
    let gap = between.square() - reach * reach;
    if gap <= 0.0 {
        return Some(0.0);
    }
    let root = approach * approach - relative.square() * gap;
    (root >= 0.0).then(|| gap / (approach + root.sqrt()))
}

/// The first time at which |d + w t + b t^2 / 2| falls to R; for a pair that overlaps by rounding, to what it is now.
fn bent(between: Vec2, relative: Vec2, bend: Vec2, reach: f64, left: f64) -> Option<f64> {
    let gap = (between.square() - reach * reach).max(0.0);
    let slope = 2.0 * between.dot(relative);
    let second = relative.square() + between.dot(bend);
    let (third, fourth) = (relative.dot(bend), 0.25 * bend.square());
    if gap > 0.0 {
        if passes(between, relative, bend, reach, left) {
            return None;
        }
        return first_fall(&[gap, slope, second, third, fourth], left);
    }
    if slope < 0.0 || (slope == 0.0 && second < 0.0) {
        return Some(0.0);
    }
    // The root at 0 is divided out: what is left falls when the pair is back.
    first_fall(&[slope, second, third, fourth, 0.0], left)
}

/// Whether a pair that is apart surely stays so: as if it moved along the chord of its path, with the room by which
/// a parabola leaves its chord.
fn passes(between: Vec2, relative: Vec2, bend: Vec2, reach: f64, left: f64) -> bool {
    let chord = relative * left + bend * (0.5 * left * left);
    let part = (-between.dot(chord) / chord.square()).clamp(0.0, 1.0);
    let room = widen(reach, bend.length() * (left * left * 0.125));
    // Where the chord is a point, NaN: then it is not sure.
    (between + chord * part).square() > room * room
}

/// When a ball on this piece of path hits a wall next, if it does before the substep ends.
pub(super) fn wall(length: f64, radius: f64, piece: &Piece, wall: &Wall) -> Option<f64> {
    // What reaches beyond the wall touches it where it is.
    let gap = wall.gap(piece.position, radius).max(0.0);
    let away = piece.velocity.dot(wall.inward);
    let pull = -piece.curvature.dot(wall.inward);
    let wait = if away < 0.0 {
        // Where the pull is away from the wall, the ball may turn before it.
        let root = away * away + 2.0 * pull * gap;
        (root >= 0.0).then(|| 2.0 * gap / (root.sqrt() - away))?
    } else if pull > 0.0 {
        (away + (away * away + 2.0 * pull * gap).sqrt()) / pull
    } else {
        return None;
    };
    (wait <= length - piece.since).then_some(piece.since + wait)
}
