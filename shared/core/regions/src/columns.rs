//! A column of whole numbers near each other: the lowest, the width of the differences to it, the differences.

use crate::Error;
use crate::bits::{Reader, width, write_bits, write_signed};

/// Below it, in either direction, every whole number is an f64.
pub(crate) const FARTHEST: f64 = (1u64 << 52) as f64;
const MOST_WIDTH: u32 = 54;

/// Added and taken away again, it leaves the nearest whole number of those up to [`FARTHEST`] / 2.
const WHOLE: f64 = 1.5 * FARTHEST;

/// The whole number of steps that comes nearest, if it is not too far away to be told. `inverse` is steps per unit.
pub(crate) fn steps(value: f64, inverse: f64) -> Option<i64> {
    let steps = value * inverse;
    (steps.abs() <= 0.5 * FARTHEST).then_some(((steps + WHOLE) - WHOLE) as i64)
}

pub(crate) fn write_column(out: &mut Vec<u8>, numbers: &[i64]) {
    let low = numbers.iter().copied().min().unwrap_or(0);
    let high = numbers.iter().copied().max().unwrap_or(0);
    let wide = width((high - low) as u64);
    write_signed(out, low);
    out.push(wide as u8);
    write_bits(out, numbers.iter().map(|&number| (number - low) as u64), wide);
}

/// The column in f64, in units of the step.
pub(crate) fn read_column(reader: &mut Reader<'_>, count: usize) -> Result<Vec<f64>, Error> {
    let low = reader.signed()?;
    if low.unsigned_abs() > FARTHEST as u64 {
        return Err(Error(format!(
            "a number of {low} steps, at most {FARTHEST} either way"
        )));
    }
    let wide = reader.width(MOST_WIDTH)?;
    let differences = reader.bits(count, wide)?;
    Ok(differences
        .into_iter()
        .map(|difference| (low + difference as i64) as f64)
        .collect())
}
