//! What happens at a contact.
//!
//! Approaching balls exchange their normal velocities. Two cases would otherwise be infinitely many collisions:
//!
//! - *Rest.* No approach, but an acceleration into the contact: the contact bears it until the substep ends. So does
//!   an approach no faster than a fall through a millionth of a millionth of the radius would give, which is rounding.
//! - *Collapse* below restitution 1. An impact slower than the speed that the balls' own acceleration gains in a
//!   substep loses nothing, so that restitution jumps to 1 there, at a speed that depends on the length of the substep;
//!   there is no such speed without an acceleration. Real impacts, too, lose less the slower they are, but gradually
//!   (Brilliantov et al. 1996, doi 10.1103/PhysRevE.53.5382). Nor does a ball lose anything that is hit again within
//!   1/1024 of the substep of its last hit, the contact time of Luding & McNamara 1998 (doi 10.1007/s100350050017),
//!   which ends collapses that no acceleration drives. A ball that touches no other and would leave a wall for less
//!   than a substep comes to rest on it. Piles so keep a jitter too small to see; they would need endless collisions
//!   to lose it. Drag would take it from them all the same, and the collisions would double with every halving: from
//!   the 16th hit of a substep on, balls that are pressed together part at a speed that keeps them apart for 1/4 of it,
//!   under forces that vary.

use super::paths::{Motion, Paths};
use crate::Vec2;
use crate::contacts::exchange::{Shares, transfer};
use crate::walls::Wall;

/// Contact time, as a part of the substep.
const CONTACT_TIME: f64 = 1.0 / 1024.0;
/// From so many hits in a substep on, a ball is in a crowd that drag may bring to rest.
const CROWDED_HITS: u32 = 16;
/// The shortest bounce there, as a part of the substep.
const LEAST_BOUNCE: f64 = 1.0 / 4.0;
/// A fall through this part of a radius is taken for rounding.
const ROUNDING_FALL: f64 = 1e-12;
/// The part of an acceleration below which what contacts leave of it is rounding.
pub(super) const ROUNDING: f64 = 1e-9;

/// The law of contact of one substep.
pub(super) struct Law {
    pub(super) motion: Motion,
    restitution: f64,
    length: f64,
    /// The least speed at which balls in a crowd part, per acceleration into their contact.
    least: f64,
}

/// A ball at a contact.
pub(super) struct Body {
    pub(super) velocity: Vec2,
    pub(super) acceleration: Vec2,
    /// The speed that its own acceleration gains in the substep.
    pub(super) gain: f64,
    pub(super) radius: f64,
    pub(super) mass: f64,
    /// It was hit within the contact time.
    pub(super) again: bool,
    /// It was hit very often.
    pub(super) crowded: bool,
}

/// What comes of a contact.
pub(super) struct Outcome<Velocities> {
    pub(super) fate: Fate,
    /// After it.
    pub(super) velocities: Velocities,
    /// An impulse passed.
    pub(super) hit: bool,
}

/// A contact, as seen along its normal.
struct Meeting {
    /// Speed into the contact.
    approach: f64,
    /// Acceleration into the contact; 0 where it is rounding.
    pressing: f64,
    /// Radius of the smaller ball.
    radius: f64,
    /// Impacts below this speed lose nothing.
    slow: f64,
    /// A ball was hit within the contact time.
    again: bool,
    /// A ball was hit very often.
    crowded: bool,
    /// The contact is with a wall, and nothing else is near.
    alone: bool,
}

/// What becomes of the approach.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Fate {
    /// It is turned round, times this restitution.
    Bounce(f64),
    /// It ends, and the contact bears the acceleration.
    Rest,
    /// Nothing.
    Pass,
}

impl Law {
    pub(super) fn new(paths: &Paths, restitution: f64) -> Law {
        Law {
            motion: paths.motion,
            restitution,
            length: paths.length,
            least: if paths.varies {
                0.5 * LEAST_BOUNCE * paths.length
            } else {
                0.0
            },
        }
    }

    fn fate(&self, meeting: &Meeting) -> Fate {
        let &Meeting {
            approach,
            pressing,
            radius,
            slow,
            again,
            crowded,
            alone,
        } = meeting;
        // Of either sign: a contact that rounding has left a hair too early would not be predicted again.
        if pressing > 0.0 && approach * approach <= 2.0 * pressing * ROUNDING_FALL * radius {
            return Fate::Rest;
        }
        if approach > 0.0 {
            if crowded && approach < pressing * self.least {
                return Fate::Bounce(pressing * self.least / approach);
            }
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
        Fate::Pass
    }

    /// An acceleration between two balls, or 0 if it is no more than what rounding leaves of theirs.
    fn felt(&self, pressing: f64, whole: f64) -> f64 {
        if pressing * self.length > ROUNDING * whole {
            pressing
        } else {
            0.0
        }
    }

    /// Whether a ball that was hit so often is in a crowd.
    pub(super) fn is_crowded(hits: u32) -> bool {
        hits >= CROWDED_HITS
    }

    /// Whether a ball that was hit so often, last at `since`, was hit within the contact time.
    pub(super) fn is_again(&self, hits: u32, since: f64, time: f64) -> bool {
        hits > 0 && time - since < CONTACT_TIME * self.length
    }

    /// What comes of a contact of two balls, if anything; `along` points from the first centre to the second.
    #[inline]
    pub(super) fn of_pair(&self, along: Vec2, first: &Body, second: &Body) -> Option<Outcome<[Vec2; 2]>> {
        let length = along.length();
        let approach = (first.velocity - second.velocity).dot(along);
        let pressing = if self.motion == Motion::Straight {
            0.0
        } else {
            (first.acceleration - second.acceleration).dot(along)
        };
        let gain = first.gain.max(second.gain);
        let fate = self.fate(&Meeting {
            approach: approach / length,
            pressing: self.felt(pressing / length, gain),
            radius: first.radius.min(second.radius),
            slow: gain,
            again: first.again || second.again,
            crowded: first.crowded || second.crowded,
            alone: false,
        });
        let restitution = match fate {
            Fate::Bounce(restitution) => restitution,
            Fate::Rest => 0.0,
            Fate::Pass => return None,
        };
        let shares = Shares::new(first.mass, second.mass, restitution)?;
        let (w1, w2) = transfer(along, approach, shares, first.velocity, second.velocity);
        if matches!(fate, Fate::Bounce(_)) && (w1 - w2).dot(along) > 0.5 * approach {
            // An approach below the last bits of the velocities cannot be exchanged: it is rounding, left alone.
            return None;
        }
        Some(Outcome {
            fate,
            velocities: [w1, w2],
            hit: approach > 0.0,
        })
    }

    /// What comes of a contact of a ball with a wall, if anything; `alone`: it touches no other ball.
    #[inline]
    pub(super) fn of_wall(&self, wall: &Wall, ball: &Body, alone: bool) -> Option<Outcome<Vec2>> {
        let approach = -ball.velocity.dot(wall.inward);
        let pressing = if self.motion == Motion::Straight {
            0.0
        } else {
            -ball.acceleration.dot(wall.inward)
        };
        let fate = self.fate(&Meeting {
            approach,
            pressing: self.felt(pressing, ball.gain),
            radius: ball.radius,
            slow: ball.gain,
            again: ball.again,
            crowded: ball.crowded,
            alone,
        });
        let away = match fate {
            Fate::Bounce(restitution) => restitution * approach,
            Fate::Rest => 0.0,
            Fate::Pass => return None,
        };
        Some(Outcome {
            fate,
            velocities: wall.with_normal(ball.velocity, away),
            hit: approach > 0.0,
        })
    }
}
