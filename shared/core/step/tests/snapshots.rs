//! A snapshot restores a world bit for bit, and damaged bytes restore nothing.

use kuglice_step::{Error, Input, InputKind, Model, NO_BALL, NewBall, Rules, Vec2, World};
use proptest::prelude::*;

fn rules() -> Rules {
    let forces: &[(&str, &[f64])] = &[("gravity", &[0.0, -10.0]), ("thrust", &[]), ("attract", &[0.5])];
    Rules::new([0.0, 0.0, 20.0, 10.0], true, 1.0, 60.0, forces).unwrap()
}

fn model(contacts: &str) -> Model {
    Model::new("verlet", contacts, "loose_quadtree", 1, None).unwrap()
}

fn world(contacts: &str, count: u32) -> World {
    let balls: Vec<NewBall> = (0..count)
        .map(|i| NewBall {
            position: Vec2::new(1.0 + 1.5 * f64::from(i % 12), 1.0 + 1.5 * f64::from(i / 12)),
            velocity: Vec2::new(f64::from(i % 5) - 2.0, f64::from(i % 3)),
            radius: 0.4 + 0.02 * f64::from(i % 4),
            mass: if i == 7 {
                f64::INFINITY
            } else {
                1.0 + f64::from(i % 2)
            },
        })
        .collect();
    World::new(rules(), model(contacts), &balls).unwrap()
}

fn inputs(tick: u64) -> Vec<Input> {
    let input = |kind, client, ball, numbers| Input {
        kind,
        client,
        sequence: tick,
        ball,
        numbers,
    };
    match tick {
        1 => vec![input(
            InputKind::Join,
            3,
            NO_BALL,
            [10.0, 9.0, 0.3, 1.0, 0.0, 0.0],
        )],
        2 => vec![input(
            InputKind::Thrust,
            3,
            NO_BALL,
            [4.0, 20.0, 0.0, 0.0, 0.0, 0.0],
        )],
        5 => vec![
            input(InputKind::Attract, 3, NO_BALL, [5.0, 5.0, 30.0, 0.0, 0.0, 0.0]),
            input(InputKind::Spawn, 0, NO_BALL, [18.0, 9.0, -1.0, 0.0, 0.3, 2.0]),
        ],
        8 => vec![input(InputKind::Remove, 0, 4, [0.0; 6])],
        _ => vec![],
    }
}

fn run(world: &mut World, ticks: std::ops::Range<u64>) {
    for tick in ticks {
        world.step(&inputs(tick), None).unwrap();
    }
}

/// The snapshot, written to slots that hold `before`.
fn written_over(world: &World, before: u8) -> Vec<u8> {
    let mut bytes = vec![before; world.saving().len()];
    world.saving().write_to(&mut bytes);
    bytes
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn a_restored_world_goes_on_bit_for_bit(at in 0u64..20, count in 0u32..40, exact in any::<bool>()) {
        let contacts = if exact { "event" } else { "overlap" };
        let mut whole = world(contacts, count);
        run(&mut whole, 0..at);
        let bytes = whole.snapshot();
        let mut again = World::restore(rules(), model(contacts), &bytes).unwrap();
        prop_assert_eq!(again.state(), whole.state());
        prop_assert_eq!(again.snapshot(), bytes);
        run(&mut whole, at..at + 20);
        run(&mut again, at..at + 20);
        prop_assert_eq!(again.state_hash(), whole.state_hash());
        prop_assert_eq!(again.state(), whole.state());
    }

    #[test]
    fn each_byte_is_written_whatever_was_there(count in 0u32..40, at in 0u64..10) {
        let mut world = world("overlap", count);
        run(&mut world, 0..at);
        let bytes = world.snapshot();
        prop_assert_eq!(written_over(&world, 0x55), &bytes[..]);
        prop_assert_eq!(written_over(&world, 0xaa), &bytes[..]);
    }

    #[test]
    fn a_damaged_snapshot_is_refused(cut in any::<prop::sample::Index>(), bit in 0u8..8, shorten in any::<bool>()) {
        let mut bytes = world("overlap", 9).snapshot();
        let at = cut.index(bytes.len());
        if shorten {
            bytes.truncate(at);
        } else {
            bytes[at] ^= 1 << bit;
        }
        prop_assert!(matches!(World::restore(rules(), model("overlap"), &bytes), Err(Error::Snapshot(_))));
    }

    #[test]
    fn the_order_in_which_inputs_arrive_does_not_matter(mut order in Just((0..6usize).collect::<Vec<_>>()).prop_shuffle()) {
        let all = [
            Input { kind: InputKind::Join, client: 1, sequence: 0, ball: NO_BALL, numbers: [3.0, 9.0, 0.3, 1.0, 0.0, 0.0] },
            Input { kind: InputKind::Join, client: 2, sequence: 0, ball: NO_BALL, numbers: [9.0, 9.0, 0.3, 1.0, 0.0, 0.0] },
            Input { kind: InputKind::Thrust, client: 2, sequence: 1, ball: NO_BALL, numbers: [1.0, 9.0, 0.0, 0.0, 0.0, 0.0] },
            Input { kind: InputKind::Thrust, client: 2, sequence: 1, ball: NO_BALL, numbers: [1.5, 9.0, 0.0, 0.0, 0.0, 0.0] },
            Input { kind: InputKind::Kick, client: 1, sequence: 4, ball: NO_BALL, numbers: [0.1, 0.3, 0.0, 0.0, 0.0, 0.0] },
            Input { kind: InputKind::Spawn, client: 1, sequence: 3, ball: NO_BALL, numbers: [15.0, 9.0, 0.0, 0.0, 0.2, 1.0] },
        ];
        let mut one = world("overlap", 10);
        one.step(&all, None).unwrap();
        let mut other = world("overlap", 10);
        other.step(&order.drain(..).map(|i| all[i]).collect::<Vec<_>>(), None).unwrap();
        prop_assert_eq!(one.state(), other.state());
    }
}

#[test]
fn a_snapshot_of_an_older_format_is_refused_by_its_version() {
    let mut bytes = world("overlap", 3).snapshot();
    bytes[4] = 2;
    let Err(Error::Snapshot(message)) = World::restore(rules(), model("overlap"), &bytes) else {
        panic!("it was restored")
    };
    assert_eq!(message, "snapshot has version 2, this build reads version 3");
}

#[test]
fn copying_into_a_world_makes_it_equal() {
    let (mut one, mut other) = (world("event", 20), world("event", 20));
    let clone = one.clone();
    run(&mut one, 0..10);
    other.copy_from(&one);
    assert_eq!(other.state(), one.state());
    run(&mut other, 10..12);
    assert_eq!(clone.state().tick, 0);
}

#[test]
fn an_input_that_cannot_take_effect_is_counted() {
    let mut world = world("overlap", 3);
    let gone = Input {
        kind: InputKind::Remove,
        client: 0,
        sequence: 0,
        ball: 99,
        numbers: [0.0; 6],
    };
    let not_finite = Input {
        kind: InputKind::Kick,
        ball: 0,
        numbers: [f64::NAN, 0.0, 0.0, 0.0, 0.0, 0.0],
        ..gone
    };
    let no_ball = Input {
        kind: InputKind::Thrust,
        client: 9,
        numbers: [1.0; 6],
        ..gone
    };
    world.step(&[gone, not_finite, no_ball], None).unwrap();
    let counters = world.state().counters;
    assert_eq!((counters.inputs_applied, counters.inputs_ignored), (0, 3));
}

#[test]
fn a_world_that_diverges_stays_at_its_last_whole_tick() {
    let spring: &[(&str, &[f64])] = &[("spring", &[0.0, 0.0, 1e300])];
    let rules = Rules::new([0.0, 0.0, 20.0, 10.0], false, 1.0, 60.0, spring).unwrap();
    let ball = NewBall {
        position: Vec2::new(5.0, 5.0),
        velocity: Vec2::ZERO,
        radius: 0.5,
        mass: 1.0,
    };
    let model = Model::new("euler", "overlap", "brute", 1, None).unwrap();
    let mut world = World::new(rules, model, &[ball]).unwrap();
    let failed = loop {
        let before = world.state().clone();
        if let Err(error) = world.step(&[], None) {
            assert_eq!(world.state(), &before);
            break error;
        }
    };
    assert!(matches!(failed, Error::Diverged { ball: 0, .. }), "{failed}");
}
