//! Filled discs: the balls.

use crate::Colour;
use crate::block::{BYTES, Lanes, PIXELS, blend as blend_block, coverage, round};
use crate::canvas::{Canvas, blend, weight};
use crate::coverage::{REACH, SMALL, small_disc_row};

/// How the colour runs over a disc. The middle of a disc always has its own colour.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shading {
    /// One colour all over.
    #[default]
    Flat,
    /// Lit from the top left: darker towards the rim, with a soft highlight.
    Ball,
}

/// Blend filled discs onto the picture, in order.
///
/// The three slices go together; what is longer than the shortest is left out.
pub fn draw_discs(
    canvas: &mut Canvas,
    centers: &[[f64; 2]],
    radii: &[f64],
    colours: &[Colour],
    shading: Shading,
) {
    for ((&[x, y], &radius), &[red, green, blue, opacity]) in centers.iter().zip(radii).zip(colours) {
        let finite = x.is_finite() && y.is_finite() && radius.is_finite();
        if !finite || radius <= 0.0 || opacity == 0 {
            continue;
        }
        let colour = [red, green, blue];
        if radius < SMALL {
            draw_small(canvas, x, y, radius, colour, opacity);
        } else if shading == Shading::Flat {
            draw_large(canvas, [x, y], radius, opacity, &Flat::new(colour, opacity));
        } else {
            draw_large(canvas, [x, y], radius, opacity, &Ball::new(colour, radius));
        }
    }
}

fn draw_small(canvas: &mut Canvas, x: f64, y: f64, radius: f64, colour: [u8; 3], opacity: u8) {
    let columns = canvas.columns(x - radius, x + radius);
    for row in canvas.rows(y - radius, y + radius) {
        let coverage = small_disc_row(x - columns.start as f64, y - row as f64, radius);
        for (pixel, part) in canvas.row(row)[columns.clone()].iter_mut().zip(coverage) {
            blend(pixel, colour, weight(part, opacity));
        }
    }
}

/// How a disc is coloured, eight pixels at a time.
trait Paint {
    /// The one colour of pixels that are wholly inside, if there is one.
    fn plain(&self) -> Option<[u8; 3]>;

    /// Colours of pixels in a row, the first centred at (`x`, `y`) from the disc's centre.
    fn block(&self, x: f32, y: f32) -> [f32; BYTES];
}

struct Flat {
    plain: Option<[u8; 3]>,
    block: [f32; BYTES],
}

impl Flat {
    fn new(colour: [u8; 3], opacity: u8) -> Self {
        let block = std::array::from_fn(|at| f32::from(colour[at % 3]));
        Self {
            plain: (opacity == 255).then_some(colour),
            block,
        }
    }
}

impl Paint for Flat {
    #[inline]
    fn plain(&self) -> Option<[u8; 3]> {
        self.plain
    }

    #[inline]
    fn block(&self, _x: f32, _y: f32) -> [f32; BYTES] {
        self.block
    }
}

/// The light on a ball, from the top left, in radii of the ball. Chosen by eye.
mod light {
    pub const X: f32 = -0.10;
    pub const Y: f32 = -0.17;
    pub const RIM: f32 = 0.34;
    pub const SPOT: f32 = 78.0;
    pub const SPOT_X: f32 = -0.34;
    pub const SPOT_Y: f32 = -0.44;
    pub const SPOT_WIDTH: f32 = 0.42;
}

struct Ball {
    colour: [f32; 3],
    scale: f32,
}

impl Ball {
    fn new(colour: [u8; 3], radius: f64) -> Self {
        Self {
            colour: colour.map(f32::from),
            scale: (1.0 / radius) as f32,
        }
    }
}

impl Paint for Ball {
    #[inline]
    fn plain(&self) -> Option<[u8; 3]> {
        None
    }

    #[inline]
    fn block(&self, x: f32, y: f32) -> [f32; BYTES] {
        let v = y * self.scale;
        let (mut factor, mut spot) = ([0.0; PIXELS], [0.0; PIXELS]);
        for lane in 0..PIXELS {
            let u = (x + lane as f32) * self.scale;
            let square = u * u + v * v;
            factor[lane] = 1.0 + light::X * u + light::Y * v - light::RIM * square * square;
            let (a, b) = (u - light::SPOT_X, v - light::SPOT_Y);
            const SHARP: f32 = 1.0 / (light::SPOT_WIDTH * light::SPOT_WIDTH);
            let near = (1.0 - (a * a + b * b) * SHARP).max(0.0);
            spot[lane] = light::SPOT * near * near;
        }
        std::array::from_fn(|at| {
            let lit = self.colour[at % 3] * factor[at / 3] + spot[at / 3];
            lit.min(255.0)
        })
    }
}

fn draw_large(canvas: &mut Canvas, [x, y]: [f64; 2], radius: f64, opacity: u8, paint: &impl Paint) {
    let part = f32::from(opacity) / 255.0;
    for row in canvas.rows(y - radius, y + radius) {
        let dy = row as f64 + 0.5 - y;
        // Half a pixel more: a pixel counts from its centre.
        let half = chord(radius + REACH, dy) + 0.5;
        let outer = canvas.columns(x - half, x + half);
        let core = chord(radius - REACH, dy);
        let inner = if radius - REACH > dy.abs() {
            -core..core
        } else {
            0.0..0.0
        };
        let pixels = canvas.row(row);
        let mut column = outer.start;
        while column < outer.end {
            let dx = column as f64 + 0.5 - x;
            let end = (column + PIXELS).min(pixels.len());
            if inner.contains(&dx) && opacity == 255 {
                if let Some(colour) = paint.plain() {
                    let end = ((x + core + 0.5).max(0.0) as usize).clamp(column + 1, outer.end);
                    pixels[column..end].fill(colour);
                    column = end;
                    continue;
                }
                if inner.contains(&(dx + (PIXELS - 1) as f64)) && end - column == PIXELS {
                    let bytes = paint.block(dx as f32, dy as f32).map(round);
                    pixels[column..end].as_flattened_mut().copy_from_slice(&bytes);
                    column = end;
                    continue;
                }
            }
            let colours = paint.block(dx as f32, dy as f32);
            let weights = coverage(dx as f32, dy as f32, radius as f32).map(|covered| covered * part);
            draw_block(&mut pixels[column..end], &colours, &weights);
            column = end;
        }
    }
}

#[inline]
fn chord(radius: f64, dy: f64) -> f64 {
    (radius * radius - dy * dy).max(0.0).sqrt()
}

#[inline]
fn draw_block(pixels: &mut [[u8; 3]], colours: &[f32; BYTES], weights: &Lanes) {
    if let Ok(block) = <&mut [u8; BYTES]>::try_from(pixels.as_flattened_mut()) {
        blend_block(block, colours, weights);
    } else {
        // The last pixels of a row.
        let mut block = [0; BYTES];
        let bytes = pixels.as_flattened_mut();
        block[..bytes.len()].copy_from_slice(bytes);
        blend_block(&mut block, colours, weights);
        bytes.copy_from_slice(&block[..bytes.len()]);
    }
}
