//! Outlines of rectangles: the nodes of a quadtree, and the walls.

use crate::Colour;
use crate::canvas::{Canvas, blend, weight};

/// Blend outlines of rectangles (left, top, right, bottom) onto the picture, in order.
///
/// The line lies half inside and half outside of the rectangle's edge. Coverage is exact.
pub fn draw_rectangles(canvas: &mut Canvas, rectangles: &[[f64; 4]], thickness: f64, colours: &[Colour]) {
    let half = 0.5 * thickness;
    for (&[left, top, right, bottom], &colour) in rectangles.iter().zip(colours) {
        let finite = [left, top, right, bottom, half]
            .iter()
            .all(|number| number.is_finite());
        if !finite || half <= 0.0 || left > right || top > bottom {
            continue;
        }
        let (outer_left, outer_right) = (left - half, right + half);
        if right - left <= thickness || bottom - top <= thickness {
            fill_box(
                canvas,
                [outer_left, top - half, outer_right, bottom + half],
                colour,
            );
            continue;
        }
        // The corners belong to the horizontal bars alone: what is half transparent is not to be drawn twice.
        fill_box(canvas, [outer_left, top - half, outer_right, top + half], colour);
        fill_box(
            canvas,
            [outer_left, bottom - half, outer_right, bottom + half],
            colour,
        );
        fill_box(
            canvas,
            [outer_left, top + half, left + half, bottom - half],
            colour,
        );
        fill_box(
            canvas,
            [right - half, top + half, outer_right, bottom - half],
            colour,
        );
    }
}

fn fill_box(canvas: &mut Canvas, [left, top, right, bottom]: [f64; 4], [red, green, blue, opacity]: Colour) {
    let columns = canvas.columns(left, right);
    for row in canvas.rows(top, bottom) {
        let tall = overlap(row, top, bottom);
        let pixels = canvas.row(row);
        for column in columns.clone() {
            let part = tall * overlap(column, left, right);
            blend(&mut pixels[column], [red, green, blue], weight(part, opacity));
        }
    }
}

#[inline]
fn overlap(cell: usize, low: f64, high: f64) -> f64 {
    let start = cell as f64;
    (high.min(start + 1.0) - low.max(start)).max(0.0)
}
