//! Whether the data determine the parameters, in words a person can act on.

use nalgebra::{Matrix3, Vector3};
use sensor::{Base, Kinematics};
use solver::Report;

use crate::error::Error;
use crate::intervals::Segmentation;
use crate::methods::{AccelerometerFit, AccelerometerRequest, Choice, Fitted, GyroscopeFit};
use crate::recording::Recording;
use crate::residuals::StaticMean;

/// Orientations closer than this count as one, cos 20°.
const SAME_ORIENTATION: f64 = 0.939_692_620_785_908_4;

/// A face counts as recorded by a placement within 45° of it.
const FACE_REACHED: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// Standard errors of scale factors and misalignments above which a warning, or a refusal, is due.
const RELATIVE_WARN: f64 = 0.01;
const RELATIVE_REFUSE: f64 = 0.05;

/// The same for biases, as a fraction of gravity or rad/s.
const BIAS_WARN: f64 = 0.01;
const BIAS_REFUSE: f64 = 0.05;

/// Spread of a rest above which the device was not still, as a fraction of gravity.
const STILL: f64 = 0.05;

/// A gyroscope that misses gravity by this much after the fit is not understood, rad.
const LOST: f64 = 0.1;

/// A turn longer than this may hide a rest, s.
const LONG_TURN: f64 = 15.0;

/// An element of the gyroscope's matrix this far from that of aligned axes is no misalignment.
const TURNED: f64 = 0.26;

/// A residual this many times the noise is worth a warning.
const BEYOND_NOISE: f64 = 3.0;

/// More unobservable combinations than this are counted, not written out.
const MOST_COMBINATIONS: usize = 2;

/// A scale this far from one on all axes of readings in SI units is a unit or a time base.
const COMMON_SCALE: f64 = 0.03;

/// The recordings without repeats of the same data.
pub(super) fn without_repeats<'a>(
    recordings: &'a [Recording],
    warnings: &mut Vec<String>,
) -> Vec<&'a Recording> {
    let mut kept: Vec<&Recording> = Vec::new();
    for recording in recordings {
        let twin = kept.iter().find(|k| {
            k.accelerometer == recording.accelerometer && k.gyroscope == recording.gyroscope
        });
        match twin {
            Some(twin) => warnings.push(format!(
                "{}: the same data as {}; counted once",
                recording.name, twin.name
            )),
            None => kept.push(recording),
        }
        warnings.extend(recording.warnings.iter().cloned());
    }
    kept
}

/// A mean of which nothing else is known.
pub(super) fn bare_mean(raw: Vector3<f64>) -> StaticMean {
    StaticMean {
        raw,
        rest: Kinematics::at_rest(Vector3::zeros()),
        white: 0.0,
    }
}

/// Refuses recordings without rests or without turns.
pub(super) fn enough_rests(
    recordings: &[&Recording],
    choices: &[Choice],
    means: &[Vec<StaticMean>],
) -> Result<(), Error> {
    let names: Vec<&str> = recordings.iter().map(|r| r.name.as_str()).collect();
    match means.iter().map(Vec::len).sum::<usize>() {
        0 => Err(Error::NotEnough(format!(
            "{}: no static interval: the device is never still for long enough; lay it down for 5 s \
             between the turns, or lower --min-static or raise --multiplier",
            names.join(", ")
        ))),
        1 => {
            let length: f64 = choices
                .iter()
                .flat_map(|c| &c.segmentation.statics)
                .map(|rest| rest.span.length())
                .sum();
            Err(Error::NotEnough(format!(
                "{}: all static: one rest of {length:.1} s and no turn; turn the device to at least \
                 ten orientations (each face up and down, then edges and corners) and hold it still \
                 for 5 s in each",
                names.join(", ")
            )))
        }
        _ => Ok(()),
    }
}

/// The fit of an accelerometer, by whatever method.
pub(super) struct ForceEvidence<'a> {
    pub fitted: &'a Fitted,
    /// Direction of specific force in every rest, body frame.
    pub directions: Vec<Vector3<f64>>,
    /// SI units per raw unit.
    pub scale: f64,
    /// Local gravity, m/s².
    pub gravity: f64,
    pub report: &'a Report,
}

/// The fit of a gyroscope, by whatever method.
pub(super) struct RateEvidence<'a> {
    pub fitted: &'a Fitted,
    /// Number of turns.
    pub turns: usize,
    /// SI units per raw unit.
    pub scale: f64,
    /// By how much the turns miss gravity after the fit, rad.
    pub rms: f64,
    pub report: &'a Report,
}

impl<'a> ForceEvidence<'a> {
    /// Of the stepwise fit.
    pub(super) fn of(fit: &'a AccelerometerFit, request: &AccelerometerRequest) -> Self {
        Self {
            fitted: &fit.fitted,
            directions: directions(fit, request),
            scale: fit.unit.scale,
            gravity: request.gravity,
            report: &fit.first,
        }
    }
}

impl<'a> RateEvidence<'a> {
    /// Of the stepwise fit.
    pub(super) fn of(fit: &'a GyroscopeFit) -> Self {
        Self {
            fitted: &fit.fitted,
            turns: fit.chords.len(),
            scale: fit.unit.scale,
            rms: fit.rms(),
            report: &fit.report,
        }
    }
}

/// Refuses a fit whose parameters the data do not determine and warns of weak ones.
pub(super) fn accelerometer_is_determined(
    fit: &ForceEvidence<'_>,
    warnings: &mut Vec<String>,
) -> Result<(), Error> {
    let directions = &fit.directions;
    let Coverage {
        words: coverage,
        complete,
    } = coverage(directions);
    let free = fit.fitted.free.len();
    let count = directions.len();
    if fit.fitted.rank < free {
        return Err(Error::NotEnough(format!(
            "{coverage}: too few for {free} parameters (rank {}); not observable: {}",
            fit.fitted.rank,
            not_observable(fit.fitted)
        )));
    }
    if count <= free {
        return Err(Error::NotEnough(format!(
            "{coverage}: {free} parameters leave nothing to check them with; record at least \
             {} placements",
            free + 1
        )));
    }
    if !fit.report.termination.converged() {
        return Err(Error::NotConverged(format!(
            "the accelerometer's fit stopped after {} steps ({:?}); is the gravity of {} m/s² right, \
             and was the device still in the intervals that `segment` shows?",
            fit.report.iterations.len(),
            fit.report.termination,
            fit.gravity
        )));
    }
    let weak = weak_parameters(fit.fitted, fit.scale, fit.gravity);
    let refused: Vec<&Weak> = weak.iter().filter(|w| w.refused).collect();
    if !refused.is_empty() {
        return Err(Error::NotEnough(format!(
            "{coverage}: {}",
            refused
                .iter()
                .map(|w| w.words.as_str())
                .collect::<Vec<_>>()
                .join("; ")
        )));
    }
    if !complete {
        let worst = worst_known(fit.fitted, fit.scale);
        warnings.push(format!("{coverage}{worst}"));
    }
    warnings.extend(
        weak.into_iter()
            .map(|w| format!("{} ({coverage})", w.words)),
    );
    Ok(())
}

/// `; accel.s_z is known to 0.31 % only`: the scale factor or misalignment with the largest error.
fn worst_known(fitted: &Fitted, scale: f64) -> String {
    let worst = fitted
        .free
        .iter()
        .filter(|name| name.starts_with("accel.") && !name.contains(".b_"))
        .filter_map(|name| Some((name, fitted.standard_error(name)? / scale)))
        .max_by(|a, b| a.1.total_cmp(&b.1));
    worst.map_or(String::new(), |(name, error)| {
        format!("; {name} is known to {:.2} % only", 100.0 * error)
    })
}

/// Rests that disagree with all the others, by name.
pub(super) fn disagreeing_rests(
    fit: &AccelerometerFit,
    recordings: &[&Recording],
    choices: &[Choice],
) -> Vec<String> {
    let rests: Vec<_> = recordings
        .iter()
        .zip(choices)
        .flat_map(|(recording, choice)| {
            let rests = choice.segmentation.statics.iter().enumerate();
            rests.map(move |(k, rest)| (recording, k, rest))
        })
        .filter(|(_, _, rest)| rest.accelerometer.is_some())
        .collect();
    if rests.len() != fit.first.residuals.len() {
        return Vec::new();
    }
    fit.outliers
        .iter()
        .map(|outlier| {
            let (recording, k, rest) = rests[outlier.row];
            format!(
                "{}: static interval {} (t = {:.2} to {:.2} s) disagrees with the others by {:.1} \
                 mm/s² (by chance in {:.0e} of recordings): was the device touched, or did it slip?",
                recording.name,
                k + 1,
                rest.span.from,
                rest.span.to,
                1e3 * outlier.deleted_residual,
                outlier.p_value
            )
        })
        .collect()
}

/// Turns that last much longer than the others: a rest in them may have been missed.
pub(super) fn long_turns(recording: &Recording, segmentation: &Segmentation) -> Vec<String> {
    let mut lengths: Vec<f64> = segmentation.turns.iter().map(|t| t.span.length()).collect();
    lengths.sort_by(f64::total_cmp);
    let Some(&usual) = lengths.get(lengths.len() / 4) else {
        return Vec::new();
    };
    segmentation
        .turns
        .iter()
        .filter(|turn| turn.fault.is_none())
        .filter(|turn| turn.span.length() > LONG_TURN.max(3.0 * usual))
        .map(|turn| {
            format!(
                "{}: turn {} lasts {:.1} s (t = {:.2} to {:.2} s): no rest was found in it; if the \
                 device was still, it vibrated or not for long enough (--min-static, --multiplier)",
                recording.name,
                turn.from + 1,
                turn.span.length(),
                turn.span.from,
                turn.span.to
            )
        })
        .collect()
}

/// A residual that the noise within the rests does not explain.
pub(super) fn beyond_noise(what: &str, reduced_chi2: Option<f64>) -> Option<String> {
    let ratio = reduced_chi2?.sqrt();
    (ratio > BEYOND_NOISE).then(|| {
        format!(
            "{what} is {ratio:.1} times what the noise within the rests allows: something beyond the \
             base model is in the recording (see `stillpoint effects`); the standard errors are scaled \
             to it"
        )
    })
}

/// Refuses a fit that the turns do not determine and warns of weak parameters.
pub(super) fn gyroscope_is_determined(
    fit: &RateEvidence<'_>,
    warnings: &mut Vec<String>,
) -> Result<(), Error> {
    let RateEvidence { fitted, turns, .. } = *fit;
    if fitted.rank < fitted.free.len() {
        return Err(Error::NotEnough(format!(
            "{turns} turns determine {} of the gyroscope's {} parameters; not observable: {}; turn \
             the device about other axes too",
            fitted.rank,
            fitted.free.len(),
            not_observable(fitted)
        )));
    }
    if 2 * turns <= fitted.free.len() {
        return Err(Error::NotEnough(format!(
            "{turns} turns leave nothing to check the gyroscope's {} parameters with; record at \
             least {} turns",
            fitted.free.len(),
            fitted.free.len() / 2 + 1
        )));
    }
    if !fit.report.termination.converged() {
        return Err(Error::NotConverged(format!(
            "the gyroscope's fit stopped after {} steps ({:?})",
            fit.report.iterations.len(),
            fit.report.termination
        )));
    }
    let weak = weak_parameters(fitted, fit.scale, 1.0);
    let refused: Vec<&str> = weak
        .iter()
        .filter(|w| w.refused)
        .map(|w| w.words.as_str())
        .collect();
    if !refused.is_empty() && fit.rms < LOST {
        return Err(Error::NotEnough(format!(
            "{turns} turns: {}; turn the device about other axes too",
            refused.join("; ")
        )));
    }
    warnings.extend(
        weak.into_iter()
            .map(|w| format!("{} ({turns} turns)", w.words)),
    );
    Ok(())
}

/// Reasons not to use a gyroscope's fit as it stands.
pub(super) fn gyroscope_gates(fit: &RateEvidence<'_>, si: bool) -> Vec<String> {
    let mut failed = Vec::new();
    let base = Base::from_parameters(fit.fitted.parameters.values());
    let near_si: Matrix3<f64> = base.t / fit.scale;
    if fit.rms > LOST {
        failed.push(format!(
            "the gyroscope misses gravity by {:.1}° rms after the fit: is a sensor mounted or logged \
             with other axes, or the time stamps not those of the samples?",
            fit.rms.to_degrees()
        ));
    }
    if near_si.determinant() < 0.0 {
        failed.push(format!(
            "the gyroscope's axes are left-handed against the accelerometer's: {}",
            mounting(&near_si)
        ));
    }
    let ratio = base.t.trace() / 3.0;
    if si && fit.rms <= LOST && (0.5..=2.1).contains(&ratio) && all_off(&base.t) {
        failed.push(format!(
            "the gyroscope's scale is {ratio:.3} on all axes: a wrong time base (nominal rate) or \
             unit rather than a sensor error"
        ));
    }
    failed
}

fn all_off(t: &Matrix3<f64>) -> bool {
    let off: Vec<f64> = (0..3).map(|k| t[(k, k)] - 1.0).collect();
    off.iter().all(|v| *v > COMMON_SCALE) || off.iter().all(|v| *v < -COMMON_SCALE)
}

/// A gyroscope mounted or logged with other axes than the accelerometer.
pub(super) fn turned_axes(fit: &RateEvidence<'_>) -> Option<String> {
    let base = Base::from_parameters(fit.fitted.parameters.values());
    let near_si: Matrix3<f64> = base.t / fit.scale;
    let largest = (0..9)
        .map(|k| near_si[(k / 3, k % 3)] - if k % 4 == 0 { 1.0 } else { 0.0 })
        .fold(0.0, |a: f64, b| a.max(b.abs()));
    (fit.rms <= LOST && near_si.determinant() > 0.0 && largest > TURNED).then(|| {
        format!(
            "the gyroscope's axes are turned against the accelerometer's: {}; T carries them over",
            mounting(&near_si)
        )
    })
}

/// `its y is flipped`, or which axis of the sensor lies on which of the body.
fn mounting(t: &Matrix3<f64>) -> String {
    let axes = ["x", "y", "z"];
    let nearest = |row: usize| {
        let column = (0..3).fold(0, |best, k| {
            if t[(row, k)].abs() > t[(row, best)].abs() {
                k
            } else {
                best
            }
        });
        (column, t[(row, column)] < 0.0)
    };
    let rows: Vec<(usize, bool)> = (0..3).map(nearest).collect();
    let in_order = rows
        .iter()
        .enumerate()
        .all(|(row, (column, _))| row == *column);
    if in_order {
        let flipped: Vec<&str> = (0..3).filter(|&k| rows[k].1).map(|k| axes[k]).collect();
        if !flipped.is_empty() {
            return format!("{} is flipped", flipped.join(" and "));
        }
    }
    rows.iter()
        .enumerate()
        .map(|(row, (column, negative))| {
            let sign = if *negative { "-" } else { "" };
            format!("{} is its {sign}{}", axes[row], axes[*column])
        })
        .collect::<Vec<_>>()
        .join(", ")
}

/// Rests whose spread says that the device was not still.
pub(super) fn restless(
    recording: &Recording,
    segmentation: &Segmentation,
    scale: f64,
    gravity: f64,
) -> Vec<String> {
    let unsteady = |rest: &crate::intervals::StaticInterval| {
        let spread = rest.accelerometer?.std().norm() * scale;
        (spread > STILL * gravity).then_some(spread)
    };
    segmentation
        .statics
        .iter()
        .enumerate()
        .filter_map(|(k, rest)| {
            let spread = unsteady(rest)?;
            Some(format!(
                "{}: static interval {} (t = {:.2} to {:.2} s) shakes by {spread:.2} m/s²: the \
                 device was not still",
                recording.name,
                k + 1,
                rest.span.from,
                rest.span.to
            ))
        })
        .collect()
}

fn directions(fit: &AccelerometerFit, request: &AccelerometerRequest) -> Vec<Vector3<f64>> {
    let shared = request.model.parameters().len();
    let mut all = Vec::new();
    for (k, means) in request.recordings.iter().enumerate() {
        let p = fit.fitted.local(shared, k);
        all.extend(
            means
                .iter()
                .map(|m| request.model.correct(&m.raw, &m.rest, &p))
                .map(|f| f.normalize()),
        );
    }
    all
}

/// The combinations that the data cannot see; with more than a few, how many and of what.
fn not_observable(fitted: &Fitted) -> String {
    let combinations = &fitted.unobservable;
    if combinations.len() <= MOST_COMBINATIONS {
        return combinations.join("; ");
    }
    let involved: Vec<&str> = fitted
        .free
        .iter()
        .filter(|name| {
            combinations
                .iter()
                .any(|words| words.contains(name.as_str()))
        })
        .map(String::as_str)
        .collect();
    format!(
        "{} combinations of {}",
        combinations.len(),
        involved.join(", ")
    )
}

/// `26 placements, 24 of which differ by more than 20°, none with z down`.
fn coverage(directions: &[Vector3<f64>]) -> Coverage {
    let mut distinct: Vec<Vector3<f64>> = Vec::new();
    for u in directions {
        if distinct.iter().all(|d| d.dot(u) < SAME_ORIENTATION) {
            distinct.push(*u);
        }
    }
    let faces = ["x up", "x down", "y up", "y down", "z up", "z down"];
    let missing: Vec<&str> = faces
        .iter()
        .enumerate()
        .filter(|(k, _)| {
            let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
            directions.iter().all(|u| sign * u[k / 2] < FACE_REACHED)
        })
        .map(|(_, face)| *face)
        .collect();
    let mut words = format!(
        "{} placements, {} of which differ by more than 20°",
        directions.len(),
        distinct.len()
    );
    if !missing.is_empty() {
        words.push_str(&format!("; add placements with {}", missing.join(", ")));
    }
    Coverage {
        words,
        complete: missing.is_empty(),
    }
}

/// Which orientations were recorded.
struct Coverage {
    words: String,
    /// Every face was up and down at least once.
    complete: bool,
}

struct Weak {
    words: String,
    refused: bool,
}

/// Parameters known too badly; `scale` is SI units per raw unit, `size` the unit of the bias limits.
fn weak_parameters(fitted: &Fitted, scale: f64, size: f64) -> Vec<Weak> {
    fitted
        .free
        .iter()
        .filter(|name| name.starts_with("accel.") || name.starts_with("gyro."))
        .filter_map(|name| {
            let std = fitted.standard_error(name)?;
            if name.contains(".b_") {
                let relative = std * scale / size;
                (relative > BIAS_WARN).then(|| Weak {
                    words: format!("{name} is known to {std:.2} only"),
                    refused: relative > BIAS_REFUSE,
                })
            } else {
                let relative = std / scale;
                (relative > RELATIVE_WARN).then(|| Weak {
                    words: format!("{name} is known to {:.1} % only", 100.0 * relative),
                    refused: relative > RELATIVE_REFUSE,
                })
            }
        })
        .collect()
}
