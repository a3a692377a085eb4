//! Linear drag: m a = -c v.

use std::sync::Arc;

use super::{Body, Force, HeldNow, Kind, at_least_zero};
use crate::Vec2;

pub(super) const KIND: Kind = Kind {
    name: "drag",
    numbers: &["coefficient"],
    make: |n| {
        Ok(Arc::new(Drag {
            coefficient: at_least_zero("drag", "coefficient", n[0])?,
        }))
    },
};

#[derive(Debug)]
struct Drag {
    coefficient: f64,
}

impl Force for Drag {
    fn acceleration(&self, _time: f64, body: &Body, _held: &HeldNow) -> Vec2 {
        body.velocity * (-self.coefficient / body.mass)
    }
}
