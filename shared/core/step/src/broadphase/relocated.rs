//! Discs that were put elsewhere since the tree was built, in chains that begin at their new cells.

use std::ops::Range;

use crate::Vec2;

const NONE: u32 = u32::MAX;

struct Moved {
    center: Vec2,
    reach: f64,
    index: u32,
    cell: u32,
    next: u32,
}

/// An overlay on the sorted discs: empty, and free, while nothing has moved.
#[derive(Default)]
pub(super) struct Relocated {
    moved: Vec<Moved>,
    /// For each disc, where it stands among the moved ones.
    slots: Vec<u32>,
    /// For each cell, the first of its chain.
    heads: Vec<u32>,
    /// Discs wider than the widest cell.
    wide: Vec<u32>,
}

impl Relocated {
    pub(super) fn clear(&mut self) {
        // Undone one by one: most ticks move few discs, and the tables are long.
        for moved in self.moved.drain(..) {
            self.slots[moved.index as usize] = NONE;
            if moved.cell != NONE {
                self.heads[moved.cell as usize] = NONE;
            }
        }
        self.wide.clear();
    }

    /// Whether a disc is here rather than among the sorted ones.
    #[inline]
    pub(super) fn holds(&self, index: u32) -> bool {
        !self.moved.is_empty() && self.slots[index as usize] != NONE
    }

    /// Puts a disc into a cell, or into none if it is too wide for all; `discs` and `cells` are how many there are.
    pub(super) fn put(
        &mut self,
        index: usize,
        center: Vec2,
        reach: f64,
        cell: Option<u32>,
        discs: usize,
        cells: usize,
    ) {
        if self.moved.is_empty() {
            self.slots.resize(discs, NONE);
            self.heads.resize(cells, NONE);
        }
        let at = match self.slots[index] {
            NONE => {
                let at = self.moved.len() as u32;
                self.slots[index] = at;
                self.moved.push(Moved {
                    center,
                    reach,
                    index: index as u32,
                    cell: NONE,
                    next: NONE,
                });
                at
            }
            at => {
                self.unchain(at);
                at
            }
        };
        let moved = &mut self.moved[at as usize];
        moved.center = center;
        moved.reach = reach;
        moved.next = NONE;
        moved.cell = cell.unwrap_or(NONE);
        if let Some(cell) = cell {
            moved.next = self.heads[cell as usize];
            self.heads[cell as usize] = at;
        } else {
            self.wide.push(at);
        }
    }

    fn unchain(&mut self, at: u32) {
        let Moved { cell, next, .. } = self.moved[at as usize];
        if cell == NONE {
            self.wide.retain(|&other| other != at);
            return;
        }
        let mut link = self.heads[cell as usize];
        if link == at {
            self.heads[cell as usize] = next;
            return;
        }
        while link != NONE {
            let following = self.moved[link as usize].next;
            if following == at {
                self.moved[link as usize].next = next;
                return;
            }
            link = following;
        }
    }

    /// Shows all discs in these cells: index, centre, reach.
    #[inline]
    pub(super) fn in_cells(&self, cells: Range<usize>, mut show: impl FnMut(u32, Vec2, f64)) {
        if self.moved.is_empty() {
            return;
        }
        for &head in &self.heads[cells] {
            let mut at = head;
            while at != NONE {
                let moved = &self.moved[at as usize];
                show(moved.index, moved.center, moved.reach);
                at = moved.next;
            }
        }
    }

    /// Shows all discs that are too wide for a cell.
    pub(super) fn in_no_cell(&self, mut show: impl FnMut(u32, Vec2, f64)) {
        for &at in &self.wide {
            let moved = &self.moved[at as usize];
            show(moved.index, moved.center, moved.reach);
        }
    }
}
