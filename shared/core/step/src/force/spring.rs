//! A spring to a point: m a = -k (p - centre).

use std::sync::Arc;

use super::{Body, Force, HeldNow, Kind, at_least_zero};
use crate::Vec2;

pub(super) const KIND: Kind = Kind {
    name: "spring",
    numbers: &["x", "y", "stiffness"],
    make: |n| {
        let stiffness = at_least_zero("spring", "stiffness", n[2])?;
        Ok(Arc::new(Spring {
            centre: Vec2::new(n[0], n[1]),
            stiffness,
        }))
    },
};

#[derive(Debug)]
struct Spring {
    centre: Vec2,
    stiffness: f64,
}

impl Force for Spring {
    fn acceleration(&self, _time: f64, body: &Body, _held: &HeldNow) -> Vec2 {
        (body.position - self.centre) * (-self.stiffness / body.mass)
    }

    fn potential(&self, body: &Body, _held: &HeldNow) -> f64 {
        0.5 * self.stiffness * (body.position - self.centre).square()
    }
}
