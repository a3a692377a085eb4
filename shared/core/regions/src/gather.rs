//! Which balls lie in the nodes that somebody looks at: one pass over all balls, whatever their number of nodes.

use kuglice_step::Balls;

use crate::Grid;

/// Scratch memory of the pass.
#[derive(Debug, Default)]
pub struct Gatherer {
    /// By cell: 0, or one more than the place of its node among the wanted.
    place: Vec<u32>,
    /// Place and index of balls in wanted nodes.
    hits: Vec<(u32, u32)>,
    /// Indices of balls, node after node.
    found: Vec<u32>,
    ends: Vec<usize>,
}

/// Balls by node.
#[derive(Debug)]
pub struct Gathered<'a> {
    found: &'a [u32],
    ends: &'a [usize],
}

impl Gathered<'_> {
    /// Indices of the balls in the wanted node of that place, in order of their ids.
    #[must_use]
    pub fn node(&self, place: usize) -> &[u32] {
        let begin = if place == 0 { 0 } else { self.ends[place - 1] };
        &self.found[begin..self.ends[place]]
    }
}

impl Gatherer {
    /// Finds the balls in each of the wanted nodes. Nodes that the grid does not have stay empty.
    pub fn gather(&mut self, grid: &Grid, balls: &Balls, wanted: &[u32]) -> Gathered<'_> {
        self.place.clear();
        self.place.resize(grid.nodes(), 0);
        for (place, &node) in (1..).zip(wanted) {
            if (node as usize) < grid.nodes() {
                self.place[grid.cell_of(node)] = place;
            }
        }
        self.hits.clear();
        for (index, &position) in (0..).zip(&balls.position) {
            let place = self.place[grid.cell(position)];
            if place != 0 {
                self.hits.push((place - 1, index));
            }
        }
        self.ends.clear();
        self.ends.resize(wanted.len(), 0);
        for &(place, _) in &self.hits {
            self.ends[place as usize] += 1;
        }
        let mut next = 0;
        for end in &mut self.ends {
            next += std::mem::replace(end, next);
        }
        self.found.clear();
        self.found.resize(self.hits.len(), 0);
        for &(place, index) in &self.hits {
            let at = &mut self.ends[place as usize];
            self.found[*at] = index;
            *at += 1;
        }
        let mut begin = 0;
        for &end in &self.ends {
            if !balls.is_by_id() {
                self.found[begin..end].sort_unstable_by_key(|&index| balls.id[index as usize]);
            }
            begin = end;
        }
        Gathered {
            found: &self.found,
            ends: &self.ends,
        }
    }
}
