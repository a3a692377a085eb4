//! Shapes drawn into a lent buffer of red, green and blue bytes, with anti-aliased edges.
//!
//! A picture is `height` rows of `width` pixels of three bytes. Coordinates are in pixels, the origin at the top left
//! corner of the top left pixel, y downwards, so the middle of the first pixel is (0.5, 0.5). Shapes are drawn in the
//! order given, clipped to the picture; a shape with a number that is not finite is left out. Nothing here is part of
//! the step: pictures need not be equal in every bit on every machine.

#![forbid(unsafe_code)]

mod block;
mod canvas;
mod coverage;
mod disc;
mod fade;
mod fluid;
mod rectangle;
mod ring;
mod segment;

pub use canvas::{Canvas, SizeError};
pub use disc::{Shading, draw_discs};
pub use fade::fade;
pub use fluid::{Liquid, draw_fluid};
pub use rectangle::draw_rectangles;
pub use ring::draw_rings;
pub use segment::draw_segments;

/// Red, green, blue, opacity; 0-255 each.
pub type Colour = [u8; 4];
