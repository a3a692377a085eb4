//! The levels of the loose quadtree, each with cells twice as wide as those of the level before: how many there are, and
//! how wide the finest cells, comes of the discs.

use super::lanes::LANES;
use super::level::{Level, MARGIN, MOST_CELLS};
use super::{Discs, Reach};
use crate::Vec2;

/// Cells per disc, at the most: more than balls at any packing that collide often can use.
const CELLS_PER_DISC: f64 = 6.0;
const MOST_LEVELS: usize = 16;
/// Cells that need be no more than so many times as wide to hold all discs are made as wide as that.
const NEARLY: f64 = 1.5;
/// Of so many discs one, or fewer, may be too wide for the finest cells without being counted among those that differ.
const FEW: usize = 16;

/// All levels, the finest first.
#[derive(Debug, Default)]
pub(super) struct Levels {
    all: Vec<Level>,
}

impl Levels {
    pub(super) fn all(&self) -> &[Level] {
        &self.all
    }

    /// The finest one.
    pub(super) fn finest(&self) -> &Level {
        &self.all[0]
    }

    /// Counts the discs of each level, given where those of each cell begin.
    pub(super) fn populate(&mut self, offsets: &[u32]) {
        for level in &mut self.all {
            level.population = offsets[level.end()] - offsets[level.first];
        }
    }

    /// How many cells there are, borders included.
    pub(super) fn cells(&self) -> usize {
        self.all.last().map_or(0, Level::end)
    }

    /// The finest level that takes discs of that reach, if one does.
    #[inline]
    pub(super) fn find_mut(&mut self, reach: f64) -> Option<&mut Level> {
        self.all.iter_mut().find(|level| level.takes(reach))
    }

    /// The same for a disc of the layout, which always has one.
    #[inline]
    pub(super) fn of(&self, reach: f64) -> &Level {
        let found = self.all.iter().find(|level| level.takes(reach));
        found.unwrap_or(&self.all[self.all.len() - 1])
    }

    /// Lays the levels out for these discs: over the root, or over the discs alone if they fill little of it.
    pub(super) fn lay_out(&mut self, discs: &Discs<'_>, root: [f64; 4]) {
        self.all.clear();
        let Reaches { finest, most, wider } = Reaches::of(discs);
        let most_cells = CELLS_PER_DISC * discs.len() as f64 + 16.0;
        let [left, bottom, right, top] = root;
        let mut origin = Vec2::new(left, bottom);
        let mut extent = Vec2::new(right - left, top - bottom);
        let mut wanted = 2.0 * finest * MARGIN;
        if extent.x * extent.y > wanted * wanted * most_cells || extent.x.max(extent.y) > wanted * most_cells
        {
            (origin, extent) = bounds(discs);
        }
        if wider * FEW > discs.len() {
            // Each level is one more place to look: where a cell of the next one would hold a disc or so, start there.
            // Not for the sake of a few, like players among what they play with: they look, and the others do not.
            wanted = wanted.max((extent.x * extent.y / discs.len() as f64).sqrt());
            let widest = 2.0 * most * MARGIN;
            if wanted * NEARLY >= widest {
                wanted = widest;
            }
        }
        let longest = extent.x.max(extent.y);
        let mut size = wanted
            .max((extent.x * extent.y / most_cells).sqrt())
            .max(longest / most_cells)
            .max(longest / MOST_CELLS)
            .max(f64::MIN_POSITIVE);
        loop {
            if self.all.len() + 1 == MOST_LEVELS {
                size = size.max(2.0 * most * MARGIN);
            }
            let level = Level::new(origin, extent, size, self.cells());
            self.all.push(level);
            if level.takes(most) || self.all.len() == MOST_LEVELS {
                return;
            }
            size *= 2.0;
        }
    }
}

/// What the reaches of the discs ask of the levels.
struct Reaches {
    /// The reach that the finest level is made for.
    finest: f64,
    most: f64,
    /// How many are wider than that level's.
    wider: usize,
}

impl Reaches {
    /// Discs that differ little share the finest level: it takes up to a quarter more than the mean, but at the most
    /// twice the least.
    fn of(discs: &Discs<'_>) -> Reaches {
        match discs.reach {
            Reach::Same(reach) => Reaches {
                finest: reach,
                most: reach,
                wider: 0,
            },
            Reach::Each([]) => Reaches {
                finest: 1.0,
                most: 1.0,
                wider: 0,
            },
            Reach::Each(all) => {
                let (mut least, mut most, mut sum) = ([f64::INFINITY; LANES], [0.0; LANES], [0.0; LANES]);
                let (fours, rest) = all.as_chunks::<LANES>();
                for four in fours {
                    for lane in 0..LANES {
                        least[lane] = if four[lane] < least[lane] {
                            four[lane]
                        } else {
                            least[lane]
                        };
                        most[lane] = if four[lane] > most[lane] {
                            four[lane]
                        } else {
                            most[lane]
                        };
                        sum[lane] += four[lane];
                    }
                }
                let least = least
                    .iter()
                    .chain(rest)
                    .fold(f64::INFINITY, |least, &reach| reach.min(least));
                let most = most
                    .iter()
                    .chain(rest)
                    .fold(0.0, |most: f64, &reach| reach.max(most));
                let mean = sum.iter().chain(rest).sum::<f64>() / all.len() as f64;
                let finest = (1.25 * mean).min(2.0 * least).min(most);
                Reaches {
                    finest,
                    most,
                    wider: all.iter().filter(|&&reach| reach > finest).count(),
                }
            }
        }
    }
}

/// Origin and extent of the centres.
fn bounds(discs: &Discs<'_>) -> (Vec2, Vec2) {
    let Some(&start) = discs.center.first() else {
        return (Vec2::ZERO, Vec2::ZERO);
    };
    let (low, high) = discs.center.iter().fold((start, start), |(low, high), center| {
        (
            Vec2::new(low.x.min(center.x), low.y.min(center.y)),
            Vec2::new(high.x.max(center.x), high.y.max(center.y)),
        )
    });
    (low, high - low)
}

#[cfg(test)]
mod tests;
