//! Radius and mass: told by their place in a table that both ends know, else as numbers.

use std::collections::HashMap;
use std::f64::consts::PI;

use crate::Error;
use crate::bits::{Reader, width, write_bits, write_varint};

/// Shapes in a table, at the most.
pub const MOST_SHAPES: usize = 256;

const ONE: u8 = 0;
const LISTED: u8 = 1;
const RADII: u8 = 2;
const NUMBERS: u8 = 3;

/// Radius and mass.
pub type Shape = (f64, f64);

/// The table.
#[derive(Clone, Debug, Default)]
pub struct Shapes {
    listed: Vec<Shape>,
    places: HashMap<(u64, u64), u64>,
}

impl Shapes {
    /// A table of these shapes, which are checked as those of balls.
    ///
    /// # Errors
    /// [`Error`] if there are more than [`MOST_SHAPES`].
    pub fn new(listed: &[Shape]) -> Result<Shapes, Error> {
        if listed.len() > MOST_SHAPES {
            return Err(Error(format!("{} shapes, at most {MOST_SHAPES}", listed.len())));
        }
        let places = listed.iter().map(|&(r, m)| (r.to_bits(), m.to_bits())).zip(0..);
        Ok(Shapes {
            listed: listed.to_vec(),
            places: places.collect(),
        })
    }

    /// As one place for all, a place for each, radii rounded to f32 whose masses follow from them, or numbers: the
    /// first of these that can say it.
    pub(crate) fn write(&self, out: &mut Vec<u8>, shapes: &[Shape]) {
        let place = |&(r, m): &Shape| self.places.get(&(r.to_bits(), m.to_bits())).copied();
        if let Some(places) = shapes.iter().map(place).collect::<Option<Vec<u64>>>() {
            if places.iter().all(|&other| Some(&other) == places.first()) {
                out.push(ONE);
                write_varint(out, places.first().copied().unwrap_or(0));
            } else {
                let wide = width(self.listed.len() as u64 - 1);
                out.push(LISTED);
                write_bits(out, places.into_iter(), wide);
            }
        } else if shapes
            .iter()
            .all(|&(r, m)| m == PI * r * r && (r as f32).is_normal())
        {
            out.push(RADII);
            for &(radius, _) in shapes {
                out.extend_from_slice(&(radius as f32).to_le_bytes());
            }
        } else {
            out.push(NUMBERS);
            for &(radius, mass) in shapes {
                out.extend_from_slice(&radius.to_le_bytes());
                out.extend_from_slice(&mass.to_le_bytes());
            }
        }
    }

    pub(crate) fn read(&self, reader: &mut Reader<'_>, count: usize) -> Result<Vec<Shape>, Error> {
        let listed = |place: u64| {
            usize::try_from(place)
                .ok()
                .and_then(|place| self.listed.get(place).copied())
                .ok_or_else(|| Error(format!("shape {place} of {}", self.listed.len())))
        };
        match reader.byte()? {
            ONE => Ok(vec![listed(reader.varint()?)?; count]),
            LISTED => {
                let wide = width((self.listed.len() as u64).saturating_sub(1));
                reader.bits(count, wide)?.into_iter().map(listed).collect()
            }
            RADII => {
                let (numbers, _) = reader.take(4 * count)?.as_chunks::<4>();
                let radii = numbers.iter().map(|&bytes| f64::from(f32::from_le_bytes(bytes)));
                Ok(radii.map(|radius| (radius, PI * radius * radius)).collect())
            }
            NUMBERS => {
                let (numbers, _) = reader.take(16 * count)?.as_chunks::<8>();
                let numbers: Vec<f64> = numbers.iter().map(|&bytes| f64::from_le_bytes(bytes)).collect();
                Ok(numbers.chunks_exact(2).map(|pair| (pair[0], pair[1])).collect())
            }
            other => Err(Error(format!("shapes of kind {other}, the last is {NUMBERS}"))),
        }
    }
}
