//! `overlap`: move, then exchange the velocities of every approaching pair that overlaps, in order of (lower id,
//! higher id). Positions are left alone. Cheap; late by up to a tick, and blind to what passed within one.

use super::exchange::{SharesOf, exchange, normal};
use super::{Contacts, Pairs, Substep};
use crate::{Error, walls};

#[derive(Default)]
pub(super) struct Overlap {
    pairs: Pairs,
}

impl Contacts for Overlap {
    fn advance(&mut self, substep: &mut Substep<'_>) -> Result<(), Error> {
        let balls = &mut *substep.balls;
        (substep.integrator.advance)(balls, substep.field, substep.time, substep.dt);
        self.pairs.find(balls, substep.broadphase);
        let shares = SharesOf::new(balls, substep.rules.restitution());
        let mut collisions = 0;
        self.pairs.treat(balls, |balls, first, second| {
            let Some(shares) = shares.pair(balls, first, second) else {
                return;
            };
            let along = normal(balls.position[first], balls.position[second]);
            let (mut v1, mut v2) = (balls.velocity[first], balls.velocity[second]);
            if exchange(along, shares, &mut v1, &mut v2) {
                balls.velocity[first] = v1;
                balls.velocity[second] = v2;
                collisions += 1;
            }
        });
        substep.counters.collisions += collisions;
        walls::reflect(substep.rules, balls, substep.counters);
        Ok(())
    }
}
