//! The state hash: 64 bits, a wrapping sum of strong per-ball mixes plus the rest of the state.
//!
//! A sum does not depend on the order of its terms: neither memory order nor threads can show in it. Each term mixes
//! the ball's id with its numbers by 64 x 64 -> 128 bit multiplications whose halves are folded, the construction of
//! Wang Yi's wyhash (public domain); the constants are its secret.

mod balls;
// A build for processors that all have AVX2 goes without: safe code cannot tell its two versions apart.
#[cfg(all(target_arch = "x86_64", not(target_feature = "avx2")))]
mod fours;
mod one_by_one;

#[cfg(all(target_arch = "x86_64", not(target_feature = "avx2")))]
use fours as fastest;
#[cfg(not(all(target_arch = "x86_64", not(target_feature = "avx2"))))]
use one_by_one as fastest;

use crate::team::Team;
use crate::{HeldKind, NO_BALL, State};

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
    fold(balls::sum(&state.balls, team) ^ K3, rest ^ K2).wrapping_add(rest)
}

/// A sum and a word, mixed.
pub(crate) fn mixed(sum: u64, word: u64) -> u64 {
    fold(sum ^ word ^ K3, K0)
}

#[cfg(test)]
mod tests;
