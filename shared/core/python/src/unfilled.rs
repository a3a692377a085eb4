//! A snapshot written to where Python keeps its bytes, which hold nothing yet: to fill them with zeros first, as pyo3 does,
//! took a sixth of its time.

use std::mem::MaybeUninit;

use kuglice_step::Saving;
use pyo3::ffi;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

pub fn written<'py>(py: Python<'py>, saving: &Saving<'_>) -> PyResult<Bound<'py, PyBytes>> {
    let len = ffi::Py_ssize_t::try_from(saving.len())?;
    // SAFETY: a null pointer asks for bytes that hold nothing yet. What comes back is null, with Python's error set, or a
    // reference of our own to an object of type `bytes`.
    let bytes = unsafe {
        let object = ffi::PyBytes_FromStringAndSize(std::ptr::null(), len);
        Bound::from_owned_ptr_or_err(py, object)?.cast_into_unchecked::<PyBytes>()
    };
    // SAFETY: the object has room for `len` bytes there, nobody else knows of it yet (only that of no bytes is shared, and no
    // snapshot is so short), and slots may hold nothing.
    let slots = unsafe {
        let start = ffi::PyBytes_AsString(bytes.as_ptr()).cast::<MaybeUninit<u8>>();
        std::slice::from_raw_parts_mut(start, saving.len())
    };
    // Each slot is written, or it panics and nobody sees the object.
    saving.write_to(slots);
    Ok(bytes)
}
