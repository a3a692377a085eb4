//! Every fast path against brute force on one thread, on states made to break it.

use kuglice_step::{Error, Model, NewBall, Rules, Team, Vec2, World};
use proptest::prelude::*;

const BOX: [f64; 4] = [0.0, 0.0, 16.0, 8.0];
const TICKS: u32 = 4;
const THREADS: [usize; 4] = [1, 2, 3, 8];

fn ball(position: (f64, f64), velocity: (f64, f64), radius: f64) -> NewBall {
    NewBall {
        position: Vec2::new(position.0, position.1),
        velocity: Vec2::new(velocity.0, velocity.1),
        radius,
        mass: if radius == 0.75 {
            f64::INFINITY
        } else {
            1.0 + radius
        },
    }
}

/// In and around the box, on lines that split it, at both zeros, among the subnormals, far outside.
fn coordinate() -> impl Strategy<Value = f64> {
    let lines = vec![
        0.0,
        -0.0,
        0.5,
        1.0,
        2.0,
        4.0,
        8.0,
        16.0,
        5e-324,
        -5e-324,
        f64::MIN_POSITIVE / 8.0,
    ];
    prop_oneof![
        4 => -1.0..17.0f64,
        3 => prop::sample::select(lines),
        1 => prop::sample::select(vec![-40.0, 300.0, 1e6]),
    ]
}

fn velocity() -> impl Strategy<Value = (f64, f64)> {
    let one = || prop_oneof![3 => -20.0..20.0f64, 1 => prop::sample::select(vec![0.0, -0.0, 5e-324, 600.0])];
    (one(), one())
}

fn radius() -> impl Strategy<Value = f64> {
    prop_oneof![3 => Just(0.3), 2 => 0.05..0.5f64, 1 => prop::sample::select(vec![0.01, 10.0, 1e-9, 0.75])]
}

fn scattered() -> impl Strategy<Value = Vec<NewBall>> {
    let one = ((coordinate(), coordinate()), velocity(), radius());
    prop::collection::vec(one.prop_map(|(p, v, r)| ball(p, v, r)), 0..40)
}

/// All in one node: far nearer to each other than any cell is wide.
fn crowd() -> impl Strategy<Value = Vec<NewBall>> {
    let one = ((0.0..1e-3f64, 0.0..1e-3f64), velocity());
    prop::collection::vec(
        one.prop_map(|((x, y), v)| ball((3.0 + x, 5.0 + y), v, 1e-4)),
        0..40,
    )
}

/// Centres that coincide, of equal and of other balls.
fn coincident() -> impl Strategy<Value = Vec<NewBall>> {
    let place = prop::sample::select(vec![(4.0, 4.0), (8.0, 4.0), (0.0, -0.0)]);
    let one = (place, velocity(), prop::sample::select(vec![0.3, 0.2]));
    prop::collection::vec(one.prop_map(|(p, v, r)| ball(p, v, r)), 0..16)
}

/// A grid of equal balls that just touch, on the lines of the tree, all at the same moment.
fn lattice() -> impl Strategy<Value = Vec<NewBall>> {
    (1u32..9, 1u32..6, velocity()).prop_map(|(columns, rows, v)| {
        let places = (0..columns * rows).map(|i| (f64::from(i % columns), f64::from(i / columns)));
        places
            .enumerate()
            .map(|(i, p)| {
                ball(
                    (p.0 + 1.0, p.1 + 1.0),
                    if i % 2 == 0 { v } else { (-v.0, -v.1) },
                    0.5,
                )
            })
            .collect()
    })
}

/// A large ball in the midst of dust.
fn dust() -> impl Strategy<Value = Vec<NewBall>> {
    let speck = ((-4.0..20.0f64, -4.0..12.0f64), velocity());
    prop::collection::vec(speck.prop_map(|(p, v)| ball(p, v, 0.01)), 0..60).prop_map(|mut specks| {
        specks.push(ball((8.0, 4.0), (1.0, 0.0), 10.0));
        specks
    })
}

fn world(balls: &[NewBall], contacts: &str, broadphase: &str, falls: bool) -> World {
    let forces: &[(&str, &[f64])] = &[("gravity", &[0.0, -10.0])];
    let rules = Rules::new(BOX, true, 1.0, 60.0, if falls { forces } else { &[] }).unwrap();
    let model = Model::new("verlet", contacts, broadphase, 1, None).unwrap();
    World::new(rules, model, balls).unwrap()
}

/// The hash after each tick, up to the error that ends it.
fn run(mut world: World) -> Vec<Result<u64, String>> {
    let mut states = Vec::new();
    for _ in 0..TICKS {
        let done = world.step(&[], None).map_err(|error: Error| error.to_string());
        let failed = done.is_err();
        states.push(done.map(|()| world.state_hash()));
        if failed {
            break;
        }
    }
    states
}

/// For `event`, which takes every collision of a tick, however many: no crowd that starts overlapping, no ball between
/// whose walls there is no room, and none that is fixed, as another one may fly to and fro in a gap of nothing before it.
/// What it does with those is told in tests/stability.
fn apart(balls: &[NewBall]) -> Vec<NewBall> {
    let mut kept: Vec<NewBall> = Vec::new();
    for &ball in balls {
        let ball = NewBall {
            radius: ball.radius.min(3.0),
            mass: 1.0 + ball.radius,
            ..ball
        };
        let free = |other: &NewBall| {
            let sum = ball.radius + other.radius;
            (ball.position - other.position).square() >= sum * sum
        };
        if kept.iter().all(free) {
            kept.push(ball);
        }
    }
    kept
}

fn states() -> impl Strategy<Value = Vec<NewBall>> {
    prop_oneof![3 => scattered(), 1 => crowd(), 1 => coincident(), 1 => lattice(), 1 => dust()]
}

fn compare(balls: &[NewBall], contacts: &str, falls: bool) -> Result<(), TestCaseError> {
    let expected = run(world(balls, contacts, "brute", falls));
    for broadphase in ["brute", "quadtree", "loose_quadtree"] {
        for threads in THREADS {
            let mut other = world(balls, contacts, broadphase, falls);
            other.employ(Team::new(threads).unwrap());
            let found = run(other);
            prop_assert_eq!(
                &found,
                &expected,
                "{}, {}, {} threads",
                contacts,
                broadphase,
                threads
            );
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    #[test]
    fn no_path_gives_other_bits(
        balls in states(),
        contacts in prop::sample::select(vec!["overlap", "backtrack"]),
        falls in any::<bool>(),
    ) {
        compare(&balls, contacts, falls)?;
    }

    #[test]
    fn no_path_of_event_does(balls in states(), falls in any::<bool>()) {
        compare(&apart(&balls), "event", falls)?;
    }
}
