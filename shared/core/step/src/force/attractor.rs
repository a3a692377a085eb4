//! A softened point attractor: a = -s d / (|d|^2 + e^2)^(3/2), d = p - centre (Plummer's softening).

use std::sync::Arc;

use super::{Body, Force, HeldNow, Kind, at_least_zero};
use crate::Vec2;

pub(super) const KIND: Kind = Kind {
    name: "attractor",
    numbers: &["x", "y", "strength", "softening"],
    make: |n| {
        let softening = at_least_zero("attractor", "softening", n[3])?;
        Ok(Arc::new(Attractor {
            centre: Vec2::new(n[0], n[1]),
            strength: n[2],
            softening,
        }))
    },
};

#[derive(Debug)]
struct Attractor {
    centre: Vec2,
    strength: f64,
    softening: f64,
}

/// The pull of a point; 0 at the point itself, where the direction is not defined.
#[inline]
pub(super) fn pull(from: Vec2, centre: Vec2, strength: f64, softening: f64) -> Vec2 {
    let d = from - centre;
    let square = d.square() + softening * softening;
    if square == 0.0 {
        return Vec2::ZERO;
    }
    d * (-strength / (square * square.sqrt()))
}

/// Potential energy of a ball of that mass in the pull of a point.
pub(super) fn well(body: &Body, centre: Vec2, strength: f64, softening: f64) -> f64 {
    let d = body.position - centre;
    let square = d.square() + softening * softening;
    if square == 0.0 {
        0.0
    } else {
        -strength * body.mass / square.sqrt()
    }
}

impl Force for Attractor {
    fn acceleration(&self, _time: f64, body: &Body, _held: &HeldNow) -> Vec2 {
        pull(body.position, self.centre, self.strength, self.softening)
    }

    fn potential(&self, body: &Body, _held: &HeldNow) -> f64 {
        well(body, self.centre, self.strength, self.softening)
    }
}
