//! From density to a lit surface with a smooth edge.

use super::Liquid;
use super::field::{CELL, Field, MARGIN, THRESHOLD};
use crate::canvas::{Canvas, blend};

/// Light from the top left, towards the one who looks; a unit vector.
const LIGHT: [f32; 3] = [-0.371, -0.557, 0.743];

/// Half way between the light and the one who looks: where a mirror would show the light.
const HALFWAY: [f32; 3] = [-0.199, -0.298, 0.933];

/// How steep the surface looks. Chosen by eye.
const STEEPNESS: f32 = 2.2;

/// A cell of the surface: what is needed to draw the pixels in it.
#[derive(Clone, Copy, Default)]
struct Lit {
    /// Distance to the edge in pixels, positive inside, cut off a little beyond a pixel.
    depth: f32,
    colour: [f32; 3],
}

const CUT: f32 = 4.0;

/// The two cells between which a pixel lies, and the weight of the nearer one, are the same in every cell.
const NEAR: f32 = 0.75;
const FAR: f32 = 0.25;

pub(super) fn draw(canvas: &mut Canvas, field: &Field, liquid: Liquid) {
    let width = field.width;
    let mut above = lit_row(field, MARGIN - 1, liquid);
    let mut here = lit_row(field, MARGIN, liquid);
    let mut mixed = vec![Lit::default(); width];
    for row in MARGIN..field.height - MARGIN {
        let below = lit_row(field, row + 1, liquid);
        for (half, other) in [&above, &below].into_iter().enumerate() {
            let y = (row - MARGIN) * CELL + half;
            if y >= canvas.height() {
                break;
            }
            if other.wet || here.wet {
                for ((mixed, near), far) in mixed.iter_mut().zip(&here.cells).zip(&other.cells) {
                    *mixed = mix(near, far);
                }
                draw_row(canvas.row(y), &mixed, liquid.opacity);
            }
        }
        above = here;
        here = below;
    }
}

#[inline]
fn mix(near: &Lit, far: &Lit) -> Lit {
    Lit {
        depth: NEAR * near.depth + FAR * far.depth,
        colour: std::array::from_fn(|channel| {
            NEAR * near.colour[channel] + FAR * far.colour[channel]
        }),
    }
}

fn draw_row(pixels: &mut [[u8; 3]], cells: &[Lit], opacity: f32) {
    for (pair, three) in pixels.chunks_mut(CELL).zip(cells[MARGIN - 1..].windows(3)) {
        let [left, here, right] = [&three[0], &three[1], &three[2]];
        if left.depth.max(here.depth).max(right.depth) <= -CUT {
            continue;
        }
        for (pixel, other) in pair.iter_mut().zip([left, right]) {
            let Lit { depth, colour } = mix(here, other);
            let part = (depth + 0.5).clamp(0.0, 1.0);
            if part > 0.0 {
                blend(
                    pixel,
                    colour.map(|channel| (channel + 0.5) as u8),
                    (255.0 * part * opacity + 0.5) as u32,
                );
            }
        }
    }
}

struct Row {
    cells: Vec<Lit>,
    wet: bool,
}

/// Light one row of cells. Dry cells beside wet ones get a colour too, for the pixels between them.
fn lit_row(field: &Field, row: usize, liquid: Liquid) -> Row {
    let width = field.width;
    let dry = Lit {
        depth: -CUT,
        colour: [0.0; 3],
    };
    let mut cells = vec![dry; width];
    let mut wet = false;
    let start = row * width;
    for column in 1..width - 1 {
        let at = start + column;
        let density = field.density[at];
        if density < 0.02 {
            continue;
        }
        let slope_x = 0.5 * (field.density[at + 1] - field.density[at - 1]);
        let slope_y = 0.5 * (field.density[at + width] - field.density[at - width]);
        cells[column] = lit(field, at, [slope_x, slope_y], liquid);
        wet |= cells[column].depth > -CUT;
    }
    Row { cells, wet }
}

#[inline]
fn lit(field: &Field, at: usize, [slope_x, slope_y]: [f32; 2], liquid: Liquid) -> Lit {
    let density = field.density[at];
    let radius = field.radius[at] / density;
    let steep = (slope_x * slope_x + slope_y * slope_y).sqrt();
    // Where bumps meet the density is level: without a bound the edge there would be a blur.
    let per_pixel = steep.max(0.25 / radius.max(1.0)) / CELL as f32;
    let depth = ((density - THRESHOLD) / per_pixel).clamp(-CUT, CUT);

    // The deeper inside, the flatter: a film with a rounded rim, not a heap of bumps.
    let flatten = STEEPNESS * radius / (0.35 + density * density);
    let (x, y) = (-slope_x * flatten, -slope_y * flatten);
    let scale = 1.0 / (x * x + y * y + 1.0).sqrt();
    let [x, y, z] = [x * scale, y * scale, scale];
    let diffuse = (LIGHT[0] * x + LIGHT[1] * y + LIGHT[2] * z).max(0.0);
    let shine = (HALFWAY[0] * x + HALFWAY[1] * y + HALFWAY[2] * z).max(0.0);
    let shine = shine * shine;
    let shine = shine * shine * shine;
    let shine = shine * shine;
    let shine = shine * shine;

    let last = liquid.palette.len() - 1;
    let index = (field.value[at] / density * last as f32 + 0.5) as usize;
    let body = liquid.palette[index.min(last)];
    // The rim of a drop shows less light from below.
    let factor = 0.42 + 0.78 * diffuse * (0.35 + 0.65 * z);
    let colour = body.map(|channel| {
        (f32::from(channel) * factor + 120.0 * shine * (1.0 - z * z)).clamp(0.0, 255.0)
    });
    Lit { depth, colour }
}
