//! The overlapping pairs of a substep, in the order in which they are treated.
//!
//! That order is (lower id, higher id). It can only show in balls that are in two pairs or more; a pair that shares no
//! ball with another is treated where it was found, while it is still in the cache, and needs no sorting.

use crate::Balls;
use crate::broadphase::{Broadphase, Discs, Pair, Reach};

/// A pair that shares a ball with another one.
#[derive(Clone, Copy)]
struct Entangled {
    ids: (u64, u64),
    first: u32,
    second: u32,
}

/// Scratch memory for the pairs of one substep.
#[derive(Default)]
pub(crate) struct Pairs {
    found: Vec<Pair>,
    /// In how many pairs each ball is; all 0 between substeps.
    counts: Vec<u8>,
    entangled: Vec<Entangled>,
}

impl Pairs {
    /// Finds the pairs that overlap.
    pub(crate) fn find(&mut self, balls: &Balls, broadphase: &mut dyn Broadphase) {
        let reach = match balls.uniform() {
            Some(shape) => Reach::Same(shape.radius),
            None => Reach::Each(&balls.radius),
        };
        let discs = Discs {
            center: &balls.position,
            reach,
        };
        self.found.clear();
        broadphase.build(&discs);
        broadphase.pairs(&discs, &mut self.found);
    }

    /// Shows the pairs as (index of the lower id, index of the higher id), as if in order of these ids.
    pub(crate) fn treat(&mut self, balls: &mut Balls, mut treat: impl FnMut(&mut Balls, usize, usize)) {
        self.counts.resize(balls.len(), 0);
        for &(first, second) in &self.found {
            for index in [first, second] {
                let count = &mut self.counts[index as usize];
                *count = count.saturating_add(1);
            }
        }
        self.entangled.clear();
        for &pair in &self.found {
            let (first, second) = by_id(balls, pair);
            if (self.counts[first], self.counts[second]) == (1, 1) {
                treat(balls, first, second);
            } else {
                self.entangled.push(Entangled {
                    ids: (balls.id[first], balls.id[second]),
                    first: first as u32,
                    second: second as u32,
                });
            }
        }
        for &(first, second) in &self.found {
            self.counts[first as usize] = 0;
            self.counts[second as usize] = 0;
        }
        self.entangled.sort_unstable_by_key(|pair| pair.ids);
        for pair in &self.entangled {
            treat(balls, pair.first as usize, pair.second as usize);
        }
    }

    /// The pairs as indices, the lower id first, in order of the ids.
    pub(crate) fn sorted(self, balls: &Balls) -> Vec<Pair> {
        let mut pairs: Vec<_> = self
            .found
            .iter()
            .map(|&pair| by_id(balls, pair))
            .map(|(first, second)| (first as u32, second as u32))
            .collect();
        pairs.sort_unstable_by_key(|&(first, second)| (balls.id[first as usize], balls.id[second as usize]));
        pairs
    }
}

/// The same pair with the lower id first.
#[inline]
fn by_id(balls: &Balls, (first, second): Pair) -> (usize, usize) {
    let (first, second) = (first as usize, second as usize);
    if balls.is_by_id() || balls.id[first] < balls.id[second] {
        (first, second)
    } else {
        (second, first)
    }
}
