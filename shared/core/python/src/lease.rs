//! The lease of a world's arrays: numpy arrays over the world's own memory.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use kuglice_step::Vec2;
use numpy::ndarray::{ArrayView1, ArrayView2};
use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::world::World;

/// What each lent array keeps alive: while one of these lives, the world does not change.
#[pyclass(frozen, module = "kuglice._core")]
struct Loan {
    _world: Py<World>,
    lent: Arc<AtomicUsize>,
}

impl Drop for Loan {
    fn drop(&mut self) {
        self.lent.fetch_sub(1, Ordering::AcqRel);
    }
}

struct Arrays {
    position: Py<PyArray2<f64>>,
    velocity: Py<PyArray2<f64>>,
    radius: Py<PyArray1<f64>>,
    mass: Py<PyArray1<f64>>,
    id: Py<PyArray1<u64>>,
}

/// Read-only arrays over a world's own memory, in its order: `id` says whose numbers they are.
#[pyclass(module = "kuglice._core")]
pub struct Lease {
    arrays: Option<Arrays>,
}

impl Lease {
    pub fn open(world: Bound<'_, World>) -> PyResult<Lease> {
        let py = world.py();
        let lent = Arc::clone(&world.borrow().lent);
        lent.fetch_add(1, Ordering::AcqRel);
        let loan = Bound::new(
            py,
            Loan {
                _world: world.clone().unbind(),
                lent,
            },
        )?
        .into_any();
        let borrowed = world.borrow();
        let balls = &borrowed.inner.state().balls;
        let arrays = Arrays {
            position: vectors(&balls.position, &loan)?,
            velocity: vectors(&balls.velocity, &loan)?,
            radius: numbers(&balls.radius, &loan)?,
            mass: numbers(&balls.mass, &loan)?,
            id: numbers(&balls.id, &loan)?,
        };
        Ok(Lease { arrays: Some(arrays) })
    }

    fn arrays(&self) -> PyResult<&Arrays> {
        self.arrays
            .as_ref()
            .ok_or_else(|| PyValueError::new_err("this view has ended: its arrays went back"))
    }
}

fn numbers<T: numpy::Element>(numbers: &[T], loan: &Bound<'_, PyAny>) -> PyResult<Py<PyArray1<T>>> {
    let view = ArrayView1::from(numbers);
    // SAFETY: the memory belongs to a vector of the world that the loan keeps alive, and that neither moves, changes
    // nor goes while the loan lives: every method of the world that could do so asks `check_not_lent` first.
    let array = unsafe { PyArray1::borrow_from_array(&view, loan.clone()) };
    read_only(array.as_any())?;
    Ok(array.unbind())
}

fn vectors(vectors: &[Vec2], loan: &Bound<'_, PyAny>) -> PyResult<Py<PyArray2<f64>>> {
    // SAFETY: Vec2 is `repr(C)` with two f64, so the slice is 2 n of them; the rest is as in `numbers`.
    let array = unsafe {
        let view = ArrayView2::from_shape_ptr((vectors.len(), 2), vectors.as_ptr().cast::<f64>());
        PyArray2::borrow_from_array(&view, loan.clone())
    };
    read_only(array.as_any())?;
    Ok(array.unbind())
}

fn read_only(array: &Bound<'_, PyAny>) -> PyResult<()> {
    array.getattr("flags")?.setattr("writeable", false)
}

#[pymethods]
impl Lease {
    #[getter]
    fn position(&self, py: Python<'_>) -> PyResult<Py<PyArray2<f64>>> {
        Ok(self.arrays()?.position.clone_ref(py))
    }

    #[getter]
    fn velocity(&self, py: Python<'_>) -> PyResult<Py<PyArray2<f64>>> {
        Ok(self.arrays()?.velocity.clone_ref(py))
    }

    #[getter]
    fn radius(&self, py: Python<'_>) -> PyResult<Py<PyArray1<f64>>> {
        Ok(self.arrays()?.radius.clone_ref(py))
    }

    #[getter]
    fn mass(&self, py: Python<'_>) -> PyResult<Py<PyArray1<f64>>> {
        Ok(self.arrays()?.mass.clone_ref(py))
    }

    #[getter]
    fn id(&self, py: Python<'_>) -> PyResult<Py<PyArray1<u64>>> {
        Ok(self.arrays()?.id.clone_ref(py))
    }

    /// Gives the arrays back.
    fn end(&mut self) {
        self.arrays = None;
    }
}
