//! The work that a caller gives a substep, counted so that the count is a function of the state: not of threads, memory
//! order, the broadphase or the last tick.
//!
//! Looked at are the pairs of discs, each around what is left of a path, that overlap: at the start, and around every
//! ball that begins a new path, as all discs are at that time. Each event counts as one more. [`super::sequence`] counts
//! just that. [`super::groups`] know only that they looked at no less; where that is within the budget the count is, too,
//! and where it is not, the order of all times decides.

use crate::Error;

pub(super) struct Budget {
    tick: u64,
    left: u64,
}

impl Budget {
    pub(super) fn new(tick: u64, pairs: u64) -> Budget {
        Budget { tick, left: pairs }
    }

    /// Takes so many pairs from it.
    #[inline]
    pub(super) fn spend(&mut self, pairs: usize) -> Result<(), Error> {
        match self.left.checked_sub(pairs as u64) {
            Some(left) => {
                self.left = left;
                Ok(())
            }
            None => Err(Error::Budget { tick: self.tick }),
        }
    }
}
