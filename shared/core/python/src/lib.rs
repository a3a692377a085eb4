//! kuglice._core: the step and the rasteriser for Python. Conversion only, no logic.
#![deny(unsafe_code)]

mod arrays;
mod errors;
#[expect(
    unsafe_code,
    reason = "an allocator is unsafe by nature; see its SAFETY lines"
)]
mod large_pages;
#[expect(
    unsafe_code,
    reason = "numpy arrays over a world's own memory; see its SAFETY lines and .ci/memcheck"
)]
mod lease;
mod model;
mod raster;
mod recording;
mod regions;
mod rules;
#[expect(
    unsafe_code,
    reason = "Python's bytes are filled once; see its SAFETY lines and .ci/memcheck"
)]
mod unfilled;
mod world;

use kuglice_regions::{MOST_DEPTH, MOST_SHAPES};
use kuglice_step::{
    INPUT_BYTES, InputKind, MOST_THREADS, NO_BALL, STEP_VERSION, broadphase, contacts, force, integrator,
    random,
};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

#[global_allocator]
static ALLOCATOR: large_pages::LargePages = large_pages::LargePages;

/// Numbers `first .. first + count` of a stream, in [0, 1).
#[pyfunction]
fn random_uniform(
    py: Python<'_>,
    seed: u64,
    stream: u64,
    first: u64,
    count: usize,
) -> Bound<'_, PyArray1<f64>> {
    let numbers = (first..)
        .take(count)
        .map(|counter| random::uniform(seed, stream, counter));
    PyArray1::from_iter(py, numbers)
}

/// What the module was built with and for; see build.rs.
const BUILD: [(&str, &str); 5] = [
    ("rustc", env!("KUGLICE_RUSTC")),
    ("target", env!("KUGLICE_TARGET")),
    ("target_features", env!("KUGLICE_TARGET_FEATURES")),
    ("flags", env!("KUGLICE_FLAGS")),
    ("opt_level", env!("KUGLICE_OPT_LEVEL")),
];

#[pymodule]
fn _core(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let py = module.py();
    module.add("STEP_VERSION", STEP_VERSION)?;
    let build = PyDict::new(py);
    for (name, fact) in BUILD {
        build.set_item(name, fact)?;
    }
    module.add("BUILD", build)?;
    module.add(
        "INTEGRATORS",
        PyTuple::new(py, integrator::TABLE.iter().map(|entry| entry.name))?,
    )?;
    module.add(
        "CONTACTS",
        PyTuple::new(py, contacts::TABLE.iter().map(|entry| entry.name))?,
    )?;
    module.add(
        "BROADPHASES",
        PyTuple::new(py, broadphase::TABLE.iter().map(|entry| entry.name))?,
    )?;
    let forces = PyDict::new(py);
    for kind in &force::KINDS {
        forces.set_item(kind.name, PyTuple::new(py, kind.numbers)?)?;
    }
    module.add("FORCES", forces)?;
    module.add(
        "INPUT_KINDS",
        PyTuple::new(py, InputKind::ALL.map(InputKind::name))?,
    )?;
    module.add("INPUT_BYTES", INPUT_BYTES)?;
    module.add("MOST_THREADS", MOST_THREADS)?;
    module.add("NO_BALL", NO_BALL)?;
    module.add("MOST_DEPTH", MOST_DEPTH)?;
    module.add("MOST_SHAPES", MOST_SHAPES)?;
    module.add_class::<rules::Rules>()?;
    module.add_class::<model::Model>()?;
    module.add_class::<world::World>()?;
    module.add_class::<lease::Lease>()?;
    module.add_class::<regions::Regions>()?;
    module.add_function(wrap_pyfunction!(random_uniform, module)?)?;
    module.add_function(wrap_pyfunction!(recording::recording, module)?)?;
    raster::register(module)
}
