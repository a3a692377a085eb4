//! Wherever discs are, and however different, they fit their cells, and two that overlap are where they are looked for.

use super::*;
use proptest::prelude::*;

fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => -1.0..17.0f64,
        2 => prop::sample::select(vec![0.0, -0.0, 2.0, 4.0, 8.0, 16.0, f64::MIN_POSITIVE / 8.0, -5e-324]),
        1 => prop::sample::select(vec![1e9, -1e9, 1e150, -1e300]),
    ]
}

fn reach() -> impl Strategy<Value = f64> {
    prop_oneof![
        3 => 0.1..2.0f64,
        1 => prop::sample::select(vec![0.01, 10.0, 1e-9, 1e6, f64::MIN_POSITIVE, 5e-324, 1e200]),
    ]
}

fn discs() -> impl Strategy<Value = (Vec<Vec2>, Vec<f64>)> {
    prop::collection::vec(((coordinate(), coordinate()), reach()), 1..40).prop_map(|discs| {
        let center = discs.iter().map(|&((x, y), _)| Vec2::new(x, y)).collect();
        (center, discs.iter().map(|&(_, reach)| reach).collect())
    })
}

proptest! {
    #[test]
    fn two_that_overlap_are_where_they_are_looked_for((center, reach) in discs(), size in prop::sample::select(vec![1e-6, 1.0, 16.0, 1e6])) {
        let all = Discs { center: &center, reach: Reach::Each(&reach) };
        let mut levels = Levels::default();
        levels.lay_out(&all, [0.0, 0.0, size, 0.5 * size]);
        prop_assert!(levels.all().len() <= MOST_LEVELS);
        for (at, level) in levels.all().iter().enumerate() {
            let end = levels.all().get(at + 1).map_or(levels.cells(), |next| next.first);
            prop_assert_eq!(level.end(), end);
        }
        for first in 0..center.len() {
            let level = levels.of(reach[first]);
            let own = level.cell_at(center[first]) as usize;
            // The border: no cell without neighbours.
            prop_assert!(own > level.first && own + level.stride as usize + 1 < level.end());
            for other in 0..center.len() {
                if !all.overlap(first, other) {
                    continue;
                }
                let level = levels.of(reach[other]);
                let cell = level.cell_at(center[other]) as usize;
                let found = level.runs(center[first], reach[first]).filter(|run| run.contains(&cell)).count();
                prop_assert_eq!(found, 1, "disc {} looks for {} in cell {}", first, other, cell);
                if level.first == levels.of(reach[first]).first {
                    let apart = cell.abs_diff(own);
                    let rows = [0, level.stride as usize];
                    prop_assert!(rows.iter().any(|row| apart.abs_diff(*row) <= 1), "cells {} and {}", own, cell);
                }
            }
        }
    }

    #[test]
    fn there_are_never_many_more_cells_than_discs((center, reach) in discs()) {
        let all = Discs { center: &center, reach: Reach::Each(&reach) };
        let mut levels = Levels::default();
        levels.lay_out(&all, [0.0, 0.0, 1e9, 1e9]);
        prop_assert!(levels.cells() < 400 * (center.len() + 10), "{} cells for {} discs", levels.cells(), center.len());
    }
}

/// A player of twelve times their radius once made the cells of 10,000 balls so wide that a tick took twice as long.
#[test]
fn cells_are_as_fine_with_a_few_wide_discs_as_without() {
    let center: Vec<_> = (0..400)
        .map(|i| Vec2::new(f64::from(i % 20), f64::from(i / 20)))
        .collect();
    let mut reach = vec![0.1; center.len()];
    let finest = |reach: &[f64]| {
        let mut levels = Levels::default();
        let reach = Reach::Each(reach);
        levels.lay_out(
            &Discs {
                center: &center,
                reach,
            },
            [0.0, 0.0, 20.0, 20.0],
        );
        levels.finest().size()
    };
    let equal = finest(&reach);
    reach[7] = 1.2;
    reach[300] = 0.9;
    assert_eq!(finest(&reach), equal);
    // Half of them are another matter: every level that is occupied is one more place to look.
    reach[..200].fill(1.2);
    assert!(finest(&reach) > 2.0 * equal);
}
