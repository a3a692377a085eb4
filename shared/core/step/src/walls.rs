//! Walls of the box, for treatments that look at the end of a tick.

use crate::{Balls, Counters, Rules};

/// Turns the velocity of every ball that reaches beyond a wall and moves on into it, in the order left, right,
/// bottom, top. Positions are left alone.
pub(crate) fn reflect(rules: &Rules, balls: &mut Balls, counters: &mut Counters) {
    if !rules.walls() {
        return;
    }
    let [left, bottom, right, top] = rules.bounds();
    let restitution = rules.restitution();
    let uniform = balls.uniform();
    let mut hits = 0;
    for (index, (position, velocity)) in balls.position.iter().zip(&mut balls.velocity).enumerate() {
        let radius = match uniform {
            Some(shape) => shape.radius,
            None => balls.radius[index],
        };
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
    counters.wall_hits += hits;
}
