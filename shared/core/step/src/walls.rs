//! The walls of the box.

use crate::team::GRAIN;
use crate::{Balls, Counters, Rules, Team, Vec2};

/// Balls that are passed over together.
const GROUP: usize = 16;

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

/// Turns the velocity of every ball that reaches beyond a wall and moves on into it, in the order left, right,
/// bottom, top. Positions are left alone.
pub(crate) fn reflect(rules: &Rules, balls: &mut Balls, counters: &mut Counters, team: &Team) {
    if !rules.walls() {
        return;
    }
    counters.wall_hits += match balls.uniform() {
        Some(shape) => team.share(
            (&balls.position[..], &mut balls.velocity[..]),
            GRAIN,
            &|(positions, velocities)| {
                let groups = positions.chunks(GROUP).zip(velocities.chunks_mut(GROUP));
                (groups.filter(|(positions, _)| !inside(rules, positions, shape.radius)))
                    .map(|(positions, velocities)| {
                        reflect_all(rules, positions, velocities, |_| shape.radius)
                    })
                    .sum()
            },
            &|left, right| left + right,
        ),
        None => team.share(
            (&balls.position[..], &mut balls.velocity[..], &balls.radius[..]),
            GRAIN,
            &|(positions, velocities, radii)| reflect_all(rules, positions, velocities, |index| radii[index]),
            &|left, right| left + right,
        ),
    };
}

/// Whether none of a group of balls reaches beyond a wall: most groups are nowhere near one.
#[inline]
fn inside(rules: &Rules, positions: &[Vec2], radius: f64) -> bool {
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

#[inline]
fn reflect_all(
    rules: &Rules,
    positions: &[Vec2],
    velocities: &mut [Vec2],
    radius: impl Fn(usize) -> f64,
) -> u64 {
    let [left, bottom, right, top] = rules.bounds();
    let restitution = rules.restitution();
    let mut hits = 0;
    for (index, (position, velocity)) in positions.iter().zip(velocities).enumerate() {
        let radius = radius(index);
        let inside = (position.x - radius >= left)
            & (position.x + radius <= right)
            & (position.y - radius >= bottom)
            & (position.y + radius <= top);
        if inside {
            continue;
        }
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
    }
    hits
}
