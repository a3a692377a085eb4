//! One suite for all broadphases; brute force is the judge.

use kuglice_step::broadphase::{Broadphase, Discs, Found, Pair, Reach, Settings, TABLE};
use kuglice_step::{Team, Vec2};
use proptest::prelude::*;

#[derive(Clone, Debug)]
struct Scene {
    center: Vec<Vec2>,
    reach: Vec<f64>,
}

const BOX: [f64; 4] = [0.0, 0.0, 16.0, 8.0];

fn settings() -> Settings {
    Settings {
        root: BOX,
        smallest_node: None,
    }
}

fn pairs_of(broadphase: &mut dyn Broadphase, scene: &Scene) -> Vec<Pair> {
    let reach = Reach::Each(&scene.reach);
    pairs_among(broadphase, &scene.center, reach, &Team::default())
}

fn pairs_among(broadphase: &mut dyn Broadphase, center: &[Vec2], reach: Reach<'_>, team: &Team) -> Vec<Pair> {
    let discs = Discs { center, reach };
    let mut found = Found::default();
    broadphase.build(&discs, team);
    broadphase.pairs(&discs, team, &mut found);
    found.keep_overlapping(&discs, team);
    let mut pairs: Vec<_> = found.iter().collect();
    pairs.sort_unstable();
    pairs
}

fn judge(scene: &Scene) -> Vec<Pair> {
    let mut pairs = Vec::new();
    for j in 0..scene.center.len() as u32 {
        for i in 0..j {
            let (a, b) = (i as usize, j as usize);
            let sum = scene.reach[a] + scene.reach[b];
            if (scene.center[a] - scene.center[b]).square() < sum * sum {
                pairs.push((i, j));
            }
        }
    }
    pairs.sort_unstable();
    pairs
}

/// Coordinates that trees stumble over: split lines, corners, outside, signed zeros, subnormals.
fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => -1.0..17.0f64,
        2 => prop::sample::select(vec![0.0, -0.0, 2.0, 4.0, 8.0, 16.0, 1.0, 0.5, f64::MIN_POSITIVE / 8.0]),
        1 => -1e3..1e3f64,
        1 => prop::sample::select(vec![1e9, -1e9, 1e-300]),
    ]
}

fn reach() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => Just(0.5),
        2 => 0.1..2.0f64,
        1 => prop::sample::select(vec![0.01, 10.0, 1e-9, 1e3]),
    ]
}

fn scene() -> impl Strategy<Value = Scene> {
    prop::collection::vec(((coordinate(), coordinate()), reach()), 0..60).prop_map(|discs| Scene {
        center: discs.iter().map(|&((x, y), _)| Vec2::new(x, y)).collect(),
        reach: discs.iter().map(|&(_, reach)| reach).collect(),
    })
}

/// All in one node: a crowd far smaller than any cell wants to be.
fn crowd() -> impl Strategy<Value = Scene> {
    prop::collection::vec((0.0..1e-3f64, 0.0..1e-3f64), 0..60).prop_map(|places| Scene {
        center: places.iter().map(|&(x, y)| Vec2::new(3.0 + x, 5.0 + y)).collect(),
        reach: vec![1e-4; places.len()],
    })
}

proptest! {
    #[test]
    fn all_find_the_same_pairs(scene in prop_oneof![scene(), crowd()]) {
        let expected = judge(&scene);
        for kind in &TABLE {
            prop_assert_eq!(&pairs_of(&mut *(kind.make)(&settings()), &scene), &expected, "{}", kind.name);
        }
    }

    #[test]
    fn what_was_built_before_does_not_matter(scenes in prop::collection::vec(scene(), 2..5)) {
        for kind in &TABLE {
            let mut kept = (kind.make)(&settings());
            for scene in &scenes {
                prop_assert_eq!(pairs_of(&mut *kept, scene), judge(scene), "{}", kind.name);
            }
        }
    }

    #[test]
    fn equal_discs_need_no_array(scene in scene()) {
        let same = Scene { reach: vec![0.5; scene.center.len()], ..scene };
        for kind in &TABLE {
            let mut broadphase = (kind.make)(&settings());
            let found = pairs_among(&mut *broadphase, &same.center, Reach::Same(0.5), &Team::default());
            prop_assert_eq!(found, judge(&same), "{}", kind.name);
        }
    }

    #[test]
    fn any_number_of_threads_finds_them(scene in scene(), threads in 2usize..9) {
        let team = Team::new(threads).unwrap();
        for kind in &TABLE {
            let mut broadphase = (kind.make)(&settings());
            let found = pairs_among(&mut *broadphase, &scene.center, Reach::Each(&scene.reach), &team);
            prop_assert_eq!(found, judge(&scene), "{}", kind.name);
        }
    }

    #[test]
    fn queries_find_all_that_overlap_after_any_relocation(
        scene in scene(),
        moves in prop::collection::vec((any::<prop::sample::Index>(), (coordinate(), coordinate()), reach()), 0..30),
    ) {
        prop_assume!(!scene.center.is_empty());
        for kind in &TABLE {
            let mut broadphase = (kind.make)(&settings());
            pairs_of(&mut *broadphase, &scene);
            let mut moved = scene.clone();
            for &(index, (x, y), reach) in &moves {
                let index = index.index(moved.center.len());
                moved.center[index] = Vec2::new(x, y);
                moved.reach[index] = reach;
                broadphase.relocate(index, moved.center[index], reach);
                let mut found = Vec::new();
                broadphase.query(moved.center[index], reach, &mut found);
                found.sort_unstable();
                let unique = found.windows(2).all(|pair| pair[0] < pair[1]);
                prop_assert!(unique, "{} finds a disc twice", kind.name);
                for other in 0..moved.center.len() {
                    let sum = moved.reach[other] + reach;
                    if (moved.center[other] - moved.center[index]).square() < sum * sum {
                        prop_assert!(found.contains(&(other as u32)), "{} misses {}", kind.name, other);
                    }
                }
            }
        }
    }
}

#[test]
fn radii_may_differ_a_thousandfold() {
    let mut scene = Scene {
        center: vec![Vec2::new(8.0, 4.0)],
        reach: vec![10.0],
    };
    for i in 0..400 {
        let (column, row) = (f64::from(i % 20), f64::from(i / 20));
        scene.center.push(Vec2::new(column * 0.8, row * 0.4));
        scene.reach.push(0.01 + 0.02 * f64::from(i % 7));
    }
    for kind in &TABLE {
        assert_eq!(
            pairs_of(&mut *(kind.make)(&settings()), &scene),
            judge(&scene),
            "{}",
            kind.name
        );
    }
}
