//! The same sums, where the processor has AVX2: of eight balls four in vectors and four one by one.
//!
//! A processor has units for vectors beside those that multiply 64 x 64 bits, and either half of the work leaves the
//! other's units idle. Vectors multiply 32 x 32 bits, so a product of 64 x 64 is put together from four.

use std::arch::x86_64::*;

use multiversion::multiversion;
use multiversion::target::match_target;

use super::balls::Columns;
use super::{K0, K1, K2, K3, K4, one_by_one};
use crate::Vec2;

const FOUR: usize = 4;
/// Balls that are looked at together.
const EIGHT: usize = 2 * FOUR;

/// Of balls that share their radius and mass.
#[multiversion(targets("x86_64+avx2"))]
pub(super) fn equal(all: Columns<'_>, shape: u64) -> u64 {
    match_target! {
        "x86_64+avx2" => equal_by_eights(all, shape),
        _ => one_by_one::equal(all, shape),
    }
}

/// Of balls that do not.
#[multiversion(targets("x86_64+avx2"))]
pub(super) fn differing(all: Columns<'_>, radius: &[f64], mass: &[f64]) -> u64 {
    match_target! {
        "x86_64+avx2" => differing_by_eights(all, radius, mass),
        _ => one_by_one::differing(all, radius, mass),
    }
}

#[target_feature(enable = "avx2")]
fn equal_by_eights(all: Columns<'_>, shape: u64) -> u64 {
    let ((id, position, velocity), rest) = whole_eights(all);
    let shapes = word(shape);
    let (mut fours, mut ones) = (word(0), one_by_one::equal(rest, shape));
    for ((id, position), velocity) in id.iter().zip(position).zip(velocity) {
        fours = _mm256_add_epi64(fours, four(&id[0], &position[0], &velocity[0], shapes));
        for ((&id, &position), &velocity) in id[1].iter().zip(&position[1]).zip(&velocity[1]) {
            ones = ones.wrapping_add(one_by_one::ball(id, position, velocity, shape));
        }
    }
    ones.wrapping_add(lanes(fours))
}

#[target_feature(enable = "avx2")]
fn differing_by_eights(all: Columns<'_>, radius: &[f64], mass: &[f64]) -> u64 {
    let ((id, position, velocity), rest) = whole_eights(all);
    let (radius, last_radius) = eights(radius);
    let (mass, last_mass) = eights(mass);
    let mut fours = word(0);
    let mut ones = one_by_one::differing(rest, last_radius, last_mass);
    for ((((id, position), velocity), radius), mass) in
        id.iter().zip(position).zip(velocity).zip(radius).zip(mass)
    {
        let shapes = fold(
            _mm256_xor_si256(as_positions(radius[0].map(f64::to_bits)), word(K1)),
            _mm256_xor_si256(as_positions(mass[0].map(f64::to_bits)), word(K2)),
        );
        fours = _mm256_add_epi64(fours, four(&id[0], &position[0], &velocity[0], shapes));
        for at in 0..FOUR {
            let shape = one_by_one::shape(radius[1][at], mass[1][at]);
            ones = ones.wrapping_add(one_by_one::ball(
                id[1][at],
                position[1][at],
                velocity[1][at],
                shape,
            ));
        }
    }
    ones.wrapping_add(lanes(fours))
}

type Eight<T> = [[T; FOUR]; 2];

fn eights<T>(all: &[T]) -> (&[Eight<T>], &[T]) {
    let (whole, rest) = all.split_at(all.len() / EIGHT * EIGHT);
    (whole.as_chunks().0.as_chunks().0, rest)
}

type Eights<'a> = (&'a [Eight<u64>], &'a [Eight<Vec2>], &'a [Eight<Vec2>]);

fn whole_eights<'a>((id, position, velocity): Columns<'a>) -> (Eights<'a>, Columns<'a>) {
    let (id, last_id) = eights(id);
    let (position, last_position) = eights(position);
    let (velocity, last_velocity) = eights(velocity);
    ((id, position, velocity), (last_id, last_position, last_velocity))
}

/// The mixes of four balls, in the order 0, 2, 1, 3: that in which unpacking leaves coordinates.
#[inline]
#[target_feature(enable = "avx2")]
fn four(id: &[u64; FOUR], position: &[Vec2; FOUR], velocity: &[Vec2; FOUR], shape: __m256i) -> __m256i {
    let id = as_positions(*id);
    let here = fold_coordinates(position, K0, K1);
    let there = _mm256_shuffle_epi32::<0b10_11_00_01>(fold_coordinates(velocity, K2, K3));
    let moving = fold(
        _mm256_xor_si256(here, _mm256_xor_si256(id, word(K4))),
        _mm256_xor_si256(there, word(K0)),
    );
    let turned = _mm256_or_si256(_mm256_slli_epi64::<17>(id), _mm256_srli_epi64::<47>(id));
    fold(
        _mm256_xor_si256(moving, word(K3)),
        _mm256_xor_si256(turned, _mm256_xor_si256(shape, word(K2))),
    )
}

#[inline]
#[target_feature(enable = "avx2")]
fn fold_coordinates(of: &[Vec2; FOUR], x: u64, y: u64) -> __m256i {
    let two = |a: Vec2, b: Vec2| words([a.x, a.y, b.x, b.y].map(f64::to_bits));
    let (low, high) = (two(of[0], of[1]), two(of[2], of[3]));
    fold(
        _mm256_xor_si256(_mm256_unpacklo_epi64(low, high), word(x)),
        _mm256_xor_si256(_mm256_unpackhi_epi64(low, high), word(y)),
    )
}

/// The halves of the 128 bit products, folded.
#[inline]
#[target_feature(enable = "avx2")]
fn fold(a: __m256i, b: __m256i) -> __m256i {
    let (a_upper, b_upper) = (_mm256_srli_epi64::<32>(a), _mm256_srli_epi64::<32>(b));
    let lowest = _mm256_mul_epu32(a, b);
    let highest = _mm256_mul_epu32(a_upper, b_upper);
    // Neither sum overflows: (2^32 - 1)^2 leaves room for twice 2^32 - 1.
    let middle = _mm256_add_epi64(_mm256_mul_epu32(a, b_upper), _mm256_srli_epi64::<32>(lowest));
    let lower_middle = _mm256_and_si256(middle, word(u64::from(u32::MAX)));
    let carried = _mm256_add_epi64(_mm256_mul_epu32(a_upper, b), lower_middle);
    let upper = _mm256_add_epi64(
        _mm256_add_epi64(highest, _mm256_srli_epi64::<32>(middle)),
        _mm256_srli_epi64::<32>(carried),
    );
    let lower = _mm256_blend_epi32::<0b1010_1010>(lowest, _mm256_slli_epi64::<32>(carried));
    _mm256_xor_si256(lower, upper)
}

#[inline]
#[target_feature(enable = "avx2")]
fn as_positions(of: [u64; FOUR]) -> __m256i {
    _mm256_permute4x64_epi64::<0b11_01_10_00>(words(of))
}

#[inline]
#[target_feature(enable = "avx2")]
fn words(of: [u64; FOUR]) -> __m256i {
    let [a, b, c, d] = of.map(u64::cast_signed);
    _mm256_setr_epi64x(a, b, c, d)
}

#[inline]
#[target_feature(enable = "avx2")]
fn word(everywhere: u64) -> __m256i {
    _mm256_set1_epi64x(everywhere.cast_signed())
}

/// The sum of all lanes.
#[target_feature(enable = "avx2")]
fn lanes(of: __m256i) -> u64 {
    let halves = _mm_add_epi64(_mm256_castsi256_si128(of), _mm256_extracti128_si256::<1>(of));
    let sum = _mm_add_epi64(halves, _mm_unpackhi_epi64(halves, halves));
    _mm_cvtsi128_si64(sum).cast_unsigned()
}
