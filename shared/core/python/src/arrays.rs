//! Balls as numpy arrays, one row each, and back.

use kuglice_step::{Balls, NewBall, Vec2};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::errors::named;

/// Two numbers a row.
pub fn pairs_to_array<'py, T: numpy::Element + Copy>(
    py: Python<'py>,
    rows: &[[T; 2]],
) -> Bound<'py, PyArray2<T>> {
    let flat = PyArray1::from_slice(py, rows.as_flattened());
    flat.reshape([rows.len(), 2]).expect("two numbers a row")
}

/// One number per ball, in id order.
pub fn numbers<'py, T: numpy::Element + Copy>(
    py: Python<'py>,
    balls: &Balls,
    numbers: &[T],
) -> Bound<'py, PyArray1<T>> {
    if balls.is_by_id() {
        return PyArray1::from_slice(py, numbers);
    }
    PyArray1::from_iter(py, balls.by_id().map(|index| numbers[index]))
}

/// One vector per ball, in id order.
pub fn vectors<'py>(py: Python<'py>, balls: &Balls, vectors: &[Vec2]) -> Bound<'py, PyArray2<f64>> {
    let rows: Vec<[f64; 2]> = balls
        .by_id()
        .map(|index| [vectors[index].x, vectors[index].y])
        .collect();
    pairs_to_array(py, &rows)
}

/// Balls, not yet checked: one row of each array a ball.
pub fn new_balls(
    py: Python<'_>,
    position: &PyReadonlyArray2<'_, f64>,
    velocity: &PyReadonlyArray2<'_, f64>,
    radius: &PyReadonlyArray1<'_, f64>,
    mass: &PyReadonlyArray1<'_, f64>,
) -> PyResult<Vec<NewBall>> {
    let count = radius.len();
    for (name, shape) in [("position", position.shape()), ("velocity", velocity.shape())] {
        if shape != [count, 2] {
            return Err(named(
                py,
                "SceneError",
                &format!("{name} has shape {shape:?}, it must be [{count}, 2]"),
            ));
        }
    }
    if mass.len() != count {
        return Err(named(
            py,
            "SceneError",
            &format!("mass has {} numbers, it must have {count}", mass.len()),
        ));
    }
    let (position, velocity) = (position.as_array(), velocity.as_array());
    let (radius, mass) = (radius.as_array(), mass.as_array());
    let balls: Vec<NewBall> = (0..count)
        .map(|i| NewBall {
            position: Vec2::new(position[[i, 0]], position[[i, 1]]),
            velocity: Vec2::new(velocity[[i, 0]], velocity[[i, 1]]),
            radius: radius[i],
            mass: mass[i],
        })
        .collect();
    Ok(balls)
}

/// The same with an id for each.
pub fn told_balls(
    py: Python<'_>,
    id: &PyReadonlyArray1<'_, u64>,
    position: &PyReadonlyArray2<'_, f64>,
    velocity: &PyReadonlyArray2<'_, f64>,
    radius: &PyReadonlyArray1<'_, f64>,
    mass: &PyReadonlyArray1<'_, f64>,
) -> PyResult<Vec<(u64, NewBall)>> {
    let balls = new_balls(py, position, velocity, radius, mass)?;
    if id.len() != balls.len() {
        return Err(named(
            py,
            "SceneError",
            &format!("id has {} numbers, it must have {}", id.len(), balls.len()),
        ));
    }
    Ok(id.as_array().iter().copied().zip(balls).collect())
}
