//! Whether all numbers still are numbers.

use super::Balls;
use crate::Vec2;
use crate::team::{GRAIN, Team};

impl Balls {
    /// Id of the first ball whose position or velocity is not finite.
    #[must_use]
    pub fn first_not_finite(&self, team: &Team) -> Option<u64> {
        let chunks = (&self.position[..], &self.velocity[..]);
        let fine =
            |(positions, velocities): (&[Vec2], &[Vec2])| are_finite(positions) & are_finite(velocities);
        if team.share(chunks, GRAIN, &fine, &|left, right| left & right) {
            return None;
        }
        self.by_id()
            .find(|&i| !(self.position[i].is_finite() && self.velocity[i].is_finite()))
            .map(|i| self.id[i])
    }
}

/// Whether no number is infinite or NaN: 0 times such a one is NaN, and a sum with NaN is NaN.
pub(crate) fn are_finite(all: &[Vec2]) -> bool {
    let mut sums = [Vec2::ZERO; 4];
    let (fours, rest) = all.as_chunks::<4>();
    for four in fours {
        for (sum, &vector) in sums.iter_mut().zip(four) {
            *sum += vector * 0.0;
        }
    }
    let sum = rest
        .iter()
        .map(|&vector| vector * 0.0)
        .chain(sums)
        .fold(Vec2::ZERO, |a, b| a + b);
    sum.x == 0.0 && sum.y == 0.0
}
