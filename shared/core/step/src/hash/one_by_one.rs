//! The mix of a ball, and sums of them on any processor.

use super::balls::Columns;
use super::{K0, K1, K2, K3, K4, fold};
use crate::Vec2;

/// Of balls that share their radius and mass.
pub(super) fn equal((id, position, velocity): Columns<'_>, shape: u64) -> u64 {
    let all = id.iter().zip(position).zip(velocity);
    all.map(|((&id, &position), &velocity)| ball(id, position, velocity, shape))
        .fold(0, u64::wrapping_add)
}

/// Of balls that do not.
pub(super) fn differing((id, position, velocity): Columns<'_>, radius: &[f64], mass: &[f64]) -> u64 {
    let all = id.iter().zip(position).zip(velocity).zip(radius).zip(mass);
    all.map(|((((&id, &position), &velocity), &radius), &mass)| {
        ball(id, position, velocity, shape(radius, mass))
    })
    .fold(0, u64::wrapping_add)
}

/// What a ball's radius and mass bring to its mix.
#[inline]
pub(super) fn shape(radius: f64, mass: f64) -> u64 {
    fold(radius.to_bits() ^ K1, mass.to_bits() ^ K2)
}

#[inline]
pub(super) fn ball(id: u64, position: Vec2, velocity: Vec2, shape: u64) -> u64 {
    let here = fold(position.x.to_bits() ^ K0, position.y.to_bits() ^ K1);
    let there = fold(velocity.x.to_bits() ^ K2, velocity.y.to_bits() ^ K3);
    fold(
        fold(here ^ id ^ K4, there.rotate_left(32) ^ K0) ^ K3,
        shape ^ id.rotate_left(17) ^ K2,
    )
}
