//! The paths of the balls inside a substep.
//!
//! While a substep runs, a ball's position and velocity are those of the start of the piece of path that it is on,
//! and `since` is the time at which that piece began. A collision time is computed from two pieces alone, so it does
//! not depend on when, or by which broadphase, the pair was looked at.

use super::piece::Piece;
use super::rest::Supports;
use crate::force::Body;
use crate::team::GRAIN;
use crate::{Balls, Team, Vec2};

/// What a piece of path is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum Motion {
    /// No force: a straight line.
    #[default]
    Straight,
    /// A constant acceleration per ball: a parabola.
    Curved,
}

/// What pulls the balls in a substep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Pull {
    None,
    /// The same for all balls.
    Common(Vec2),
    /// One for each ball, the same all the time.
    Constant,
    /// One for each ball, which changes on its way.
    Varying,
}

#[derive(Default)]
pub(super) struct Paths {
    pub(super) motion: Motion,
    /// Length of the substep.
    pub(super) length: f64,
    pub(super) since: Vec<f64>,
    /// How often each ball was hit in this substep.
    pub(super) hits: Vec<u32>,
    /// Along the path, less what resting contacts have taken. Unused if straight.
    pub(super) acceleration: Vec<Vec2>,
    /// What all balls have, until contacts may change it: then no array is filled, nor read.
    common: Option<Vec2>,
    /// What pulls each ball at the start. Unused if straight.
    pub(super) pulls: Vec<Vec2>,
    /// That changes on the way.
    pub(super) varies: bool,
    /// Balls that have another so near at the start that both could meet at the speed which one substep's
    /// acceleration gives. Empty without forces and at restitution 1, where the answer would change nothing.
    touched: Vec<bool>,
    /// How far apart a pair may be to count as touching.
    pub(super) margin: f64,
    pub(super) supports: Supports,
    /// Balls whose accelerations a strike may change; scratch.
    pub(super) loose: Vec<usize>,
    /// A disc around all that is left of each ball's path.
    pub(super) center: Vec<Vec2>,
    pub(super) reach: Vec<f64>,
    /// Where paths are not hit, balls have finite places and velocities at the end of the substep.
    pub(super) is_moderate: bool,
}

impl Paths {
    pub(super) fn begin(
        &mut self,
        balls: &Balls,
        (length, elastic): (f64, bool),
        pull: Pull,
        team: &Team,
        acceleration: impl Fn(Body) -> Vec2 + Sync,
    ) {
        let count = balls.len();
        self.motion = if pull == Pull::None {
            Motion::Straight
        } else {
            Motion::Curved
        };
        self.varies = pull == Pull::Varying;
        self.length = length;
        self.pulls.clear();
        self.supports.clear();
        self.touched.clear();
        self.margin = 0.0;
        self.common = match pull {
            Pull::Common(common) if elastic => Some(common),
            _ => None,
        };
        if pull == Pull::None || self.common.is_some() {
            return;
        }
        self.acceleration.resize(count, Vec2::ZERO);
        let whole = (&mut self.acceleration[..], 0..count);
        team.each(whole, GRAIN, &|(accelerations, indices)| {
            for (place, index) in accelerations.iter_mut().zip(indices) {
                *place = acceleration(Body {
                    index,
                    mass: balls.mass[index],
                    position: balls.position[index],
                    velocity: balls.velocity[index],
                });
            }
        });
        self.pulls.extend_from_slice(&self.acceleration);
        if !elastic {
            self.margin = (0..count).fold(0.0, |most: f64, index| most.max(self.gain(index))) * length;
            self.touched.resize(count, false);
        }
    }

    /// Counts hits, and keeps accelerations that contacts may change, from the start of the substep on.
    pub(super) fn follow_hits(&mut self, balls: &Balls) {
        if let Some(common) = self.common.take() {
            self.acceleration.clear();
            self.acceleration.resize(balls.len(), common);
            self.pulls.extend_from_slice(&self.acceleration);
        }
        self.since.clear();
        self.since.resize(balls.len(), 0.0);
        self.hits.clear();
        self.hits.resize(balls.len(), 0);
    }

    /// The speed that a ball's acceleration gains in the substep.
    #[inline]
    pub(super) fn gain(&self, index: usize) -> f64 {
        if self.motion == Motion::Straight {
            0.0
        } else {
            self.pulls[index].length() * self.length
        }
    }

    /// Whether it is of interest which balls touch at the start of the substep.
    pub(super) fn notes_touches(&self) -> bool {
        self.margin != 0.0
    }

    /// Notes which of two balls, at the start of the substep, touch.
    pub(super) fn note_touch(&mut self, balls: &Balls, first: usize, second: usize) {
        if self.margin == 0.0 {
            return;
        }
        let near = balls.radius[first] + balls.radius[second] + self.margin;
        if (balls.position[first] - balls.position[second]).square() < near * near {
            self.touched[first] = true;
            self.touched[second] = true;
        }
    }

    /// Whether a ball neither touched another at the start of the substep nor was hit in it.
    pub(super) fn is_alone(&self, index: usize) -> bool {
        self.hits[index] == 0 && self.touched.get(index) == Some(&false)
    }

    /// Acceleration along the path.
    #[inline]
    pub(super) fn curvature(&self, index: usize) -> Vec2 {
        match self.motion {
            Motion::Curved => self.common.unwrap_or_else(|| self.acceleration[index]),
            Motion::Straight => Vec2::ZERO,
        }
    }

    /// The piece of path that a ball is on.
    #[inline]
    pub(super) fn piece(&self, balls: &Balls, index: usize) -> Piece {
        Piece {
            since: self.since[index],
            ..self.first_piece(balls, index)
        }
    }

    /// The piece of path that a ball is on at the start of the substep.
    #[inline]
    pub(super) fn first_piece(&self, balls: &Balls, index: usize) -> Piece {
        self.first_piece_of(index, balls.position[index], balls.velocity[index])
    }

    /// The same of a ball that is there, and as fast, at the start of the substep.
    #[inline]
    pub(super) fn first_piece_of(&self, index: usize, position: Vec2, velocity: Vec2) -> Piece {
        Piece {
            since: 0.0,
            position,
            velocity,
            curvature: self.curvature(index),
        }
    }

    /// Moves all balls to the end of the substep.
    pub(super) fn end(&self, balls: &mut Balls, team: &Team) {
        let indices = 0..balls.len();
        let whole = (&mut balls.position[..], &mut balls.velocity[..], indices);
        team.each(whole, GRAIN, &|(positions, velocities, indices)| {
            for ((position, velocity), index) in positions.iter_mut().zip(velocities).zip(indices) {
                let piece = Piece {
                    since: self.since[index],
                    ..self.first_piece_of(index, *position, *velocity)
                };
                (*position, *velocity) = piece.at(self.motion, self.length);
            }
        });
    }
}
