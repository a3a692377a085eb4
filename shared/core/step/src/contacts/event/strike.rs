//! Balls that are struck: they begin new pieces of path, and what rests on what is settled anew.

use super::contact::ROUNDING;
use super::paths::Paths;
use super::rest::Support;
use crate::{Balls, Vec2};

impl Paths {
    /// Gives struck balls, each with its place, new velocities. What they rested on or bore is let go, and `support`,
    /// if given, bears from now on; all balls that this gives another acceleration begin a new piece of path.
    pub(super) fn strike(
        &mut self,
        balls: &mut Balls,
        time: f64,
        struck: &[(usize, Vec2, Vec2)],
        support: Option<Support>,
        changed: &mut Vec<usize>,
    ) {
        let resettles = support.is_some() || struck.iter().any(|&(index, ..)| self.supports.involve(index));
        if resettles {
            self.resettle(balls, time, struck, support, changed);
        }
        for &(index, place, velocity) in struck {
            self.turn(balls, index, time, place, velocity);
            changed.push(index);
        }
    }

    fn resettle(
        &mut self,
        balls: &mut Balls,
        time: f64,
        struck: &[(usize, Vec2, Vec2)],
        support: Option<Support>,
        changed: &mut Vec<usize>,
    ) {
        let mut loose = std::mem::take(&mut self.loose);
        loose.clear();
        self.supports.balls(&mut loose);
        loose.retain(|&index| struck.iter().all(|&(other, ..)| other != index));
        let before: Vec<_> = loose
            .iter()
            .map(|&index| {
                let (place, velocity) = self.piece(balls, index).at(self.motion, time);
                (index, place, velocity, self.acceleration[index])
            })
            .collect();
        match support {
            Some(support) => self.supports.add(support),
            None => struck
                .iter()
                .for_each(|&(index, ..)| self.supports.drop_of(index)),
        }
        let all = || {
            struck
                .iter()
                .map(|&(index, ..)| index)
                .chain(loose.iter().copied())
        };
        for index in all() {
            self.acceleration[index] = self.pulls[index];
        }
        self.supports.solve(balls, &mut self.acceleration);
        for index in all() {
            // What is no more than rounding leaves of the ball's own acceleration is none.
            if self.acceleration[index].length() * self.length <= ROUNDING * self.gain(index) {
                self.acceleration[index] = Vec2::ZERO;
            }
        }
        for (index, place, velocity, acceleration) in before {
            if self.acceleration[index] != acceleration {
                self.turn(balls, index, time, place, velocity);
                changed.push(index);
            }
        }
        self.loose = loose;
    }

    /// Begins a new piece of path.
    fn turn(&mut self, balls: &mut Balls, index: usize, time: f64, place: Vec2, velocity: Vec2) {
        balls.position[index] = place;
        balls.velocity[index] = velocity;
        self.since[index] = time;
        self.hits[index] = self.hits[index].wrapping_add(1);
    }
}
