//! Recordings.

use std::path::PathBuf;
use std::str::FromStr;

use findings::Finding;
use numpy::{PyReadonlyArray1, PyReadonlyArray2, PyReadwriteArray1, PyReadwriteArray2};
use pyo3::prelude::*;
use stillpoint::{ColumnMap, Error, ReadOptions, Rows, Sensor};

use crate::arrays::{numbers, rows, rows_to_fill};
use crate::error::{exception, usage};

/// A recording that was checked.
#[pyclass(frozen, module = "stillpoint._native")]
#[derive(Clone, Debug)]
pub struct Recording(pub stillpoint::Recording);

/// The sensor of that name.
pub fn sensor(py: Python<'_>, name: &str) -> PyResult<Sensor> {
    let found = Sensor::ALL.into_iter().find(|sensor| sensor.name() == name);
    found.ok_or_else(|| {
        let known = Sensor::ALL.map(Sensor::name).join(", ");
        usage(
            py,
            format!("sensor: `{name}` found, one of {known} expected"),
        )
    })
}

/// The unit of that spelling, if one is given.
fn unit<U: FromStr<Err = Box<Finding>>>(
    py: Python<'_>,
    option: &str,
    spelling: Option<String>,
) -> PyResult<Option<U>> {
    let unit = spelling.map(|text| text.parse::<U>()).transpose();
    unit.map_err(|words| usage(py, format!("{option}: {words}")))
}

#[pymethods]
impl Recording {
    /// From contiguous arrays of float64.
    #[staticmethod]
    #[allow(clippy::too_many_arguments)]
    fn from_arrays(
        py: Python<'_>,
        t: PyReadonlyArray1<'_, f64>,
        accel: Option<PyReadonlyArray2<'_, f64>>,
        gyro: Option<PyReadonlyArray2<'_, f64>>,
        temperature: Option<PyReadonlyArray1<'_, f64>>,
        mag: Option<PyReadonlyArray2<'_, f64>>,
        name: String,
    ) -> PyResult<Self> {
        let stamps = numbers(&t, "t")?;
        let force = accel.as_ref().map(|a| rows(a, "accel")).transpose()?;
        let rate = gyro.as_ref().map(|a| rows(a, "gyro")).transpose()?;
        let celsius = temperature.as_ref();
        let celsius = celsius.map(|a| numbers(a, "temperature")).transpose()?;
        let field = mag.as_ref().map(|a| rows(a, "mag")).transpose()?;
        let rows = Rows {
            t: stamps,
            accel: force.unwrap_or_default(),
            gyro: rate.unwrap_or_default(),
            temperature: celsius.unwrap_or_default(),
            mag: field.unwrap_or_default(),
        };
        let made = py.detach(|| Ok(stillpoint::Recording::from_rows(rows)?.named(name)));
        made.map(Self).map_err(|error: Error| exception(py, &error))
    }

    /// From a file or a folder.
    #[staticmethod]
    #[allow(clippy::too_many_arguments)]
    fn from_file(
        py: Python<'_>,
        path: PathBuf,
        gyro_file: Option<PathBuf>,
        columns: Option<String>,
        rate: Option<f64>,
        na_drop: bool,
        sort_time: bool,
        skip_bad_rows: usize,
        accel_unit: Option<String>,
        gyro_unit: Option<String>,
        mag_unit: Option<String>,
    ) -> PyResult<Self> {
        let columns = columns.map(|text| text.parse::<ColumnMap>()).transpose();
        let columns = columns.map_err(|words| usage(py, format!("columns: {words}")))?;
        let how = ReadOptions {
            columns: columns.unwrap_or_default(),
            rate,
            na_drop,
            sort_time,
            skip_bad_rows,
            accel_unit: unit(py, "accel_unit", accel_unit)?,
            gyro_unit: unit(py, "gyro_unit", gyro_unit)?,
            mag_unit: unit(py, "mag_unit", mag_unit)?,
            ..ReadOptions::default()
        };
        let read = py.detach(|| match gyro_file {
            Some(gyro) => stillpoint::Recording::from_pair(path, gyro, &how),
            None => stillpoint::Recording::from_file_with(path, &how),
        });
        read.map(Self).map_err(|error| exception(py, &error))
    }

    #[getter]
    fn name(&self) -> &str {
        self.0.name()
    }

    #[getter]
    fn duration(&self) -> f64 {
        self.0.duration()
    }

    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.0.warnings()
    }

    /// Number of samples of a sensor.
    fn rows(&self, py: Python<'_>, of: &str) -> PyResult<usize> {
        Ok(self.0.rows(sensor(py, of)?))
    }

    /// Writes stamps and samples of a sensor into arrays of that many rows.
    fn fill(
        &self,
        py: Python<'_>,
        of: &str,
        mut t: PyReadwriteArray1<'_, f64>,
        mut values: PyReadwriteArray2<'_, f64>,
    ) -> PyResult<()> {
        let of = sensor(py, of)?;
        let stamps = t
            .as_slice_mut()
            .map_err(|_| usage(py, "t: a contiguous array expected".into()))?;
        let to = rows_to_fill(&mut values, "values")?;
        if stamps.len() != self.0.rows(of) || to.len() != stamps.len() {
            return Err(usage(py, "fill: arrays of other lengths".into()));
        }
        stamps.copy_from_slice(self.0.stamps(of));
        py.detach(|| {
            for (to, value) in to.iter_mut().zip(self.0.values(of)) {
                *to = value;
            }
        });
        Ok(())
    }

    /// Temperature at a time; `None` without a thermometer.
    fn temperature_at(&self, t: f64) -> Option<f64> {
        self.0.temperature_at(t)
    }

    fn to_csv(&self, py: Python<'_>) -> String {
        py.detach(|| self.0.to_csv())
    }
}
