//! Rings: the mark of a player's ball.

use crate::Colour;
use crate::canvas::{Canvas, blend, weight};
use crate::coverage::{REACH, SMALL, disc};

/// Blend rings onto the picture, in order. A ring lies between `radius - thickness` and `radius`.
pub fn draw_rings(
    canvas: &mut Canvas,
    centers: &[[f64; 2]],
    radii: &[f64],
    thickness: f64,
    colours: &[Colour],
) {
    for ((&[x, y], &radius), &[red, green, blue, opacity]) in centers.iter().zip(radii).zip(colours) {
        let finite = x.is_finite() && y.is_finite() && radius.is_finite() && thickness.is_finite();
        if finite && radius > 0.0 && thickness > 0.0 {
            draw_ring(
                canvas,
                [x, y],
                radius.max(SMALL),
                thickness,
                [red, green, blue],
                opacity,
            );
        }
    }
}

fn draw_ring(
    canvas: &mut Canvas,
    [x, y]: [f64; 2],
    radius: f64,
    thickness: f64,
    colour: [u8; 3],
    opacity: u8,
) {
    let hole = radius - thickness;
    let reach = radius + REACH;
    for row in canvas.rows(y - radius, y + radius) {
        let dy = row as f64 + 0.5 - y;
        let half = (reach * reach - dy * dy).max(0.0).sqrt();
        let outer = canvas.columns(x - half - 0.5, x + half + 0.5);
        let clear = (hole - REACH).max(0.0);
        let skip = (clear * clear - dy * dy).max(0.0).sqrt();
        let pixels = canvas.row(row);
        for column in outer {
            let dx = column as f64 + 0.5 - x;
            if dx.abs() < skip {
                continue;
            }
            let inner = if hole >= SMALL { disc(dx, dy, hole) } else { 0.0 };
            let outer = if dx == 0.0 && dy == 0.0 {
                1.0
            } else {
                disc(dx, dy, radius)
            };
            blend(
                &mut pixels[column],
                colour,
                weight((outer - inner).max(0.0), opacity),
            );
        }
    }
}
