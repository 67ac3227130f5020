//! Requests, as the package hands them over: a dictionary with every key.

use std::path::PathBuf;

use pyo3::prelude::*;
use stillpoint::{
    Catalogue, ClockMode, DetectorOptions, Frame, GyroBias, Integrator, Method, Request,
};

use crate::error::{exception, usage};
use crate::recording::Recording;

/// The keys of the dictionary.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Options<'py> {
    method: String,
    first_order: bool,
    gravity: Option<f64>,
    latitude: Option<f64>,
    altitude: Option<f64>,
    multiplier: Option<f64>,
    min_static: Option<f64>,
    min_dynamic: Option<f64>,
    window: Option<f64>,
    initial_static: Option<f64>,
    sections: Vec<Vec<(f64, f64)>>,
    leave_out: Vec<(usize, f64)>,
    gyro_recordings: Vec<PyRef<'py, Recording>>,
    frame: String,
    integrator: String,
    gyro_bias: String,
    nominal_rate: Option<f64>,
    clock: String,
    field: Option<f64>,
    effects: Vec<String>,
    effect_files: Vec<PathBuf>,
    force_device: bool,
    alpha: f64,
    walks: Option<[f64; 2]>,
    validation: Option<PyRef<'py, Recording>>,
}

impl Options<'_> {
    /// The request.
    pub fn request(&self, py: Python<'_>) -> PyResult<Request> {
        let word = Word(py);
        Ok(Request {
            method: match self.method.as_str() {
                "auto" => Method::Auto,
                "stepwise" => Method::Stepwise,
                "joint" => Method::Joint,
                "six-position" => Method::SixPosition {
                    first_order: self.first_order,
                },
                other => {
                    let known = "auto, stepwise, joint or six-position";
                    return Err(word.wrong("method", other, known));
                }
            },
            gravity: self.gravity,
            latitude: self.latitude,
            field: self.field,
            altitude: self.altitude,
            detector: DetectorOptions {
                multiplier: self.multiplier,
                min_static: self.min_static,
                min_dynamic: self.min_dynamic,
                window: self.window,
                initial_static: self.initial_static,
            },
            sections: self.sections.clone(),
            left_out: self.leave_out.clone(),
            gyro_recordings: self.gyro_recordings.iter().map(|r| r.0.clone()).collect(),
            frame: match self.frame.as_str() {
                "triangular" => Frame::Triangular,
                "symmetric" => Frame::Symmetric,
                other => return Err(word.wrong("frame", other, "triangular or symmetric")),
            },
            integrator: match self.integrator.as_str() {
                "exponential" => Integrator::Exponential,
                "first-order-normalized" => Integrator::FirstOrderNormalized,
                "first-order" => Integrator::FirstOrder,
                other => {
                    let known = "exponential, first-order-normalized or first-order";
                    return Err(word.wrong("integrator", other, known));
                }
            },
            gyro_bias: match self.gyro_bias.as_str() {
                "adjacent" => GyroBias::Adjacent,
                "initial" => GyroBias::Initial,
                other => return Err(word.wrong("gyro_bias", other, "adjacent or initial")),
            },
            nominal_rate: self.nominal_rate,
            clock: match self.clock.as_str() {
                "auto" => ClockMode::Auto,
                "stamps" => ClockMode::Stamps,
                "even" => ClockMode::Even,
                other => return Err(word.wrong("clock", other, "auto, stamps or even")),
            },
            effects: self.effects.clone(),
            catalogue: catalogue(py, &self.effect_files)?,
            force_device: self.force_device,
            alpha: self.alpha,
            walks: self.walks,
            validation: self.validation.as_ref().map(|r| r.0.clone()),
            watch: None,
        })
    }
}

/// The effects of the program and those that files define.
pub fn catalogue(py: Python<'_>, files: &[PathBuf]) -> PyResult<Catalogue> {
    let mut catalogue = Catalogue::default();
    for file in files {
        catalogue = catalogue
            .with_file(file)
            .map_err(|error| exception(py, &error))?;
    }
    Ok(catalogue)
}

struct Word<'py>(Python<'py>);

impl Word<'_> {
    fn wrong(&self, name: &str, found: &str, known: &str) -> PyErr {
        usage(self.0, format!("{name}: `{found}` found, {known} expected"))
    }
}
