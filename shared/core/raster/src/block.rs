//! Eight pixels at a time: the inner loop of discs, in a shape that compilers turn into vector instructions.

use crate::coverage::{CURVATURE, FLATTEST};

/// Pixels in a block.
pub(crate) const PIXELS: usize = 4;

/// Bytes in a block.
pub(crate) const BYTES: usize = 3 * PIXELS;

pub(crate) type Lanes = [f32; PIXELS];

/// Coverage by a disc of pixels in one row, the first centred at (`x`, `y`) from the disc's centre.
///
/// The same measure as `coverage::disc`, without a branch: the part beyond the edge is a sum of squares of what reaches past the four corners.
#[inline]
pub(crate) fn coverage(x: f32, y: f32, radius: f32) -> Lanes {
    let inwards = radius - CURVATURE as f32 / radius;
    std::array::from_fn(|lane| {
        let dx = x + lane as f32;
        let distance = (dx * dx + y * y).sqrt();
        let depth = (inwards - distance).clamp(-1.0, 1.0);
        // Of a pixel so near the middle that the bound counts, all is covered whatever its normal.
        let turn = 1.0 / distance.max(0.5);
        let (wide, tall) = ((dx.abs() * turn).max(FLATTEST), (y.abs() * turn).max(FLATTEST));
        let (sum, difference) = (0.5 * (wide + tall), 0.5 * (wide - tall));
        let corners = square(depth + sum) - square(depth + difference) - square(depth - difference)
            + square(depth - sum);
        (corners / (2.0 * wide * tall)).min(1.0)
    })
}

#[inline]
fn square(reach: f32) -> f32 {
    let reach = reach.max(0.0);
    reach * reach
}

/// Move pixels towards their new colours by their weights (0 to 1).
#[inline]
pub(crate) fn blend(block: &mut [u8; BYTES], colour: &[f32; BYTES], weight: &Lanes) {
    for (at, byte) in block.iter_mut().enumerate() {
        let old = f32::from(*byte);
        *byte = round(old + (colour[at] - old) * weight[at / 3]);
    }
}

/// The nearest integer of a number from 0 to 255.
///
/// Adding 2^23 leaves the rounded number in the last bits: one instruction for many lanes, unlike a checked cast.
#[inline]
pub(crate) fn round(number: f32) -> u8 {
    (number + 8_388_608.0).to_bits() as u8
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::coverage::tests::area;

    #[test]
    fn rounding_is_to_the_nearest_integer() {
        for number in 0..=255_u8 {
            for part in [-0.49, -0.1, 0.0, 0.3, 0.49] {
                assert_eq!(round((f32::from(number) + part).clamp(0.0, 255.0)), number);
            }
        }
    }

    #[test]
    fn coverage_is_close_to_the_area_of_every_pixel() {
        let mut worst: f64 = 0.0;
        for radius in [2.0, 2.7, 4.2, 9.0, 33.3, 250.0] {
            for part in 0..7 {
                let middle = f64::from(part) / 7.0;
                let rows = [-0.97_f64, -0.8, -0.5, 0.0, 0.3, 0.71, 0.9, 1.0];
                for y in rows.map(|part| (part * radius).round() + middle) {
                    let edge = (radius * radius - y * y).max(0.0).sqrt();
                    for start in [-edge, edge] {
                        let start = (start - 4.0).round() + middle;
                        let got = coverage(start as f32, y as f32, radius as f32);
                        for (lane, part) in got.iter().enumerate() {
                            let exact = area(start + lane as f64, y, radius);
                            worst = worst.max((f64::from(*part) - exact).abs());
                        }
                    }
                }
            }
        }
        assert!(worst < 0.03, "{worst}");
    }
}
