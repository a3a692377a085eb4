//! The step's errors as the exceptions of kuglice.errors.

use kuglice_step::Error;
use pyo3::prelude::*;

/// The exception that stands for an error of the step.
pub fn raise(py: Python<'_>, error: &Error) -> PyErr {
    named(py, error.class(), &error.to_string())
}

/// An exception of kuglice.errors by the name of its class.
pub fn named(py: Python<'_>, class: &str, message: &str) -> PyErr {
    let made = py
        .import("kuglice.errors")
        .and_then(|module| module.getattr(class))
        .and_then(|class| class.call1((message,)));
    match made {
        Ok(exception) => PyErr::from_value(exception),
        Err(error) => error,
    }
}
