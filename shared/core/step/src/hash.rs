//! The state hash: 64 bits, a wrapping sum of strong per-ball mixes plus the rest of the state.
//!
//! A sum does not depend on the order of its terms: neither memory order nor threads can show in it. Each term mixes
//! the ball's id with its numbers by 64 x 64 -> 128 bit multiplications whose halves are folded, the construction of
//! Wang Yi's wyhash (public domain); the constants are its secret.

use crate::team::{GRAIN, Team};
use crate::{Balls, HeldKind, NO_BALL, State, Vec2};

const K0: u64 = 0xa076_1d64_78bd_642f;
const K1: u64 = 0xe703_7ed1_a0b4_28db;
const K2: u64 = 0x8ebc_6af0_9c88_c6e3;
const K3: u64 = 0x5899_65cc_7537_4cc3;
const K4: u64 = 0x1d8e_4e27_c47d_124f;

/// The halves of the 128 bit product, folded.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "both halves are used")]
fn fold(a: u64, b: u64) -> u64 {
    let product = u128::from(a) * u128::from(b);
    (product as u64) ^ ((product >> 64) as u64)
}

#[inline]
fn ball(id: u64, position: Vec2, velocity: Vec2, radius: f64, mass: f64) -> u64 {
    let here = fold(position.x.to_bits() ^ K0, position.y.to_bits() ^ K1);
    let there = fold(velocity.x.to_bits() ^ K2, velocity.y.to_bits() ^ K3);
    let shape = fold(radius.to_bits() ^ K1, mass.to_bits() ^ K2);
    fold(
        fold(here ^ id ^ K4, there.rotate_left(32) ^ K0) ^ K3,
        shape ^ id.rotate_left(17) ^ K2,
    )
}

/// Balls that a thread hashes at a time, at least: calling others takes as long as hashing some thousands.
const MANY_BALLS: usize = 16 * GRAIN;

fn balls(balls: &Balls, team: &Team) -> u64 {
    let all = (&balls.id[..], &balls.position[..], &balls.velocity[..]);
    let add = |left: u64, right: u64| left.wrapping_add(right);
    let sum = || match balls.uniform() {
        Some(shape) => team.share(
            all,
            MANY_BALLS,
            &|(id, position, velocity)| {
                let all = id.iter().zip(position).zip(velocity);
                all.map(|((&id, &p), &v)| ball(id, p, v, shape.radius, shape.mass))
                    .fold(0, add)
            },
            &add,
        ),
        None => team.share(
            (all, &balls.radius[..], &balls.mass[..]),
            MANY_BALLS,
            &|((id, position, velocity), radius, mass)| {
                let all = id.iter().zip(position).zip(velocity).zip(radius).zip(mass);
                all.map(|((((&id, &p), &v), &r), &m)| ball(id, p, v, r, m))
                    .fold(0, add)
            },
            &add,
        ),
    };
    if balls.len() > MANY_BALLS {
        team.enter(sum)
    } else {
        sum()
    }
}

/// The hash that stands for a state.
#[must_use]
pub(crate) fn state(state: &State, team: &Team) -> u64 {
    let mut rest = K4;
    let mut add = |value: u64| rest = fold(rest ^ value ^ K0, K1 ^ rest.rotate_left(29));
    add(state.tick);
    add(state.variable_ticks);
    add(state.variable_time.to_bits());
    add(state.next_id);
    add(state.counters.collisions);
    add(state.counters.wall_hits);
    add(state.counters.inputs_applied);
    add(state.counters.inputs_ignored);
    add(state.balls.len() as u64);
    add(state.players.len() as u64);
    for player in &state.players {
        add(u64::from(player.client));
        add(player.ball.unwrap_or(NO_BALL));
    }
    for held in &state.held {
        add(u64::from(held.client));
        add(match held.kind {
            HeldKind::Thrust => 1,
            HeldKind::Attract => 2,
        });
        add(held.vector.x.to_bits());
        add(held.vector.y.to_bits());
        add(held.strength.to_bits());
    }
    fold(balls(&state.balls, team) ^ K3, rest ^ K2).wrapping_add(rest)
}

/// A sum and a word, mixed.
pub(crate) fn mixed(sum: u64, word: u64) -> u64 {
    fold(sum ^ word ^ K3, K0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::NewBall;

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
}
