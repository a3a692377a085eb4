//! The walls of the box.

use crate::broadphase::Reach;
use crate::{Rules, Vec2};

/// Balls that are passed over together.
pub(crate) const GROUP: usize = 16;

/// A wall as a half-plane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wall {
    /// The unit normal, away from the wall; one component is 0.
    pub(crate) inward: Vec2,
    /// Where the wall is along that normal.
    place: f64,
}

impl Wall {
    /// Distance of a ball from the wall; below 0 if it reaches beyond.
    pub(crate) fn gap(&self, position: Vec2, radius: f64) -> f64 {
        position.dot(self.inward) - self.place - radius
    }

    /// The vector with its component away from the wall replaced, the other one untouched.
    pub(crate) fn with_normal(&self, vector: Vec2, away: f64) -> Vec2 {
        if self.inward.x == 0.0 {
            Vec2::new(vector.x, away * self.inward.y)
        } else {
            Vec2::new(away * self.inward.x, vector.y)
        }
    }
}

/// The four walls, numbered left, right, bottom, top.
pub(crate) struct Walls {
    bounds: [f64; 4],
}

impl Walls {
    /// The walls of a world, if it has any.
    pub(crate) fn of(rules: &Rules) -> Option<Walls> {
        rules.walls().then(|| Walls {
            bounds: rules.bounds(),
        })
    }

    /// Whether a disc stays clear of all walls.
    pub(crate) fn hold(&self, center: Vec2, reach: f64) -> bool {
        let [left, bottom, right, top] = self.bounds;
        (center.x - reach > left)
            & (center.x + reach < right)
            & (center.y - reach > bottom)
            & (center.y + reach < top)
    }

    /// A wall by its number.
    pub(crate) fn wall(&self, number: u32) -> Wall {
        let [left, bottom, right, top] = self.bounds;
        match number {
            0 => Wall {
                inward: Vec2::new(1.0, 0.0),
                place: left,
            },
            1 => Wall {
                inward: Vec2::new(-1.0, 0.0),
                place: -right,
            },
            2 => Wall {
                inward: Vec2::new(0.0, 1.0),
                place: bottom,
            },
            _ => Wall {
                inward: Vec2::new(0.0, -1.0),
                place: -top,
            },
        }
    }
}

/// Of up to 16 groups of balls, a bit for each in which one reaches beyond a wall: most groups are nowhere near one.
pub(crate) fn beyond(rules: &Rules, positions: &[Vec2], radii: Reach<'_>) -> u16 {
    let groups = positions.chunks(GROUP).zip(0..);
    let bit = |inside: bool, group: u32| u16::from(!inside) << group;
    match radii {
        _ if !rules.walls() => 0,
        Reach::Same(radius) => groups.fold(0, |bits, (positions, group)| {
            bits | bit(all_inside(rules, positions, radius), group)
        }),
        Reach::Each(radii) => {
            (groups.zip(radii.chunks(GROUP))).fold(0, |bits, ((positions, group), radii)| {
                let inside = (positions.iter().zip(radii)).fold(true, |all, (&position, &radius)| {
                    all & is_inside(rules, position, radius)
                });
                bits | bit(inside, group)
            })
        }
    }
}

fn is_inside(rules: &Rules, position: Vec2, radius: f64) -> bool {
    let [left, bottom, right, top] = rules.bounds();
    (position.x - radius >= left)
        & (position.x + radius <= right)
        & (position.y - radius >= bottom)
        & (position.y + radius <= top)
}

/// Whether none of a group of balls reaches beyond a wall.
#[inline]
fn all_inside(rules: &Rules, positions: &[Vec2], radius: f64) -> bool {
    let (mut low, mut high) = (positions[0], positions[0]);
    for position in positions {
        // As comparisons, not minima: these are single instructions.
        low.x = if position.x < low.x { position.x } else { low.x };
        low.y = if position.y < low.y { position.y } else { low.y };
        high.x = if position.x > high.x { position.x } else { high.x };
        high.y = if position.y > high.y { position.y } else { high.y };
    }
    let [left, bottom, right, top] = rules.bounds();
    (low.x - radius >= left)
        & (high.x + radius <= right)
        & (low.y - radius >= bottom)
        & (high.y + radius <= top)
}

/// The velocity of a ball that reaches beyond a wall and moves on into it, turned in the order left, right, bottom, top;
/// and how many walls turned it.
pub(crate) fn reflected(rules: &Rules, position: Vec2, mut velocity: Vec2, radius: f64) -> (Vec2, u64) {
    let [left, bottom, right, top] = rules.bounds();
    let restitution = rules.restitution();
    let mut hits = 0;
    if position.x - radius < left && velocity.x < 0.0 {
        velocity.x *= -restitution;
        hits += 1;
    }
    if position.x + radius > right && velocity.x > 0.0 {
        velocity.x *= -restitution;
        hits += 1;
    }
    if position.y - radius < bottom && velocity.y < 0.0 {
        velocity.y *= -restitution;
        hits += 1;
    }
    if position.y + radius > top && velocity.y > 0.0 {
        velocity.y *= -restitution;
        hits += 1;
    }
    (velocity, hits)
}
