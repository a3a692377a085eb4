//! Players' thrust: m a = the force that the ball's owner holds.

use std::sync::Arc;

use super::{Body, Force, HeldNow, Kind};
use crate::Vec2;

pub(super) const KIND: Kind = Kind {
    name: "thrust",
    numbers: &[],
    make: |_| Ok(Arc::new(Thrust)),
};

#[derive(Debug)]
struct Thrust;

impl Force for Thrust {
    fn acceleration(&self, _time: f64, body: &Body, held: &HeldNow) -> Vec2 {
        match held.thrust.binary_search_by_key(&body.index, |&(index, _)| index) {
            Ok(at) => {
                let force = held.thrust[at].1;
                Vec2::new(force.x / body.mass, force.y / body.mass)
            }
            Err(_) => Vec2::ZERO,
        }
    }

    fn constant_elsewhere(&self) -> Option<Vec2> {
        Some(Vec2::ZERO)
    }

    fn acts(&self, held: &HeldNow) -> bool {
        !held.thrust.is_empty()
    }
}
