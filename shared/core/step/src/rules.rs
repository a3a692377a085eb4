//! Rules: what never changes in a world.

use std::sync::Arc;

use crate::codec::{Reader, Writer};
use crate::error::Shown;
use crate::force::{self, Force};
use crate::{Error, State};

const MAGIC: &[u8; 4] = b"KGRU";
/// 2, 3: another checksum.
const VERSION: u32 = 3;
const WHAT: &str = "rules of a world";

/// Box, walls, restitution, tick rate and forces of a world.
#[derive(Clone, Debug)]
pub struct Rules {
    bounds: [f64; 4],
    walls: bool,
    restitution: f64,
    tick_rate: f64,
    forces: Vec<Arc<dyn Force>>,
    named: Vec<(String, Vec<f64>)>,
}

impl Rules {
    /// `bounds` are left, bottom, right, top; `forces` are names and numbers as [`force::KINDS`] lists them.
    ///
    /// # Errors
    /// [`Error::Scene`] naming the number that is out of bounds.
    pub fn new(
        bounds: [f64; 4],
        walls: bool,
        restitution: f64,
        tick_rate: f64,
        forces: &[(&str, &[f64])],
    ) -> Result<Rules, Error> {
        let [left, bottom, right, top] = bounds;
        if !(bounds.iter().all(|side| side.is_finite()) && left < right && bottom < top) {
            return Err(Error::Scene(format!(
                "box is {bounds:?}, it must be finite with left < right and bottom < top"
            )));
        }
        if !(0.0..=1.0).contains(&restitution) {
            return Err(Error::Scene(format!(
                "restitution is {}, it must be in [0, 1]",
                Shown(restitution)
            )));
        }
        if !(tick_rate.is_finite() && tick_rate > 0.0) {
            return Err(Error::Scene(format!(
                "tick_rate is {}, it must be above 0 and finite",
                Shown(tick_rate)
            )));
        }
        let named = forces
            .iter()
            .map(|(name, numbers)| ((*name).to_owned(), numbers.to_vec()))
            .collect();
        let forces = forces
            .iter()
            .map(|(name, numbers)| force::make(name, numbers))
            .collect::<Result<_, _>>()?;
        Ok(Rules {
            bounds,
            walls,
            restitution,
            tick_rate,
            forces,
            named,
        })
    }

    /// The box: left, bottom, right, top.
    #[must_use]
    pub fn bounds(&self) -> [f64; 4] {
        self.bounds
    }

    /// Whether the box has walls.
    #[must_use]
    pub fn walls(&self) -> bool {
        self.walls
    }

    /// Restitution of balls and walls.
    #[must_use]
    pub fn restitution(&self) -> f64 {
        self.restitution
    }

    /// Ticks per second.
    #[must_use]
    pub fn tick_rate(&self) -> f64 {
        self.tick_rate
    }

    /// The forces, in the order in which they are added up.
    #[must_use]
    pub fn forces(&self) -> &[Arc<dyn Force>] {
        &self.forces
    }

    /// Simulated seconds of a state.
    #[must_use]
    pub fn time(&self, state: &State) -> f64 {
        state.time(self.tick_rate)
    }

    /// As bytes, for recordings and for machines without Python.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut writer = Writer::new(MAGIC, VERSION);
        for side in self.bounds {
            writer.f64(side);
        }
        writer.u8(u8::from(self.walls));
        writer.f64(self.restitution);
        writer.f64(self.tick_rate);
        writer.count(self.named.len());
        for (name, numbers) in &self.named {
            writer.bytes(name.as_bytes());
            writer.count(numbers.len());
            for &number in numbers {
                writer.f64(number);
            }
        }
        writer.seal()
    }

    /// From bytes.
    ///
    /// # Errors
    /// [`Error::Snapshot`] if the bytes are damaged, [`Error::Scene`] if the rules are out of bounds.
    pub fn from_bytes(bytes: &[u8]) -> Result<Rules, Error> {
        let mut reader = Reader::open(bytes, MAGIC, VERSION, WHAT)?;
        let bounds = [reader.f64()?, reader.f64()?, reader.f64()?, reader.f64()?];
        let walls = reader.u8()? != 0;
        let (restitution, tick_rate) = (reader.f64()?, reader.f64()?);
        let mut named = Vec::new();
        for _ in 0..reader.count(16)? {
            let name = String::from_utf8_lossy(reader.bytes()?).into_owned();
            let numbers = (0..reader.count(8)?)
                .map(|_| reader.f64())
                .collect::<Result<Vec<f64>, Error>>()?;
            named.push((name, numbers));
        }
        reader.end()?;
        let forces: Vec<(&str, &[f64])> = named
            .iter()
            .map(|(name, n)| (name.as_str(), n.as_slice()))
            .collect();
        Rules::new(bounds, walls, restitution, tick_rate, &forces)
    }
}
