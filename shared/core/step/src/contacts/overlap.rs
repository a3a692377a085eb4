//! `overlap`: move, then exchange the velocities of every approaching pair that overlaps, in order of (lower id,
//! higher id). Positions are left alone. Cheap; late by up to a tick, and blind to what passed within one.

use super::exchange::{SharesOf, exchange, normal};
use super::{Contacts, Pairs, Substep};
use crate::{Balls, Error, Vec2, walls};

#[derive(Default)]
pub(super) struct Overlap {
    pairs: Pairs<[Vec2; 2]>,
}

impl Contacts for Overlap {
    fn advance(&mut self, substep: &mut Substep<'_>) -> Result<(), Error> {
        let balls = &mut *substep.balls;
        (substep.integrator.advance)(balls, substep.field, substep.time, substep.dt, substep.team);
        self.pairs.find(balls, substep.broadphase, substep.team);
        let alike = SharesOf::new(balls, substep.rules.restitution());
        let hit = |balls: &Balls, first: usize, second: usize| {
            let (p1, p2) = (balls.position[first], balls.position[second]);
            let (mut v1, mut v2) = (balls.velocity[first], balls.velocity[second]);
            let reach = alike.reach(balls, first, second);
            if (p1 - p2).square() >= reach * reach {
                return None;
            }
            let shares = alike.pair(balls, first, second)?;
            exchange(normal(p1, p2), shares, &mut v1, &mut v2).then_some([v1, v2])
        };
        let collisions = self
            .pairs
            .treat(balls, substep.team, &hit, &|balls, first, second, [v1, v2]| {
                balls.velocity[first] = v1;
                balls.velocity[second] = v2;
            });
        substep.counters.collisions += collisions;
        walls::reflect(substep.rules, balls, substep.counters, substep.team);
        Ok(())
    }
}
