//! Fixed pieces of work whose instructions are counted: `instructions CASE` under callgrind, `instructions` names the cases.
//!
//! Only what runs inside [`counted`] counts; see `.ci/instructions.py`.

use std::hint::black_box;

use kuglice_step::{Input, InputKind, Model, NO_BALL, NewBall, Rules, Vec2, World, random};

/// What a case prepares and then has counted.
type Case = fn();

const CASES: [(&str, Case); 12] = [
    ("overlap", || {
        ticks(world(3000, "overlap", "loose_quadtree", &EQUAL), 10)
    }),
    ("overlap, mixed radii", || {
        ticks(world(3000, "overlap", "loose_quadtree", &MIXED), 10);
    }),
    ("backtrack, a player among small balls", || {
        ticks(played(3000), 10);
    }),
    ("overlap, quadtree", || {
        ticks(world(1000, "overlap", "quadtree", &EQUAL), 10)
    }),
    ("overlap, brute", || {
        ticks(world(100, "overlap", "brute", &EQUAL), 20)
    }),
    ("overlap, 10 balls", || {
        ticks(world(10, "overlap", "brute", &EQUAL), 200)
    }),
    ("backtrack", || {
        ticks(world(3000, "backtrack", "loose_quadtree", &EQUAL), 10)
    }),
    ("event", || {
        ticks(world(3000, "event", "loose_quadtree", &EQUAL), 10)
    }),
    ("event, mixed radii under gravity", || {
        ticks(world(3000, "event", "loose_quadtree", &FALLING), 10);
    }),
    ("state hash", || {
        let world = arranged();
        counted(|| _ = black_box(world.state_hash()));
    }),
    ("snapshot", || {
        let world = arranged();
        let mut bytes = vec![0; world.saving().len()];
        counted(|| world.saving().write_to(black_box(&mut bytes)));
    }),
    ("restore", || {
        let world = arranged();
        let bytes = world.snapshot();
        counted(|| {
            _ = black_box(World::restore(
                world.rules().clone(),
                world.model().clone(),
                &bytes,
            ))
        });
    }),
];

struct Gas {
    least_radius: f64,
    gravity: bool,
}

const EQUAL: Gas = Gas {
    least_radius: 0.5,
    gravity: false,
};
const MIXED: Gas = Gas {
    least_radius: 0.05,
    gravity: false,
};
const FALLING: Gas = Gas {
    least_radius: 0.05,
    gravity: true,
};

/// Never inlined: callgrind begins to count where it is entered, and ends where it is left.
#[inline(never)]
fn counted(work: impl FnOnce()) {
    work();
}

fn ticks(mut world: World, ticks: u32) {
    let mut run = |ticks| (0..ticks).for_each(|_| world.step(&[], None).expect("a gas never fails"));
    // Scratch memory grows in the first ticks.
    run(5);
    counted(|| run(ticks));
}

/// A world whose balls stand in spatial order, as they do in all large worlds.
fn arranged() -> World {
    let mut world = world(5000, "overlap", "loose_quadtree", &EQUAL);
    world.step(&[], None).expect("a gas never fails");
    world
}

/// Balls with weight, and among them one twelve times as wide that a client thrusts.
fn played(count: u32) -> World {
    const HEAVY: Gas = Gas {
        least_radius: 0.5,
        gravity: true,
    };
    let mut world = world(count, "backtrack", "loose_quadtree", &HEAVY);
    let input = |kind, sequence, numbers| Input {
        kind,
        client: 1,
        sequence,
        ball: NO_BALL,
        numbers,
    };
    let inputs = [
        input(InputKind::Join, 1, [20.0, 20.0, 6.0, 144.0, 0.0, 0.0]),
        input(InputKind::Thrust, 2, [400.0, -300.0, 0.0, 0.0, 0.0, 0.0]),
    ];
    world.step(&inputs, None).expect("the inputs are sound");
    world
}

/// A gas at packing 0.3, or less where radii are mixed.
fn world(count: u32, contacts: &str, broadphase: &str, gas: &Gas) -> World {
    let columns = f64::from(count).sqrt().ceil();
    let pitch = 0.5 * (std::f64::consts::PI / 0.3).sqrt();
    let balls: Vec<NewBall> = (0..count)
        .map(|i| {
            let (row, column) = ((f64::from(i) / columns).floor(), f64::from(i) % columns);
            let number = |stream| random::uniform(1, stream, u64::from(i));
            let radius = gas.least_radius + (0.5 - gas.least_radius) * number(2);
            NewBall {
                position: Vec2::new((column + 0.5) * pitch, (row + 0.5) * pitch),
                velocity: Vec2::new(12.0 * number(0) - 6.0, 12.0 * number(1) - 6.0),
                radius,
                mass: radius * radius,
            }
        })
        .collect();
    let forces: &[(&str, &[f64])] = if gas.gravity {
        &[("gravity", &[0.0, -10.0]), ("thrust", &[])]
    } else {
        &[]
    };
    let side = columns * pitch;
    let rules = Rules::new([0.0, 0.0, side, side], true, 1.0, 60.0, forces).expect("the rules are sound");
    let model = Model::new("verlet", contacts, broadphase, 1, None).expect("the model is registered");
    World::new(rules, model, &balls).expect("the balls are sound")
}

fn main() -> Result<(), String> {
    let Some(wanted) = std::env::args().nth(1) else {
        CASES.iter().for_each(|(name, _)| println!("{name}"));
        return Ok(());
    };
    let case = CASES.iter().find(|(name, _)| *name == wanted);
    let (_, run) = case.ok_or_else(|| format!("there is no case {wanted:?}"))?;
    run();
    Ok(())
}
