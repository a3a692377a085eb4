//! kuglice._core.World.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use kuglice_step::{Held, HeldKind, Player, Team, Vec2, read_inputs};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::arrays::{new_balls, numbers, pairs_to_array, told_balls, vectors};
use crate::errors::{named, raise};
use crate::lease::Lease;
use crate::model::Model;
use crate::rules::Rules;
use crate::unfilled;

const HELD_KINDS: [HeldKind; 2] = [HeldKind::Thrust, HeldKind::Attract];

fn held_name(kind: HeldKind) -> &'static str {
    match kind {
        HeldKind::Thrust => "thrust",
        HeldKind::Attract => "attract",
    }
}

/// A state and the step that moves it.
#[pyclass(module = "kuglice._core")]
pub struct World {
    pub inner: kuglice_step::World,
    /// How often the arrays are lent: whatever would move or free them is refused until the last one is back.
    pub lent: Arc<AtomicUsize>,
}

impl World {
    fn own(inner: kuglice_step::World) -> World {
        World {
            inner,
            lent: Arc::default(),
        }
    }

    fn check_not_lent(&self, py: Python<'_>) -> PyResult<()> {
        match self.lent.load(Ordering::Acquire) {
            0 => Ok(()),
            lent => Err(named(
                py,
                "LentError",
                &format!(
                    "the world's arrays are lent by {lent} views; a world can change when there are 0: \
                     leave the `with world.view()` block and drop the arrays taken from it"
                ),
            )),
        }
    }
}

#[pymethods]
impl World {
    #[new]
    #[pyo3(signature = (rules, model, *, position, velocity, radius, mass))]
    fn new(
        py: Python<'_>,
        rules: &Rules,
        model: &Model,
        position: PyReadonlyArray2<'_, f64>,
        velocity: PyReadonlyArray2<'_, f64>,
        radius: PyReadonlyArray1<'_, f64>,
        mass: PyReadonlyArray1<'_, f64>,
    ) -> PyResult<World> {
        let balls = new_balls(py, &position, &velocity, &radius, &mass)?;
        let world = kuglice_step::World::new(rules.inner.clone(), model.inner.clone(), &balls);
        world.map(World::own).map_err(|error| raise(py, &error))
    }

    #[staticmethod]
    #[pyo3(signature = (rules, model, tick, *, id, position, velocity, radius, mass))]
    #[expect(
        clippy::too_many_arguments,
        reason = "one array for each thing that is known of a ball"
    )]
    fn with_balls(
        py: Python<'_>,
        rules: &Rules,
        model: &Model,
        tick: u64,
        id: PyReadonlyArray1<'_, u64>,
        position: PyReadonlyArray2<'_, f64>,
        velocity: PyReadonlyArray2<'_, f64>,
        radius: PyReadonlyArray1<'_, f64>,
        mass: PyReadonlyArray1<'_, f64>,
    ) -> PyResult<World> {
        let balls = told_balls(py, &id, &position, &velocity, &radius, &mass)?;
        let world = kuglice_step::World::with_balls(rules.inner.clone(), model.inner.clone(), tick, &balls);
        world.map(World::own).map_err(|error| raise(py, &error))
    }

    #[pyo3(signature = (gone, *, id, position, velocity, radius, mass))]
    #[expect(
        clippy::too_many_arguments,
        reason = "one array for each thing that is known of a ball"
    )]
    fn replace(
        &mut self,
        py: Python<'_>,
        gone: PyReadonlyArray1<'_, u64>,
        id: PyReadonlyArray1<'_, u64>,
        position: PyReadonlyArray2<'_, f64>,
        velocity: PyReadonlyArray2<'_, f64>,
        radius: PyReadonlyArray1<'_, f64>,
        mass: PyReadonlyArray1<'_, f64>,
    ) -> PyResult<()> {
        self.check_not_lent(py)?;
        let balls = told_balls(py, &id, &position, &velocity, &radius, &mass)?;
        let gone: Vec<u64> = gone.as_array().iter().copied().collect();
        self.inner
            .replace(&gone, &balls)
            .map_err(|error| raise(py, &error))
    }

    fn hold(
        &mut self,
        py: Python<'_>,
        players: Vec<(u32, Option<u64>)>,
        held: Vec<(u32, String, f64, f64, f64)>,
    ) -> PyResult<()> {
        self.check_not_lent(py)?;
        let players: Vec<Player> = players
            .into_iter()
            .map(|(client, ball)| Player { client, ball })
            .collect();
        let held = held
            .into_iter()
            .map(|(client, kind, x, y, strength)| {
                let kind = HELD_KINDS
                    .into_iter()
                    .find(|&known| held_name(known) == kind)
                    .ok_or_else(|| {
                        named(
                            py,
                            "InputError",
                            &format!("held input of kind {kind:?}: there is none"),
                        )
                    })?;
                Ok(Held {
                    client,
                    kind,
                    vector: Vec2::new(x, y),
                    strength,
                })
            })
            .collect::<PyResult<Vec<Held>>>()?;
        self.inner
            .hold(&players, &held)
            .map_err(|error| raise(py, &error))
    }

    #[staticmethod]
    fn restore(py: Python<'_>, rules: &Rules, model: &Model, data: &[u8]) -> PyResult<World> {
        let world = kuglice_step::World::restore(rules.inner.clone(), model.inner.clone(), data);
        world.map(World::own).map_err(|error| raise(py, &error))
    }

    #[pyo3(signature = (inputs, dt = None, budget = None))]
    fn step(&mut self, py: Python<'_>, inputs: &[u8], dt: Option<f64>, budget: Option<u64>) -> PyResult<()> {
        self.check_not_lent(py)?;
        let inputs = read_inputs(inputs).map_err(|error| raise(py, &error))?;
        let world = &mut self.inner;
        py.detach(|| world.step_within(&inputs, dt, budget.unwrap_or(u64::MAX)))
            .map_err(|error| raise(py, &error))
    }

    fn run(&mut self, py: Python<'_>, mut ticks: u64) -> PyResult<()> {
        // In slices, so that a long run can be interrupted from the keyboard.
        const SLICE: u64 = 1024;
        self.check_not_lent(py)?;
        let world = &mut self.inner;
        while ticks > 0 {
            let slice = ticks.min(SLICE);
            py.detach(|| (0..slice).try_for_each(|_| world.step(&[], None)))
                .map_err(|error| raise(py, &error))?;
            py.check_signals()?;
            ticks -= slice;
        }
        Ok(())
    }

    fn snapshot<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        unfilled::written(py, &self.inner.saving())
    }

    #[pyo3(name = "clone")]
    fn copy(&self) -> World {
        World::own(self.inner.clone())
    }

    fn copy_from(&mut self, py: Python<'_>, other: PyRef<'_, World>) -> PyResult<()> {
        self.check_not_lent(py)?;
        self.inner.copy_from(&other.inner);
        Ok(())
    }

    /// Shares the work of a step among so many threads from now on.
    fn employ(&mut self, py: Python<'_>, threads: usize) -> PyResult<()> {
        let team = Team::new(threads).map_err(|error| raise(py, &error))?;
        self.inner.employ(team);
        Ok(())
    }

    #[getter]
    fn threads(&self) -> usize {
        self.inner.team().size()
    }

    #[getter]
    fn tick(&self) -> u64 {
        self.inner.state().tick
    }

    #[getter]
    fn time(&self) -> f64 {
        self.inner.time()
    }

    #[getter]
    fn next_id(&self) -> u64 {
        self.inner.state().next_id
    }

    #[getter]
    fn collisions(&self) -> u64 {
        self.inner.state().counters.collisions
    }

    #[getter]
    fn wall_hits(&self) -> u64 {
        self.inner.state().counters.wall_hits
    }

    #[getter]
    fn inputs_applied(&self) -> u64 {
        self.inner.state().counters.inputs_applied
    }

    #[getter]
    fn inputs_ignored(&self) -> u64 {
        self.inner.state().counters.inputs_ignored
    }

    #[getter]
    fn state_hash(&self) -> u64 {
        self.inner.state_hash()
    }

    #[getter]
    fn count(&self) -> usize {
        self.inner.state().balls.len()
    }

    #[getter]
    fn id<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u64>> {
        let balls = &self.inner.state().balls;
        numbers(py, balls, &balls.id)
    }

    #[getter]
    fn position<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        let balls = &self.inner.state().balls;
        vectors(py, balls, &balls.position)
    }

    #[getter]
    fn velocity<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        let balls = &self.inner.state().balls;
        vectors(py, balls, &balls.velocity)
    }

    #[getter]
    fn radius<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let balls = &self.inner.state().balls;
        numbers(py, balls, &balls.radius)
    }

    #[getter]
    fn mass<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let balls = &self.inner.state().balls;
        numbers(py, balls, &balls.mass)
    }

    #[getter]
    fn kinetic_energy(&self) -> f64 {
        self.inner.kinetic_energy()
    }

    #[getter]
    fn potential_energy(&self) -> f64 {
        self.inner.potential_energy()
    }

    #[getter]
    fn momentum(&self) -> (f64, f64) {
        let Vec2 { x, y } = self.inner.momentum();
        (x, y)
    }

    #[getter]
    fn players(&self) -> Vec<(u32, Option<u64>)> {
        self.inner
            .state()
            .players
            .iter()
            .map(|player| (player.client, player.ball))
            .collect()
    }

    #[getter]
    fn held(&self) -> Vec<(u32, &'static str, f64, f64, f64)> {
        let held = self.inner.state().held.iter();
        held.map(|h| (h.client, held_name(h.kind), h.vector.x, h.vector.y, h.strength))
            .collect()
    }

    fn overlapping<'py>(&mut self, py: Python<'py>) -> Bound<'py, PyArray2<u64>> {
        let pairs = self.inner.overlapping();
        let id = &self.inner.state().balls.id;
        let rows: Vec<[u64; 2]> = pairs
            .iter()
            .map(|&(a, b)| [id[a as usize], id[b as usize]])
            .collect();
        pairs_to_array(py, &rows)
    }

    fn nodes<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        let nodes = self.inner.nodes();
        let flat = PyArray1::from_slice(py, nodes.as_flattened());
        flat.reshape([nodes.len(), 4]).expect("four numbers a row")
    }

    fn lend(slf: Bound<'_, World>) -> PyResult<Lease> {
        Lease::open(slf)
    }
}
