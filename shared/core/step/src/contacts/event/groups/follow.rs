//! Where a ball goes that was hit, and whom it meets there.

use super::super::piece::{Piece, radius};
use super::super::predict_walls;
use super::super::queue::Event;
use super::super::sweep::is_moderate;
use super::actors::{DEFERRED, EARLY, NONE, WAITING, meeting};
use super::ground::{Beyond, Ground};
use super::run::Halt;
use super::set::Groups;

impl Groups {
    /// Predicts the next collisions of an actor that was hit, and finds out whom it meets.
    pub(super) fn follow(
        &mut self,
        ground: &Ground<'_>,
        beyond: &mut Beyond<'_>,
        slot: usize,
    ) -> Result<(), Halt> {
        let (paths, balls) = (ground.paths, ground.balls);
        let actor = &self.actors.all[slot];
        let (ball, piece) = (actor.ball as usize, actor.piece(paths));
        let (center, reach) = piece.disc(paths.motion, paths.length, radius(balls, ball));
        let (_, velocity) = piece.at(paths.motion, paths.length);
        if !is_moderate(center, reach, velocity) {
            return Err(Halt::Stuck);
        }
        self.stay(
            ground,
            beyond,
            slot,
            (center - paths.center[ball]).length() + reach,
        )?;
        self.near.clear();
        beyond.query(center, reach + ground.strips.slack, &mut self.near);
        self.looked_at += self.near.len() as u64;
        if self.actors.all[slot].far > 0.0 {
            // Those that were hit before it was relocated have not found it there.
            let hits = self
                .near
                .iter()
                .map(|&other| self.hits_of(ground, beyond, other as usize));
            self.looked_at += hits.sum::<u64>();
        }
        if self.looked_at > ground.budget {
            return Err(Halt::Stuck);
        }
        for at in 0..self.near.len() {
            let other = self.near[at] as usize;
            if other != ball {
                self.face(ground, beyond, (slot, ball, &piece), other)?;
            }
        }
        if let Some(walls) = &ground.walls
            && !walls.hold(center, reach)
        {
            let path = (&piece, self.actors.party(slot));
            predict_walls(paths, balls, walls, ball, path, |event| self.queue.push(event));
        }
        Ok(())
    }

    /// How often a ball was hit, whichever strip ran it.
    fn hits_of(&self, ground: &Ground<'_>, beyond: &Beyond<'_>, ball: usize) -> u64 {
        let hits = match (self.find(ground, ball), beyond) {
            (Some(slot), _) => self.actors.hits.get(slot),
            (None, Beyond::Open(_, strips)) => {
                let strip = &strips[ground.strips.of(ground.paths.center[ball].y)];
                (strip.actors.hits).get(ground.whereabouts.get(ball) as usize)
            }
            (None, Beyond::Closed(_)) => None,
        };
        hits.map_or(0, |&hits| u64::from(hits))
    }

    /// Sees to it that an actor is found where it is now: so far from the centre of its first disc, at the most.
    fn stay(
        &mut self,
        ground: &Ground<'_>,
        beyond: &mut Beyond<'_>,
        slot: usize,
        far: f64,
    ) -> Result<(), Halt> {
        let actor = &mut self.actors.all[slot];
        let ball = actor.ball as usize;
        if far <= actor.far || far <= ground.paths.reach[ball] + ground.strips.slack {
            return Ok(());
        }
        match beyond {
            Beyond::Closed(_) => Err(Halt::Leaves),
            Beyond::Open(broadphase, _) => {
                actor.far = far;
                broadphase.relocate(ball, ground.paths.center[ball], far);
                Ok(())
            }
        }
    }

    /// Finds out whether an actor, on its new piece of path, meets a ball, and what follows.
    fn face(
        &mut self,
        ground: &Ground<'_>,
        beyond: &Beyond<'_>,
        (slot, ball, piece): (usize, usize, &Piece),
        other: usize,
    ) -> Result<(), Halt> {
        let (paths, balls) = (ground.paths, ground.balls);
        let partner = if let Some(partner) = self.find(ground, other) {
            let group = self.actors.all[partner].group;
            if group != self.running() && !matches!(group, WAITING | EARLY | DEFERRED) {
                let meets = self.actors.meet(paths, balls, (ball, piece), partner);
                return if meets { Err(Halt::Met(partner)) } else { Ok(()) };
            }
            Some(partner)
        } else {
            if let Beyond::Open(_, strips) = beyond {
                let at = ground.whereabouts.get(other);
                if at != NONE {
                    let (strip, at) = (ground.strips.of(paths.center[other].y), at as usize);
                    let meets = strips[strip].actors.meet(paths, balls, (ball, piece), at);
                    return if meets {
                        Err(Halt::MetElsewhere(strip, at))
                    } else {
                        Ok(())
                    };
                }
            }
            None
        };
        let theirs = match partner {
            Some(partner) => self.actors.all[partner].piece(paths),
            None => paths.first_piece(balls, other),
        };
        let Some(time) = meeting(paths, balls, (ball, piece), (other, &theirs)) else {
            return Ok(());
        };
        let partner = match partner {
            Some(partner) => match self.actors.all[partner].group {
                WAITING | EARLY => return Err(Halt::Met(partner)),
                DEFERRED => return Err(Halt::Leaves),
                _ => partner,
            },
            None if !self.holds(ground, other) => return Err(Halt::Leaves),
            None => {
                let partner = self.find_or_enlist(ground, other);
                self.join(ground, partner);
                if self.is_early {
                    return Err(Halt::Early);
                }
                partner
            }
        };
        let (first, second) = if balls.in_id_order(ball, other).0 == ball {
            (slot, partner)
        } else {
            (partner, slot)
        };
        let event = Event::of_pair(time, self.actors.party(first), self.actors.party(second));
        self.queue.push(event);
        Ok(())
    }
}
