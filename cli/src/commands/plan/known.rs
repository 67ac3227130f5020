//! Prior knowledge for a plan from an input: a recording, a calibration or findings.

use std::path::Path;

use calib::Calibration;
use calib::calibration::LeftOut;
use calib::methods::{accelerometer_unit, cut, static_means};
use nalgebra::Vector3;
use plan::{
    Coverage, ForceMatrix, Information, Known, Noise, Timing, best, coverage, force_part,
    information_of,
};
use sensor::{PLACES, Sensor, base_names};
use serde_json::Value;

use super::args::Args;
use super::rivals::Rivals;
use super::units::unit_of;
use crate::commands::shared::inputs::{load, looked_at, read as read_recording};
use crate::exit::{Failure, INPUT};
use crate::show;

/// Placements that are asked for where nothing is missing.
const FEWEST: usize = 3;

/// A recording, a calibration or findings.
pub struct Input {
    /// Name of the input.
    pub name: String,
    /// Prior knowledge from the input.
    pub known: Known,
    /// Coverage by the placements of a recording.
    pub coverage: Option<Coverage>,
    /// Notes for the user: recordings that distinguish tied effects (findings), or parameters that no placement
    /// determines (calibration).
    pub notes: Vec<String>,
    /// Tied effects of findings.
    pub rivals: Rivals,
    /// The accelerometer's information in noises of one placement.
    force: ForceMatrix,
}

impl Input {
    /// The placements to add.
    pub fn next(&self, count: Option<usize>) -> Vec<Vector3<f64>> {
        let wanted = self.coverage.iter().flat_map(|found| &found.wanted);
        let wanted: Vec<Vector3<f64>> = wanted.map(|w| Vector3::from(w.up)).collect();
        match count {
            Some(count) => best(count, &self.force),
            None if wanted.is_empty() => best(FEWEST, &self.force),
            None => wanted,
        }
    }
}

/// Reads it; `document` is what it holds of ours.
pub fn read(
    path: &Path,
    document: Option<&Value>,
    args: &Args,
    noise: &Noise,
    timing: &Timing,
) -> Result<Input, Failure> {
    match document {
        Some(document) => of_calibration(path, document, noise, timing),
        None => of_recording(path, args, noise, timing),
    }
}

/// A document of ours; `None` for everything else.
///
/// # Errors
/// Status 3: the system does not let it be read.
pub fn document(path: &Path) -> Result<Option<Value>, Failure> {
    let Some(bytes) = looked_at(path, std::fs::read(path))? else {
        return Ok(None);
    };
    let document: Option<Value> = serde_json::from_slice(&bytes).ok();
    let is_ours = |document: &Value| {
        let schema = document.get("schema").and_then(Value::as_str);
        schema.is_some_and(|schema| schema.starts_with("stillpoint."))
    };
    Ok(document.filter(is_ours))
}

/// The calibration itself, or that of findings.
fn calibration(document: &Value) -> &Value {
    document.get("calibration").unwrap_or(document)
}

/// The gravity of a calibration or of findings.
pub fn gravity(document: &Value) -> Option<f64> {
    calibration(document).get("gravity")?.as_f64()
}

/// Returns the error of a placement beyond white noise, from the residuals of a calibration, mm/s².
pub fn misfit(document: &Value) -> Option<f64> {
    let misfits = calibration(document).get("misfit")?.as_array()?;
    let norm = misfits.iter().find(|m| m["channel"] == "static_norm")?;
    let [rms, noise] = ["rms", "noise"].map(|key| norm.get(key).and_then(Value::as_f64));
    Some(1e3 * (rms?.powi(2) - noise?.powi(2)).max(0.0).sqrt())
}

/// The parameter that an effect which was left out may change most beside its standard error, in words.
fn left_out(calibration: &Calibration) -> Option<String> {
    let std = |name: &str| {
        let k = calibration.parameters.iter().position(|own| own == name)?;
        let variance = *calibration.covariance.get(k)?.get(k)?;
        Some(variance.sqrt()).filter(|std| *std > 0.0)
    };
    let of = |left: &LeftOut| {
        let std = std(&left.parameter)?;
        Some((
            left.std_added / std,
            std.hypot(left.std_added),
            left.clone(),
        ))
    };
    // Of a magnetometer nothing is planned.
    let is_planned = |left: &&LeftOut| !left.parameter.starts_with("mag.");
    let all = calibration
        .left_out
        .iter()
        .filter(is_planned)
        .filter_map(of);
    let (share, with_it, left) = all.max_by(|a, b| a.0.total_cmp(&b.0))?;
    let (factor, unit) = unit_of(&left.parameter);
    (share > 1.0).then(|| {
        format!(
            "The errors hold for a sensor without further effects. If it has {}, no larger than the recording would show, {} is \
             known to {} {unit} only, however many placements follow.",
            left.effect,
            left.parameter,
            show::figures(with_it * factor, 2)
        )
    })
}

/// The information of a calibration without what it does not know of gravity, and by how much that moves each element of
/// `T`, all in proportion (`Calibration::carry_gravity`): more placements at the same place do not tell it.
fn at_one_gravity(calibration: &Calibration) -> Option<(Information, [f64; 6])> {
    let names = &calibration.parameters;
    let share = calibration.gravity_source.std() / calibration.gravity;
    let mut moved = vec![0.0; names.len()];
    if let Some(triad) = &calibration.accelerometer {
        for (name, (i, j)) in base_names(Sensor::Accelerometer).iter().zip(PLACES) {
            if let Some(k) = names.iter().position(|own| own == name) {
                moved[k] = share * triad.t[i][j];
            }
        }
    }
    let mut covariance = calibration.covariance.clone();
    for (row, a) in covariance.iter_mut().zip(&moved) {
        for (entry, b) in row.iter_mut().zip(&moved) {
            *entry -= a * b;
        }
    }
    let places = plan::parameter_names();
    let place = |k: usize| names.iter().position(|own| *own == places[k]);
    let scale = std::array::from_fn(|k| place(k).map_or(0.0, |k| moved[k]));
    let without = information_of(names, &covariance).map(|information| (information, scale));
    without.or_else(|| Some((information_of(names, &calibration.covariance)?, [0.0; 6])))
}

fn of_calibration(
    path: &Path,
    document: &Value,
    noise: &Noise,
    timing: &Timing,
) -> Result<Input, Failure> {
    let calibration = load(path)?;
    let name = show::path(path);
    let (information, scale) = at_one_gravity(&calibration).ok_or_else(|| {
        Failure::new(INPUT, "its covariance is missing or no covariance")
            .in_file(&name)
            .advise("calibrate again")
    })?;
    let mut notes = ties(document);
    notes.extend(left_out(&calibration));
    let share = calibration.gravity_source.std() / calibration.gravity;
    if scale.iter().any(|moved| *moved != 0.0) {
        notes.push(format!(
            "{:.0} ppm of the accelerometer's scale errors are gravity, which was not given: no placement lowers that. Calibrate with \
             --gravity or --latitude.",
            1e6 * share
        ));
    }
    Ok(Input {
        name,
        known: Known {
            information: Some(information),
            up: None,
            scale,
        },
        coverage: None,
        notes,
        rivals: Rivals::of(document),
        force: force_part(&information, noise, timing.used(1)),
    })
}

fn of_recording(
    path: &Path,
    args: &Args,
    noise: &Noise,
    timing: &Timing,
) -> Result<Input, Failure> {
    let (detector, choose) = args.detector.detector()?;
    let recording = read_recording(path, &args.read)?.decimated();
    let choice = cut(&recording, &detector, choose, noise.gravity)?;
    let means: Vec<Vector3<f64>> = static_means(&recording, &choice.segmentation)
        .iter()
        .map(|mean| mean.raw)
        .collect();
    let unit = accelerometer_unit(&means, noise.gravity);
    let ups: Vec<Vector3<f64>> = means
        .iter()
        .map(|raw| {
            unit.as_ref()
                .map_or(*raw, |unit| unit.to_si(raw))
                .normalize()
        })
        .collect();
    let found = coverage(&ups);
    let information = (!ups.is_empty()).then(|| plan::recorded(&ups, noise, timing));
    Ok(Input {
        name: show::path(path),
        force: plan::force_information(&ups),
        known: Known {
            information,
            up: ups.last().copied(),
            scale: [0.0; 6],
        },
        coverage: Some(found),
        notes: Vec::new(),
        rivals: Rivals::default(),
    })
}

/// Returns a note for each tied effect, with the recording that would distinguish it.
fn ties(document: &Value) -> Vec<String> {
    let effects = document.get("effects").and_then(Value::as_array);
    let words = |effect: &Value| {
        let ties = effect.get("indistinguishable_from")?.as_array()?;
        let ties: Vec<&str> = ties.iter().filter_map(Value::as_str).collect();
        let by = effect.get("told_apart_by")?.as_str()?;
        let name = effect.get("name")?.as_str()?;
        (!ties.is_empty()).then(|| format!("To tell {name} from {}: {by}.", ties.join(", ")))
    };
    effects.into_iter().flatten().filter_map(words).collect()
}
