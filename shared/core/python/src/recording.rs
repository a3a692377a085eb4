//! kuglice._core.recording.

use kuglice_step::{Recording, read_inputs};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::errors::raise;
use crate::world::World;

/// A run as bytes that the example `rerun` of kuglice-step can make again: the world as it is, then inputs per tick.
#[pyfunction]
pub fn recording<'py>(
    py: Python<'py>,
    world: PyRef<'_, World>,
    ticks: Vec<Vec<u8>>,
) -> PyResult<Bound<'py, PyBytes>> {
    let ticks = ticks
        .iter()
        .map(|inputs| read_inputs(inputs))
        .collect::<Result<_, _>>();
    let recording = Recording {
        world: world.inner.clone(),
        ticks: ticks.map_err(|error| raise(py, &error))?,
    };
    Ok(PyBytes::new(py, &recording.to_bytes()))
}
