//! `backtrack`: move, then take every overlapping pair back to the time since which it touches, exchange there, and
//! let both go on for the rest of the tick. The relative motion is taken as straight, so an isolated collision comes
//! out exact; whatever hits twice in one tick does not.

use super::exchange::{Shares, SharesOf, exchange, normal};
use super::{Contacts, Pairs, Rule, Substep};
use crate::force::Field;
use crate::{Balls, Counters, Error, Rules, Vec2};

#[derive(Default)]
pub(super) struct Backtrack {
    pairs: Pairs<Hit>,
    /// Mean accelerations of the move, which a wall's contact time depends on; empty without forces.
    accelerations: Vec<Vec2>,
}

impl Contacts for Backtrack {
    fn advance(&mut self, substep: &mut Substep<'_>) -> Result<(), Error> {
        let balls = &mut *substep.balls;
        let (rules, dt) = (substep.rules, substep.dt);
        self.accelerations.clear();
        if !matches!(substep.field, Field::None(_)) {
            self.accelerations.extend_from_slice(&balls.velocity);
        }
        substep
            .integrator
            .advance_all(balls, substep.field, substep.time, dt, substep.team);
        for (acceleration, &velocity) in self.accelerations.iter_mut().zip(&balls.velocity) {
            *acceleration = (velocity - *acceleration) * (1.0 / dt);
        }
        self.pairs
            .find_overlapping(balls, substep.broadphase, substep.team);
        let rule = Backwards {
            alike: SharesOf::new(balls, rules.restitution()),
            dt,
        };
        let mut apply = |balls: &mut Balls, first: usize, second: usize, Hit { shift, velocity }: Hit| {
            for (at, index) in [first, second].into_iter().enumerate() {
                balls.position[index] += shift[at];
                balls.velocity[index] = velocity[at];
            }
        };
        substep.counters.collisions += self.pairs.treat(balls, substep.team, &rule, &mut apply);
        walls(rules, balls, &self.accelerations, dt, substep.counters);
        Ok(())
    }
}

struct Backwards {
    alike: SharesOf,
    dt: f64,
}

impl Rule<Hit> for Backwards {
    fn may(&self, _: &Balls, _: usize, _: usize) -> bool {
        true
    }

    fn outcome(&self, balls: &Balls, first: usize, second: usize) -> Option<Hit> {
        let shares = self.alike.pair(balls, first, second)?;
        let reach = self.alike.reach(balls, first, second);
        collide(balls, (first, second), reach, shares, self.dt)
    }
}

/// Seconds since a pair touches, from where it is now; None if it does not overlap.
fn since(between: Vec2, relative: Vec2, reach: f64) -> Option<f64> {
    let depth = reach * reach - between.square();
    if depth <= 0.0 {
        return None;
    }
    let along = between.dot(relative);
    let speed = relative.square();
    // The positive root of |d - w s|^2 = R^2; a pair at rest has touched for ever.
    let root = (along * along + speed * depth).sqrt();
    Some(if along > 0.0 {
        (along + root) / speed
    } else {
        depth / (root - along)
    })
}

/// What a collision does to two balls.
#[derive(Clone, Copy)]
struct Hit {
    shift: [Vec2; 2],
    velocity: [Vec2; 2],
}

fn collide(
    balls: &Balls,
    (first, second): (usize, usize),
    reach: f64,
    shares: Shares,
    dt: f64,
) -> Option<Hit> {
    let (p1, p2) = (balls.position[first], balls.position[second]);
    let (u1, u2) = (balls.velocity[first], balls.velocity[second]);
    // An earlier pair of this tick may have taken these two apart. A pair that overlapped before the tick began is
    // taken back to its beginning, and judged there.
    let back = since(p2 - p1, u2 - u1, reach)?.min(dt);
    let along = normal(p1 - u1 * back, p2 - u2 * back);
    let (mut v1, mut v2) = (u1, u2);
    exchange(along, shares, &mut v1, &mut v2).then(|| Hit {
        shift: [(v1 - u1) * back, (v2 - u2) * back],
        velocity: [v1, v2],
    })
}

/// Takes balls that reach beyond a wall back to it, in the order left, right, bottom, top.
fn walls(rules: &Rules, balls: &mut Balls, accelerations: &[Vec2], dt: f64, counters: &mut Counters) {
    if !rules.walls() {
        return;
    }
    let [left, bottom, right, top] = rules.bounds();
    for index in 0..balls.len() {
        let radius = balls.radius[index];
        let Vec2 { x, y } = balls.position[index];
        if x - radius >= left && x + radius <= right && y - radius >= bottom && y + radius <= top {
            continue;
        }
        let velocity = balls.velocity[index];
        let acceleration = accelerations.get(index).copied().unwrap_or(Vec2::ZERO);
        let mut x = Axis {
            place: x,
            velocity: velocity.x,
            acceleration: acceleration.x,
        };
        let mut y = Axis {
            place: y,
            velocity: velocity.y,
            acceleration: acceleration.y,
        };
        for (limit, inward) in [(left + radius, 1.0), (right - radius, -1.0)] {
            counters.wall_hits += u64::from(x.bounce(limit, inward, rules.restitution(), dt));
        }
        for (limit, inward) in [(bottom + radius, 1.0), (top - radius, -1.0)] {
            counters.wall_hits += u64::from(y.bounce(limit, inward, rules.restitution(), dt));
        }
        balls.position[index] = Vec2::new(x.place, y.place);
        balls.velocity[index] = Vec2::new(x.velocity, y.velocity);
    }
}

/// The motion of a ball at right angles to a wall, as it is at the end of the tick.
struct Axis {
    place: f64,
    velocity: f64,
    acceleration: f64,
}

impl Axis {
    fn bounce(&mut self, limit: f64, inward: f64, restitution: f64, dt: f64) -> bool {
        let depth = (limit - self.place) * inward;
        if depth <= 0.0 {
            return false;
        }
        let (speed, pull) = (-self.velocity * inward, -self.acceleration * inward);
        // Going back s seconds, depth - speed s + pull s^2 / 2 = 0.
        let root = speed * speed - 2.0 * pull * depth;
        let back = if root >= 0.0 && speed + root.sqrt() > 0.0 {
            2.0 * depth / (speed + root.sqrt())
        } else {
            dt
        };
        if back >= dt {
            // It was beyond the wall before the tick began: judged as it is, like a pair.
            if speed > 0.0 {
                self.velocity *= -restitution;
                return true;
            }
            return false;
        }
        let there = self.velocity - self.acceleration * back;
        let after = -restitution * there;
        self.velocity = after + self.acceleration * back;
        self.place = limit + (after + self.acceleration * (0.5 * back)) * back;
        true
    }
}
