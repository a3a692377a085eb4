//! The pairs of a substep, in the order in which they are treated.
//!
//! That order is (lower id, higher id). It can only show in balls that are in two pairs or more; a pair that shares no
//! ball with another is treated where it was found, while it is still in the cache, and needs no sorting. What comes of
//! such pairs is independent, so it can be worked out at once; only the writing is one after the other.

use crate::broadphase::{Broadphase, Discs, Found, Pair, Reach};
use crate::{Balls, Team};

/// A pair that shares a ball with another one.
#[derive(Clone, Copy)]
struct Entangled {
    ids: (u64, u64),
    first: u32,
    second: u32,
}

impl Entangled {
    fn new(balls: &Balls, pair: Pair) -> Entangled {
        let (first, second) = by_id(balls, pair);
        Entangled {
            ids: (balls.id[first], balls.id[second]),
            first: first as u32,
            second: second as u32,
        }
    }
}

/// What a piece of the work on pairs leaves behind.
struct Piece<O> {
    outcomes: Vec<(u32, u32, O)>,
    entangled: Vec<Entangled>,
}

impl<O> Piece<O> {
    fn work_out(&mut self, balls: &Balls, list: &[Pair], counts: &[u8], rule: &impl Rule<O>) {
        for list in list.chunks(BATCH) {
            let batch = Batch::new(balls, list, counts, rule);
            for pair in batch.alone(list) {
                let (first, second) = rule.in_order(balls, pair);
                if let Some(outcome) = rule.outcome(balls, first, second) {
                    self.outcomes.push((first as u32, second as u32, outcome));
                }
            }
            (self.entangled).extend(batch.entangled(list).map(|pair| Entangled::new(balls, pair)));
        }
    }
}

/// What comes of a pair.
pub(crate) trait Rule<O>: Sync {
    /// False if nothing does, as the two balls are now. Asked about many pairs in a row, whose balls are far from any
    /// cache: without a branch, the processor fetches them all at once.
    fn may(&self, balls: &Balls, first: usize, second: usize) -> bool;

    /// The order in which [`Rule::outcome`] gets a pair that shares no ball: the lower id first, unless what comes of it
    /// is the same in either order, to the last bit. Then nobody need fetch the ids.
    fn in_order(&self, balls: &Balls, pair: Pair) -> (usize, usize) {
        by_id(balls, pair)
    }

    /// What comes of a pair.
    fn outcome(&self, balls: &Balls, first: usize, second: usize) -> Option<O>;
}

/// Pairs that are asked about in a row.
const BATCH: usize = u64::BITS as usize;

/// A bit for each pair of a batch.
struct Batch {
    /// It shares no ball with another, and something may come of it.
    alone: u64,
    /// It shares a ball.
    entangled: u64,
}

impl Batch {
    fn new<O>(balls: &Balls, list: &[Pair], counts: &[u8], rule: &impl Rule<O>) -> Batch {
        let (mut may, mut entangled) = (0, 0);
        for (bit, &(first, second)) in list.iter().enumerate() {
            let (first, second) = (first as usize, second as usize);
            may |= u64::from(rule.may(balls, first, second)) << bit;
            entangled |= u64::from((counts[first] | counts[second]) > 1) << bit;
        }
        Batch {
            alone: may & !entangled,
            entangled,
        }
    }

    fn alone(&self, list: &[Pair]) -> impl Iterator<Item = Pair> {
        chosen(self.alone, list)
    }

    fn entangled(&self, list: &[Pair]) -> impl Iterator<Item = Pair> {
        chosen(self.entangled, list)
    }
}

fn chosen(mut bits: u64, list: &[Pair]) -> impl Iterator<Item = Pair> {
    std::iter::from_fn(move || {
        let pair = list.get(bits.trailing_zeros() as usize)?;
        bits &= bits - 1;
        Some(*pair)
    })
}

/// Scratch memory for the pairs of one substep; `O` is what can come of a pair.
pub(crate) struct Pairs<O> {
    found: Found,
    /// In how many pairs each ball is; all 0 between substeps.
    counts: Vec<u8>,
    pieces: Vec<Piece<O>>,
    entangled: Vec<Entangled>,
}

impl<O> Default for Pairs<O> {
    fn default() -> Pairs<O> {
        Pairs {
            found: Found::default(),
            counts: Vec::new(),
            pieces: Vec::new(),
            entangled: Vec::new(),
        }
    }
}

impl<O: Copy + Send> Pairs<O> {
    /// Finds at least the pairs that overlap.
    pub(crate) fn find(&mut self, balls: &Balls, broadphase: &mut dyn Broadphase, team: &Team) {
        let discs = discs_of(balls);
        broadphase.build(&discs, team);
        broadphase.pairs(&discs, team, &mut self.found);
    }

    /// Finds the pairs that overlap, and no others.
    pub(crate) fn find_overlapping(&mut self, balls: &Balls, broadphase: &mut dyn Broadphase, team: &Team) {
        self.find(balls, broadphase, team);
        self.found.keep_overlapping(&discs_of(balls), team);
    }

    /// Treats the pairs as if in order of (lower id, higher id). `apply` gets a pair as `rule` did. Returns how many pairs had
    /// an outcome.
    pub(crate) fn treat(
        &mut self,
        balls: &mut Balls,
        team: &Team,
        rule: &impl Rule<O>,
        apply: &mut impl FnMut(&mut Balls, usize, usize, O),
    ) -> u64 {
        self.count(balls.len());
        let mut treated = 0;
        let mut treat = |balls: &mut Balls, first: usize, second: usize| {
            if let Some(outcome) = rule.outcome(balls, first, second) {
                apply(balls, first, second, outcome);
                treated += 1;
            }
        };
        self.entangled.clear();
        if team.size() == 1 {
            for list in self.found.lists().iter().flat_map(|list| list.chunks(BATCH)) {
                let batch = Batch::new(balls, list, &self.counts, rule);
                for pair in batch.alone(list) {
                    let (first, second) = rule.in_order(balls, pair);
                    treat(balls, first, second);
                }
                (self.entangled).extend(batch.entangled(list).map(|pair| Entangled::new(balls, pair)));
            }
        } else {
            self.work_out(balls, team, rule);
        }
        self.entangled.sort_unstable_by_key(|pair| pair.ids);
        for pair in &self.entangled {
            treat(balls, pair.first as usize, pair.second as usize);
        }
        for &(first, second, outcome) in self.pieces.iter().flat_map(|piece| &piece.outcomes) {
            apply(balls, first as usize, second as usize, outcome);
            treated += 1;
        }
        self.forget();
        treated
    }

    /// Works out what comes of each pair that shares no ball with another, and collects the others.
    fn work_out(&mut self, balls: &Balls, team: &Team, rule: &impl Rule<O>) {
        let lists = self.found.lists();
        self.pieces.resize_with(lists.len(), || Piece {
            outcomes: Vec::new(),
            entangled: Vec::new(),
        });
        let counts = &self.counts[..];
        team.each((&mut self.pieces[..], lists), 1, &|(pieces, lists)| {
            for (piece, list) in pieces.iter_mut().zip(lists) {
                piece.work_out(balls, list, counts, rule);
            }
        });
        for piece in &mut self.pieces {
            self.entangled.append(&mut piece.entangled);
        }
    }

    /// Counts in how many pairs each ball is.
    fn count(&mut self, balls: usize) {
        self.counts.resize(balls, 0);
        for (first, second) in self.found.iter() {
            for index in [first, second] {
                let count = &mut self.counts[index as usize];
                *count = count.saturating_add(1);
            }
        }
    }

    /// Leaves the counts at 0, without a look at balls that are in no pair, and no outcome behind.
    fn forget(&mut self) {
        for (first, second) in self.found.iter() {
            self.counts[first as usize] = 0;
            self.counts[second as usize] = 0;
        }
        for piece in &mut self.pieces {
            piece.outcomes.clear();
        }
    }

    /// The pairs as indices, the lower id first, in order of the ids.
    pub(crate) fn sorted(self, balls: &Balls) -> Vec<Pair> {
        let mut pairs: Vec<_> = self
            .found
            .iter()
            .map(|pair| by_id(balls, pair))
            .map(|(first, second)| (first as u32, second as u32))
            .collect();
        pairs.sort_unstable_by_key(|&(first, second)| (balls.id[first as usize], balls.id[second as usize]));
        pairs
    }
}

/// The balls as a broadphase sees them.
fn discs_of(balls: &Balls) -> Discs<'_> {
    Discs {
        center: &balls.position,
        reach: match balls.uniform() {
            Some(shape) => Reach::Same(shape.radius),
            None => Reach::Each(&balls.radius),
        },
    }
}

/// The same pair with the lower id first.
#[inline]
fn by_id(balls: &Balls, (first, second): Pair) -> (usize, usize) {
    balls.in_id_order(first as usize, second as usize)
}

#[cfg(test)]
mod tests;
