//! Discs around the paths of a substep, which a broadphase looks for pairs among.

use std::ops::Range;

use super::paths::{Motion, Paths};
use super::piece::{radius, widen};
use crate::broadphase::{Discs, Reach};
use crate::team::{GRAIN, Team};
use crate::{Balls, Vec2};

/// Far from overflow, however often such numbers are added.
const MODERATE: f64 = 1e300;

/// Whether a ball that ends a piece of path with that velocity, and has that disc around it, is somewhere.
#[inline]
pub(super) fn is_moderate(center: Vec2, reach: f64, velocity: Vec2) -> bool {
    let size = |vector: Vec2| vector.x.abs() + vector.y.abs();
    size(center) + reach + size(velocity) < MODERATE
}

impl Paths {
    /// The discs, for a broadphase.
    pub(super) fn discs(&self) -> Discs<'_> {
        Discs {
            center: &self.center,
            reach: Reach::Each(&self.reach),
        }
    }

    /// Discs around all paths, as they are at the start of the substep.
    pub(super) fn sweep(&mut self, balls: &Balls, team: &Team) {
        let (mut center, mut reach) = (std::mem::take(&mut self.center), std::mem::take(&mut self.reach));
        center.resize(balls.len(), Vec2::ZERO);
        reach.resize(balls.len(), 0.0);
        let paths = &*self;
        let whole = (&mut center[..], &mut reach[..], 0..balls.len());
        let moderate = team.share(
            whole,
            GRAIN,
            &|(centers, reaches, indices)| {
                // Block by block: what one loop has read, the next finds in the nearest cache.
                let blocks = centers.chunks_mut(GRAIN).zip(reaches.chunks_mut(GRAIN));
                (blocks.zip(indices.step_by(GRAIN)))
                    .map(|((centers, reaches), begin)| {
                        let indices = begin..begin + centers.len();
                        if paths.motion == Motion::Curved {
                            paths.sweep_curved(balls, indices, centers, reaches)
                        } else {
                            paths.sweep_straight(balls, indices, centers, reaches)
                        }
                    })
                    .fold(true, |all, moderate| all & moderate)
            },
            &|left, right| left & right,
        );
        (self.center, self.reach, self.is_moderate) = (center, reach, moderate);
    }

    /// The discs of these balls; says whether they, and the velocities at the end of the substep, are moderate.
    fn sweep_curved(
        &self,
        balls: &Balls,
        indices: Range<usize>,
        centers: &mut [Vec2],
        reaches: &mut [f64],
    ) -> bool {
        let mut moderate = true;
        for ((center, reach), index) in centers.iter_mut().zip(reaches).zip(indices) {
            let piece = self.first_piece(balls, index);
            (*center, *reach) = piece.disc(self.motion, self.length, radius(balls, index));
            let (_, velocity) = piece.at(self.motion, self.length);
            moderate &= is_moderate(*center, *reach, velocity);
        }
        moderate
    }

    /// The same where every path is straight and whole.
    fn sweep_straight(
        &self,
        balls: &Balls,
        indices: Range<usize>,
        centers: &mut [Vec2],
        reaches: &mut [f64],
    ) -> bool {
        let half = 0.5 * self.length;
        let (positions, velocities) = (&balls.position[indices.clone()], &balls.velocity[indices.clone()]);
        for (center, (&position, &velocity)) in centers.iter_mut().zip(positions.iter().zip(velocities)) {
            *center = position + velocity * half;
        }
        match balls.uniform() {
            Some(shape) => {
                for (reach, velocity) in reaches.iter_mut().zip(velocities) {
                    *reach = widen(shape.radius, velocity.length() * half);
                }
            }
            None => {
                let sized = balls.radius[indices].iter().zip(velocities);
                for (reach, (&radius, velocity)) in reaches.iter_mut().zip(sized) {
                    *reach = widen(radius, velocity.length() * half);
                }
            }
        }
        let discs = centers.iter().zip(&*reaches).zip(velocities);
        discs.fold(true, |all, ((&center, &reach), &velocity)| {
            all & is_moderate(center, reach, velocity)
        })
    }

    /// The disc around what is left of one path.
    pub(super) fn sweep_one(&mut self, balls: &Balls, index: usize) {
        let piece = self.piece(balls, index);
        (self.center[index], self.reach[index]) = piece.disc(self.motion, self.length, radius(balls, index));
    }
}
