//! How much of a pixel a shape covers.

/// Lines per pixel row with which a small disc is measured.
const LINES: usize = 8;

/// Part of a unit square on the inner side of a straight edge.
///
/// `depth` is the distance of the square's centre from the edge, positive inside; (`x`, `y`) is the unit normal of the
/// edge, signs do not matter. Exact: the square seen along the normal is a trapezoid.
#[inline]
pub(crate) fn half_plane(depth: f64, x: f64, y: f64) -> f64 {
    let (x, y) = (x.abs(), y.abs());
    let (large, small) = if x > y { (x, y) } else { (y, x) };
    let reach = 0.5 * (large + small);
    let flat = 0.5 * (large - small);
    let away = depth.abs();
    let beyond = if away <= flat {
        0.5 - away / large
    } else if away < reach {
        let rest = reach - away;
        rest * rest / (2.0 * large * small)
    } else {
        0.0
    };
    if depth < 0.0 { beyond } else { 1.0 - beyond }
}

/// Mean distance of an arc from its tangent over one pixel, times the radius.
pub(crate) const CURVATURE: f64 = 1.0 / 24.0;

/// The least component of a normal that is told from nothing where one divides by it.
pub(crate) const FLATTEST: f32 = 0.01;

/// Part of the pixel whose centre is (`x`, `y`) from the centre of a disc that is covered by the disc.
///
/// The edge is taken as straight, moved inwards by what the arc bends away from it on the mean. For discs of at least `SMALL` and pixels that the edge can touch.
#[inline]
pub(crate) fn disc(x: f64, y: f64, radius: f64) -> f64 {
    let distance = (x * x + y * y).sqrt();
    half_plane(radius - distance - CURVATURE / radius, x / distance, y / distance)
}

/// Discs below this radius are smaller than the pixels' own structure, and measured by lines instead.
pub(crate) const SMALL: f64 = 2.0;

/// Half the diagonal of a pixel: beyond it from the edge, a pixel is wholly in or out.
pub(crate) const REACH: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// Coverage of up to `2 SMALL + 2` pixels of one row by a small disc centred at (`x`, `y`), as seen from the top left
/// corner of the first of these pixels.
///
/// Exact along x; along y, the mean of lines spread over the part of the row that the disc reaches.
pub(crate) fn small_disc_row(x: f64, y: f64, radius: f64) -> [f64; 6] {
    let mut row = [0.0; 6];
    let (top, bottom) = ((y - radius).max(0.0), (y + radius).min(1.0));
    let step = (bottom - top) / LINES as f64;
    if step <= 0.0 {
        return row;
    }
    for line in 0..LINES {
        let dy = top + (line as f64 + 0.5) * step - y;
        let half = (radius * radius - dy * dy).max(0.0).sqrt();
        let (left, right) = (x - half, x + half);
        for (column, coverage) in row.iter_mut().enumerate() {
            let start = column as f64;
            *coverage += (right.min(start + 1.0) - left.max(start)).max(0.0) * step;
        }
    }
    row
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// The area of the pixel at (`x`, `y`) from the centre inside the disc, by exact chords on 4,000 lines.
    pub(crate) fn area(x: f64, y: f64, radius: f64) -> f64 {
        let lines = 4000;
        let mut sum = 0.0;
        for line in 0..lines {
            let dy = y - 0.5 + (f64::from(line) + 0.5) / f64::from(lines);
            let half = (radius * radius - dy * dy).max(0.0).sqrt();
            sum += (half.min(x + 0.5) - (-half).max(x - 0.5)).max(0.0);
        }
        sum / f64::from(lines)
    }

    #[test]
    fn a_straight_edge_is_measured_exactly() {
        for degrees in 0..90 {
            let (y, x) = f64::from(degrees).to_radians().sin_cos();
            for step in -20..=20 {
                let depth = f64::from(step) / 20.0;
                // A disc so large that its edge is straight, through the wanted depth along the wanted normal.
                let radius = 1e6;
                let exact = area(x * (radius - depth), y * (radius - depth), radius);
                assert!(
                    (half_plane(depth, x, y) - exact).abs() < 1e-3,
                    "{degrees} {depth}"
                );
            }
        }
    }

    #[test]
    fn an_edge_pixel_of_a_disc_is_close_to_its_area() {
        let mut worst: f64 = 0.0;
        for radius in [2.0, 2.5, 3.3, 5.0, 12.0, 100.0] {
            for degrees in 0..90 {
                let (sin, cos) = f64::from(degrees).to_radians().sin_cos();
                for step in -14..=14 {
                    let distance = radius + f64::from(step) / 20.0;
                    let (x, y) = (distance * cos, distance * sin);
                    worst = worst.max((disc(x, y, radius) - area(x, y, radius)).abs());
                }
            }
        }
        assert!(worst < 0.03, "{worst}");
    }

    #[test]
    fn a_small_disc_is_close_to_its_area() {
        let mut worst: f64 = 0.0;
        for radius in [0.05, 0.3, 0.5, 0.9, 1.4, 1.99] {
            for (x, y) in [(2.5, 0.5), (2.1, 0.9), (2.7, -0.3), (2.0, 1.6), (2.9, -0.8)] {
                for (column, got) in small_disc_row(x, y, radius).iter().enumerate() {
                    worst = worst.max((got - area(column as f64 + 0.5 - x, 0.5 - y, radius)).abs());
                }
            }
        }
        assert!(worst < 0.015, "{worst}");
    }
}
