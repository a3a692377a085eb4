//! The sum over all balls, by all threads.

use super::fastest::{differing, equal};
use super::one_by_one::shape;
use crate::team::{GRAIN, Team};
use crate::{Balls, Vec2};

/// Ids, positions and velocities of the same balls.
pub(super) type Columns<'a> = (&'a [u64], &'a [Vec2], &'a [Vec2]);

/// Balls that a thread hashes at a time, at least: calling others takes as long as hashing some thousands.
const MANY_BALLS: usize = 16 * GRAIN;

/// The wrapping sum of all balls' mixes.
pub(super) fn sum(balls: &Balls, team: &Team) -> u64 {
    let all = (&balls.id[..], &balls.position[..], &balls.velocity[..]);
    let sum = || match balls.uniform() {
        Some(uniform) => {
            let shape = shape(uniform.radius, uniform.mass);
            team.share(all, MANY_BALLS, &|all| equal(all, shape), &u64::wrapping_add)
        }
        None => team.share(
            (all, &balls.radius[..], &balls.mass[..]),
            MANY_BALLS,
            &|(all, radius, mass)| differing(all, radius, mass),
            &u64::wrapping_add,
        ),
    };
    if balls.len() > MANY_BALLS {
        team.enter(sum)
    } else {
        sum()
    }
}
