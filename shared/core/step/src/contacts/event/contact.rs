//! What happens at a contact.
//!
//! Approaching balls exchange their normal velocities. Two cases would otherwise be infinitely many collisions:
//!
//! - *Rest.* No approach, but an acceleration into the contact: the contact bears it until the substep ends. So does
//!   an approach no faster than a fall through a millionth of a millionth of the radius would give, which is rounding.
//! - *Collapse* below restitution 1. No impact takes a rebound below the speed that the balls' own acceleration gains
//!   in a substep, and slower ones lose nothing: real ones, too, lose less the slower they are (Brilliantov et al. 1996,
//!   doi 10.1103/PhysRevE.53.5382). Nor does a ball lose anything that is hit again within 1/1024 of the substep of
//!   its last hit (the contact time of Luding & McNamara 1998, doi 10.1007/s100350050017). A ball that touches no
//!   other and would leave a wall for less than a substep comes to rest on it. Piles so keep a jitter too small to
//!   see; they would need endless collisions to lose it.
//!
//! Between kicks a third case appears: a ball whose path leads into the contact while the ball itself leaves it. It
//! would be back within the substep; it is held there, and gets its velocity back at the end.

use super::paths::{Motion, Paths};
use super::rest::Support;
use crate::Balls;
use crate::contacts::exchange::{Shares, normal, transfer};
use crate::walls::Wall;

/// Contact time, as a part of the substep.
const CONTACT_TIME: f64 = 1.0 / 1024.0;
/// A fall through this part of a radius is taken for rounding.
const ROUNDING_FALL: f64 = 1e-12;

/// The law of contact of one substep.
pub(super) struct Law {
    restitution: f64,
    length: f64,
}

/// A contact, as seen along its normal.
struct Meeting {
    /// Speed into the contact.
    approach: f64,
    /// Acceleration into the contact; 0 where it is rounding.
    pressing: f64,
    /// Radius of the smaller ball.
    radius: f64,
    /// No impact takes the rebound below this speed.
    slow: f64,
    /// A ball was hit within the contact time.
    again: bool,
    /// The contact is with a wall, and nothing else is near.
    alone: bool,
}

/// What becomes of the approach.
enum Fate {
    /// It is turned round, times this restitution.
    Bounce(f64),
    /// It ends, and the contact bears the acceleration.
    Rest,
    /// There is none; the path is stopped, the velocity kept for later.
    Hold,
    /// Nothing.
    Pass,
}

impl Law {
    pub(super) fn new(restitution: f64, length: f64) -> Law {
        Law { restitution, length }
    }

    fn fate(&self, meeting: &Meeting, motion: Motion) -> Fate {
        let &Meeting {
            approach,
            pressing,
            radius,
            slow,
            again,
            alone,
        } = meeting;
        // Of either sign: a contact that rounding has left a hair too early would not be predicted again.
        if pressing > 0.0 && approach * approach <= 2.0 * pressing * ROUNDING_FALL * radius {
            return Fate::Rest;
        }
        if approach > 0.0 {
            if self.restitution == 1.0 {
                return Fate::Bounce(1.0);
            }
            if alone && 2.0 * self.restitution * approach < pressing * self.length {
                return Fate::Rest;
            }
            return Fate::Bounce(if again || approach < slow {
                1.0
            } else {
                self.restitution
            });
        }
        match motion {
            Motion::Kicked if pressing > 0.0 => Fate::Hold,
            _ => Fate::Pass,
        }
    }

    fn is_again(&self, paths: &Paths, index: usize, time: f64) -> bool {
        paths.hits[index] > 0 && time - paths.since[index] < CONTACT_TIME * self.length
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
        let (p1, path1) = paths.at(balls, first, time);
        let (p2, path2) = paths.at(balls, second, time);
        let along = normal(p1, p2);
        let length = along.length();
        let support = Support::new(first, Some(second), along * (1.0 / length));
        if paths.supports.hold(&support) {
            return false;
        }
        let (v1, v2) = (
            path1 + paths.ahead(first, time),
            path2 + paths.ahead(second, time),
        );
        let approach = (v1 - v2).dot(along);
        let pressing = if paths.motion == Motion::Straight {
            0.0
        } else {
            (paths.acceleration[first] - paths.acceleration[second]).dot(along)
        };
        let meeting = Meeting {
            approach: approach / length,
            pressing: paths.felt(pressing / length, first, second),
            radius: balls.radius[first].min(balls.radius[second]),
            slow: paths.gain(first).max(paths.gain(second)),
            again: self.is_again(paths, first, time) || self.is_again(paths, second, time),
            alone: false,
        };
        let fate = self.fate(&meeting, paths.motion);
        let restitution = match fate {
            Fate::Bounce(restitution) => restitution,
            Fate::Rest | Fate::Hold => 0.0,
            Fate::Pass => return false,
        };
        let Some(shares) = Shares::new(balls.mass[first], balls.mass[second], restitution) else {
            return false;
        };
        let (w1, w2) = transfer(along, approach, shares, v1, v2);
        let bounces = matches!(fate, Fate::Bounce(_));
        if bounces && (w1 - w2).dot(along) > 0.5 * approach {
            // An approach below the last bits of the velocities cannot be exchanged: it is rounding, left alone.
            return false;
        }
        if matches!(fate, Fate::Hold) {
            paths.deferred.push((first, v1 - w1));
            paths.deferred.push((second, v2 - w2));
        }
        let struck = [(first, p1, w1), (second, p2, w2)];
        paths.strike(balls, time, &struck, (!bounces).then_some(support), changed);
        approach > 0.0
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
        let (place, path) = paths.at(balls, index, time);
        let velocity = path + paths.ahead(index, time);
        let approach = -velocity.dot(wall.inward);
        let pressing = if paths.motion == Motion::Straight {
            0.0
        } else {
            -paths.acceleration[index].dot(wall.inward)
        };
        let meeting = Meeting {
            approach,
            pressing: paths.felt(pressing, index, index),
            radius: balls.radius[index],
            slow: paths.gain(index),
            again: self.is_again(paths, index, time),
            alone: paths.is_alone(index),
        };
        let (after, support) = match self.fate(&meeting, paths.motion) {
            Fate::Bounce(restitution) => (wall.with_normal(velocity, restitution * approach), None),
            Fate::Rest => (wall.with_normal(velocity, 0.0), Some(support)),
            Fate::Hold => {
                let after = wall.with_normal(velocity, 0.0);
                paths.deferred.push((index, velocity - after));
                (after, Some(support))
            }
            Fate::Pass => return false,
        };
        paths.strike(balls, time, &[(index, place, after)], support, changed);
        approach > 0.0
    }
}
