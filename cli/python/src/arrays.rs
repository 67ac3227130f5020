//! Arrays of numpy as slices, without copies.

use numpy::{PyReadonlyArray1, PyReadonlyArray2, PyReadwriteArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::error::usage;

/// The values of a contiguous array.
pub fn numbers<'a>(array: &'a PyReadonlyArray1<'_, f64>, name: &str) -> PyResult<&'a [f64]> {
    array
        .as_slice()
        .map_err(|_| usage(array.py(), format!("{name}: a contiguous array expected")))
}

/// The rows of a contiguous array (`n × 3`).
pub fn rows<'a>(array: &'a PyReadonlyArray2<'_, f64>, name: &str) -> PyResult<&'a [[f64; 3]]> {
    check_width(array.py(), array.shape(), name)?;
    let all = array
        .as_slice()
        .map_err(|_| usage(array.py(), format!("{name}: a contiguous array expected")))?;
    Ok(all.as_chunks().0)
}

/// The rows of a contiguous array (`n × 3`) to be filled.
pub fn rows_to_fill<'a>(
    array: &'a mut PyReadwriteArray2<'_, f64>,
    name: &str,
) -> PyResult<&'a mut [[f64; 3]]> {
    let py = array.py();
    check_width(py, array.shape(), name)?;
    let all = array
        .as_slice_mut()
        .map_err(|_| usage(py, format!("{name}: a contiguous array expected")))?;
    Ok(all.as_chunks_mut().0)
}

fn check_width(py: Python<'_>, shape: &[usize], name: &str) -> PyResult<()> {
    match shape {
        [_, 3] => Ok(()),
        [n, other] => Err(usage(
            py,
            format!("{name}: an array of shape ({n}, {other}), (N, 3) expected"),
        )),
        _ => Err(usage(
            py,
            format!("{name}: an array of shape (N, 3) expected"),
        )),
    }
}
