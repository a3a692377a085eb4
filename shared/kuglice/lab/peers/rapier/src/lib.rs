//! Rapier's world of discs for the lab: conversion between numpy and Rapier, no logic of its own.
#![forbid(unsafe_code)]

use numpy::{PyArray2, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use rapier2d::prelude::*;

/// Discs in a box; defaults of Rapier but for restitution 1, no friction, no rotation and no sleep.
#[pyclass]
struct World {
    world: PhysicsWorld,
    balls: Vec<RigidBodyHandle>,
}

#[pymethods]
impl World {
    #[new]
    #[pyo3(signature = (position, velocity, radius, mass, walls, gravity, dt))]
    #[allow(clippy::cast_possible_truncation, clippy::too_many_arguments)]
    fn new(
        position: PyReadonlyArray2<'_, f64>,
        velocity: PyReadonlyArray2<'_, f64>,
        radius: PyReadonlyArray1<'_, f64>,
        mass: PyReadonlyArray1<'_, f64>,
        walls: PyReadonlyArray2<'_, f64>,
        gravity: (f64, f64),
        dt: f64,
    ) -> World {
        let mut world = PhysicsWorld {
            gravity: Vector::new(gravity.0 as Real, gravity.1 as Real),
            ..PhysicsWorld::default()
        };
        world.integration_parameters.dt = dt as Real;
        let bouncing = |collider: ColliderBuilder| {
            collider
                .restitution(1.0)
                .friction(0.0)
                .friction_combine_rule(CoefficientCombineRule::Min)
        };
        let rows = position.as_array();
        let speeds = velocity.as_array();
        let mut balls = Vec::new();
        for (index, (&radius, &mass)) in radius.as_array().iter().zip(mass.as_array().iter()).enumerate() {
            let place = Vector::new(rows[[index, 0]] as Real, rows[[index, 1]] as Real);
            let body = if mass.is_finite() {
                RigidBodyBuilder::dynamic()
                    .linvel(Vector::new(
                        speeds[[index, 0]] as Real,
                        speeds[[index, 1]] as Real,
                    ))
                    .lock_rotations()
                    .can_sleep(false)
            } else {
                RigidBodyBuilder::fixed()
            };
            let disc = bouncing(ColliderBuilder::ball(radius as Real));
            let disc = if mass.is_finite() {
                disc.mass(mass as Real)
            } else {
                disc
            };
            balls.push(world.insert(body.translation(place), disc).0);
        }
        // Each wall: its middle and half its sides.
        for wall in walls.as_array().rows() {
            let place = Vector::new(wall[0] as Real, wall[1] as Real);
            let block = bouncing(ColliderBuilder::cuboid(wall[2] as Real, wall[3] as Real));
            world.insert(RigidBodyBuilder::fixed().translation(place), block);
        }
        World { world, balls }
    }

    fn run(&mut self, ticks: u64) {
        for _ in 0..ticks {
            self.world.step();
        }
    }

    fn position<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.pairs(py, |body| body.translation())
    }

    fn velocity<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.pairs(py, |body| body.linvel())
    }
}

impl World {
    fn pairs<'py>(
        &self,
        py: Python<'py>,
        of: impl Fn(&RigidBody) -> Vector,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let rows: Vec<Vec<f64>> = self
            .balls
            .iter()
            .map(|&handle| of(&self.world.bodies[handle]))
            .map(|pair| vec![f64::from(pair.x), f64::from(pair.y)])
            .collect();
        Ok(PyArray2::from_vec2(py, &rows)?)
    }
}

/// The module.
#[pymodule]
fn _rapier(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<World>()
}
