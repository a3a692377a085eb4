//! The collisions that the paths at the start of a substep lead into.

use super::paths::Paths;
use super::queue::{Event, Party};
use super::{predict, predict_walls};
use crate::Balls;
use crate::broadphase::{Found, Pair, Part};
use crate::contacts::Substep;
use crate::walls::Walls;

/// What one piece of the work predicted.
#[derive(Default)]
pub(super) struct List {
    pub(super) events: Vec<Event>,
}

impl List {
    /// Predicts the collisions of pairs in place of what was there.
    pub(super) fn predict(&mut self, paths: &Paths, balls: &Balls, pairs: &[Pair]) {
        self.events.clear();
        for &(first, second) in pairs {
            let (first, second) = balls.in_id_order(first as usize, second as usize);
            let pieces = (
                &paths.first_piece(balls, first),
                &paths.first_piece(balls, second),
            );
            if let Some(time) = predict::pieces_of(paths, balls, (first, second), pieces) {
                self.events
                    .push(Event::of_pair(time, unhit(balls, first), unhit(balls, second)));
            }
        }
    }

    /// Predicts the collisions of the balls of a part with walls, in place of what was there.
    fn predict_walls(&mut self, paths: &Paths, balls: &Balls, walls: &Walls, part: Part) {
        self.events.clear();
        for index in part.range(balls.len()) {
            if !walls.hold(paths.center[index], paths.reach[index]) {
                let path = (&paths.first_piece(balls, index), unhit(balls, index));
                predict_walls(paths, balls, walls, index, path, |event| self.events.push(event));
            }
        }
    }

    /// Between these heights the discs of its balls have their centres.
    pub(super) fn heights(&self, paths: &Paths) -> (f64, f64) {
        self.events.iter().fold(Part::NOWHERE, |(low, high), event| {
            let height = paths.center[event.first as usize].y;
            (low.min(height), high.max(height))
        })
    }
}

#[derive(Default)]
pub(super) struct First {
    found: Found,
    walls: Vec<List>,
    pairs: Vec<List>,
}

impl First {
    /// Puts all paths in the broadphase and predicts the collisions with walls.
    pub(super) fn prepare(&mut self, paths: &mut Paths, substep: &mut Substep<'_>) {
        let balls = &*substep.balls;
        paths.sweep(balls, substep.team);
        substep.broadphase.build(&paths.discs(), substep.team);
        self.walls.iter_mut().for_each(|list| list.events.clear());
        let Some(walls) = Walls::of(substep.rules) else {
            return;
        };
        let of = substep.team.pieces();
        self.walls.resize_with(of, List::default);
        let (paths, whole) = (&*paths, (&mut self.walls[..], 0..of));
        substep.team.each(whole, 1, &|(lists, numbers)| {
            for (list, number) in lists.iter_mut().zip(numbers) {
                list.predict_walls(paths, balls, &walls, Part { number, of });
            }
        });
    }

    /// Finds all pairs and predicts their collisions.
    pub(super) fn predict(&mut self, paths: &mut Paths, substep: &mut Substep<'_>) {
        let balls = &*substep.balls;
        substep
            .broadphase
            .pairs(&paths.discs(), substep.team, &mut self.found);
        if paths.notes_touches() {
            for (first, second) in self.found.iter() {
                paths.note_touch(balls, first as usize, second as usize);
            }
        }
        let (paths, found) = (&*paths, self.found.lists());
        self.pairs.resize_with(found.len(), List::default);
        let whole = (&mut self.pairs[..], found);
        substep.team.each(whole, 1, &|(lists, found)| {
            for (list, pairs) in lists.iter_mut().zip(found) {
                list.predict(paths, balls, pairs);
            }
        });
    }

    /// How many of the pairs do overlap.
    pub(super) fn overlapping(&self, paths: &Paths) -> usize {
        let discs = paths.discs();
        let overlap = |&(first, second): &Pair| discs.overlap(first as usize, second as usize);
        self.found.iter().filter(overlap).count()
    }

    /// How many collisions were predicted.
    pub(super) fn events(&self) -> usize {
        let lists = self.walls.iter().chain(&self.pairs);
        lists.map(|list| list.events.len()).sum()
    }

    /// Those with walls.
    pub(super) fn walls(&self) -> &[List] {
        &self.walls
    }

    /// All of them.
    pub(super) fn lists_mut(&mut self) -> impl Iterator<Item = &mut List> {
        self.walls.iter_mut().chain(&mut self.pairs)
    }
}

fn unhit(balls: &Balls, index: usize) -> Party {
    Party {
        index,
        id: balls.id[index],
        hits: 0,
    }
}
