//! kuglice._core.Regions.

use std::sync::Mutex;

use kuglice_regions::{Error, Gatherer, Grid, Quanta, Shapes, pack, unpack};
use kuglice_step::Vec2;
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::errors::named;
use crate::world::World;

type Told<'py> = (
    Bound<'py, PyArray1<u64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<f64>>,
);

fn protocol(py: Python<'_>, error: &Error) -> PyErr {
    named(py, "ProtocolError", &format!("region: {error}"))
}

/// Balls by quadtree node, packed to few bytes each.
#[pyclass(frozen, module = "kuglice._core")]
pub struct Regions {
    grid: Grid,
    quanta: Quanta,
    shapes: Shapes,
    gatherer: Mutex<Gatherer>,
}

#[pymethods]
impl Regions {
    #[new]
    #[pyo3(signature = (*, r#box, depth, position_quantum, velocity_quantum, shapes))]
    fn new(
        py: Python<'_>,
        r#box: [f64; 4],
        depth: u32,
        position_quantum: f64,
        velocity_quantum: f64,
        shapes: Vec<(f64, f64)>,
    ) -> PyResult<Regions> {
        let made = || {
            Ok(Regions {
                grid: Grid::new(r#box, depth)?,
                quanta: Quanta::new(position_quantum, velocity_quantum)?,
                shapes: Shapes::new(&shapes)?,
                gatherer: Mutex::default(),
            })
        };
        made().map_err(|error| protocol(py, &error))
    }

    fn node<'py>(
        &self,
        py: Python<'py>,
        position: PyReadonlyArray2<'_, f64>,
    ) -> PyResult<Bound<'py, PyArray1<u32>>> {
        if position.shape()[1] != 2 {
            let what = format!("position has shape {:?}, it must be (n, 2)", position.shape());
            return Err(protocol(py, &Error(what)));
        }
        let position = position.as_array();
        let nodes = position
            .outer_iter()
            .map(|row| self.grid.node(Vec2::new(row[0], row[1])));
        Ok(PyArray1::from_iter(py, nodes))
    }

    fn pack<'py>(
        &self,
        py: Python<'py>,
        world: PyRef<'_, World>,
        nodes: Vec<u32>,
    ) -> (Vec<Bound<'py, PyBytes>>, usize) {
        let balls = &world.inner.state().balls;
        let packed: Vec<(Vec<u8>, usize)> = py.detach(|| {
            let mut gatherer = self.gatherer.lock().unwrap_or_else(|broken| broken.into_inner());
            let gathered = gatherer.gather(&self.grid, balls, &nodes);
            (0..nodes.len())
                .map(|place| pack(&self.grid, self.quanta, &self.shapes, balls, gathered.node(place)))
                .collect()
        });
        let left_out = packed.iter().map(|(_, left_out)| left_out).sum();
        let bytes = packed.iter().map(|(bytes, _)| PyBytes::new(py, bytes));
        (bytes.collect(), left_out)
    }

    fn unpack<'py>(&self, py: Python<'py>, data: &[u8], most: usize) -> PyResult<Told<'py>> {
        let told = unpack(&self.grid, self.quanta, &self.shapes, data, most)
            .map_err(|error| protocol(py, &error))?;
        let rows = |vector: fn(&kuglice_step::NewBall) -> Vec2| {
            let flat = told.iter().flat_map(|(_, ball)| {
                let Vec2 { x, y } = vector(ball);
                [x, y]
            });
            PyArray1::from_iter(py, flat).reshape([told.len(), 2])
        };
        Ok((
            PyArray1::from_iter(py, told.iter().map(|&(id, _)| id)),
            rows(|ball| ball.position)?,
            rows(|ball| ball.velocity)?,
            PyArray1::from_iter(py, told.iter().map(|(_, ball)| ball.radius)),
            PyArray1::from_iter(py, told.iter().map(|(_, ball)| ball.mass)),
        ))
    }
}
