//! The gap on a recording that the fit did not see.
//!
//! ```text
//! calibration (held) ± its covariance ──► r, J on the recording ──► directions and biases out ──► χ²/dof
//! ```

use ::findings::{Finding, Kind, Level};
use estimate::calibration::doubts;
use estimate::methods::joint::{
    BiasNoise, Columns, Covariance, JointFit, Rows, Whitening, covariance_at, fit_joint,
};
use faer::Mat;
use recording::{Error, Recording};
use sensor::{EffectRef, Model, is_bias};

use crate::discovery::Discovery;
use crate::findings::{Confirmation, Says, Validation};
use crate::gap::channel::Channel;
use crate::gap::sequence::{Misfit, Sequence, whitening_at};
use crate::request::{Request, Session};
use crate::search::{Name, Search};
use crate::state::{Extension, State, joint_request};

findings::tuning! {
    /// Gauss–Newton steps of directions and biases: the problem is all but linear in them, and the first is
    /// taken at the recording's own fit.
    STEPS: usize = 3;

    /// A gap of a channel from which on a recording disagrees with the calibration, alone and against that of the recordings of the fit. Of
    /// one device a gap beyond 3 is rare, for the errors of the calibration are in it; of two it is a hundred and more.
    DISAGREES: f64 = 4.0;
}

/// Result of a recording that the fit did not see.
#[derive(Clone, Debug)]
pub struct Validated {
    /// The gap in each channel.
    pub gaps: Vec<Validation>,
    /// Its verdict on each named effect.
    pub confirmations: Vec<Confirmation>,
    /// Doubts whether it is of the device and in its units, as read by the calibration of the others.
    pub doubts: Vec<Finding>,
}

/// The gap of the calibrations that `discovery` has made, without and with everything named, on another
/// recording of the device: in every channel that something named or proposed lives in, in all channels where
/// nothing is.
///
/// The calibration is held; the recording's directions and biases are free. What is missed is expected to
/// have the covariance `I + k_a² C_a + k_g² C_g + J_s Σ J_sᵀ`: white noise, noise, and the errors of the calibration.
///
/// # Errors
/// A recording that cannot be cut or has too few rests to be fitted on its own.
pub fn validate(
    recording: &Recording,
    request: &Request,
    discovery: &Discovery,
) -> Result<Validated, Error> {
    let request = Request {
        left_out: Vec::new(),
        ..request.clone()
    };
    let session = Session::new(std::slice::from_ref(recording), &request)?;
    let search = &discovery.search;
    let noise = search.last.noise;
    let before = Missed::of(&session, &search.base, noise)?;
    let after = Missed::of(&session, &search.last, noise)?;
    let confirmations = confirmations(&recording.name, &session, discovery, (&before, &after))?;
    let named = &discovery.findings.effects;
    let proposed = discovery.findings.proposed.as_ref();
    let with_formula = match &discovery.with_formula {
        Some(model) => Some(Missed::of(&session, model, model.noise)?.misfits),
        None => None,
    };
    let is_proposed = |c: Channel| proposed.is_some_and(|p| p.channel == c);
    let shows = |c: Channel| is_proposed(c) || named.iter().any(|effect| effect.channel == c);
    // Late stamps show in none of these channels.
    let none = !Channel::ALL.into_iter().any(shows);
    let gaps = Channel::ALL
        .into_iter()
        .filter(|c| none || shows(*c))
        .map(|channel| {
            let [before, after] = [&before, &after].map(|m| m.misfits[channel as usize]);
            (channel, before, after)
        })
        .filter(|(_, _, after)| after.dof > 0.0)
        .map(|(channel, before, after)| Validation {
            recording: recording.name.clone(),
            channel,
            gap_before: before.gap(),
            gap_after: after.gap(),
            gap_with_formula: with_formula
                .filter(|_| is_proposed(channel))
                .map(|with| with[channel as usize].gap()),
            dof: after.dof,
        })
        .collect();
    let mut doubts = doubts_of(recording, discovery)?;
    if doubts.is_empty() {
        doubts.extend(disagreement(&recording.name, search, &after.misfits));
    }
    Ok(Validated {
        gaps,
        confirmations,
        doubts,
    })
}

/// The channel in which the calibration misses a recording most, where it misses that of the fit by much less.
fn disagreement(recording: &str, search: &Search, missed: &[Misfit; 3]) -> Option<Finding> {
    let own = Sequence::of(&search.last, search.last.noise).misfits(&search.last);
    let times = |k: usize| missed[k].gap() / own[k].gap().max(1.0);
    let worst = (0..missed.len()).max_by(|a, b| times(*a).total_cmp(&times(*b)))?;
    (times(worst) > DISAGREES.get()).then(|| {
        Finding::of(Kind::VALIDATION_DISAGREES)
            .in_recording(recording)
            .number("missed", missed[worst].gap(), "")
            .number("own", own[worst].gap(), "")
            .detail("channel", Channel::ALL[worst].words())
    })
}

/// Doubts whether a recording is of the device that was calibrated: those beyond what biases make, which are the recording's own here.
fn doubts_of(recording: &Recording, discovery: &Discovery) -> Result<Vec<Finding>, Error> {
    match doubts(&discovery.findings.calibration, recording) {
        Ok(_) => Ok(Vec::new()),
        Err(Error::Input(found)) => Ok(vec![found.at_level(Level::Care)]),
        Err(other) => Err(other),
    }
}

/// Verdicts of the validation recording on every named effect, `before` and `with` being what the base models and everything named leave
/// of it.
///
/// Of two calibrations, without and with the effect, the second predicts `d` less of the residuals `r` of the first. The share of `d`
/// that is in `r`, `dᵀ r/dᵀd`, is 1 where the effect is as it was named and 0 where the other device has none; its variance is `1/dᵀd`
/// under the covariance of [`validate`]. Nothing else that the recording has, and no channel in which the effect does not show, hides it.
fn confirmations(
    recording: &str,
    session: &Session<'_>,
    discovery: &Discovery,
    (before, with): (&Missed, &Missed),
) -> Result<Vec<Confirmation>, Error> {
    let search = &discovery.search;
    // An instant is of one recording.
    let lasts = |name: &&Name| name.claim.effect().is_some_and(|e| e.instant().is_none());
    let mut found = Vec::new();
    for name in search.names.iter().filter(lasts) {
        let other;
        let without = match name.without.extension.is_same(&search.base.extension) {
            true => before,
            false => {
                other = Missed::of(session, &name.without, search.last.noise)?;
                &other
            }
        };
        let mut effects = discovery.findings.effects.iter();
        let effect = effects.find(|effect| effect.name == name.claim.name());
        let Some((effect, [share, std])) = effect.zip(with.share_in(without)) else {
            continue;
        };
        let std = std * with.misfits[effect.channel as usize].gap().max(1.0);
        found.push(Confirmation {
            recording: recording.into(),
            effect: effect.name.clone(),
            share,
            std,
            says: Says::of(share, std),
        });
    }
    Ok(found)
}

/// The residual of another recording under a calibration, whose directions and biases are free.
struct Missed {
    /// Residuals, white-whitened (`m`).
    residuals: Vec<f64>,
    sequence: Sequence,
    /// Misfit of each channel.
    misfits: [Misfit; 3],
}

impl Missed {
    /// Under the calibration of `model`.
    fn of(session: &Session<'_>, model: &State, noise: BiasNoise) -> Result<Self, Error> {
        // What was disturbed in the other recording was disturbed there.
        // An instant belongs to the recording that it was found in: nothing is judged by it here.
        let lasting = |(effect, _): &&(EffectRef, _)| effect.instant().is_none();
        let effects = model.extension.effects.iter().filter(lasting);
        let fit = fit_joint(&joint_request(
            session,
            &Extension {
                effects: effects.cloned().collect(),
                ..Extension::default()
            },
        ))?;
        let held = HeldCalibration::of(&under(model, noise), &fit);
        let rows = fit.plain_rows();
        let mut x = fit.parameters.values()[..rows.layout.count()].to_vec();
        for (place, value) in &held.values {
            x[*place] = *value;
        }
        let nuisance: Vec<usize> = fit
            .free
            .iter()
            .copied()
            .filter(|k| *k < x.len() && held.values.iter().all(|(place, _)| place != k))
            .collect();
        for _ in 0..STEPS.get() {
            let (r, jacobian) = whitened(&rows, &fit, &x);
            let Some(step) = jacobian.select(&nuisance).least_squares(&r) else {
                break;
            };
            for (step, place) in step.iter().zip(&nuisance) {
                x[*place] -= step;
            }
        }
        let (r, jacobian) = whitened(&rows, &fit, &x);
        let covariance = expected(&fit, &held, &jacobian, noise);
        let whitening = Whitening::with_covariance(fit.whitening.white.clone(), &covariance);
        let ends = [fit.first_rows[0], fit.first_rows[1], r.len()];
        let sequence = Sequence::under(whitening, jacobian.select(&nuisance), ends);
        Ok(Self {
            misfits: sequence.of_column(&r),
            residuals: r,
            sequence,
        })
    }

    /// The share of what this calibration explains beyond another one that the residuals of that one have, and its standard error; `None`
    /// where it explains nothing else.
    fn share_in(&self, other: &Self) -> Option<[f64; 2]> {
        if self.residuals.len() != other.residuals.len() {
            return None;
        }
        let pairs = other.residuals.iter().zip(&self.residuals);
        let explained: Vec<f64> = pairs.map(|(without, with)| without - with).collect();
        let d = self.sequence.left_of(&explained);
        let r = self.sequence.left_of(&other.residuals);
        let square: f64 = d.iter().map(|v| v * v).sum();
        let along: f64 = d.iter().zip(&r).map(|(d, r)| d * r).sum();
        (square > 0.0).then(|| [along / square, 1.0 / square.sqrt()])
    }
}

/// A model's fit, its parameters moved to where walks of these densities put them.
///
/// Where an effect is missing it is taken for a walk of the bias, and errors as large as such a walk allows would hide
/// every gap.
fn under(model: &State, noise: BiasNoise) -> JointFit {
    let mut fit = JointFit::clone(&model.fit);
    let whitening = whitening_at(model, noise);
    let r = whitening.finish_column(&fit.white_residuals);
    let jacobian = whitening.finish_columns(fit.white_jacobian.clone());
    if let Some(step) = jacobian.least_squares(&r) {
        for (step, place) in step.iter().zip(&fit.free) {
            fit.parameters.values_mut()[*place] -= step;
        }
    }
    fit.set_jacobian(jacobian);
    fit
}

/// Residuals (`m`) and Jacobian of all parameters (`m × n`), white-whitened.
fn whitened(rows: &Rows<'_>, fit: &JointFit, x: &[f64]) -> (Vec<f64>, Columns) {
    let all: Vec<usize> = (0..rows.layout.count()).collect();
    rows.linearize(x).whitened_by(&all, &fit.whitening.white)
}

/// `I + k_a² C_a + k_g² C_g + J_s Σ J_sᵀ`, white-whitened.
fn expected(
    fit: &JointFit,
    held: &HeldCalibration,
    jacobian: &Columns,
    noise: BiasNoise,
) -> Covariance {
    let m = jacobian.nrows();
    let noise = covariance_at(&fit.components, &noise.levels());
    let v = noise.map_or_else(|| Mat::identity(m, m), |noise| noise.to_dense());
    let by_calibration = jacobian.select(&held.uncertain).to_dense();
    Covariance::dense(v + &by_calibration * &held.covariance * by_calibration.transpose())
}

/// A calibration in the units of another fit, biases left out: those are the recording's own.
struct HeldCalibration {
    /// Places in the other fit, and values.
    values: Vec<(usize, f64)>,
    /// Places of what the calibration has estimated.
    uncertain: Vec<usize>,
    /// Its covariance (`k × k`).
    covariance: Mat<f64>,
}

impl HeldCalibration {
    /// Carries the calibration of `from` through the unit of the readings to that of `to`: both fits work near
    /// SI units, each with a unit of its own.
    fn of(from: &JointFit, to: &JointFit) -> Self {
        let fitted = from.all_fitted();
        let own: Vec<String> = to.models.iter().flat_map(of_heading).collect();
        let is_own = |name: &str| is_bias(name) || own.iter().any(|own| own == name);
        let place = |name: &str| to.parameters.index(name).filter(|_| !is_own(name));
        let factor = |k: usize| {
            let (unit, place) = to.unit_of(k);
            unit.factor(place)
        };
        let values = fitted
            .parameters
            .names()
            .iter()
            .zip(fitted.parameters.values())
            .filter_map(|(name, value)| place(name).map(|k| (k, value / factor(k))))
            .collect();
        let estimated: Vec<(usize, usize)> = fitted
            .free
            .iter()
            .enumerate()
            .filter_map(|(i, name)| Some((i, place(name)?)))
            .collect();
        let covariance = Mat::from_fn(estimated.len(), estimated.len(), |a, b| {
            let ((i, k), (j, l)) = (estimated[a], estimated[b]);
            fitted.covariance[i][j] / (factor(k) * factor(l))
        });
        Self {
            values,
            uncertain: estimated.into_iter().map(|(_, k)| k).collect(),
            covariance,
        }
    }
}

/// The parameters that depend on the heading, which is another one in every recording.
fn of_heading(model: &Model) -> Vec<String> {
    let all = model.parameters();
    let places = model.references().into_iter();
    places.map(|k| all.names()[k].clone()).collect()
}

#[cfg(test)]
mod tests {
    use simulate::{Session as Simulated, Spec};

    use super::*;
    use crate::discover;

    const HIDDEN: &str = "gyro_g_sensitivity";

    /// Two sessions of one device, with other placements and other biases.
    fn pair() -> (Simulated, Recording) {
        let first = Spec::hand_held(11).with_effect(HIDDEN, 1.0).run().unwrap();
        let mut second = Spec::hand_held(12);
        let truth = &first.truth;
        for parameters in [&truth.accelerometer, &truth.gyroscope] {
            for (name, value) in parameters.names().iter().zip(parameters.values()) {
                match name.strip_prefix(&format!("{HIDDEN}.")) {
                    Some(own) => {
                        let effect = second.effects.entry(HIDDEN.into()).or_default();
                        effect.insert(own.into(), *value);
                    }
                    None if is_bias(name) => {}
                    None => {
                        second.parameters.insert(name.clone(), *value);
                    }
                }
            }
        }
        (first, second.run().unwrap().recording)
    }

    #[test]
    fn the_gap_closes_on_another_recording_of_the_device_and_not_on_that_of_a_stranger() {
        let (first, second) = pair();
        let request = Request::new(first.truth.spec.gravity);
        let discovery = discover(&[first.recording], &request).unwrap();
        assert_eq!(discovery.findings.effects[0].name, HIDDEN);
        let validated = validate(&second, &request, &discovery).unwrap();
        assert!(validated.doubts.is_empty(), "{:?}", validated.doubts);
        let (found, says) = (validated.gaps, validated.confirmations);
        assert_eq!(found.len(), 1);
        let rate = &found[0];
        assert_eq!(rate.channel, Channel::StaticRate);
        assert!(rate.gap_before > 3.0, "{rate:?}");
        // χ²/dof of a complete model scatters by √(2/dof); three of these.
        let spread = 3.0 * (2.0 / rate.dof).sqrt();
        assert!((rate.gap_after.powi(2) - 1.0).abs() < spread, "{rate:?}");
        assert_eq!((says.len(), says[0].says), (1, Says::Confirms));
        assert!((says[0].share - 1.0).abs() < 4.0 * says[0].std, "{says:?}");
        let stranger = Spec::hand_held(13).run().unwrap().recording;
        let validated = validate(&stranger, &request, &discovery).unwrap();
        let is_said = |found: &Finding| found.kind == Kind::VALIDATION_DISAGREES;
        assert!(
            validated.doubts.iter().any(is_said),
            "{:?}",
            validated.doubts
        );
        let (found, says) = (validated.gaps, validated.confirmations);
        assert_eq!(says[0].says, Says::SpeaksAgainst, "{says:?}");
        assert!(found[0].gap_after > 3.0, "{found:?}");
    }

    #[test]
    fn counts_and_units_of_one_device_give_the_same_gap() {
        let (first, second) = pair();
        let request = Request::new(first.truth.spec.gravity);
        let of = |first: &Recording, second: &Recording| {
            let discovery = discover(std::slice::from_ref(first), &request).unwrap();
            validate(second, &request, &discovery).unwrap().gaps
        };
        let counted = |recording: &Recording| {
            let mut counted = recording.clone();
            for (stream, scale) in [
                (&mut counted.accelerometer, 2000.0),
                (&mut counted.gyroscope, 8000.0),
            ] {
                for value in &mut stream.as_mut().unwrap().values {
                    *value = value.map(|v| v * scale + 32768.0);
                }
            }
            counted
        };
        let plain = of(&first.recording, &second);
        let counts = of(&counted(&first.recording), &counted(&second));
        assert_eq!(plain.len(), counts.len());
        for (a, b) in plain.iter().zip(&counts) {
            // The guess of the unit moves the start of the fit, and with it the last digits and the chunks' trim.
            assert!(
                (a.gap_after / b.gap_after - 1.0).abs() < 0.02,
                "{a:?} {b:?}"
            );
            assert!(
                (a.gap_before / b.gap_before - 1.0).abs() < 0.02,
                "{a:?} {b:?}"
            );
        }
    }
}
