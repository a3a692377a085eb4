//! Resting contacts of a substep: which forces they bear, so that nothing is pressed into anything.
//!
//! A force at each contact, never pulling, just large enough that the relative acceleration along the normal is not
//! into the contact; where balls lean on several others the contacts take turns until nothing changes that counts
//! (projected Gauss-Seidel). A ball that is struck loses its resting contacts; those that still hold are found again.

use crate::{Balls, Vec2};

/// Sweeps over all contacts after which the forces are taken as they are.
const MOST_SWEEPS: u32 = 1000;
/// The part of an acceleration below which a change is rounding.
const ROUNDING: f64 = 1e-14;

/// A contact that bears.
#[derive(Clone, Copy, Debug)]
pub(super) struct Support {
    pub(super) first: usize,
    /// None: a wall.
    pub(super) second: Option<usize>,
    /// The unit normal, from the first ball to the second or into the wall.
    pub(super) along: Vec2,
    force: f64,
}

impl Support {
    pub(super) fn new(first: usize, second: Option<usize>, along: Vec2) -> Support {
        Support {
            first,
            second,
            along,
            force: 0.0,
        }
    }

    fn involves(&self, index: usize) -> bool {
        self.first == index || self.second == Some(index)
    }

    fn is_same(&self, other: &Support) -> bool {
        self.first == other.first
            && self.second == other.second
            && (self.second.is_some() || self.along == other.along)
    }

    fn act(&self, balls: &Balls, accelerations: &mut [Vec2], force: f64) {
        accelerations[self.first] -= self.along * (force / balls.mass[self.first]);
        if let Some(second) = self.second {
            accelerations[second] += self.along * (force / balls.mass[second]);
        }
    }

    /// Corrects the force; returns how much acceleration that changed.
    fn relax(&mut self, balls: &Balls, accelerations: &mut [Vec2]) -> f64 {
        let (mut relative, mut yielding) = (accelerations[self.first], 1.0 / balls.mass[self.first]);
        if let Some(second) = self.second {
            relative -= accelerations[second];
            yielding += 1.0 / balls.mass[second];
        }
        let force = (self.force + relative.dot(self.along) / yielding).max(0.0);
        let change = force - self.force;
        self.force = force;
        self.act(balls, accelerations, change);
        change.abs() * yielding
    }
}

/// The resting contacts so far.
#[derive(Default)]
pub(super) struct Supports {
    all: Vec<Support>,
    /// Sweeps in this substep: they are work like events, and count with them.
    sweeps: u64,
}

impl Supports {
    pub(super) fn clear(&mut self) {
        self.all.clear();
        self.sweeps = 0;
    }

    pub(super) fn sweeps(&self) -> u64 {
        self.sweeps
    }

    pub(super) fn involve(&self, index: usize) -> bool {
        self.all.iter().any(|support| support.involves(index))
    }

    /// Whether this contact bears already: then only rounding can press it, until one of its balls is struck.
    pub(super) fn hold(&self, support: &Support) -> bool {
        self.all.iter().any(|other| other.is_same(support))
    }

    /// Appends every ball that has a contact, once.
    pub(super) fn balls(&self, found: &mut Vec<usize>) {
        for support in &self.all {
            for index in std::iter::once(support.first).chain(support.second) {
                if !found.contains(&index) {
                    found.push(index);
                }
            }
        }
    }

    pub(super) fn drop_of(&mut self, index: usize) {
        self.all.retain(|support| !support.involves(index));
    }

    pub(super) fn add(&mut self, support: Support) {
        self.all.retain(|other| !other.is_same(&support));
        self.all.push(support);
    }

    /// Takes what the contacts bear from accelerations that know of none.
    pub(super) fn solve(&mut self, balls: &Balls, accelerations: &mut [Vec2]) {
        let whole = self.all.iter().fold(0.0, |most: f64, support| {
            most.max(accelerations[support.first].length())
        });
        for support in &self.all {
            support.act(balls, accelerations, support.force);
        }
        for _ in 0..MOST_SWEEPS {
            self.sweeps += 1;
            let mut change: f64 = 0.0;
            for support in &mut self.all {
                change = change.max(support.relax(balls, accelerations));
            }
            if change <= ROUNDING * whole {
                return;
            }
        }
    }
}
