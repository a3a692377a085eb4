//! The lent picture and the one way in which a colour gets onto it.

use std::fmt;
use std::ops::Range;

/// A picture that is drawn on: rows of pixels of three bytes.
pub struct Canvas<'a> {
    pixels: &'a mut [u8],
    width: usize,
    height: usize,
}

/// A buffer whose length is not `3 * width * height`.
#[derive(Debug, PartialEq, Eq)]
pub struct SizeError {
    /// Bytes in the buffer.
    pub length: usize,
    /// Pixels in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
}

impl fmt::Display for SizeError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            length,
            width,
            height,
        } = self;
        write!(
            out,
            "a picture of {width}x{height} pixels needs {width}*{height}*3 bytes, got {length}"
        )
    }
}

impl std::error::Error for SizeError {}

impl<'a> Canvas<'a> {
    /// Borrow a buffer as a picture.
    pub fn new(pixels: &'a mut [u8], width: usize, height: usize) -> Result<Self, SizeError> {
        let wanted = width.checked_mul(height).and_then(|area| area.checked_mul(3));
        if wanted == Some(pixels.len()) {
            Ok(Self {
                pixels,
                width,
                height,
            })
        } else {
            Err(SizeError {
                length: pixels.len(),
                width,
                height,
            })
        }
    }

    /// Pixels in a row.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> usize {
        self.height
    }

    /// The rows whose pixels may be touched by what lies between `low` and `high`.
    pub(crate) fn rows(&self, low: f64, high: f64) -> Range<usize> {
        clip(low, high, self.height)
    }

    /// The columns whose pixels may be touched by what lies between `low` and `high`.
    pub(crate) fn columns(&self, low: f64, high: f64) -> Range<usize> {
        clip(low, high, self.width)
    }

    pub(crate) fn row(&mut self, y: usize) -> &mut [[u8; 3]] {
        let start = 3 * y * self.width;
        as_pixels(&mut self.pixels[start..start + 3 * self.width])
    }
}

fn as_pixels(bytes: &mut [u8]) -> &mut [[u8; 3]] {
    bytes.as_chunks_mut::<3>().0
}

fn clip(low: f64, high: f64, end: usize) -> Range<usize> {
    // A float cast to an integer saturates, so what lies far outside needs no case of its own.
    let first = (low.floor() as isize).max(0) as usize;
    let last = (high.ceil() as isize).clamp(0, end as isize) as usize;
    first.min(last)..last
}

/// `weight` (0-255) of `colour` over what is there.
#[inline]
pub(crate) fn blend(pixel: &mut [u8; 3], colour: [u8; 3], weight: u32) {
    for (channel, new) in pixel.iter_mut().zip(colour) {
        // Exact rounding of x / 255 for x below 65,536 without a division.
        let sum = u32::from(new) * weight + u32::from(*channel) * (255 - weight) + 128;
        *channel = ((sum + (sum >> 8)) >> 8) as u8;
    }
}

/// The weight of a pixel of which a shape of that opacity covers that part.
#[inline]
pub(crate) fn weight(coverage: f64, opacity: u8) -> u32 {
    (coverage * f64::from(opacity) + 0.5) as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blending_rounds_to_the_nearest_value() {
        for old in 0..=255_u8 {
            for weight in 0..=255_u32 {
                let mut pixel = [old; 3];
                blend(&mut pixel, [0, 100, 255], weight);
                for (channel, new) in pixel.iter().zip([0.0, 100.0, 255.0]) {
                    let part = f64::from(weight) / 255.0;
                    let exact: f64 = new * part + f64::from(old) * (1.0 - part);
                    assert!((f64::from(*channel) - exact).abs() <= 0.5 + 1e-9);
                }
            }
        }
    }

    #[test]
    fn a_buffer_of_another_length_is_refused() {
        let mut pixels = vec![0; 11];
        let error = Canvas::new(&mut pixels, 2, 2).err().unwrap();
        assert_eq!(
            error,
            SizeError {
                length: 11,
                width: 2,
                height: 2
            }
        );
        assert!(Canvas::new(&mut [], usize::MAX, 2).is_err());
    }

    #[test]
    fn ranges_are_clipped() {
        let mut pixels = vec![0; 30];
        let canvas = Canvas::new(&mut pixels, 5, 2).unwrap();
        assert_eq!(canvas.columns(-1e300, 1e300), 0..5);
        assert_eq!(canvas.columns(1.2, 2.1), 1..3);
        assert!(canvas.rows(7.0, 9.0).is_empty());
        assert!(canvas.rows(-9.0, -7.0).is_empty());
    }
}
