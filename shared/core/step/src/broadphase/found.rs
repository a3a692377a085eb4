//! The pairs that a broadphase found: a list for each piece of the search, so that pieces can be searched at once.

use std::ops::Range;

use super::{Discs, Pair};
use crate::team::Team;

/// One of the equal parts that a search is cut into. Who cannot cut it does all of it in the first.
#[derive(Clone, Copy, Debug)]
pub struct Part {
    /// Which one, from 0 on.
    pub number: usize,
    /// How many there are.
    pub of: usize,
}

impl Part {
    /// The heights of no discs at all.
    pub(crate) const NOWHERE: (f64, f64) = (f64::INFINITY, f64::NEG_INFINITY);

    /// What of so many falls to this part.
    #[must_use]
    pub fn range(self, count: usize) -> Range<usize> {
        count * self.number / self.of..count * (self.number + 1) / self.of
    }
}

/// Pairs, in the order in which they were found.
#[derive(Default)]
pub struct Found {
    lists: Vec<Vec<Pair>>,
}

impl Found {
    /// Empties the lists and returns one for each piece of work that the team cuts a search into.
    pub(crate) fn begin(&mut self, team: &Team) -> &mut [Vec<Pair>] {
        let pieces = team.pieces();
        if self.lists.len() != pieces {
            self.lists.resize_with(pieces, Vec::new);
        }
        self.lists.iter_mut().for_each(Vec::clear);
        &mut self.lists
    }

    /// Keeps only the pairs that do overlap.
    pub fn keep_overlapping(&mut self, discs: &Discs<'_>, team: &Team) {
        team.each(&mut self.lists[..], 1, &|lists| {
            for list in lists {
                list.retain(|&(first, second)| discs.overlap(first as usize, second as usize));
            }
        });
    }

    /// The lists.
    #[must_use]
    pub fn lists(&self) -> &[Vec<Pair>] {
        &self.lists
    }

    /// All pairs.
    pub fn iter(&self) -> impl Iterator<Item = Pair> + Clone + '_ {
        self.lists.iter().flatten().copied()
    }
}
