//! `overlap`: move, then exchange the velocities of every approaching pair that overlaps, in order of (lower id,
//! higher id). Positions are left alone. Cheap; late by up to a tick, and blind to what passed within one.

use super::exchange::{SharesOf, exchange, normal};
use super::{Contacts, Substep, sorted_pairs};
use crate::broadphase::Pair;
use crate::{Error, walls};

#[derive(Default)]
pub(super) struct Overlap {
    pairs: Vec<Pair>,
}

impl Contacts for Overlap {
    fn advance(&mut self, substep: &mut Substep<'_>) -> Result<(), Error> {
        let balls = &mut *substep.balls;
        (substep.integrator.advance)(balls, substep.field, substep.time, substep.dt);
        sorted_pairs(balls, substep.broadphase, &mut self.pairs);
        let shares = SharesOf::new(balls, substep.rules.restitution());
        for &(first, second) in &self.pairs {
            let (first, second) = (first as usize, second as usize);
            let Some(shares) = shares.pair(balls, first, second) else {
                continue;
            };
            let along = normal(balls.position[first], balls.position[second]);
            let (mut v1, mut v2) = (balls.velocity[first], balls.velocity[second]);
            if exchange(along, shares, &mut v1, &mut v2) {
                balls.velocity[first] = v1;
                balls.velocity[second] = v2;
                substep.counters.collisions += 1;
            }
        }
        walls::reflect(substep.rules, balls, substep.counters);
        Ok(())
    }
}
