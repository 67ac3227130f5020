//! Whether the data determine the parameters, in words a person can act on.

use findings::{Finding, Findings, Kind, Remedy};
use nalgebra::Vector3;
use recording::Error;
use sensor::Sensor;

use super::coverage::{open_by_directions, refusal};
use crate::methods::{AccelerometerFit, AccelerometerRequest, Ending, Fitted, GyroscopeFit};

/// A gyroscope that misses gravity by this much after the fit is not understood, rad.
pub(super) const LOST: f64 = 0.1;

/// Standard errors of scale factors and misalignments above which a warning, or a refusal, is due.
const RELATIVE_WARN: f64 = 0.01;
const RELATIVE_REFUSE: f64 = 0.05;

/// The same for biases, as a fraction of gravity or rad/s.
const BIAS_WARN: f64 = 0.01;
const BIAS_REFUSE: f64 = 0.05;

/// The fit of an accelerometer, by whatever method.
pub(in crate::calibrate) struct ForceEvidence<'a> {
    pub fitted: &'a Fitted,
    /// Direction of specific force in every rest, body frame.
    pub directions: Vec<Vector3<f64>>,
    /// The same as the readings show them: a fit that does not end may have lost them.
    pub seen: Vec<Vector3<f64>>,
    /// SI units per raw unit.
    pub scale: f64,
    /// Local gravity, m/s².
    pub gravity: f64,
    pub ending: Ending,
}

/// The fit of a gyroscope, by whatever method.
pub(in crate::calibrate) struct RateEvidence<'a> {
    pub fitted: &'a Fitted,
    /// Number of turns.
    pub turns: usize,
    /// SI units per raw unit.
    pub scale: f64,
    /// By how much the turns miss gravity after the fit, rad.
    pub rms: f64,
    pub ending: Ending,
}

impl<'a> ForceEvidence<'a> {
    /// Of the stepwise fit.
    pub(in crate::calibrate) fn of(
        fit: &'a AccelerometerFit,
        request: &AccelerometerRequest,
    ) -> Self {
        Self {
            fitted: &fit.fitted,
            directions: directions(fit, request),
            seen: seen(request),
            scale: fit.unit.scale,
            gravity: request.gravity,
            ending: (&fit.first).into(),
        }
    }
}

impl<'a> RateEvidence<'a> {
    /// Of the stepwise fit.
    pub(in crate::calibrate) fn of(fit: &'a GyroscopeFit) -> Self {
        Self {
            fitted: &fit.fitted,
            turns: fit.chords.len(),
            scale: fit.unit.scale,
            rms: fit.rms(),
            ending: (&fit.report).into(),
        }
    }
}

/// Refuses a fit whose parameters the data do not determine and warns of weak ones.
pub(in crate::calibrate) fn accelerometer_is_determined(
    fit: &ForceEvidence<'_>,
    warnings: &mut Findings,
) -> Result<(), Error> {
    let directions = &fit.directions;
    let free = fit.fitted.free.len();
    let count = directions.len();
    if fit.fitted.rank < free {
        let unknown = format!("not observable: {}", involved(fit.fitted).join(", "));
        return Err(Error::not_enough(refusal(directions, &unknown)));
    }
    if count <= free {
        let unknown = format!(
            "{free} parameters leave nothing to check them with{}",
            least_known(fit)
        );
        return Err(Error::not_enough(refusal(directions, &unknown)));
    }
    if !fit.ending.termination.converged()
        && let Some(open) = open_by_directions(&fit.seen)
    {
        return Err(Error::not_enough(refusal(&fit.seen, &open)));
    }
    if !fit.ending.termination.converged() {
        return Err(Error::not_converged(format!(
            "the accelerometer's fit stopped after {} steps ({:?}); is the gravity of {} m/s² right, \
             and was the device still in the intervals that `segment` shows?",
            fit.ending.steps, fit.ending.termination, fit.gravity
        )));
    }
    let weak = weak_parameters(fit.fitted, fit.scale, fit.gravity);
    let refused: Vec<&str> = weak
        .iter()
        .filter(|w| w.refused)
        .map(|w| w.name.as_str())
        .collect();
    if !refused.is_empty() {
        let unknown = format!("not known: {}{}", refused.join(", "), least_known(fit));
        return Err(Error::not_enough(refusal(directions, &unknown)));
    }
    let found = plan::coverage(directions);
    if !found.is_complete() {
        let missing = Finding::of(Kind::PlacementsMissing)
            .of_sensor(Sensor::Accelerometer)
            .detail("found", found.found());
        let missing = match weakest(fit) {
            Some((name, error, _)) => missing
                .detail("parameter", name)
                .detail("error", percent(error)),
            None => missing,
        };
        let placements = found.wanted.iter().map(|w| w.axes.clone()).collect();
        warnings.push(missing.remedy(Remedy::AddPlacements { placements }));
    }
    let found = found.found();
    warnings.extend(
        weak.into_iter()
            .map(|weak| weak.finding(Sensor::Accelerometer, &found)),
    );
    Ok(())
}

/// `known to 0.31 % only`, or not known: an error of a scale factor or of a bias, as a share.
fn share_in_words(error: f64, decimals: usize, of: &str) -> String {
    if error >= 1.0 || !error.is_finite() {
        return "is not known".into();
    }
    let percent = 100.0 * error;
    // Two digits at least, and no more decimals than a person reads.
    let decimals = decimals.max((1.0 - percent.log10().floor()).clamp(0.0, 4.0) as usize);
    format!("is known to {percent:.decimals$} %{of} only")
}

/// `; accel.s_z is known to 0.31 % only`: the parameter with the largest error, a bias against gravity.
fn least_known(fit: &ForceEvidence<'_>) -> String {
    weakest(fit).map_or(String::new(), |(name, error, of)| {
        format!("; {name} {}", share_in_words(error, 2, of))
    })
}

/// The least known parameter of the accelerometer, its error as a share, and of what.
fn weakest<'a>(fit: &'a ForceEvidence<'_>) -> Option<(&'a str, f64, &'static str)> {
    let fitted = fit.fitted;
    let relative = |name: &String| {
        let error = fitted.standard_error(name)?;
        Some(if name.contains(".b_") {
            error * fit.scale / fit.gravity
        } else {
            error / fit.scale
        })
    };
    let worst = fitted
        .free
        .iter()
        .filter(|name| name.starts_with("accel."))
        .filter_map(|name| Some((name, relative(name)?)))
        .max_by(|a, b| a.1.total_cmp(&b.1));
    worst.map(|(name, error)| {
        let of = if name.contains(".b_") {
            " of gravity"
        } else {
            ""
        };
        (name.as_str(), error, of)
    })
}

/// A share in percent.
fn percent(share: f64) -> String {
    findings::human(share, "share")
}

/// Refuses a fit that the turns do not determine and warns of weak parameters.
pub(in crate::calibrate) fn gyroscope_is_determined(
    fit: &RateEvidence<'_>,
    warnings: &mut Findings,
) -> Result<(), Error> {
    let RateEvidence { fitted, turns, .. } = *fit;
    let refusal = |unknown: String, names: &[&str]| {
        let wanted = plan::turns_wanted(names.iter().copied());
        Error::not_enough(format!(
            "{turns} turns: {unknown}; {}; {wanted}",
            plan::REQUIREMENT
        ))
    };
    if fitted.rank < fitted.free.len() {
        let open = involved(fitted);
        let unknown = format!(
            "they determine {} of the gyroscope's {} parameters, not observable: {}",
            fitted.rank,
            fitted.free.len(),
            open.join(", ")
        );
        return Err(refusal(unknown, &open));
    }
    if 2 * turns <= fitted.free.len() {
        let unknown = format!(
            "they leave nothing to check the gyroscope's {} parameters with, at least {} turns are needed",
            fitted.free.len(),
            fitted.free.len() / 2 + 1
        );
        return Err(refusal(unknown, &[]));
    }
    if !fit.ending.termination.converged() {
        return Err(Error::not_converged(format!(
            "the gyroscope's fit stopped after {} steps ({:?})",
            fit.ending.steps, fit.ending.termination
        )));
    }
    let weak = weak_parameters(fitted, fit.scale, 1.0);
    let refused: Vec<&str> = weak
        .iter()
        .filter(|w| w.refused)
        .map(|w| w.name.as_str())
        .collect();
    if !refused.is_empty() && fit.rms < LOST {
        let unknown = format!("not known: {}", refused.join(", "));
        return Err(refusal(unknown, &refused));
    }
    let found = format!("{turns} turns");
    warnings.extend(
        weak.into_iter()
            .map(|weak| weak.finding(Sensor::Gyroscope, &found)),
    );
    Ok(())
}

fn seen(request: &AccelerometerRequest) -> Vec<Vector3<f64>> {
    let means = request.recordings.iter().flatten();
    means.map(|mean| mean.raw.normalize()).collect()
}

fn directions(fit: &AccelerometerFit, request: &AccelerometerRequest) -> Vec<Vector3<f64>> {
    let shared = request.model.parameter_count();
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

/// The parameters that lead a combination that the data cannot see: no factor stands before them in its words.
fn involved(fitted: &Fitted) -> Vec<&str> {
    let is_factor = |word: &&str| word.parse::<f64>().is_ok();
    let leads = |name: &&String| {
        fitted.unobservable.iter().any(|combination| {
            let words: Vec<&str> = combination.split_whitespace().collect();
            (0..words.len()).any(|k| {
                let before = k.checked_sub(1).map(|k| words[k]);
                words[k] == name.as_str() && !before.as_ref().is_some_and(is_factor)
            })
        })
    };
    let free = fitted.free.iter();
    free.filter(leads).map(String::as_str).collect()
}

struct Weak {
    name: String,
    error: String,
    refused: bool,
}

impl Weak {
    fn finding(self, sensor: Sensor, evidence: &str) -> Finding {
        Finding::of(Kind::WeakParameter)
            .of_sensor(sensor)
            .detail("parameter", self.name)
            .detail("error", self.error)
            .detail("evidence", evidence)
    }
}

/// Parameters known too badly; `scale` is SI units per raw unit, `size` the unit of the bias limits.
fn weak_parameters(fitted: &Fitted, scale: f64, size: f64) -> Vec<Weak> {
    let weak = |name: &String| {
        let std = fitted.standard_error(name)?;
        let is_bias = name.contains(".b_");
        let (share, limits, error) = if is_bias {
            let unit = if name.starts_with("accel.") {
                "m/s^2"
            } else {
                "rad/s"
            };
            let share = std * scale / size;
            (
                share,
                [BIAS_WARN, BIAS_REFUSE],
                findings::human(std * scale, unit),
            )
        } else {
            let share = std / scale;
            (share, [RELATIVE_WARN, RELATIVE_REFUSE], percent(share))
        };
        (share > limits[0]).then(|| Weak {
            name: name.clone(),
            error,
            refused: share > limits[1],
        })
    };
    let of_base = |name: &&String| name.starts_with("accel.") || name.starts_with("gyro.");
    fitted
        .free
        .iter()
        .filter(of_base)
        .filter_map(weak)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_share_beyond_the_whole_is_not_known_and_a_small_one_has_two_digits() {
        let words = [2.5e15, 1.2, f64::NAN, 0.314, 0.0567, 0.00031, 4e-6];
        let words = words.map(|error| share_in_words(error, 1, ""));
        let expected = [
            "is not known",
            "is not known",
            "is not known",
            "is known to 31.4 % only",
            "is known to 5.7 % only",
            "is known to 0.031 % only",
            "is known to 0.0004 % only",
        ];
        assert_eq!(words, expected);
    }
}
