//! The judge is the stable sort of the standard library.

use super::*;
use crate::Vec2;
use crate::broadphase::levels::Levels;
use proptest::prelude::*;

/// Few cells with many discs, many with few, neighbours in memory or strewn: what blocks and pieces could stumble over.
fn cells() -> impl Strategy<Value = (usize, Vec<u32>)> {
    let strewn = (1usize..300).prop_flat_map(|cells| {
        let of = prop::collection::vec(0..cells as u32, 0..4000);
        (Just(cells), of)
    });
    let ascending = (1usize..5000, 0usize..5000).prop_map(|(cells, discs)| {
        let of = |disc: usize| (disc * cells / discs.max(1)) as u32;
        (cells, (0..discs).map(of).collect())
    });
    let one = (1usize..50, 0usize..4000).prop_map(|(cells, discs)| (cells, vec![cells as u32 - 1; discs]));
    prop_oneof![strewn, ascending, one]
}

/// In which cells coordinates of these discs are counted, and how they become f32.
fn layout(discs: &Discs<'_>) -> (Level, Scale) {
    let mut levels = Levels::default();
    levels.lay_out(discs, [0.0, 0.0, 5000.0, 500.0]);
    let finest = *levels.finest();
    (finest, finest.scale())
}

fn narrow(level: Level, center: Vec2) -> [f32; 2] {
    let across = level.across(center);
    [across.x as f32, across.y as f32]
}

/// As they are given to the sort.
fn coordinates(level: Level, discs: &Discs<'_>) -> Vec<[f32; 2]> {
    match discs.reach {
        Reach::Same(_) => discs.center.iter().map(|&center| narrow(level, center)).collect(),
        Reach::Each(_) => Vec::new(),
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn discs_come_cell_by_cell_and_in_index_order_within_one(
        (cells, of) in cells(),
        threads in prop::sample::select(vec![1usize, 2, 3, 8]),
        with_reach in any::<bool>(),
    ) {
        let team = Team::new(threads).unwrap();
        let center: Vec<Vec2> = (0..of.len()).map(|disc| Vec2::new(disc as f64, 0.1 * disc as f64)).collect();
        let each: Vec<f64> = (0..of.len()).map(|disc| 0.5 + disc as f64).collect();
        let reach = if with_reach { Reach::Each(&each) } else { Reach::Same(0.5) };
        let discs = Discs { center: &center, reach };
        let (finest, scale) = layout(&discs);
 let across = coordinates(finest, &discs);
        let spans: Vec<Span> = of.chunks(BLOCK).map(Span::of).collect();
        let input = Input {
            cells: &of,
            spans: &spans,
            across: &across,
            discs: &discs,
            finest,
            scale,
        };
        let (mut offsets, mut sorted) = (vec![7; 3], Sorted::default());
        CellOrder::default().sort(input, cells, &team, &mut offsets, &mut sorted);

        let mut expected: Vec<u32> = (0..of.len() as u32).collect();
        expected.sort_by_key(|&disc| of[disc as usize]);
        prop_assert_eq!(&sorted.index, &expected);
        prop_assert_eq!(offsets.len(), cells + 1);
        for cell in 0..=cells as u32 {
            let before = of.iter().filter(|&&other| other < cell).count();
            prop_assert_eq!(offsets[cell as usize] as usize, before, "cell {}", cell);
        }
        for (slot, &disc) in expected.iter().enumerate() {
            let disc = disc as usize;
            prop_assert_eq!(sorted.cell[slot], of[disc]);
            prop_assert_eq!([sorted.x[slot], sorted.y[slot]], narrow(finest, center[disc]));
            if with_reach {
                prop_assert_eq!(sorted.reach[slot], scale.probed(each[disc]));
            }
        }
    }
}

#[test]
fn what_was_sorted_before_does_not_matter() {
    let (mut order, mut offsets, mut sorted) = (CellOrder::default(), Vec::new(), Sorted::default());
    for (cells, of) in [
        (9, vec![8u32; 2000]),
        (3, vec![2, 0, 1, 0]),
        (1, vec![]),
        (5, vec![4, 4, 0]),
    ] {
        let center = vec![Vec2::ZERO; of.len()];
        let discs = Discs {
            center: &center,
            reach: Reach::Same(1.0),
        };
        let (finest, scale) = layout(&discs);
        let across = coordinates(finest, &discs);
        let input = Input {
            cells: &of,
            spans: &[Span::ALL; 2],
            across: &across,
            discs: &discs,
            finest,
            scale,
        };
        order.sort(input, cells, &Team::default(), &mut offsets, &mut sorted);
        let mut expected: Vec<u32> = (0..of.len() as u32).collect();
        expected.sort_by_key(|&disc| of[disc as usize]);
        assert_eq!(sorted.index, expected);
    }
}
