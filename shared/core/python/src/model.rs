//! kuglice._core.Model.

use pyo3::prelude::*;

use crate::errors::raise;

/// How a world is computed.
#[pyclass(frozen, module = "kuglice._core")]
pub struct Model {
    pub inner: kuglice_step::Model,
}

#[pymethods]
impl Model {
    #[new]
    #[pyo3(signature = (*, integrator, contacts, broadphase, substeps = 1, smallest_node = None))]
    fn new(
        py: Python<'_>,
        integrator: &str,
        contacts: &str,
        broadphase: &str,
        substeps: u32,
        smallest_node: Option<f64>,
    ) -> PyResult<Model> {
        let inner = kuglice_step::Model::new(integrator, contacts, broadphase, substeps, smallest_node);
        inner
            .map(|inner| Model { inner })
            .map_err(|error| raise(py, &error))
    }
}
