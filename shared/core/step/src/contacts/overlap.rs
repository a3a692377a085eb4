//! `overlap`: move, then exchange the velocities of every approaching pair that overlaps, in order of (lower id,
//! higher id). Positions are left alone. Cheap; late by up to a tick, and blind to what passed within one.

mod moving;

use super::exchange::{SharesOf, exchange, has_direction, normal};
use super::{Contacts, Pairs, Rule, Substep};
use crate::broadphase::Pair;
use crate::last::Last;
use crate::walls::{self, GROUP};
use crate::{Balls, Counters, Error, Rules, Vec2};

#[derive(Default)]
pub(super) struct Overlap {
    pairs: Pairs<[Vec2; 2]>,
    /// For each block of balls that move together, a bit for each group in which a ball reaches beyond a wall.
    outside: Vec<u16>,
}

impl Contacts for Overlap {
    fn keeps_last(&self) -> bool {
        true
    }

    fn advance(&mut self, substep: &mut Substep<'_>) -> Result<(), Error> {
        let mut finite = moving::advance(substep, &mut self.outside);
        let (balls, last) = (&mut *substep.balls, &mut *substep.last);
        self.pairs.find(balls, substep.broadphase, substep.team);
        let rule = Approaching(SharesOf::new(balls, substep.rules.restitution()));
        let mut apply = |balls: &mut Balls, first: usize, second: usize, [v1, v2]: [Vec2; 2]| {
            for (index, velocity) in [(first, v1), (second, v2)] {
                finite &= velocity.is_finite();
                last.replaces(index, std::mem::replace(&mut balls.velocity[index], velocity));
            }
        };
        let collisions = self.pairs.treat(balls, substep.team, &rule, &mut apply);
        substep.counters.collisions += collisions;
        reflect(substep.rules, balls, &self.outside, substep.counters, last);
        // Where no force acts, a velocity that was not finite before the tick took its ball to no finite place.
        *substep.finite = finite;
        Ok(())
    }
}

/// Pairs that overlap and approach exchange their velocities.
struct Approaching(SharesOf);

impl Rule<[Vec2; 2]> for Approaching {
    #[inline(always)]
    fn may(&self, balls: &Balls, first: usize, second: usize) -> bool {
        let between = balls.position[second] - balls.position[first];
        let relative = balls.velocity[first] - balls.velocity[second];
        let reach = self.0.reach(balls, first, second);
        // Of two in one place, the normal is known only by their ids.
        (between.square() < reach * reach) & ((relative.dot(between) > 0.0) | !has_direction(between))
    }

    fn in_order(&self, balls: &Balls, (first, second): Pair) -> (usize, usize) {
        let (first, second) = (first as usize, second as usize);
        // Swapped, the normal and the relative velocity change sign, and every product of the two stays what it is.
        if has_direction(balls.position[second] - balls.position[first]) {
            (first, second)
        } else {
            balls.in_id_order(first, second)
        }
    }

    fn outcome(&self, balls: &Balls, first: usize, second: usize) -> Option<[Vec2; 2]> {
        let (p1, p2) = (balls.position[first], balls.position[second]);
        let (mut v1, mut v2) = (balls.velocity[first], balls.velocity[second]);
        let reach = self.0.reach(balls, first, second);
        if (p1 - p2).square() >= reach * reach {
            return None;
        }
        let shares = self.0.pair(balls, first, second)?;
        exchange(normal(p1, p2), shares, &mut v1, &mut v2).then_some([v1, v2])
    }
}

/// Turns the velocity of every ball that reaches beyond a wall and moves on into it. Positions are left alone.
fn reflect(rules: &Rules, balls: &mut Balls, outside: &[u16], counters: &mut Counters, last: &mut Last) {
    for (block, &groups) in outside.iter().enumerate() {
        let mut groups = groups;
        while groups != 0 {
            let start = block * moving::BLOCK + groups.trailing_zeros() as usize * GROUP;
            groups &= groups - 1;
            for index in start..(start + GROUP).min(balls.len()) {
                let (position, velocity) = (balls.position[index], balls.velocity[index]);
                let (turned, hits) = walls::reflected(rules, position, velocity, balls.radius[index]);
                if hits > 0 {
                    last.replaces(index, velocity);
                    balls.velocity[index] = turned;
                    counters.wall_hits += hits;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests;
