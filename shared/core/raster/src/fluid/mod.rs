//! Balls as one smooth liquid surface.
//!
//! Every ball adds a soft bump to a density on a coarse grid; where the density passes the height that a lone ball has
//! at its own rim, there is liquid. So a lone ball is a drop of its own radius, and close balls melt together
//! ("metaballs": J. Blinn, A Generalization of Algebraic Surface Drawing, 1982). The slope of the density is taken as
//! the slope of the surface and lit.

mod field;
mod surface;

use crate::canvas::Canvas;
use field::Field;

/// What the liquid looks like.
#[derive(Clone, Copy, Debug)]
pub struct Liquid<'a> {
    /// Colours for values from 0 to 1, at even steps; at least one.
    pub palette: &'a [[u8; 3]],
    /// Opacity of its body, 0 to 1.
    pub opacity: f32,
    /// First column, first row, last column + 1, last row + 1 of the part of the picture that may get wet.
    pub window: Option<[usize; 4]>,
}

/// Blend the liquid that balls make onto the picture.
///
/// `values`, one per ball, are mixed by nearness and choose the colour from the palette.
pub fn draw_fluid(canvas: &mut Canvas, centers: &[[f64; 2]], radii: &[f64], values: &[f32], liquid: Liquid) {
    if liquid.palette.is_empty() || canvas.width() == 0 || canvas.height() == 0 {
        return;
    }
    let mut field = Field::new(canvas.width(), canvas.height());
    for ((&center, &radius), &value) in centers.iter().zip(radii).zip(values) {
        field.add(center, radius, value);
    }
    surface::draw(canvas, &field, liquid);
}
