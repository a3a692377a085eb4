//! Every pair. Nothing to go wrong: the judge of the other broadphases, and the fastest for a handful of balls.

use super::{Broadphase, Discs, Found, Pair, Part};
use crate::{Team, Vec2};

#[derive(Default)]
pub(super) struct Brute {
    discs: Vec<(Vec2, f64)>,
}

impl Broadphase for Brute {
    fn build(&mut self, discs: &Discs<'_>, _team: &Team) {
        self.discs.clear();
        self.discs.extend(
            discs
                .center
                .iter()
                .enumerate()
                .map(|(i, &center)| (center, discs.reach.of(i))),
        );
    }

    fn pairs_of(&self, discs: &Discs<'_>, part: Part, found: &mut Vec<Pair>) {
        if part.number > 0 {
            return;
        }
        for second in 1..discs.len() {
            for first in 0..second {
                if discs.overlap(first, second) {
                    found.push((first as u32, second as u32));
                }
            }
        }
    }

    fn pairs(&self, discs: &Discs<'_>, team: &Team, found: &mut Found) {
        // Among ten balls it costs a twentieth of a tick to share what cannot be cut.
        let whole = Part { number: 0, of: 1 };
        self.pairs_of(discs, whole, &mut found.begin(team)[0]);
    }

    fn relocate(&mut self, index: usize, center: Vec2, reach: f64) {
        self.discs[index] = (center, reach);
    }

    fn query(&self, center: Vec2, reach: f64, found: &mut Vec<u32>) {
        for (index, &(other, far)) in self.discs.iter().enumerate() {
            let sum = reach + far;
            if (center - other).square() <= sum * sum * (1.0 + 1e-9) {
                found.push(index as u32);
            }
        }
    }

    fn nodes(&self) -> Vec<[f64; 4]> {
        Vec::new()
    }
}
