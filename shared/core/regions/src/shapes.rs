//! Radius and mass: told by their place in a table that both ends know, else as numbers.

use std::collections::HashMap;
use std::f64::consts::PI;

use crate::Error;
use crate::bits::{Reader, width, write_bits, write_varint};

/// Shapes in a table, at the most.
pub const MOST_SHAPES: usize = 256;

/// How the shapes of a message are told.
const ONE: u8 = 0;
const LISTED: u8 = 1;
const EACH: u8 = 2;

/// How one shape is told where each says that for itself.
const PLACE: u64 = 0;
const RADIUS: u64 = 1;
const NUMBERS: u64 = 2;
const WAY_BITS: u32 = 2;

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

    /// As one place for all, a place for each, or each in its own way: by its place, as a radius rounded to f32 from which
    /// the mass follows, or as numbers.
    pub(crate) fn write(&self, out: &mut Vec<u8>, shapes: &[Shape]) {
        if let (&[only], Some(&first)) = (&self.listed[..], shapes.first())
            && shapes.iter().all(|&shape| shape == first)
            && only == first
        {
            // The one case that is common in large worlds needs no look into the table.
            out.push(ONE);
            write_varint(out, 0);
            return;
        }
        let place = |&(r, m): &Shape| self.places.get(&(r.to_bits(), m.to_bits())).copied();
        let places: Vec<Option<u64>> = shapes.iter().map(place).collect();
        let known = || places.iter().flatten().copied();
        if known().count() < shapes.len() {
            out.push(EACH);
            let ways: Vec<u64> = shapes
                .iter()
                .zip(&places)
                .map(|(shape, place)| way(shape, *place))
                .collect();
            write_bits(out, ways.iter().copied(), WAY_BITS);
            write_bits(out, known(), self.place_bits());
            let told = |wanted| shapes.iter().zip(&ways).filter(move |&(_, &way)| way == wanted);
            for (&(radius, _), _) in told(RADIUS) {
                out.extend_from_slice(&(radius as f32).to_le_bytes());
            }
            for (&(radius, mass), _) in told(NUMBERS) {
                out.extend_from_slice(&radius.to_le_bytes());
                out.extend_from_slice(&mass.to_le_bytes());
            }
        } else if known().all(|other| Some(other) == places[0]) {
            out.push(ONE);
            write_varint(out, known().next().unwrap_or(0));
        } else {
            out.push(LISTED);
            write_bits(out, known(), self.place_bits());
        }
    }

    pub(crate) fn read(&self, reader: &mut Reader<'_>, count: usize) -> Result<Vec<Shape>, Error> {
        match reader.byte()? {
            ONE => Ok(vec![self.listed(reader.varint()?)?; count]),
            LISTED => self.read_places(reader, count),
            EACH => self.read_each(reader, count),
            other => Err(Error(format!("shapes of kind {other}, the last is {EACH}"))),
        }
    }

    fn read_each(&self, reader: &mut Reader<'_>, count: usize) -> Result<Vec<Shape>, Error> {
        let ways = reader.bits(count, WAY_BITS)?;
        let told = |wanted| ways.iter().filter(|&&way| way == wanted).count();
        if told(PLACE) + told(RADIUS) + told(NUMBERS) < count {
            return Err(Error("a shape that is told in no known way".into()));
        }
        let mut places = self.read_places(reader, told(PLACE))?.into_iter();
        let mut radii = reader.take(4 * told(RADIUS))?.as_chunks::<4>().0.iter();
        let mut numbers = reader.take(16 * told(NUMBERS))?.as_chunks::<8>().0.iter();
        let shape = |way: u64| -> Option<Shape> {
            match way {
                PLACE => places.next(),
                RADIUS => {
                    let radius = f64::from(f32::from_le_bytes(*radii.next()?));
                    Some((radius, PI * radius * radius))
                }
                _ => {
                    let (radius, mass) = (numbers.next()?, numbers.next()?);
                    Some((f64::from_le_bytes(*radius), f64::from_le_bytes(*mass)))
                }
            }
        };
        let shapes: Option<Vec<Shape>> = ways.iter().copied().map(shape).collect();
        shapes.ok_or_else(|| Error("fewer shapes than balls".into()))
    }

    fn read_places(&self, reader: &mut Reader<'_>, count: usize) -> Result<Vec<Shape>, Error> {
        let places = reader.bits(count, self.place_bits())?;
        places.into_iter().map(|place| self.listed(place)).collect()
    }

    fn listed(&self, place: u64) -> Result<Shape, Error> {
        let found = usize::try_from(place)
            .ok()
            .and_then(|place| self.listed.get(place));
        found
            .copied()
            .ok_or_else(|| Error(format!("shape {place} of {}", self.listed.len())))
    }

    fn place_bits(&self) -> u32 {
        width((self.listed.len() as u64).saturating_sub(1))
    }
}

fn way(&(radius, mass): &Shape, place: Option<u64>) -> u64 {
    match place {
        Some(_) => PLACE,
        None if mass == PI * radius * radius && (radius as f32).is_normal() => RADIUS,
        None => NUMBERS,
    }
}
