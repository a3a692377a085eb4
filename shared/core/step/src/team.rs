//! The threads that share a world's work. How many there are is the caller's choice and shows in nothing but time:
//! every piece of work writes to places of its own, and what pieces return is combined in the order of the pieces.

use std::ops::Range;
#[cfg(feature = "threads")]
use std::sync::Arc;

use crate::Error;

/// Most threads of one world.
pub const MOST_THREADS: usize = 256;
/// Balls that one piece of work takes, at least: for fewer, handing it over costs more than doing it.
pub(crate) const GRAIN: usize = 1024;
/// Pieces per thread, so that one that is held up leaves something for the others to take over.
const PIECES: usize = 4;

/// Something that can be cut in two, to be worked on at once.
pub(crate) trait Divide: Sized + Send {
    /// Length of the whole.
    fn length(&self) -> usize;

    /// The part before `at`, and the rest.
    fn divide(self, at: usize) -> (Self, Self);
}

impl<T: Sync> Divide for &[T] {
    fn length(&self) -> usize {
        self.len()
    }

    fn divide(self, at: usize) -> (Self, Self) {
        self.split_at(at)
    }
}

impl<T: Send> Divide for &mut [T] {
    fn length(&self) -> usize {
        self.len()
    }

    fn divide(self, at: usize) -> (Self, Self) {
        self.split_at_mut(at)
    }
}

impl Divide for Range<usize> {
    fn length(&self) -> usize {
        self.end - self.start
    }

    fn divide(self, at: usize) -> (Self, Self) {
        let middle = self.start + at;
        (self.start..middle, middle..self.end)
    }
}

macro_rules! divide_together {
    ($first:ident $(, $other:ident)+) => {
        impl<$first: Divide, $($other: Divide),+> Divide for ($first, $($other),+) {
            fn length(&self) -> usize {
                self.0.length()
            }

            #[expect(non_snake_case, reason = "each value is called like its type")]
            fn divide(self, at: usize) -> (Self, Self) {
                let ($first, $($other),+) = self;
                let ($first, $($other),+) = ($first.divide(at), $($other.divide(at)),+);
                (($first.0, $($other.0),+), ($first.1, $($other.1),+))
            }
        }
    };
}

divide_together!(A, B);
divide_together!(A, B, C);
divide_together!(A, B, C, D);

/// One or more threads.
#[derive(Clone, Default)]
pub struct Team {
    #[cfg(feature = "threads")]
    pool: Option<Arc<rayon::ThreadPool>>,
}

impl Team {
    /// A team of so many threads; one is the caller's own.
    ///
    /// # Errors
    /// [`Error::Model`] for none or too many, and where threads cannot be had.
    pub fn new(threads: usize) -> Result<Team, Error> {
        if !(1..=MOST_THREADS).contains(&threads) {
            return Err(Error::Model(format!(
                "threads = {threads}: a world needs at least 1 and can use at most {MOST_THREADS}"
            )));
        }
        if threads == 1 {
            return Ok(Team::default());
        }
        Team::pooled(threads)
    }

    #[cfg(feature = "threads")]
    fn pooled(threads: usize) -> Result<Team, Error> {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .thread_name(|number| format!("kuglice-{number}"))
            .build()
            .map_err(|error| Error::Model(format!("{threads} threads cannot be started: {error}")))?;
        Ok(Team {
            pool: Some(Arc::new(pool)),
        })
    }

    #[cfg(not(feature = "threads"))]
    fn pooled(threads: usize) -> Result<Team, Error> {
        Err(Error::Model(format!(
            "threads = {threads}: this build was made for one thread"
        )))
    }

    /// How many threads there are.
    #[must_use]
    pub fn size(&self) -> usize {
        #[cfg(feature = "threads")]
        return self.pool.as_ref().map_or(1, |pool| pool.current_num_threads());
        #[cfg(not(feature = "threads"))]
        1
    }

    /// In how many pieces work is best cut.
    pub(crate) fn pieces(&self) -> usize {
        match self.size() {
            1 => 1,
            size => size * PIECES,
        }
    }

    /// Does work that shares itself out: entering the pool once costs less than once for each of its stages.
    #[cfg(feature = "threads")]
    pub(crate) fn enter<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
        match &self.pool {
            Some(pool) => pool.install(work),
            None => work(),
        }
    }

    #[cfg(not(feature = "threads"))]
    pub(crate) fn enter<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
        work()
    }

    /// Shares out work on `whole`, cut at multiples of `grain`, and combines what the pieces return, in their order.
    pub(crate) fn share<D: Divide, R: Send>(
        &self,
        whole: D,
        grain: usize,
        work: &(impl Fn(D) -> R + Sync),
        combine: &(impl Fn(R, R) -> R + Sync),
    ) -> R {
        let pieces = self.pieces().min(whole.length().div_ceil(grain)).max(1);
        self.cut(whole, grain, pieces, work, combine)
    }

    /// The same for work that returns nothing.
    pub(crate) fn each<D: Divide>(&self, whole: D, grain: usize, work: &(impl Fn(D) + Sync)) {
        self.share(whole, grain, work, &|(), ()| ());
    }

    fn cut<D: Divide, R: Send>(
        &self,
        whole: D,
        grain: usize,
        pieces: usize,
        work: &(impl Fn(D) -> R + Sync),
        combine: &(impl Fn(R, R) -> R + Sync),
    ) -> R {
        if pieces <= 1 {
            return work(whole);
        }
        let first = pieces / 2;
        let grains = whole.length().div_ceil(grain);
        let (left, right) = whole.divide(grains * first / pieces * grain);
        let (left, right) = join(
            || self.cut(left, grain, first, work, combine),
            || self.cut(right, grain, pieces - first, work, combine),
        );
        combine(left, right)
    }
}

#[cfg(feature = "threads")]
fn join<A: Send, B: Send>(left: impl FnOnce() -> A + Send, right: impl FnOnce() -> B + Send) -> (A, B) {
    rayon::join(left, right)
}

#[cfg(not(feature = "threads"))]
fn join<A, B>(left: impl FnOnce() -> A, right: impl FnOnce() -> B) -> (A, B) {
    (left(), right())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn every_place_is_worked_on_once_and_in_order(count in 0usize..3000, grain in 1usize..700, threads in 1usize..9) {
            let team = Team::new(threads).unwrap();
            let mut seen = vec![0u32; count];
            let ranges = team.enter(|| team.share(
                (&mut seen[..], 0..count),
                grain,
                &|(seen, range)| {
                    seen.iter_mut().for_each(|times| *times += 1);
                    vec![range]
                },
                &|mut left, mut right| {
                    left.append(&mut right);
                    left
                },
            ));
            prop_assert!(seen.iter().all(|&times| times == 1));
            prop_assert!(ranges.len() <= team.pieces());
            let mut at = 0;
            for range in ranges {
                prop_assert_eq!(range.start, at);
                prop_assert!(range.start % grain == 0);
                at = range.end;
            }
            prop_assert_eq!(at, count);
        }
    }

    #[test]
    fn no_threads_and_too_many_are_refused() {
        for threads in [0, MOST_THREADS + 1] {
            let Err(Error::Model(message)) = Team::new(threads) else {
                panic!("{threads} threads")
            };
            assert!(message.contains(&threads.to_string()) && message.contains("256"));
        }
    }
}
