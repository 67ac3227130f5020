//! Checks that the data determine the parameters, with findings that tell a user what to record.

use findings::{Finding, Findings, Kind, Remedy};
use nalgebra::Vector3;
use recording::Error;
use sensor::{BasePart, Sensor, base_part, is_bias};

use super::coverage::{open_by_directions, refusal};
use crate::methods::{AccelerometerFit, AccelerometerRequest, Ending, Fitted, GyroscopeFit};

findings::tuning! {
    /// A gyroscope that misses gravity by this much after the fit is not understood, rad.
    pub(super) LOST: f64 = 0.1;

    /// Standard errors of scale factors and misalignments above which a warning is due.
    RELATIVE_WARN: f64 = 0.01;
    /// Those above which the fit is refused.
    RELATIVE_REFUSE: f64 = 0.05;

    /// Standard errors of biases above which a warning is due, as a fraction of gravity or rad/s.
    BIAS_WARN: f64 = 0.01;
    /// Those above which the fit is refused.
    BIAS_REFUSE: f64 = 0.05;

    /// Parameters of an accelerometer that are all known to this need no further placement, by whatever they are known: share of the scale, or
    /// of gravity.
    KNOWN_WELL: f64 = 5e-4;
}

/// Faces of a device, which another method takes by themselves.
const FACES: usize = 6;

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
    /// Builds it from the stepwise fit.
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
    /// Builds it from the stepwise fit.
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
        let open = involved(fit.fitted).join(", ");
        let found = refusal(directions, Kind::PLACEMENTS_LEAVE_OPEN)
            .detail("parameters", open)
            .count("rank", fit.fitted.rank)
            .count("free", free);
        let is_of_faces = count == FACES && plan::coverage(directions).missing_faces.is_empty();
        let found = match is_of_faces {
            true => found.remedy(Remedy::OtherMethod {
                method: "six-position".into(),
            }),
            false => found,
        };
        return Err(Error::not_enough(found));
    }
    if count <= free {
        let found = refusal(directions, Kind::PLACEMENTS_TOO_FEW).count("free", free);
        return Err(Error::not_enough(with_weakest(found, fit)));
    }
    if !fit.ending.termination.converged()
        && let Some(open) = open_by_directions(&fit.seen)
    {
        return Err(Error::not_enough(open));
    }
    if !fit.ending.termination.converged() {
        let stopped = stopped(Sensor::Accelerometer, &fit.ending);
        return Err(Error::not_converged(stopped.number(
            "gravity",
            fit.gravity,
            "m/s^2",
        )));
    }
    let weak = weak_parameters(fit.fitted, fit.scale, fit.gravity);
    let refused: Vec<&str> = weak
        .iter()
        .filter(|w| w.refused)
        .map(|w| w.name.as_str())
        .collect();
    if !refused.is_empty() {
        let found = refusal(directions, Kind::PLACEMENTS_TELL_LITTLE)
            .detail("parameters", refused.join(", "));
        return Err(Error::not_enough(with_weakest(found, fit)));
    }
    let found = plan::coverage(directions);
    let weakest = weakest(fit);
    let is_known = weakest.is_some_and(|(_, error)| error <= KNOWN_WELL.get());
    let is_full = found.missing_faces.is_empty() && count >= plan::REQUIREMENT.placements;
    let is_enough = found.is_complete() || (is_known && is_full);
    if !is_enough {
        let missing = Finding::of(Kind::PLACEMENTS_MISSING)
            .of_sensor(Sensor::Accelerometer)
            .detail("found", found.found());
        let missing = match weakest {
            Some((name, error)) => missing
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

/// Builds the finding about a fit that did not converge.
fn stopped(sensor: Sensor, ending: &Ending) -> Finding {
    Finding::of(Kind::FIT_STOPPED)
        .of_sensor(sensor)
        .count("steps", ending.steps)
        .detail("ending", format!("{:?}", ending.termination))
}

/// The finding with the parameter that has the largest error, a bias against gravity; as it is where all are known well.
fn with_weakest(found: Finding, fit: &ForceEvidence<'_>) -> Finding {
    let is_open = |(_, error): &(&str, f64)| error.is_nan() || *error > KNOWN_WELL.get();
    match weakest(fit).filter(is_open) {
        Some((name, error)) if is_bias(name) => {
            known_to(found, name, error, (error * fit.gravity, "m/s^2"))
        }
        Some((name, error)) => known_to(found, name, error, (error, "share")),
        None => found,
    }
}

/// The finding with a parameter that is known to a share of the whole, or is not known.
fn known_to(found: Finding, name: &str, share: f64, error: (f64, &'static str)) -> Finding {
    match share < 1.0 {
        true => found
            .detail("weakest", name)
            .number("error", error.0, error.1),
        false => found.detail("unknown", name),
    }
}

/// The least known parameter of the accelerometer, and its error as a share of the scale or of gravity.
fn weakest<'a>(fit: &'a ForceEvidence<'_>) -> Option<(&'a str, f64)> {
    let fitted = fit.fitted;
    let relative = |name: &String| {
        let error = fitted.standard_error(name)?;
        Some(if is_bias(name) {
            error * fit.scale / fit.gravity
        } else {
            error / fit.scale
        })
    };
    let worst = fitted
        .free
        .iter()
        .filter(|name| base_part(name).is_some())
        .filter_map(|name| Some((name, relative(name)?)))
        .max_by(|a, b| a.1.total_cmp(&b.1));
    worst.map(|(name, error)| (name.as_str(), error))
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
    let refusal = |kind, names: &[&str]| {
        let found = Finding::of(kind)
            .of_sensor(Sensor::Gyroscope)
            .count("count", turns)
            .count("free", fitted.free.len())
            .detail("axes", plan::axes_wanted(names.iter().copied()))
            .because(plan::REQUIREMENT.finding());
        match names {
            [] => found,
            names => found.detail("parameters", names.join(", ")),
        }
    };
    if fitted.rank < fitted.free.len() {
        let open = involved(fitted);
        let found = refusal(Kind::TURNS_LEAVE_OPEN, &open).count("rank", fitted.rank);
        return Err(Error::not_enough(found));
    }
    if 2 * turns <= fitted.free.len() {
        let least = fitted.free.len() / 2 + 1;
        let found = refusal(Kind::TURNS_TOO_FEW, &[]).count("least", least);
        return Err(Error::not_enough(found));
    }
    if !fit.ending.termination.converged() {
        return Err(Error::not_converged(stopped(
            Sensor::Gyroscope,
            &fit.ending,
        )));
    }
    let weak = weak_parameters(fitted, fit.scale, 1.0);
    let refused: Vec<&str> = weak
        .iter()
        .filter(|w| w.refused)
        .map(|w| w.name.as_str())
        .collect();
    if !refused.is_empty() && fit.rms < LOST.get() {
        return Err(Error::not_enough(refusal(
            Kind::TURNS_TELL_LITTLE,
            &refused,
        )));
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
        Finding::of(Kind::WEAK_PARAMETER)
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
        let (sensor, part) = base_part(name)?;
        let (share, limits, error) = if part == BasePart::Bias {
            let unit = match sensor {
                Sensor::Accelerometer => "m/s^2",
                _ => "rad/s",
            };
            let share = std * scale / size;
            (
                share,
                [BIAS_WARN.get(), BIAS_REFUSE.get()],
                findings::human(std * scale, unit),
            )
        } else {
            let share = std / scale;
            (
                share,
                [RELATIVE_WARN.get(), RELATIVE_REFUSE.get()],
                percent(share),
            )
        };
        (share > limits[0]).then(|| Weak {
            name: name.clone(),
            error,
            refused: share > limits[1],
        })
    };
    fitted.free.iter().filter_map(weak).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_share_beyond_the_whole_is_not_known() {
        let words = [2.5e15, 1.2, f64::NAN, 0.314, 0.0567, 0.00031].map(|share| {
            let found = Finding::of(Kind::PLACEMENTS_TOO_FEW);
            known_to(found, "accel.s_x", share, (share, "share")).what()
        });
        let ends = [
            "accel.s_x is not known",
            "accel.s_x is not known",
            "accel.s_x is not known",
            "accel.s_x is known to 31.4 % only",
            "accel.s_x is known to 5.67 % only",
            "accel.s_x is known to 0.031 % only",
        ];
        for (words, end) in words.iter().zip(ends) {
            assert!(words.ends_with(end), "{words}");
        }
    }
}
