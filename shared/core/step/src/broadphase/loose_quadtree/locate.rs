//! Finding the cells of discs.

use super::LooseQuadtree;
use crate::Team;
use crate::broadphase::places::{BLOCK, Places, Span};
use crate::broadphase::{Discs, Reach};

impl LooseQuadtree {
    /// Finds the cell of each disc, and its coordinates in cells of the finest level where they are kept.
    pub(super) fn locate(&mut self, discs: &Discs<'_>, team: &Team) {
        let count = discs.len();
        self.cells.resize(count, 0);
        self.spans.resize(count.div_ceil(BLOCK), Span::ALL);
        let each = matches!(discs.reach, Reach::Each(_));
        self.across.resize(if each { 0 } else { count }, [0.0; 2]);
        let levels = &self.levels;
        let finest = *levels.finest();
        let places = Places {
            cells: &mut self.cells,
            spans: &mut self.spans,
            across: &mut self.across,
        };
        let span = |cells: &[u32]| {
            if team.pieces() == 1 {
                Span::ALL
            } else {
                Span::of(cells)
            }
        };
        match discs.reach {
            Reach::Same(_) => team.each((places, discs.center), BLOCK, &|(places, centers)| {
                for ((cells, covered, narrow), centers) in places.blocks().zip(centers.chunks(BLOCK)) {
                    for ((cell, narrow), &center) in cells.iter_mut().zip(narrow).zip(centers) {
                        let across = finest.across(center);
                        *cell = finest.cell(across);
                        *narrow = [across.x as f32, across.y as f32];
                    }
                    *covered = span(cells);
                }
            }),
            Reach::Each(all) => {
                let whole = (places, discs.center, all);
                team.each(whole, BLOCK, &|(places, centers, all)| {
                    let discs = centers.chunks(BLOCK).zip(all.chunks(BLOCK));
                    for ((cells, covered, _), (centers, all)) in places.blocks().zip(discs) {
                        let discs = centers.iter().zip(all);
                        for (cell, (&center, &reach)) in cells.iter_mut().zip(discs) {
                            *cell = levels.of(reach).cell_at(center);
                        }
                        *covered = span(cells);
                    }
                });
            }
        }
    }
}
