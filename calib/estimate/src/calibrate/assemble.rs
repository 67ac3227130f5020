//! The fits written down as a [`Calibration`].

use findings::{Finding, Findings, Kind};
use recording::intervals::Segmentation;
use recording::{Error, Recording};
use sensor::{BASE_PARAMETERS, Base, Model, PLACES, Sensor, base_names};

use super::bias::at_rest::rest_bias;
use super::cut::Cut;
use super::left_out::left_out_by_norms;
use super::request::{Frame, Request};
use super::static_norm::{StaticNorms, per_degree_of_freedom};
use super::{checks, noise};
use crate::calibration::{
    Calibration, EffectParameter, EffectValues, Outside, RecordingBias, Remainder, Triad,
    WITHOUT_WALKS, effect_named,
};
use crate::methods::joint::Channel;
use crate::methods::{AccelerometerFit, Fitted, GyroscopeFit};

/// Writes the fits down, checks the quality gates, turns the result into the frame asked for.
pub(super) fn calibration(
    cut: &Cut<'_>,
    turning: &[(&Recording, &Segmentation)],
    (accelerometer, gyroscope): (Option<&AccelerometerFit>, Option<&GyroscopeFit>),
    request: &Request,
    mut warnings: Findings,
) -> Result<Calibration, Error> {
    let mut table = Table::default();
    let mut failed_gates = Findings::new();
    let norms = accelerometer.and_then(|fit| StaticNorms::of(fit, cut));
    let accelerometer_triad = accelerometer.map(|fit| {
        table.add(&fit.fitted);
        let (scale, gravity) = (fit.unit.scale, request.gravity);
        for (recording, segmentation) in cut.each() {
            failed_gates.extend(checks::restless(recording, segmentation, scale, gravity));
            warnings.extend(checks::long_turns(recording, segmentation));
        }
        failed_gates.extend(checks::disagreeing_rests(fit, cut.each()));
        let force = checks::ForceFit::of(&fit.fitted, fit.unit, gravity, &cut.recordings);
        let said = force.said();
        said.add_to(&mut failed_gates, &mut warnings);
        accelerometer_triad(fit, &cut.recordings, norms.as_ref(), request)
    });
    let gyroscope_triad = match (gyroscope, accelerometer) {
        (Some(fit), Some(force)) => {
            table.add(&fit.fitted);
            let turned: Vec<&Recording> = turning.iter().map(|(recording, _)| *recording).collect();
            let rate = checks::RateFit::of(&fit.fitted, &fit.unit, fit.rms(), &force.unit, &turned);
            let said = rate.said();
            said.add_to(&mut failed_gates, &mut warnings);
            Some(gyroscope_triad(fit, force, turning, request, &mut table))
        }
        _ => resting_gyroscope(turning, &mut table),
    };
    let remainders: Vec<Remainder> = [
        accelerometer
            .zip(accelerometer_triad.as_ref())
            .and_then(|(fit, triad)| {
                let spare = fit.first.residuals.len().checked_sub(fit.fitted.rank)?;
                let (rms, chi2) = (triad.residual_rms, triad.reduced_chi2?);
                let shown = norms.as_ref().and_then(StaticNorms::pattern);
                Some(Remainder::new(Channel::Force, rms, chi2, spare as f64).depending(shown))
            }),
        gyroscope
            .zip(gyroscope_triad.as_ref())
            .and_then(|(fit, triad)| {
                let dof =
                    direction_freedom(fit, triad.residual_rms.to_radians(), triad.reduced_chi2?);
                let (rms, chi2) = (triad.residual_rms.to_radians(), triad.reduced_chi2?);
                Some(Remainder::new(Channel::Direction, rms, chi2, dof))
            }),
    ]
    .into_iter()
    .flatten()
    .collect();
    warnings.extend(
        remainders
            .iter()
            .filter_map(|r| r.finding(WITHOUT_WALKS.get())),
    );
    let mut effects = Vec::new();
    for fit in [
        accelerometer.map(|fit| (&fit.model, &fit.fitted)),
        gyroscope.map(|fit| (&fit.model, &fit.fitted)),
    ] {
        effects.extend(
            fit.into_iter()
                .flat_map(|(model, fitted)| effect_values(model, fitted)),
        );
    }
    if accelerometer_triad.is_none() && gyroscope_triad.is_none() {
        return Err(Error::not_enough(Finding::of(Kind::NOTHING_TO_CALIBRATE)));
    }
    let left_out = accelerometer
        .zip(norms.as_ref())
        .map_or_else(Vec::new, |(fit, norms)| left_out_by_norms(fit, norms));
    let calibration = Calibration {
        accelerometer: accelerometer_triad,
        gyroscope: gyroscope_triad,
        effects,
        parameters: table.names,
        covariance: table.covariance,
        misfit: remainders,
        left_out,
        warnings,
        failed_gates,
        ..Calibration::by("stepwise", request.gravity, request.gravity_source)
    };
    Ok(match request.frame {
        Frame::Triangular => calibration,
        Frame::Symmetric => crate::calibration::in_symmetric_frame(calibration),
    })
}

/// Names and block-diagonal covariance, as the stages add to it.
#[derive(Default)]
struct Table {
    names: Vec<String>,
    covariance: Vec<Vec<f64>>,
}

impl Table {
    fn add(&mut self, fitted: &Fitted) {
        self.block(&fitted.free, &fitted.covariance);
    }

    fn block(&mut self, names: &[String], block: &[Vec<f64>]) {
        let before = self.names.len();
        for row in &mut self.covariance {
            row.resize(before + names.len(), 0.0);
        }
        for row in block {
            let mut padded = vec![0.0; before];
            padded.extend_from_slice(row);
            self.covariance.push(padded);
        }
        self.names.extend_from_slice(names);
    }
}

fn accelerometer_triad(
    fit: &AccelerometerFit,
    recordings: &[&Recording],
    norms: Option<&StaticNorms>,
    request: &Request,
) -> Triad {
    let mut triad = triad(Sensor::Accelerometer, &fit.fitted);
    triad.residual_rms = fit.first.rms();
    triad.static_intervals = Some(fit.first.residuals.len());
    if fit.own_bias {
        let shared = fit.model.parameter_count();
        let names = recordings.iter().map(|r| r.name.as_str());
        triad.state_biases(own_biases(
            Sensor::Accelerometer,
            &fit.fitted,
            shared,
            names,
        ));
    }
    if request.static_means.is_empty() {
        triad.reduced_chi2 = norms.and_then(StaticNorms::reduced_chi2);
    }
    triad
}

/// The bias of every recording.
pub(super) fn own_biases<'a>(
    sensor: Sensor,
    fitted: &Fitted,
    shared: usize,
    names: impl Iterator<Item = &'a str>,
) -> Vec<RecordingBias> {
    let of = |(k, name): (usize, &str)| {
        let bias = &fitted.local(shared, k)[9..BASE_PARAMETERS];
        let std = ["x", "y", "z"].map(|axis| {
            let common = format!("{}.b_{axis}", sensor.prefix());
            let own = format!("{common}[{name}]");
            fitted
                .standard_error(&own)
                .or(fitted.standard_error(&common))
        });
        RecordingBias {
            recording: name.to_owned(),
            bias: [bias[0], bias[1], bias[2]],
            bias_std: std,
        }
    };
    names.enumerate().map(of).collect()
}

fn gyroscope_triad(
    fit: &GyroscopeFit,
    force: &AccelerometerFit,
    turning: &[(&Recording, &Segmentation)],
    request: &Request,
    table: &mut Table,
) -> Triad {
    let mut triad = triad(Sensor::Gyroscope, &fit.fitted);
    triad.residual_rms = fit.rms().to_degrees();
    triad.dynamic_intervals = Some(fit.chords.len());
    let base = Base::from_parameters(force.fitted.parameters.values());
    let sigmas: Vec<f64> = turning
        .iter()
        .flat_map(|(r, s)| noise::of_turns(r, s, &base, fit.unit.scale, request.gravity))
        .collect();
    if sigmas.len() == fit.chords.len() {
        let sum: f64 = fit
            .chords
            .iter()
            .zip(&sigmas)
            .map(|(c, s)| (c / s).powi(2))
            .sum();
        let noise = sigmas.iter().map(|s| s * s).sum::<f64>() / sigmas.len() as f64;
        let spare = (2 * sigmas.len()).saturating_sub(fit.fitted.rank).max(1) as f64;
        // What the accelerometer's own errors make of the turns is no misfit of the gyroscope.
        let explained = 1.0 + fit.carried.iter().sum::<f64>() / (noise * spare);
        triad.reduced_chi2 =
            per_degree_of_freedom(sum / explained, 2 * sigmas.len(), fit.fitted.rank);
    }
    if fit.model.effects().is_empty() {
        rest_biases(&mut triad, turning, table);
    }
    triad
}

/// Degrees of freedom of the turns' sum of squares (Satterthwaite 1946): the noise has many small shares in it, each
/// combination of the accelerometer's errors one that may be large.
fn direction_freedom(fit: &GyroscopeFit, rms: f64, reduced_chi2: f64) -> f64 {
    let spare = (2 * fit.chords.len())
        .saturating_sub(fit.fitted.rank)
        .max(1) as f64;
    let expected = rms * rms * fit.chords.len() as f64 / reduced_chi2.max(f64::MIN_POSITIVE);
    let carried: f64 = fit.carried.iter().sum();
    let noise = (expected - carried).max(0.0) / spare;
    let squares = spare * noise * noise + fit.carried.iter().map(|c| c * c).sum::<f64>();
    if squares > 0.0 {
        (spare * noise + carried).powi(2) / squares
    } else {
        spare
    }
}

/// A gyroscope without gravity to carry: its bias from the rests, and nothing else.
fn resting_gyroscope(turning: &[(&Recording, &Segmentation)], table: &mut Table) -> Option<Triad> {
    let rests = turning.iter().flat_map(|(_, s)| &s.statics);
    rests.clone().find_map(|rest| rest.gyroscope)?;
    let mut triad = Triad {
        static_intervals: Some(rests.count()),
        rank: 3,
        unobservable: vec![Finding::of(Kind::NOT_SEEN_WITHOUT_GRAVITY).what()],
        ..Triad::of(Sensor::Gyroscope, &Base::identity())
    };
    rest_biases(&mut triad, turning, table);
    Some(triad)
}

/// The gyroscope's bias: the mean over the rests of each recording, with the scatter between rests
/// as its error.
fn rest_biases(triad: &mut Triad, turning: &[(&Recording, &Segmentation)], table: &mut Table) {
    let biases: Vec<RecordingBias> = turning
        .iter()
        .filter_map(|(recording, s)| rest_bias(recording, s))
        .collect();
    let Some(last) = biases.last() else { return };
    triad.bias = last.bias;
    triad.bias_std = last.bias_std;
    let names = &base_names(Sensor::Gyroscope)[9..];
    let block: Vec<Vec<f64>> = (0..3)
        .map(|i| {
            let variance = last.bias_std[i].map_or(f64::NAN, |s| s * s);
            (0..3)
                .map(|j| if i == j { variance } else { 0.0 })
                .collect()
        })
        .collect();
    if last.bias_std.iter().all(Option::is_some) {
        table.block(names, &block);
    }
    if biases.len() > 1 {
        triad.state_biases(biases);
    }
}

pub(super) fn triad(sensor: Sensor, fitted: &Fitted) -> Triad {
    let names = base_names(sensor);
    let base = Base::from_parameters(fitted.parameters.values());
    let mut t_std = [[None; 3]; 3];
    for (name, (i, j)) in names.iter().zip(PLACES) {
        t_std[i][j] = fitted.standard_error(name);
    }
    Triad {
        t_std,
        bias_std: [9, 10, 11].map(|k| fitted.standard_error(&names[k])),
        rank: fitted.rank,
        condition: fitted.condition,
        unobservable: fitted.unobservable.clone(),
        ..Triad::of(sensor, &base)
    }
}

pub(super) fn effect_values<'a>(
    model: &'a Model,
    fitted: &'a Fitted,
) -> impl Iterator<Item = EffectValues> + 'a {
    model.effects().iter().map(|effect| {
        let parameters = effect
            .params()
            .iter()
            .map(|p| {
                let name = format!("{}.{}", effect.name(), p.name);
                EffectParameter {
                    name: p.name.to_string(),
                    value: fitted.parameters.get(&name).unwrap_or(p.nominal),
                    std: fitted.standard_error(&name),
                    unit: p.unit.to_string(),
                }
            })
            .collect();
        EffectValues {
            name: effect.name().into(),
            definition: effect.definition().cloned(),
            parameters,
            outside: effect_named(effect.name())
                .is_none()
                .then_some(Outside(effect.clone())),
        }
    })
}
