//! All events of a substep in the order of their times, from one queue.

use super::budget::Budget;
use super::contact::Law;
use super::first::List;
use super::paths::Paths;
use super::queue::{Event, Party, Queue};
use super::{event_limit, predict, predict_walls};
use crate::contacts::{EVENT_LIMIT, Substep};
use crate::walls::Walls;
use crate::{Balls, Error};

#[derive(Default)]
pub(super) struct Sequence {
    queue: Queue,
    near: Vec<u32>,
    /// Balls that the last event gave new paths.
    changed: Vec<usize>,
}

impl Sequence {
    /// Does all collisions; `predicted` are those at the start, which are taken out.
    pub(super) fn run<'a>(
        &mut self,
        paths: &mut Paths,
        substep: &mut Substep<'_>,
        budget: &mut Budget,
        predicted: impl Iterator<Item = &'a mut List>,
    ) -> Result<(), Error> {
        let walls = Walls::of(substep.rules);
        let law = Law::new(paths, substep.rules.restitution());
        paths.follow_hits(substep.balls);
        self.queue.begin(predicted.map(|list| &mut list.events));
        let mut count = 0;
        while let Some(event) = self.queue.next(&paths.hits) {
            count += 1;
            if count + paths.supports.sweeps() > EVENT_LIMIT {
                return Err(event_limit(substep, &event));
            }
            budget.spend(1)?;
            let first = event.first as usize;
            self.changed.clear();
            match event.partner.as_ball() {
                Some(second) => {
                    let pair = (first, second);
                    let hit = law.pair(paths, substep.balls, pair, event.time, &mut self.changed);
                    substep.counters.collisions += u64::from(hit);
                }
                None => {
                    let Some(wall) = walls.as_ref().map(|walls| walls.wall(event.partner.as_wall())) else {
                        continue;
                    };
                    let hit = law.wall(paths, substep.balls, first, &wall, event.time, &mut self.changed);
                    substep.counters.wall_hits += u64::from(hit);
                }
            }
            for at in 0..self.changed.len() {
                let met = self.predict_again(paths, substep, walls.as_ref(), self.changed[at]);
                budget.spend(met)?;
            }
        }
        Ok(())
    }

    /// Puts a ball that was hit elsewhere in the tree and predicts its next collisions. Returns how many other discs its
    /// own overlaps.
    fn predict_again(
        &mut self,
        paths: &mut Paths,
        substep: &mut Substep<'_>,
        walls: Option<&Walls>,
        index: usize,
    ) -> usize {
        let balls = &*substep.balls;
        paths.sweep_one(balls, index);
        let (center, reach) = (paths.center[index], paths.reach[index]);
        substep.broadphase.relocate(index, center, reach);
        let (discs, mut met) = (paths.discs(), 0);
        self.near.clear();
        substep.broadphase.query(center, reach, &mut self.near);
        for &other in &self.near {
            let other = other as usize;
            if other == index {
                continue;
            }
            met += usize::from(discs.overlap(index, other));
            let (first, second) = balls.in_id_order(index, other);
            if let Some(time) = predict::pair(paths, balls, first, second) {
                self.queue.push(Event::of_pair(
                    time,
                    party(paths, balls, first),
                    party(paths, balls, second),
                ));
            }
        }
        if let Some(walls) = walls
            && !walls.hold(center, reach)
        {
            let path = (&paths.piece(balls, index), party(paths, balls, index));
            predict_walls(paths, balls, walls, index, path, |event| self.queue.push(event));
        }
        met
    }
}

fn party(paths: &Paths, balls: &Balls, index: usize) -> Party {
    Party {
        index,
        id: balls.id[index],
        hits: paths.hits[index],
    }
}
