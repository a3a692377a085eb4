//! Bindings of kuglice-raster: numpy arrays in, pixels changed in place.

use kuglice_raster::{Canvas, Colour, Liquid, Shading};
use numpy::PyUntypedArrayMethods;
use numpy::{PyReadonlyArray1, PyReadonlyArray2, PyReadonlyArrayDyn, PyReadwriteArray3, PyReadwriteArrayDyn};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

type Floats1<'py> = PyReadonlyArray1<'py, f64>;
type Floats2<'py> = PyReadonlyArray2<'py, f64>;
type Bytes2<'py> = PyReadonlyArray2<'py, u8>;
type Pixels<'py> = PyReadwriteArray3<'py, u8>;

/// Add the drawing functions to the module.
pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(draw_discs, module)?)?;
    module.add_function(wrap_pyfunction!(draw_rings, module)?)?;
    module.add_function(wrap_pyfunction!(draw_segments, module)?)?;
    module.add_function(wrap_pyfunction!(draw_rectangles, module)?)?;
    module.add_function(wrap_pyfunction!(draw_fluid, module)?)?;
    module.add_function(wrap_pyfunction!(fade, module)?)?;
    Ok(())
}

#[pyfunction]
#[pyo3(signature = (pixels, center, radius, colour, shaded = false))]
fn draw_discs(
    py: Python<'_>,
    mut pixels: Pixels<'_>,
    center: Floats2<'_>,
    radius: Floats1<'_>,
    colour: Bytes2<'_>,
    shaded: bool,
) -> PyResult<()> {
    let center = rows("center", &center)?;
    let radius = radius.as_array().to_vec();
    let colour: Vec<Colour> = rows("colour", &colour)?;
    same_length("radius", radius.len(), center.len())?;
    same_length("colour", colour.len(), center.len())?;
    let shading = if shaded { Shading::Ball } else { Shading::Flat };
    draw(py, &mut pixels, |canvas| {
        kuglice_raster::draw_discs(canvas, &center, &radius, &colour, shading)
    })
}

#[pyfunction]
fn draw_rings(
    py: Python<'_>,
    mut pixels: Pixels<'_>,
    center: Floats2<'_>,
    radius: Floats1<'_>,
    thickness: f64,
    colour: Bytes2<'_>,
) -> PyResult<()> {
    let center = rows("center", &center)?;
    let radius = radius.as_array().to_vec();
    let colour: Vec<Colour> = rows("colour", &colour)?;
    same_length("radius", radius.len(), center.len())?;
    same_length("colour", colour.len(), center.len())?;
    draw(py, &mut pixels, |canvas| {
        kuglice_raster::draw_rings(canvas, &center, &radius, thickness, &colour)
    })
}

#[pyfunction]
#[pyo3(signature = (pixels, start, end, thickness, colour, lighten = false))]
fn draw_segments(
    py: Python<'_>,
    mut pixels: Pixels<'_>,
    start: Floats2<'_>,
    end: Floats2<'_>,
    thickness: Floats1<'_>,
    colour: Bytes2<'_>,
    lighten: bool,
) -> PyResult<()> {
    let start = rows("start", &start)?;
    let end = rows("end", &end)?;
    let thickness = thickness.as_array().to_vec();
    let colour: Vec<Colour> = rows("colour", &colour)?;
    same_length("end", end.len(), start.len())?;
    same_length("thickness", thickness.len(), start.len())?;
    same_length("colour", colour.len(), start.len())?;
    draw(py, &mut pixels, |canvas| {
        kuglice_raster::draw_segments(canvas, &start, &end, &thickness, &colour, lighten)
    })
}

#[pyfunction]
fn draw_rectangles(
    py: Python<'_>,
    mut pixels: Pixels<'_>,
    rectangle: Floats2<'_>,
    thickness: f64,
    colour: Bytes2<'_>,
) -> PyResult<()> {
    let rectangle = rows("rectangle", &rectangle)?;
    let colour: Vec<Colour> = rows("colour", &colour)?;
    same_length("colour", colour.len(), rectangle.len())?;
    draw(py, &mut pixels, |canvas| {
        kuglice_raster::draw_rectangles(canvas, &rectangle, thickness, &colour)
    })
}

#[pyfunction]
#[pyo3(signature = (pixels, center, radius, value, palette, opacity, window = None))]
#[expect(clippy::too_many_arguments, reason = "one per keyword in Python")]
fn draw_fluid(
    py: Python<'_>,
    mut pixels: Pixels<'_>,
    center: Floats2<'_>,
    radius: Floats1<'_>,
    value: Floats1<'_>,
    palette: Bytes2<'_>,
    opacity: f64,
    window: Option<[usize; 4]>,
) -> PyResult<()> {
    let center = rows("center", &center)?;
    let radius = radius.as_array().to_vec();
    let value: Vec<f32> = value.as_array().iter().map(|&number| number as f32).collect();
    let palette: Vec<[u8; 3]> = rows("palette", &palette)?;
    same_length("radius", radius.len(), center.len())?;
    same_length("value", value.len(), center.len())?;
    if palette.is_empty() {
        return Err(PyValueError::new_err(
            "palette: needs at least one colour, got none",
        ));
    }
    if !(0.0..=1.0).contains(&opacity) {
        return Err(PyValueError::new_err(format!(
            "opacity: {opacity} is not within 0 and 1"
        )));
    }
    let liquid = Liquid {
        palette: &palette,
        opacity: opacity as f32,
        window,
    };
    draw(py, &mut pixels, |canvas| {
        kuglice_raster::draw_fluid(canvas, &center, &radius, &value, liquid)
    })
}

#[pyfunction]
fn fade(
    py: Python<'_>,
    mut pixels: PyReadwriteArrayDyn<'_, u8>,
    target: PyReadonlyArrayDyn<'_, u8>,
    keep: u16,
) -> PyResult<()> {
    if pixels.shape() != target.shape() {
        let message = format!(
            "target: shape {:?} is not that of pixels, {:?}",
            target.shape(),
            pixels.shape()
        );
        return Err(PyValueError::new_err(message));
    }
    if keep > 256 {
        return Err(PyValueError::new_err(format!("keep: {keep} is above 256")));
    }
    let pixels = pixels.as_slice_mut().map_err(|_| not_contiguous("pixels"))?;
    let target = target.as_slice().map_err(|_| not_contiguous("target"))?;
    py.detach(|| kuglice_raster::fade(pixels, target, keep));
    Ok(())
}

/// Run a drawing function over a numpy picture without the GIL.
fn draw(py: Python<'_>, pixels: &mut Pixels<'_>, paint: impl FnOnce(&mut Canvas) + Send) -> PyResult<()> {
    let shape = pixels.shape();
    let (height, width, channels) = (shape[0], shape[1], shape[2]);
    if channels != 3 {
        return Err(PyValueError::new_err(format!(
            "pixels: shape (height, width, 3) wanted, last is {channels}"
        )));
    }
    let bytes = pixels.as_slice_mut().map_err(|_| not_contiguous("pixels"))?;
    py.detach(|| {
        let mut canvas =
            Canvas::new(bytes, width, height).map_err(|error| PyValueError::new_err(error.to_string()))?;
        paint(&mut canvas);
        Ok(())
    })
}

/// The rows of an array of shape (n, N), in any memory layout.
fn rows<T: numpy::Element + Copy, const N: usize>(
    name: &str,
    array: &PyReadonlyArray2<'_, T>,
) -> PyResult<Vec<[T; N]>> {
    let array = array.as_array();
    if array.ncols() != N {
        let message = format!(
            "{name}: shape (n, {N}) wanted, got ({}, {})",
            array.nrows(),
            array.ncols()
        );
        return Err(PyValueError::new_err(message));
    }
    Ok(array
        .rows()
        .into_iter()
        .map(|row| std::array::from_fn(|column| row[column]))
        .collect())
}

fn same_length(name: &str, length: usize, wanted: usize) -> PyResult<()> {
    if length == wanted {
        Ok(())
    } else {
        Err(PyValueError::new_err(format!(
            "{name}: {wanted} rows wanted, as many as shapes, got {length}"
        )))
    }
}

fn not_contiguous(name: &str) -> PyErr {
    PyValueError::new_err(format!("{name}: a C-contiguous array is needed"))
}
