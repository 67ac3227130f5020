//! One session: made, looked into, judged.

use std::time::Instant;

use calib::Error;
use calib::discover::{
    EffectFinding, Extension, Request, Session, State, Verdict, delay, discover, gap_of, held_out,
};
use calib::methods::joint::BiasNoise;
use calib::simulate::{Spec, Truth};
use sensor::Role;
use serde::{Deserialize, Serialize};

use super::formulas;
use super::row::{Job, Row};
use super::size::noncentrality;

/// What became of a session.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Record {
    /// Its place in the row.
    pub index: u64,
    /// What kind of session of the row.
    pub kind: String,
    /// Noncentrality of what is hidden, as measured at unit size and scaled; `None` where it could not be.
    pub lambda: Vec<Option<f64>>,
    /// The names that are right.
    pub hidden: Vec<String>,
    /// Claims that are right although nothing is hidden.
    #[serde(default)]
    pub right: Vec<String>,
    /// The effects that were named.
    pub named: Vec<String>,
    /// What each of them was said to be indistinguishable from.
    pub ties: Vec<Vec<String>>,
    /// The faults of the recording that were named.
    pub integrity: Vec<String>,
    /// What each of them was said to be indistinguishable from.
    #[serde(default)]
    pub fault_ties: Vec<Vec<String>>,
    /// The formula that was proposed.
    #[serde(default)]
    pub proposed: Option<String>,
    /// Whether that, or one that could not be told from it, is the hidden one.
    #[serde(default)]
    pub is_formula: bool,
    /// Forms that explain as much as the named effects.
    #[serde(default)]
    pub forms: Vec<String>,
    /// What was left unexplained, in words.
    pub unexplained: Option<String>,
    /// `(estimate − truth)/σ` of the parameters of effects that were rightly named.
    pub z: Vec<f64>,
    /// Held-out gap of the final model over that of the true model, of rightly named effects.
    pub gap_ratio: Vec<f64>,
    /// Seconds for the whole discovery.
    pub seconds: f64,
    /// Why there was none.
    pub refused: Option<String>,
}

/// Runs one session; the same index gives the same result.
///
/// # Errors
/// A spec that contradicts itself.
pub fn run(row: Row, index: u64) -> Result<Record, Error> {
    let job = Job::new(row, index);
    let mut record = Record {
        index,
        kind: job.kind.clone(),
        hidden: job.hidden.clone(),
        right: job.right.clone(),
        ..Record::default()
    };
    let spec = scaled(&job, &mut record)?;
    let session = spec.run()?;
    let recordings = [session.recording.clone()];
    let mut request = Request::new(spec.gravity);
    request.noise = job.told.then(|| BiasNoise::walks(job.walks));
    let start = Instant::now();
    let discovery = match discover(&recordings, &request) {
        Ok(discovery) => discovery,
        Err(refusal) => {
            record.refused = Some(refusal.to_string());
            return Ok(record);
        }
    };
    record.seconds = start.elapsed().as_secs_f64();
    let findings = &discovery.findings;
    debug_assert!(findings.verdict != Verdict::Nothing || findings.effects.is_empty());
    record.unexplained = findings.unexplained.as_ref().map(|u| u.shape());
    if let Some(proposed) = &findings.proposed {
        let hidden = formulas::Hidden::named(&job.kind);
        record.is_formula =
            hidden.is_some_and(|hidden| hidden.is(&proposed.equation, &proposed.alternatives));
        record.proposed = Some(proposed.equation.clone());
    }
    let faults = findings.integrity.iter();
    let mut faults: Vec<(String, Vec<String>)> = faults
        .map(|fault| (fault.name.to_string(), fault.indistinguishable_from.clone()))
        .collect();
    faults.sort();
    faults.dedup();
    (record.integrity, record.fault_ties) = faults.into_iter().unzip();
    for effect in &findings.effects {
        record.named.push(effect.name.clone());
        record.ties.push(effect.indistinguishable_from.clone());
        record.forms.extend(effect.forms.iter().cloned());
        if !job.hidden.contains(&effect.name) {
            continue;
        }
        record.z.extend(deviations(effect, &session.truth));
    }
    if !record.named.is_empty() && job.what() == job.hidden {
        record.gap_ratio = against_the_truth(&job, &recordings, &request, &discovery)?;
    }
    Ok(record)
}

/// The session of this number in a row, with what is hidden in it.
///
/// # Errors
/// A spec that contradicts itself.
pub fn spec_of(row: Row, index: u64) -> Result<Spec, Error> {
    scaled(&Job::new(row, index), &mut Record::default())
}

/// The session of this number in a row with what is hidden in it, and the noise of the biases that the analysis is told;
/// `None` where it hides something else.
///
/// # Errors
/// A spec that contradicts itself.
pub fn hidden_in(
    row: Row,
    hidden: &str,
    index: u64,
) -> Result<Option<(Spec, Option<BiasNoise>)>, Error> {
    let job = Job::new(row, index);
    if job.kind != hidden {
        return Ok(None);
    }
    let spec = scaled(&job, &mut Record::default())?;
    Ok(Some((spec, job.told.then(|| BiasNoise::walks(job.walks)))))
}

/// Errors of an effect's parameters in their standard errors, as far as a recording shows them.
fn deviations(effect: &EffectFinding, truth: &Truth) -> Vec<f64> {
    let known: Vec<(f64, Option<f64>, f64)> = effect
        .parameters
        .iter()
        .filter_map(|p| {
            let truth = truth.get(&format!("{}.{}", effect.name, p.name))?;
            Some((p.value, p.std, truth))
        })
        .collect();
    let compared = match (effect.name.as_str(), known.as_slice()) {
        // The heading of the first rest is nobody's to know: the length of the horizontal part, and the vertical one.
        ("earth_rate", &[(x, x_std, north), (y, y_std, east), vertical]) => {
            let length = x.hypot(y);
            let std = x_std.zip(y_std).map(|(a, b)| (a * x).hypot(b * y) / length);
            vec![(length, std, north.hypot(east)), vertical]
        }
        // Delays are relative to that of the axis without a standard error.
        ("gyro_delay", all) => {
            let earliest = all.iter().find(|(_, std, _)| std.is_none());
            let least = earliest.map_or(0.0, |(.., truth)| *truth);
            let relative = all
                .iter()
                .map(|(value, std, truth)| (*value, *std, truth - least));
            relative.collect()
        }
        _ => known,
    };
    compared
        .iter()
        .filter_map(|(value, std, truth)| Some((value - truth) / (*std)?))
        .collect()
}

/// The session with everything hidden in it at the size that the row asks for.
fn scaled(job: &Job, record: &mut Record) -> Result<Spec, Error> {
    let mut spec = job.clean.clone();
    let first = if job.clean.grade == calib::simulate::Grade::Tactical {
        0.1
    } else {
        1.0
    };
    for what in job.what() {
        let size = match job.row {
            Row::Invisible => 1.0,
            // The earth turns as fast as it does.
            _ if what == "earth_rate" => 1.0,
            _ if what == "time_offset" => {
                let late = lateness(job)?;
                record.lambda.push(late.map(|_| job.row.lambda()));
                spec.parameters
                    .extend(late.map(|d| ("time_offset.d".into(), d)));
                1.0
            }
            // Two samples: lost ones move the stamps of all that follow, so that sessions cannot be compared.
            _ if what.starts_with("lost_") => 0.4,
            // It is looked for in the readings of single rests, which the means know nothing of.
            _ if what == "rezeroing" => first,
            _ => {
                // Faults of the readout have no size.
                let Some(unit) = job.with(&what, 1.0) else {
                    spec = readout(job, &what)?;
                    continue;
                };
                let trial = if first == 1.0 {
                    unit
                } else {
                    job.with(&what, first).unwrap_or(unit)
                };
                match noncentrality(&job.clean, &trial, job.walks)? {
                    Some(lambda) if lambda > 0.0 => {
                        record.lambda.push(Some(job.row.lambda()));
                        first * (job.row.lambda() / lambda).sqrt()
                    }
                    _ => {
                        record.lambda.push(None);
                        first
                    }
                }
            }
        };
        if let Some(with) = job.with(&what, size) {
            spec.definitions.extend(with.definitions);
            spec.effects.extend(with.effects);
            spec.parameters.extend(with.parameters);
            spec.hidden.extend(with.hidden);
            spec.faults.extend(with.faults);
            spec.latitude = spec.latitude.or(with.latitude);
            spec.temperature = spec.temperature.or(with.temperature);
            spec.vibration = spec.vibration.or(with.vibration);
        }
    }
    Ok(spec)
}

/// Late stamps show in the moving accelerometer only: so many of its standard errors that their square is the row's
/// noncentrality. `None` where the moving accelerometer says nothing.
fn lateness(job: &Job) -> Result<Option<f64>, Error> {
    let recordings = [job.clean.run()?.recording];
    let session = Session::new(&recordings, &Request::new(job.clean.gravity))?;
    let base = State::fit(&session, Extension::default())?;
    Ok(delay(&base).map(|found| job.row.lambda().sqrt() * found.std))
}

/// A range that the turns exceed, steps four times the noise, or a dead zone of up to 1 °/s.
fn readout(job: &Job, what: &str) -> Result<Spec, Error> {
    let mut spec = job.clean.clone();
    if what == "saturation" {
        let recording = spec.run()?.recording;
        let rates = recording.gyroscope.iter().flat_map(|s| &s.values);
        let most = rates.map(nalgebra::Vector3::amax).fold(0.0, f64::max);
        spec.gyroscope.range = Some(0.7 * most);
    } else if what == "dead_zone" {
        spec.gyroscope.dead_zone = [0.002, 0.005, 0.01, 0.0175][(job.clean.seed % 4) as usize];
    } else {
        let noise = spec.noise(sensor::Sensor::Accelerometer).white * spec.rate.sqrt();
        spec.accelerometer.step = 4.0 * noise;
    }
    Ok(spec)
}

/// The held-out gaps of the final model over those of the model that is told the truth.
fn against_the_truth(
    job: &Job,
    recordings: &[calib::Recording],
    request: &Request,
    discovery: &calib::discover::Discovery,
) -> Result<Vec<f64>, Error> {
    let session = Session::new(recordings, request)?;
    let mut extension = Extension::default();
    for name in &job.hidden {
        let Some(effect) = request.catalogue.iter().find(|e| e.name() == name) else {
            return Ok(Vec::new());
        };
        let mut shape = None;
        for (k, p) in effect.params().iter().enumerate() {
            if p.role != Role::Coefficient && p.role != Role::Reference {
                let named = discovery
                    .search
                    .names
                    .iter()
                    .find(|n| n.claim.name() == name);
                shape = named
                    .and_then(|n| n.hypothesis.shape)
                    .or(Some((k, p.nominal)));
            }
        }
        extension.effects.push((effect.clone(), shape));
    }
    let truth = State::fit(&session, extension)?;
    let noise = discovery.search.last.noise;
    let Some(best) = held_out(&truth, noise) else {
        return Ok(Vec::new());
    };
    Ok(discovery
        .findings
        .effects
        .iter()
        .map(|e| e.held_out_gap_after / gap_of(&best, e.channel))
        .collect())
}
