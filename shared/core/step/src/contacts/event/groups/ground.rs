//! What groups stand on, and how far each strip's may look.

use super::super::contact::{Body, Law};
use super::super::paths::{Motion, Paths};
use super::super::piece::{Piece, mass, radius};
use super::actors::Whereabouts;
use super::set::Groups;
use super::strips::Strips;
use crate::broadphase::Broadphase;
use crate::walls::Walls;
use crate::{Balls, Vec2};

/// What nobody changes while groups run.
pub(super) struct Ground<'a> {
    pub(super) paths: &'a Paths,
    pub(super) balls: &'a Balls,
    pub(super) walls: Option<Walls>,
    pub(super) law: Law,
    pub(super) strips: &'a Strips,
    pub(super) whereabouts: &'a Whereabouts,
    /// Pairs that may be looked at: see [`super::super::budget`].
    pub(super) budget: u64,
}

/// What lies beyond the groups that run.
pub(super) enum Beyond<'a> {
    /// Strips that run at the same time.
    Closed(&'a dyn Broadphase),
    /// Strips that have run: what they did may be taken back.
    Open(&'a mut dyn Broadphase, &'a mut [Groups]),
}

impl Beyond<'_> {
    /// Appends at least all balls whose discs, as they are in the tree, overlap this one.
    pub(super) fn query(&self, center: Vec2, reach: f64, near: &mut Vec<u32>) {
        match self {
            Beyond::Closed(broadphase) => broadphase.query(center, reach, near),
            Beyond::Open(broadphase, _) => broadphase.query(center, reach, near),
        }
    }
}

impl Ground<'_> {
    /// A ball on a piece of path, as a contact sees it.
    pub(super) fn body(&self, ball: usize, piece: &Piece, velocity: Vec2, hits: u32, time: f64) -> Body {
        let gain = if self.paths.motion == Motion::Straight {
            0.0
        } else {
            piece.curvature.length() * self.paths.length
        };
        Body {
            velocity,
            acceleration: piece.curvature,
            gain,
            radius: radius(self.balls, ball),
            mass: mass(self.balls, ball),
            again: self.law.is_again(hits, piece.since, time),
            crowded: Law::is_crowded(hits),
        }
    }
}
