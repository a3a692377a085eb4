//! Broadphases: which discs may overlap. How the pairs are found changes the cost, never what comes of it: pairs that
//! only come near may be among them, and whoever asked looks again at the two balls, which he needs anyway.
//!
//! Discs are what balls are to a broadphase: for `overlap` contacts the balls themselves, for `event` contacts
//! whatever bounds a ball's path over a tick. One file each, one trait, one table; [`brute`](self) is the judge of all.

mod brute;
mod cell_order;
mod discs;
mod found;
mod lanes;
mod level;
mod levels;
mod loose_quadtree;
mod places;
mod quadtree;
mod rectangle;
mod relocated;
mod runs;
mod sorted;

pub use discs::{Discs, Reach};
pub use found::{Found, Part};

use crate::{Team, Vec2};

/// Indices of two discs, the lower first.
pub type Pair = (u32, u32);

/// A way to find overlapping discs.
///
/// Whatever an implementation keeps from one tick to the next may only make it faster: [`Broadphase::build`] must
/// leave it as if it were new.
pub trait Broadphase: Send + Sync {
    /// Takes in these discs in place of all earlier ones.
    fn build(&mut self, discs: &Discs<'_>, team: &Team);

    /// Appends the pairs of a part of the search. All parts together find at least every pair of discs that overlap, each
    /// once, in any order. The discs are those of the last build.
    fn pairs_of(&self, discs: &Discs<'_>, part: Part, found: &mut Vec<Pair>);

    /// Between these heights, at least, lie the centres of the discs that a part finds.
    fn heights(&self, part: Part) -> (f64, f64) {
        if part.number == 0 {
            (f64::NEG_INFINITY, f64::INFINITY)
        } else {
            Part::NOWHERE
        }
    }

    /// Finds the pairs of all parts.
    fn pairs(&self, discs: &Discs<'_>, team: &Team, found: &mut Found) {
        let lists = found.begin(team);
        let of = lists.len();
        team.each((lists, 0..of), 1, &|(lists, numbers)| {
            for (list, number) in lists.iter_mut().zip(numbers) {
                self.pairs_of(discs, Part { number, of }, list);
            }
        });
    }

    /// Puts disc `index` elsewhere, with another reach.
    fn relocate(&mut self, index: usize, center: Vec2, reach: f64);

    /// Appends at least every disc that overlaps the one given, each once, in any order.
    fn query(&self, center: Vec2, reach: f64, found: &mut Vec<u32>);

    /// The indices of the discs of the last build, neighbours near each other; None if it knows no such order.
    fn order(&self) -> Option<&[u32]> {
        None
    }

    /// Rectangles (left, bottom, right, top) of the occupied nodes.
    fn nodes(&self) -> Vec<[f64; 4]>;
}

/// What a broadphase may be told about the world.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// The box: left, bottom, right, top.
    pub root: [f64; 4],
    /// The smallest node of `quadtree`; None: twice the largest diameter.
    pub smallest_node: Option<f64>,
}

/// A registered broadphase.
pub struct Kind {
    /// Its name.
    pub name: &'static str,
    /// Makes one.
    pub make: fn(&Settings) -> Box<dyn Broadphase>,
}

/// All broadphases.
pub static TABLE: [Kind; 3] = [
    Kind {
        name: "brute",
        make: |_| Box::new(brute::Brute::default()),
    },
    Kind {
        name: "quadtree",
        make: |settings| Box::new(quadtree::Quadtree::new(settings)),
    },
    Kind {
        name: "loose_quadtree",
        make: |settings| Box::new(loose_quadtree::LooseQuadtree::new(settings)),
    },
];

/// How much further than its reach a disc is looked for, so that rounding in a tree's own bounds can lose no pair.
fn slack(center: Vec2, reach: f64) -> f64 {
    reach * 1e-9 + (center.x.abs() + center.y.abs()) * (4.0 * f64::EPSILON)
}
