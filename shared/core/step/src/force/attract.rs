//! Held attract inputs: each one a softened point attractor for every ball.

use std::sync::Arc;

use super::attractor::{pull, well};
use super::{Body, Force, HeldNow, Kind, at_least_zero};
use crate::Vec2;

pub(super) const KIND: Kind = Kind {
    name: "attract",
    numbers: &["softening"],
    make: |n| {
        Ok(Arc::new(Attract {
            softening: at_least_zero("attract", "softening", n[0])?,
        }))
    },
};

#[derive(Debug)]
struct Attract {
    softening: f64,
}

impl Force for Attract {
    fn acceleration(&self, _time: f64, body: &Body, held: &HeldNow) -> Vec2 {
        held.attract.iter().fold(Vec2::ZERO, |sum, &(point, strength)| {
            sum + pull(body.position, point, strength, self.softening)
        })
    }

    fn acts(&self, held: &HeldNow) -> bool {
        !held.attract.is_empty()
    }

    fn potential(&self, body: &Body, held: &HeldNow) -> f64 {
        held.attract
            .iter()
            .map(|&(point, strength)| well(body, point, strength, self.softening))
            .sum()
    }
}
