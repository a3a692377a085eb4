//! Recordings: rules, model, first state and inputs of a run, so that a machine without Python can run it again.

use crate::codec::{Reader, Writer};
use crate::{Error, Input, Model, Rules, World, read_inputs, write_inputs};

const MAGIC: &[u8; 4] = b"KGRE";
/// 2, 3: another checksum.
const VERSION: u32 = 3;
const WHAT: &str = "recording";

/// A run that can be made again.
pub struct Recording {
    /// The world as it was when the recording began.
    pub world: World,
    /// Inputs of each tick.
    pub ticks: Vec<Vec<Input>>,
}

impl Recording {
    /// As bytes.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut writer = Writer::new(MAGIC, VERSION);
        writer.bytes(&self.world.rules().to_bytes());
        let model = self.world.model();
        for name in [model.integrator().name, model.contacts(), model.broadphase()] {
            writer.bytes(name.as_bytes());
        }
        writer.u32(model.substeps());
        writer.f64(model.smallest_node().unwrap_or(0.0));
        writer.bytes(&self.world.snapshot());
        writer.count(self.ticks.len());
        for inputs in &self.ticks {
            writer.bytes(&write_inputs(inputs));
        }
        writer.seal()
    }

    /// From bytes.
    ///
    /// # Errors
    /// [`Error::Snapshot`] if they are damaged; [`Error::Model`] or [`Error::Scene`] for what this build cannot run.
    pub fn from_bytes(bytes: &[u8]) -> Result<Recording, Error> {
        let mut reader = Reader::open(bytes, MAGIC, VERSION, WHAT)?;
        let rules = Rules::from_bytes(reader.bytes()?)?;
        let mut name = || Ok::<_, Error>(String::from_utf8_lossy(reader.bytes()?).into_owned());
        let (integrator, contacts, broadphase) = (name()?, name()?, name()?);
        let substeps = reader.u32()?;
        let smallest_node = Some(reader.f64()?).filter(|&size| size != 0.0);
        let model = Model::new(&integrator, &contacts, &broadphase, substeps, smallest_node)?;
        let world = World::restore(rules, model, reader.bytes()?)?;
        let ticks = (0..reader.count(8)?)
            .map(|_| read_inputs(reader.bytes()?))
            .collect::<Result<_, _>>()?;
        reader.end()?;
        Ok(Recording { world, ticks })
    }
}
