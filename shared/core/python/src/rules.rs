//! kuglice._core.Rules.

use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::errors::raise;

/// What never changes in a world: box, walls, restitution, tick rate, forces.
#[pyclass(frozen, module = "kuglice._core")]
pub struct Rules {
    pub inner: kuglice_step::Rules,
}

#[pymethods]
impl Rules {
    #[new]
    #[pyo3(signature = (*, r#box, walls, restitution, tick_rate, forces))]
    fn new(
        py: Python<'_>,
        r#box: [f64; 4],
        walls: bool,
        restitution: f64,
        tick_rate: f64,
        forces: Vec<(String, Vec<f64>)>,
    ) -> PyResult<Rules> {
        let forces: Vec<(&str, &[f64])> = forces
            .iter()
            .map(|(name, n)| (name.as_str(), n.as_slice()))
            .collect();
        let inner = kuglice_step::Rules::new(r#box, walls, restitution, tick_rate, &forces);
        inner
            .map(|inner| Rules { inner })
            .map_err(|error| raise(py, &error))
    }

    #[staticmethod]
    fn from_bytes(py: Python<'_>, data: &[u8]) -> PyResult<Rules> {
        let inner = kuglice_step::Rules::from_bytes(data);
        inner
            .map(|inner| Rules { inner })
            .map_err(|error| raise(py, &error))
    }

    fn to_bytes<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, &self.inner.to_bytes())
    }
}
