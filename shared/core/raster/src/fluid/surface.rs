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
    /// What the light does to a cell: times, plus.
    factor: Vec<f32>,
    shine: Vec<f32>,
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

/// Draws rows of pixels; it keeps its rows of numbers so that a frame allocates them once.
struct Brush {
    /// Between two rows of cells.
    depth: Vec<f32>,
    colour: Vec<f32>,
    /// For the two pixels of each cell: how much of the pixel is wet, and its colour.
    sides: [Side; 2],
    /// Columns that may get wet.
    columns: Range<usize>,
    opacity: f32,
}

struct Side {
    part: Vec<f32>,
    colour: Vec<f32>,
}

impl Side {
    fn new(width: usize) -> Self {
        Self {
            part: vec![0.0; width],
            colour: vec![0.0; 3 * width],
        }
    }
}

impl Brush {
    fn new(width: usize, columns: Range<usize>, opacity: f32) -> Self {
        Self {
            depth: vec![-CUT; width],
            colour: vec![0.0; 3 * width],
            sides: [Side::new(width), Side::new(width)],
            columns,
            opacity,
        }
    }

    /// Draw the row of pixels that lies in the row of cells `here`, on the side of `next`.
    fn draw(&mut self, pixels: &mut [[u8; 3]], here: &Row, next: &Row) {
        let wet = hull(&here.wet, &next.wet);
        if wet.is_empty() {
            return;
        }
        // Beyond the wet cells lies at least one more on either side, at which a pixel also looks.
        let cells = wet.start - 1..wet.end + 1;
        let bytes = 3 * cells.start..3 * cells.end;
        mix(&mut self.depth, &here.depth, &next.depth, cells.clone(), 0);
        mix(&mut self.colour, &here.colour, &next.colour, bytes, 0);

        let cells = wet.start.max(MARGIN)..wet.end.min(self.depth.len() - MARGIN);
        for (side, offset) in self.sides.iter_mut().zip([-1, 1]) {
            let bytes = 3 * cells.start..3 * cells.end;
            mix(&mut side.part, &self.depth, &self.depth, cells.clone(), offset);
            mix(&mut side.colour, &self.colour, &self.colour, bytes, 3 * offset);
            for part in &mut side.part[cells.clone()] {
                *part = (*part + 0.5).clamp(0.0, 1.0) * self.opacity;
            }
        }
        let [left, right] = &self.sides;
        for cell in cells {
            if left.part[cell] + right.part[cell] == 0.0 {
                continue;
            }
            let column = CELL * (cell - MARGIN);
            for (column, side) in [(column, left), (column + 1, right)] {
                if self.columns.contains(&column) {
                    let part = side.part[cell];
                    let colour = &side.colour[3 * cell..3 * cell + 3];
                    for (byte, new) in pixels[column].iter_mut().zip(colour) {
                        let old = f32::from(*byte);
                        *byte = round(old + (new - old) * part);
                    }
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

/// `mixed[k] = NEAR near[k] + FAR far[k + offset]` for k in the range.
fn mix(mixed: &mut [f32], near: &[f32], far: &[f32], range: Range<usize>, offset: isize) {
    let shifted = range.start.wrapping_add_signed(offset)..range.end.wrapping_add_signed(offset);
    let numbers = near[range.clone()].iter().zip(&far[shifted]);
    for (mixed, (near, far)) in mixed[range].iter_mut().zip(numbers) {
        *mixed = NEAR * near + FAR * far;
    }
}

/// Light one row of cells.
fn light(lit: &mut Row, field: &Field, row: usize, palette: &[[f32; 3]]) {
    let width = field.width;
    lit.depth.clear();
    lit.depth.resize(width, -CUT);
    lit.colour.resize(3 * width, 0.0);
    lit.factor.resize(width, 0.0);
    lit.shine.resize(width, 0.0);
    let start = row * width;
    lit.wet = wet(&field.density[start..start + width]);
    if lit.wet.is_empty() {
        return;
    }
    // Each of these is a row of the same length, so that the loop needs no checks and runs over many cells at once.
    let (first, count) = (start + lit.wet.start, lit.wet.len());
    let here = &field.density[first..first + count];
    let left = &field.density[first - 1..first - 1 + count];
    let right = &field.density[first + 1..first + 1 + count];
    let above = &field.density[first - width..first - width + count];
    let below = &field.density[first + width..first + width + count];
    let radii = &field.radius[first..first + count];
    let depth = &mut lit.depth[lit.wet.clone()];
    let factor = &mut lit.factor[lit.wet.clone()];
    let shine = &mut lit.shine[lit.wet.clone()];
    for cell in 0..count {
        let density = here[cell].max(DRY);
        let radius = radii[cell] / density;
        let slope_x = 0.5 * (right[cell] - left[cell]);
        let slope_y = 0.5 * (below[cell] - above[cell]);
        let steep = (slope_x * slope_x + slope_y * slope_y).sqrt();
        // Where bumps meet the density is level: without a bound the edge there would be a blur.
        let per_pixel = steep.max(0.25 / radius.max(1.0)) / CELL as f32;
        depth[cell] = ((density - THRESHOLD) / per_pixel).clamp(-CUT, CUT);
        [factor[cell], shine[cell]] = lights(slope_x, slope_y, radius, density);
    }

    let values = &field.value[first..first + count];
    let last = palette.len() - 1;
    let colours = lit.colour[3 * lit.wet.start..3 * lit.wet.end].chunks_exact_mut(3);
    for (cell, colour) in colours.enumerate() {
        let index = (values[cell] / here[cell].max(DRY) * last as f32 + 0.5) as usize;
        for (channel, body) in colour.iter_mut().zip(palette[index.min(last)]) {
            *channel = (body * factor[cell] + shine[cell]).min(255.0);
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
