//! The collisions that the paths at the start of a substep lead into.

use super::paths::Paths;
use super::queue::{Event, Party};
use super::{predict, predict_walls};
use crate::Balls;
use crate::broadphase::{Discs, Found, Pair, Reach};
use crate::contacts::Substep;
use crate::walls::Walls;

/// What one piece of the work predicted.
#[derive(Default)]
pub(super) struct List {
    pub(super) events: Vec<Event>,
    /// Between these heights the balls' discs have their centres.
    pub(super) low: f64,
    pub(super) high: f64,
}

impl List {
    fn clear(&mut self) {
        self.events.clear();
        (self.low, self.high) = (f64::INFINITY, f64::NEG_INFINITY);
    }

    fn push(&mut self, paths: &Paths, event: Event) {
        let first = event.first as usize;
        for index in [first, event.partner.as_ball().unwrap_or(first)] {
            let height = paths.center[index].y;
            if height.is_nan() {
                (self.low, self.high) = (f64::NEG_INFINITY, f64::INFINITY);
            }
            self.low = self.low.min(height);
            self.high = self.high.max(height);
        }
        self.events.push(event);
    }

    fn add_pairs(&mut self, paths: &Paths, balls: &Balls, pairs: &[Pair]) {
        for &(first, second) in pairs {
            let (first, second) = balls.in_id_order(first as usize, second as usize);
            let pieces = (
                &paths.first_piece(balls, first),
                &paths.first_piece(balls, second),
            );
            if let Some(time) = predict::pieces_of(paths, balls, (first, second), pieces) {
                self.push(
                    paths,
                    Event::of_pair(time, unhit(balls, first), unhit(balls, second)),
                );
            }
        }
    }
}

#[derive(Default)]
pub(super) struct First {
    found: Found,
    lists: Vec<List>,
}

impl First {
    /// Finds all of them.
    pub(super) fn predict(&mut self, paths: &mut Paths, substep: &mut Substep<'_>) {
        let balls = &*substep.balls;
        let walls = Walls::of(substep.rules);
        paths.sweep(balls, substep.team);
        let discs = Discs {
            center: &paths.center,
            reach: Reach::Each(&paths.reach),
        };
        substep.broadphase.build(&discs, substep.team);
        substep.broadphase.pairs(&discs, substep.team, &mut self.found);
        if paths.notes_touches() {
            for (first, second) in self.found.iter() {
                paths.note_touch(balls, first as usize, second as usize);
            }
        }
        let (paths, found) = (&*paths, self.found.lists());
        self.lists.resize_with(found.len(), List::default);
        let pieces = (&mut self.lists[..], found, 0..found.len());
        let (count, parts) = (balls.len(), found.len());
        substep.team.each(pieces, 1, &|(lists, found, parts_here)| {
            for ((list, pairs), part) in lists.iter_mut().zip(found).zip(parts_here) {
                list.clear();
                list.add_pairs(paths, balls, pairs);
                let Some(walls) = &walls else { continue };
                for index in count * part / parts..count * (part + 1) / parts {
                    if !walls.hold(paths.center[index], paths.reach[index]) {
                        let path = (&paths.first_piece(balls, index), unhit(balls, index));
                        predict_walls(paths, balls, walls, index, path, |event| list.push(paths, event));
                    }
                }
            }
        });
    }

    /// How many pairs were looked at.
    pub(super) fn pairs(&self) -> usize {
        self.found.count()
    }

    pub(super) fn lists(&self) -> &[List] {
        &self.lists
    }

    pub(super) fn lists_mut(&mut self) -> &mut [List] {
        &mut self.lists
    }
}

fn unhit(balls: &Balls, index: usize) -> Party {
    Party {
        index,
        id: balls.id[index],
        hits: 0,
    }
}
