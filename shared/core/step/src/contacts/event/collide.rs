//! Contacts of balls on the paths of a sequence: the law, and what it does to the paths.

use super::contact::{Body, Fate, Law};
use super::paths::Paths;
use super::piece::{mass, radius};
use super::rest::Support;
use crate::contacts::exchange::normal;
use crate::walls::Wall;
use crate::{Balls, Vec2};

impl Law {
    /// A ball on its path, at that place and time.
    fn body(&self, paths: &Paths, balls: &Balls, index: usize, velocity: Vec2, time: f64) -> Body {
        Body {
            velocity,
            acceleration: paths.curvature(index),
            gain: paths.gain(index),
            radius: radius(balls, index),
            mass: mass(balls, index),
            again: self.is_again(paths.hits[index], paths.since[index], time),
            crowded: Law::is_crowded(paths.hits[index]),
        }
    }

    /// Two balls meet. True if an impulse passes between them; `changed` gets the balls that have new paths.
    pub(super) fn pair(
        &self,
        paths: &mut Paths,
        balls: &mut Balls,
        (first, second): (usize, usize),
        time: f64,
        changed: &mut Vec<usize>,
    ) -> bool {
        let (p1, v1) = paths.piece(balls, first).at(self.motion, time);
        let (p2, v2) = paths.piece(balls, second).at(self.motion, time);
        let along = normal(p1, p2);
        let support = Support::new(first, Some(second), along * (1.0 / along.length()));
        if paths.supports.hold(&support) {
            return false;
        }
        let bodies = [
            self.body(paths, balls, first, v1, time),
            self.body(paths, balls, second, v2, time),
        ];
        let Some(outcome) = self.of_pair(along, &bodies[0], &bodies[1]) else {
            return false;
        };
        let [w1, w2] = outcome.velocities;
        let struck = [(first, p1, w1), (second, p2, w2)];
        let bears = !matches!(outcome.fate, Fate::Bounce(_));
        paths.strike(balls, time, &struck, bears.then_some(support), changed);
        outcome.hit
    }

    /// A ball meets a wall; the rest is as for a pair.
    pub(super) fn wall(
        &self,
        paths: &mut Paths,
        balls: &mut Balls,
        index: usize,
        wall: &Wall,
        time: f64,
        changed: &mut Vec<usize>,
    ) -> bool {
        let support = Support::new(index, None, -wall.inward);
        if paths.supports.hold(&support) {
            return false;
        }
        let (place, velocity) = paths.piece(balls, index).at(self.motion, time);
        let body = self.body(paths, balls, index, velocity, time);
        let Some(outcome) = self.of_wall(wall, &body, paths.is_alone(index)) else {
            return false;
        };
        let after = outcome.velocities;
        let bears = !matches!(outcome.fate, Fate::Bounce(_));
        paths.strike(
            balls,
            time,
            &[(index, place, after)],
            bears.then_some(support),
            changed,
        );
        outcome.hit
    }
}
