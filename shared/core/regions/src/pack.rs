//! Balls to bytes.
//!
//! ```text
//! varint count; if it is not 0:
//! varint lowest id, byte width, then the gaps to the next ids, less one, of that many bits each
//! x, y, vx, vy: a column each: signed varint lowest, byte width, then the differences to it
//! shapes: byte kind; 0: varint place in the table for all; 1: a place each, of as many bits as the table needs;
//!         2: 2 bits each for the way it is told; a place each for those of way 0; f32 radius each for those of
//!         way 1, whose masses are pi radius^2; f64 radius and mass each for those of way 2
//! ```
//!
//! Positions are in steps of `Quanta::position` from the box's left bottom, velocities in steps of `Quanta::velocity`.
//! What is written in bits fills whole bytes in the end.

use kuglice_step::Balls;

use crate::bits::{width, write_bits, write_varint};
use crate::columns::{steps, write_column};
use crate::{Grid, Quanta, Shape, Shapes};

/// Packs the balls at `indices`, whose ids ascend. Also says how many were left out: those that are further away, or
/// faster, than 2^51 steps.
#[must_use]
pub fn pack(
    grid: &Grid,
    quanta: Quanta,
    shapes: &Shapes,
    balls: &Balls,
    indices: &[u32],
) -> (Vec<u8>, usize) {
    let mut columns: [Vec<i64>; 4] = Default::default();
    let (mut ids, mut told): (Vec<u64>, Vec<Shape>) = Default::default();
    let origin = grid.origin();
    let (per_metre, per_speed) = (1.0 / quanta.position, 1.0 / quanta.velocity);
    ids.reserve(indices.len());
    told.reserve(indices.len());
    for column in &mut columns {
        column.reserve(indices.len());
    }
    for &index in indices {
        let index = index as usize;
        let (position, velocity) = (balls.position[index] - origin, balls.velocity[index]);
        let numbers = [
            steps(position.x, per_metre),
            steps(position.y, per_metre),
            steps(velocity.x, per_speed),
            steps(velocity.y, per_speed),
        ];
        let [Some(x), Some(y), Some(vx), Some(vy)] = numbers else {
            continue;
        };
        for (column, number) in columns.iter_mut().zip([x, y, vx, vy]) {
            column.push(number);
        }
        ids.push(balls.id[index]);
        told.push((balls.radius[index], balls.mass[index]));
    }
    let mut out = Vec::with_capacity(32 + 10 * ids.len());
    write_varint(&mut out, ids.len() as u64);
    if let Some(&first) = ids.first() {
        let gaps: Vec<u64> = ids.windows(2).map(|pair| pair[1] - pair[0] - 1).collect();
        let wide = width(gaps.iter().copied().max().unwrap_or(0));
        write_varint(&mut out, first);
        out.push(wide as u8);
        write_bits(&mut out, gaps.into_iter(), wide);
        for column in &columns {
            write_column(&mut out, column);
        }
        shapes.write(&mut out, &told);
    }
    (out, indices.len() - ids.len())
}
