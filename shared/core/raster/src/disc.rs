//! Filled discs: the balls.

use crate::Colour;
use crate::canvas::{Canvas, blend, fill, weight};
use crate::coverage::{REACH, SMALL, disc, small_disc_row};

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
    for ((&[x, y], &radius), &[red, green, blue, opacity]) in centers.iter().zip(radii).zip(colours)
    {
        let finite = x.is_finite() && y.is_finite() && radius.is_finite();
        if !finite || radius <= 0.0 || opacity == 0 {
            continue;
        }
        let colour = [red, green, blue];
        if radius < SMALL {
            draw_small(canvas, x, y, radius, colour, opacity);
        } else if shading == Shading::Flat {
            draw_flat(canvas, x, y, radius, colour, opacity);
        } else {
            draw_ball(canvas, x, y, radius, colour, opacity);
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

/// Columns of one row that a disc may touch, and among them those that it covers wholly.
struct Span {
    outer: std::ops::Range<usize>,
    inner: std::ops::Range<usize>,
}

impl Span {
    #[inline]
    fn new(canvas: &Canvas, x: f64, dy: f64, radius: f64) -> Self {
        let reach = (radius + REACH) * (radius + REACH) - dy * dy;
        let half = reach.max(0.0).sqrt();
        // Half a pixel less on each side: a pixel counts from its centre.
        let outer = canvas.columns(x - half - 0.5, x + half + 0.5);
        let core = (radius - REACH) * (radius - REACH) - dy * dy;
        if core <= 0.0 {
            return Self {
                inner: outer.end..outer.end,
                outer,
            };
        }
        let half = core.sqrt();
        let start = ((x - half - 0.5).ceil().max(0.0) as usize).clamp(outer.start, outer.end);
        let end = (((x + half - 0.5).floor() + 1.0).max(0.0) as usize).clamp(start, outer.end);
        Self {
            outer,
            inner: start..end,
        }
    }
}

fn draw_flat(canvas: &mut Canvas, x: f64, y: f64, radius: f64, colour: [u8; 3], opacity: u8) {
    for row in canvas.rows(y - radius, y + radius) {
        let dy = row as f64 + 0.5 - y;
        let Span { outer, inner } = Span::new(canvas, x, dy, radius);
        let pixels = canvas.row(row);
        fill(&mut pixels[inner.clone()], colour, opacity);
        for column in (outer.start..inner.start).chain(inner.end..outer.end) {
            let part = disc(column as f64 + 0.5 - x, dy, radius);
            blend(&mut pixels[column], colour, weight(part, opacity));
        }
    }
}

/// The light on a ball, from the top left. Chosen by eye.
mod light {
    pub const X: f32 = -0.10;
    pub const Y: f32 = -0.17;
    pub const RIM: f32 = 0.34;
    pub const SPOT: f32 = 78.0;
    pub const SPOT_X: f32 = -0.34;
    pub const SPOT_Y: f32 = -0.44;
    pub const SPOT_WIDTH: f32 = 0.42;
}

/// The colour of a ball at (`u`, `v`) radii from its middle.
#[inline]
fn lit(base: [f32; 3], u: f32, v: f32) -> [u8; 3] {
    let square = u * u + v * v;
    let factor = 1.0 + light::X * u + light::Y * v - light::RIM * square * square;
    let (a, b) = (u - light::SPOT_X, v - light::SPOT_Y);
    let spot = (1.0 - (a * a + b * b) * (1.0 / (light::SPOT_WIDTH * light::SPOT_WIDTH))).max(0.0);
    let spot = light::SPOT * spot * spot;
    base.map(|channel| (channel * factor + spot + 0.5) as u8)
}

fn draw_ball(canvas: &mut Canvas, x: f64, y: f64, radius: f64, colour: [u8; 3], opacity: u8) {
    let base = colour.map(f32::from);
    let scale = 1.0 / radius;
    for row in canvas.rows(y - radius, y + radius) {
        let dy = row as f64 + 0.5 - y;
        let v = (dy * scale) as f32;
        let Span { outer, inner } = Span::new(canvas, x, dy, radius);
        let pixels = canvas.row(row);
        let mut u = ((inner.start as f64 + 0.5 - x) * scale) as f32;
        for pixel in &mut pixels[inner.clone()] {
            let colour = lit(base, u, v);
            if opacity == 255 {
                *pixel = colour;
            } else {
                blend(pixel, colour, u32::from(opacity));
            }
            u += scale as f32;
        }
        for column in (outer.start..inner.start).chain(inner.end..outer.end) {
            let dx = column as f64 + 0.5 - x;
            let colour = lit(base, (dx * scale) as f32, v);
            blend(
                &mut pixels[column],
                colour,
                weight(disc(dx, dy, radius), opacity),
            );
        }
    }
}
