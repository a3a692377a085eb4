//! From density to a lit surface with a smooth edge.

use std::ops::Range;

use super::Liquid;
use super::field::{CELL, Field, MARGIN, THRESHOLD};
use crate::block::round;
use crate::canvas::Canvas;

/// Light from the top left, towards the one who looks; a unit vector.
const LIGHT: [f32; 3] = [-0.371, -0.557, 0.743];

/// Half way between the light and the one who looks: where a mirror would show the light.
const HALFWAY: [f32; 3] = [-0.199, -0.298, 0.933];

/// How steep the surface looks. Chosen by eye.
const STEEPNESS: f32 = 3.0;

/// Cells with less than this are dry, and so are their pixels.
const DRY: f32 = 0.02;

/// Distances from the edge are cut off at this many pixels.
const CUT: f32 = 4.0;

/// A pixel lies a quarter of a cell away from the centre of its own cell: weights of this and of the next one.
const NEAR: f32 = 0.75;
const FAR: f32 = 0.25;

/// One row of cells, lit.
#[derive(Clone, Default)]
struct Row {
    /// Distance to the edge in pixels, positive inside.
    depth: Vec<f32>,
    /// Red, green and blue of every cell.
    colour: Vec<f32>,
    /// The cells that are not dry.
    wet: Range<usize>,
}

pub(super) fn draw(canvas: &mut Canvas, field: &Field, liquid: Liquid) {
    let palette: Vec<[f32; 3]> = liquid
        .palette
        .iter()
        .map(|colour| colour.map(f32::from))
        .collect();
    let [first, top, last, bottom] = liquid.window.unwrap_or([0, 0, canvas.width(), canvas.height()]);
    let columns = first.min(last)..last.min(canvas.width());
    let lines = top..bottom.min(canvas.height());
    let mut brush = Brush::new(field.width, columns, liquid.opacity);
    let mut rows = [Row::default(), Row::default(), Row::default()];
    light(&mut rows[1], field, MARGIN - 1, &palette);
    light(&mut rows[2], field, MARGIN, &palette);
    for row in MARGIN..field.height - MARGIN {
        rows.rotate_left(1);
        light(&mut rows[2], field, row + 1, &palette);
        let top = (row - MARGIN) * CELL;
        for (y, next) in (top..top + CELL).zip([&rows[0], &rows[2]]) {
            if lines.contains(&y) {
                brush.draw(canvas.row(y), &rows[1], next);
            }
        }
    }
}

/// Rows between rows and cells between cells, kept so that a frame allocates once.
struct Brush {
    depth: Vec<f32>,
    colour: Vec<f32>,
    /// Columns that may get wet.
    columns: Range<usize>,
    opacity: f32,
}

impl Brush {
    fn new(width: usize, columns: Range<usize>, opacity: f32) -> Self {
        Self {
            depth: vec![-CUT; width],
            colour: vec![0.0; 3 * width],
            columns,
            opacity,
        }
    }

    /// Draw the row of pixels that lies in the row of cells `here`, on the side of `next`.
    fn draw(&mut self, pixels: &mut [[u8; 3]], here: &Row, next: &Row) {
        let wet = hull(&here.wet, &next.wet);
        // A pixel also looks at the cell beside its own.
        let wet = wet.start.saturating_sub(1)..(wet.end + 1).min(self.depth.len());
        if wet.len() < 3 {
            return;
        }
        mix(
            &mut self.depth[wet.clone()],
            &here.depth[wet.clone()],
            &next.depth[wet.clone()],
        );
        let bytes = 3 * wet.start..3 * wet.end;
        mix(
            &mut self.colour[bytes.clone()],
            &here.colour[bytes.clone()],
            &next.colour[bytes],
        );

        let first = (wet.start + 1).max(MARGIN);
        let last = (wet.end - 1).min(self.depth.len() - MARGIN);
        for cell in first..last {
            let depth = [self.depth[cell - 1], self.depth[cell], self.depth[cell + 1]];
            if depth[0].max(depth[1]).max(depth[2]) <= -CUT {
                continue;
            }
            let colour = &self.colour[3 * cell - 3..3 * cell + 6];
            let column = CELL * (cell - MARGIN);
            for (column, side) in [(column, 0), (column + 1, 2)] {
                if !self.columns.contains(&column) {
                    continue;
                }
                let pixel = &mut pixels[column];
                let part = (NEAR * depth[1] + FAR * depth[side] + 0.5).clamp(0.0, 1.0) * self.opacity;
                for (channel, byte) in pixel.iter_mut().enumerate() {
                    let new = NEAR * colour[3 + channel] + FAR * colour[3 * side + channel];
                    let old = f32::from(*byte);
                    *byte = round(old + (new - old) * part);
                }
            }
        }
    }
}

/// The smallest range that holds both.
fn hull(one: &Range<usize>, two: &Range<usize>) -> Range<usize> {
    match (one.is_empty(), two.is_empty()) {
        (true, _) => two.clone(),
        (_, true) => one.clone(),
        _ => one.start.min(two.start)..one.end.max(two.end),
    }
}

fn mix(mixed: &mut [f32], near: &[f32], far: &[f32]) {
    for ((mixed, near), far) in mixed.iter_mut().zip(near).zip(far) {
        *mixed = NEAR * near + FAR * far;
    }
}

/// Light one row of cells.
fn light(lit: &mut Row, field: &Field, row: usize, palette: &[[f32; 3]]) {
    let width = field.width;
    lit.depth.clear();
    lit.depth.resize(width, -CUT);
    lit.colour.resize(3 * width, 0.0);
    let start = row * width;
    let density = &field.density[start..start + width];
    lit.wet = wet(density);
    if lit.wet.is_empty() {
        return;
    }
    let above = &field.density[start - width..start];
    let below = &field.density[start + width..start + 2 * width];
    let (values, radii) = (
        &field.value[start..start + width],
        &field.radius[start..start + width],
    );
    let last = (palette.len() - 1) as f32;
    for cell in lit.wet.clone() {
        let here = density[cell].max(DRY);
        let radius = radii[cell] / here;
        let slope_x = 0.5 * (density[cell + 1] - density[cell - 1]);
        let slope_y = 0.5 * (below[cell] - above[cell]);
        let steep = (slope_x * slope_x + slope_y * slope_y).sqrt();
        // Where bumps meet the density is level: without a bound the edge there would be a blur.
        let per_pixel = steep.max(0.25 / radius.max(1.0)) / CELL as f32;
        lit.depth[cell] = ((here - THRESHOLD) / per_pixel).clamp(-CUT, CUT);

        let [factor, shine] = lights(slope_x, slope_y, radius, here);
        // The first byte of 2^23 + x is x rounded, and values stay within 0 and 1.
        let index = (values[cell] / here * last).clamp(0.0, last) + 8_388_608.0;
        let body = palette[(index.to_bits() & 0x007f_ffff) as usize];
        for (channel, colour) in body.into_iter().zip(&mut lit.colour[3 * cell..3 * cell + 3]) {
            *colour = (channel * factor + shine).min(255.0);
        }
    }
}

/// What the light makes of a slope: a factor for the colour of the body, and a highlight.
#[inline]
fn lights(slope_x: f32, slope_y: f32, radius: f32, density: f32) -> [f32; 2] {
    // The deeper inside, the flatter: a film with a rounded rim, not a heap of bumps.
    let flatten = STEEPNESS * radius / (0.3 + density * density * density);
    let (x, y) = (-slope_x * flatten, -slope_y * flatten);
    let z = 1.0 / (x * x + y * y + 1.0).sqrt();
    let (x, y) = (x * z, y * z);
    let diffuse = (LIGHT[0] * x + LIGHT[1] * y + LIGHT[2] * z).max(0.0);
    let shine = (HALFWAY[0] * x + HALFWAY[1] * y + HALFWAY[2] * z).max(0.0);
    let shine = shine * shine;
    let shine = shine * shine * shine;
    let shine = shine * shine;
    let shine = shine * shine;
    // The rim of a drop shows less light from below.
    let factor = 0.42 + 0.78 * diffuse * (0.35 + 0.65 * z);
    [factor, 150.0 * shine * (1.0 - z * z)]
}

/// From the first to the last cell that is not dry, the outermost cells left out.
fn wet(density: &[f32]) -> Range<usize> {
    let inside = 1..density.len() - 1;
    let first = inside.clone().find(|&cell| density[cell] > DRY);
    let last = inside.clone().rev().find(|&cell| density[cell] > DRY);
    match (first, last) {
        (Some(first), Some(last)) => first..last + 1,
        _ => 0..0,
    }
}
