//! Line segments with round ends: trails.

use crate::Colour;
use crate::canvas::{Canvas, blend, weight};

/// Blend line segments onto the picture, in order: everything within half of a segment's thickness.
///
/// With `lighten`, each channel becomes the larger of what is there and the colour times its weight, so that where
/// the segments of a trail meet it is no brighter than elsewhere. The coverage of a pixel is taken from the distance of its centre, so it is right to about a tenth of a pixel.
pub fn draw_segments(
    canvas: &mut Canvas,
    starts: &[[f64; 2]],
    ends: &[[f64; 2]],
    thickness: &[f64],
    colours: &[Colour],
    lighten: bool,
) {
    for (((&start, &end), &thickness), &colour) in starts.iter().zip(ends).zip(thickness).zip(colours) {
        let finite = start
            .iter()
            .chain(&end)
            .chain([&thickness])
            .all(|number| number.is_finite());
        if finite && thickness > 0.0 {
            draw_segment(canvas, [start, end], 0.5 * thickness, colour, lighten);
        }
    }
}

fn draw_segment(canvas: &mut Canvas, [start, end]: [[f64; 2]; 2], half: f64, colour: Colour, lighten: bool) {
    let [red, green, blue, opacity] = colour;
    let [run, rise] = [end[0] - start[0], end[1] - start[1]];
    let square = run * run + rise * rise;
    let scale = if square > 0.0 { 1.0 / square } else { 0.0 };
    let reach = half + 0.5;
    // A line thinner than a pixel is drawn as one of a pixel, fainter by as much.
    let full = (2.0 * half).min(1.0);
    let low = start[1].min(end[1]) - reach;
    let high = start[1].max(end[1]) + reach;
    for row in canvas.rows(low, high) {
        let y = row as f64 + 0.5;
        // Only the part of the segment that is within reach of this row can touch it.
        let (mut first, mut last) = (0.0, 1.0);
        if rise != 0.0 {
            let one = (y - reach - start[1]) / rise;
            let two = (y + reach - start[1]) / rise;
            first = one.min(two).clamp(0.0, 1.0);
            last = one.max(two).clamp(0.0, 1.0);
        }
        let (one, two) = (start[0] + first * run, start[0] + last * run);
        let columns = canvas.columns(one.min(two) - reach, one.max(two) + reach);
        let pixels = canvas.row(row);
        for column in columns {
            let [dx, dy] = [column as f64 + 0.5 - start[0], y - start[1]];
            let along = ((dx * run + dy * rise) * scale).clamp(0.0, 1.0);
            let [dx, dy] = [dx - along * run, dy - along * rise];
            let part = (reach - (dx * dx + dy * dy).sqrt()).clamp(0.0, full);
            let weight = weight(part, opacity);
            if lighten {
                let pixel = &mut pixels[column];
                for (channel, new) in pixel.iter_mut().zip([red, green, blue]) {
                    *channel = (*channel).max((u32::from(new) * weight / 255) as u8);
                }
            } else {
                blend(&mut pixels[column], [red, green, blue], weight);
            }
        }
    }
}
