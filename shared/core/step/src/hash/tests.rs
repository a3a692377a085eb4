use proptest::prelude::*;

use super::*;
use crate::{NewBall, Vec2, random};

/// A ball's mix, written out word by word with products of 128 bits: the judge of whatever is faster.
fn mix(id: u64, [x, y, u, v, radius, mass]: [u64; 6]) -> u64 {
    let folded = |a: u64, b: u64| {
        let product = u128::from(a) * u128::from(b);
        (product % (1 << 64)) as u64 ^ (product >> 64) as u64
    };
    let here = folded(x ^ 0xa076_1d64_78bd_642f, y ^ 0xe703_7ed1_a0b4_28db);
    let there = folded(u ^ 0x8ebc_6af0_9c88_c6e3, v ^ 0x5899_65cc_7537_4cc3);
    let shape = folded(radius ^ 0xe703_7ed1_a0b4_28db, mass ^ 0x8ebc_6af0_9c88_c6e3);
    let moving = folded(
        here ^ id ^ 0x1d8e_4e27_c47d_124f,
        there.rotate_left(32) ^ 0xa076_1d64_78bd_642f,
    );
    folded(
        moving ^ 0x5899_65cc_7537_4cc3,
        shape ^ id.rotate_left(17) ^ 0x8ebc_6af0_9c88_c6e3,
    )
}

/// Bits of every kind: those that carry far, and those of common numbers.
fn word() -> impl Strategy<Value = u64> {
    prop_oneof![
        any::<u64>(),
        any::<f64>().prop_map(f64::to_bits),
        (-4i8..4).prop_map(|number| f64::from(number).to_bits()),
        Just(0),
        Just(u64::MAX),
        Just(u64::from(u32::MAX)),
        // What makes a factor of 0 or of all ones of a number.
        prop::sample::select(vec![K0, K1, K2, K3, !K0, !K1, !K2, !K3]),
    ]
}

proptest! {
    #[test]
    fn balls_in_vectors_and_one_by_one_give_what_the_judge_gives(
        all in prop::collection::vec((word(), prop::array::uniform6(word())), 0..40),
        radius in word(),
        mass in word(),
    ) {
        let vector = |x, y| Vec2::new(f64::from_bits(x), f64::from_bits(y));
        let id: Vec<u64> = all.iter().map(|&(id, _)| id).collect();
        let position: Vec<Vec2> = all.iter().map(|(_, of)| vector(of[0], of[1])).collect();
        let velocity: Vec<Vec2> = all.iter().map(|(_, of)| vector(of[2], of[3])).collect();
        let radii: Vec<f64> = all.iter().map(|(_, of)| f64::from_bits(of[4])).collect();
        let masses: Vec<f64> = all.iter().map(|(_, of)| f64::from_bits(of[5])).collect();
        let columns = (&id[..], &position[..], &velocity[..]);

        let differing = all.iter().fold(0, |sum: u64, &(id, of)| sum.wrapping_add(mix(id, of)));
        prop_assert_eq!(fastest::differing(columns, &radii, &masses), differing);
        prop_assert_eq!(one_by_one::differing(columns, &radii, &masses), differing);

        let equal = all.iter().fold(0, |sum: u64, &(id, [x, y, u, v, ..])| {
            sum.wrapping_add(mix(id, [x, y, u, v, radius, mass]))
        });
        let shape = one_by_one::shape(f64::from_bits(radius), f64::from_bits(mass));
        prop_assert_eq!(fastest::equal(columns, shape), equal);
        prop_assert_eq!(one_by_one::equal(columns, shape), equal);
    }
}

/// More balls than one thread hashes at a time, and no multiple of what goes into vectors.
#[test]
fn any_number_of_threads_gives_what_the_judge_gives() {
    for mixed in [false, true] {
        let mut state = State::default();
        let mut sum = 0u64;
        for id in 0..50_003 {
            let number = |stream| random::uniform(7, stream, id);
            let ball = NewBall {
                position: Vec2::new(number(0), number(1)),
                velocity: Vec2::new(number(2) - 0.5, number(3) - 0.5),
                radius: if mixed { number(4) } else { 0.5 },
                mass: if mixed { number(5) } else { 1.0 },
            };
            let numbers = [
                ball.position.x,
                ball.position.y,
                ball.velocity.x,
                ball.velocity.y,
                ball.radius,
                ball.mass,
            ];
            sum = sum.wrapping_add(mix(id, numbers.map(f64::to_bits)));
            state.balls.push(id, ball);
        }
        assert_eq!(state.balls.uniform().is_none(), mixed);
        for threads in [1, 2, 3, 8] {
            let team = Team::new(threads).unwrap();
            assert_eq!(
                balls::sum(&state.balls, &team),
                sum,
                "{threads} threads, mixed {mixed}"
            );
        }
    }
}

fn sample() -> State {
    let mut state = State::default();
    for i in 0..5u32 {
        let x = f64::from(i);
        let ball = NewBall {
            position: Vec2::new(x, -x),
            velocity: Vec2::new(1.0, x),
            radius: 0.5,
            mass: 1.0,
        };
        state.balls.push(u64::from(i), ball);
    }
    state
}

#[test]
fn every_number_counts() {
    let alone = Team::default();
    let first = super::state(&sample(), &alone);
    let changes: [fn(&mut State); 9] = [
        |s| s.tick += 1,
        |s| s.next_id += 1,
        |s| s.variable_time = 0.5,
        |s| s.counters.wall_hits += 1,
        |s| s.balls.position[2].x += 1e-16 + f64::EPSILON * 4.0,
        |s| s.balls.velocity[4].y = -0.0,
        |s| s.balls.velocity.swap(1, 2),
        |s| s.balls.id[4] = 17,
        |s| {
            s.players.push(crate::Player {
                client: 0,
                ball: None,
            })
        },
    ];
    for change in changes {
        let mut other = sample();
        change(&mut other);
        assert_ne!(super::state(&other, &alone), first);
    }
}
