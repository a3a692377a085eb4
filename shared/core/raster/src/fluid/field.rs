//! The density of the liquid on a grid of half the picture's resolution.

/// Pixels per cell, each way.
pub(super) const CELL: usize = 2;

/// Cells around the picture, so that every pixel lies between four cell centres and every drawn cell has neighbours.
pub(super) const MARGIN: usize = 2;

/// Radius of a ball's bump, in radii of the ball.
const SPREAD: f64 = 3.6;

/// Height of a bump at the ball's own rim: (1 - 1 / SPREAD^2)^3.
pub(super) const THRESHOLD: f32 = 0.785_92;

/// No bump is narrower than this, in cells, or it could fall between the cells.
const NARROWEST: f64 = 1.8;

pub(super) struct Field {
    pub width: usize,
    pub height: usize,
    /// Sum of the bumps.
    pub density: Vec<f32>,
    /// Sum of the bumps, each times its ball's value.
    pub value: Vec<f32>,
    /// Sum of the bumps, each times its ball's radius in cells.
    pub radius: Vec<f32>,
}

impl Field {
    pub fn new(width: usize, height: usize) -> Self {
        let width = width.div_ceil(CELL) + 2 * MARGIN;
        let height = height.div_ceil(CELL) + 2 * MARGIN;
        let zeros = vec![0.0; width * height];
        Self {
            width,
            height,
            density: zeros.clone(),
            value: zeros.clone(),
            radius: zeros,
        }
    }

    /// Add the bump (1 - d^2 / R^2)^3 of one ball, whose centre and radius are in pixels.
    pub fn add(&mut self, center: [f64; 2], radius: f64, value: f32) {
        let cell = CELL as f64;
        let [x, y] = center.map(|pixels| pixels / cell + MARGIN as f64);
        if !(x.is_finite() && y.is_finite() && radius.is_finite() && radius > 0.0) {
            return;
        }
        let reach = (SPREAD * radius / cell).max(NARROWEST);
        let (left, right) = span(x, reach, self.width);
        let (top, bottom) = span(y, reach, self.height);
        let scale = (1.0 / reach) as f32;
        let radius = (radius / cell) as f32;
        let first = ((left as f64 + 0.5 - x) / reach) as f32;
        for row in top..bottom {
            let v = ((row as f64 + 0.5 - y) / reach) as f32;
            let rest = 1.0 - v * v;
            let cells = row * self.width + left..row * self.width + right;
            let density = &mut self.density[cells.clone()];
            let values = &mut self.value[cells.clone()];
            let radii = &mut self.radius[cells];
            for (column, ((density, sum), radii)) in density.iter_mut().zip(values).zip(radii).enumerate() {
                let u = first + column as f32 * scale;
                let near = (rest - u * u).max(0.0);
                let bump = near * near * near;
                *density += bump;
                *sum += bump * value;
                *radii += bump * radius;
            }
        }
    }
}

fn span(middle: f64, reach: f64, end: usize) -> (usize, usize) {
    let first = ((middle - reach - 0.5).ceil().max(0.0) as usize).min(end);
    let last = (((middle + reach - 0.5).floor() + 1.0).max(0.0) as usize).clamp(first, end);
    (first, last)
}
