//! Uniform gravity: a = g.

use std::sync::Arc;

use super::{Body, Force, HeldNow, Kind};
use crate::Vec2;

pub(super) const KIND: Kind = Kind {
    name: "gravity",
    numbers: &["x", "y"],
    make: |n| {
        Ok(Arc::new(Gravity {
            g: Vec2::new(n[0], n[1]),
        }))
    },
};

#[derive(Debug)]
struct Gravity {
    g: Vec2,
}

impl Force for Gravity {
    fn acceleration(&self, _time: f64, _body: &Body, _held: &HeldNow) -> Vec2 {
        self.g
    }

    fn constant(&self) -> Option<Vec2> {
        Some(self.g)
    }

    fn potential(&self, body: &Body, _held: &HeldNow) -> f64 {
        -body.mass * self.g.dot(body.position)
    }
}
