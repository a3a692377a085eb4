//! The move of all balls in a single pass: a block of them is kept for a failed tick, moved, and looked at while it is
//! in the nearest cache. Among a million balls a pass costs what the memory takes to give and take.

use crate::broadphase::Reach;
use crate::contacts::Substep;
use crate::force::Field;
use crate::integrator::Bodies;
use crate::last::Keeping;
use crate::team::{Divide, GRAIN};
use crate::walls::{self, GROUP};
use crate::{Vec2, balls};

/// Balls of a block, so many that each group of it has a bit.
pub(super) const BLOCK: usize = GROUP * u16::BITS as usize;

/// Moves the balls of a substep. `outside` gets, for each block, a bit for each group in which a ball reaches beyond a
/// wall. Returns whether all positions are finite, and all velocities that a force may have changed.
pub(super) fn advance(substep: &mut Substep<'_>, outside: &mut Vec<u16>) -> bool {
    let balls = &mut *substep.balls;
    let count = balls.len();
    outside.resize(count.div_ceil(BLOCK), 0);
    let forced = !matches!(substep.field, Field::None(_));
    let radii = match balls.uniform() {
        Some(shape) => Reach::Same(shape.radius),
        None => Reach::Each(&balls.radius),
    };
    let moving = Moving {
        start: 0,
        position: &mut balls.position,
        velocity: &mut balls.velocity,
        mass: &balls.mass,
        kept: substep.last.lend(count, forced),
        outside,
    };
    let (rules, integrator, field) = (substep.rules, substep.integrator, substep.field);
    let (time, dt) = (substep.time, substep.dt);
    let work = |moving: Moving<'_>| {
        moving.blocks(|bodies, outside| {
            let (start, end) = (bodies.start, bodies.start + bodies.position.len());
            let Bodies {
                position, velocity, ..
            } = bodies;
            (integrator.advance)(
                Bodies {
                    position: &mut *position,
                    velocity: &mut *velocity,
                    ..bodies
                },
                field,
                time,
                dt,
            );
            let radii = match radii {
                Reach::Same(radius) => Reach::Same(radius),
                Reach::Each(all) => Reach::Each(&all[start..end]),
            };
            *outside = walls::beyond(rules, position, radii);
            balls::are_finite(position) && (!forced || balls::are_finite(velocity))
        })
    };
    substep
        .team
        .share(moving, GRAIN, &work, &|left, right| left & right)
}

/// Balls about to be moved, and what is to be found out about them.
struct Moving<'a> {
    start: usize,
    position: &'a mut [Vec2],
    velocity: &'a mut [Vec2],
    mass: &'a [f64],
    kept: Option<Keeping<'a>>,
    outside: &'a mut [u16],
}

impl Moving<'_> {
    /// Keeps and shows one block after the other; whether `work` said yes to all.
    fn blocks(self, work: impl Fn(Bodies<'_>, &mut u16) -> bool) -> bool {
        let mut rest = self;
        let mut all = true;
        while rest.length() > 0 {
            let block;
            (block, rest) = rest.split();
            if let Some(kept) = block.kept {
                kept.position.copy_from_slice(block.position);
                if !kept.velocity.is_empty() {
                    kept.velocity.copy_from_slice(block.velocity);
                }
            }
            let bodies = Bodies {
                start: block.start,
                position: block.position,
                velocity: block.velocity,
                mass: block.mass,
            };
            all &= work(bodies, &mut block.outside[0]);
        }
        all
    }

    fn split(self) -> (Self, Self) {
        let at = BLOCK.min(self.length());
        self.divide(at)
    }
}

impl Divide for Moving<'_> {
    fn length(&self) -> usize {
        self.position.len()
    }

    fn divide(self, at: usize) -> (Self, Self) {
        let position = self.position.split_at_mut(at);
        let velocity = self.velocity.split_at_mut(at);
        let mass = self.mass.split_at(at);
        let kept = self.kept.map(|kept| kept.divide(at)).unzip();
        let outside = self.outside.split_at_mut(at.div_ceil(BLOCK));
        (
            Moving {
                start: self.start,
                position: position.0,
                velocity: velocity.0,
                mass: mass.0,
                kept: kept.0,
                outside: outside.0,
            },
            Moving {
                start: self.start + at,
                position: position.1,
                velocity: velocity.1,
                mass: mass.1,
                kept: kept.1,
                outside: outside.1,
            },
        )
    }
}
