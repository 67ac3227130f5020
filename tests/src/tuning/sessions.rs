//! The sessions by which a tuning constant is judged, and what two runs of them differ by.

use std::path::Path;

use calib::calibrate::{Method, Request, calibrate};
use calib::discover::{self, discover};
use calib::recording::{ReadOptions, to_csv};
use calib::{Error, Recording};
use findings::Findings;
use sensor::Sensor;
use serde::{Deserialize, Serialize};

use crate::conditions::{CONDITIONS, condition};
use crate::power::{self, Row};

/// Conditions of recordings that are calibrated: one in so many of them.
const ONE_IN: usize = 12;

/// Recordings that are searched: one hides nothing, the others an effect and something outside the catalogue.
const SEARCHED: [(Row, u64); 3] = [(Row::Clean, 0), (Row::Orientation30, 1), (Row::Outside, 1)];

/// A number that moves by more than this share of its standard error has moved.
const MOVES: f64 = 0.1;

/// One session, simulated once for all runs.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Job {
    /// The recording's file.
    file: String,
    /// Local gravity, m/s².
    gravity: f64,
    /// The condition under which it is calibrated; `None` where it is searched.
    condition: Option<String>,
}

/// What a session gave.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Outcome {
    /// The findings and the names, without numbers.
    pub said: Vec<String>,
    /// Estimates with their standard errors.
    pub numbers: Vec<[f64; 2]>,
}

/// How many of the sessions have other results.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Moved {
    /// Whose findings are others.
    pub said: usize,
    /// Whose numbers are others, and the findings are not.
    pub numbers: usize,
}

/// Number of the sessions.
pub fn sessions() -> usize {
    CONDITIONS.iter().copied().flatten().step_by(ONE_IN).count() + SEARCHED.len()
}

/// Simulates all sessions into a folder.
///
/// # Errors
/// A session that contradicts itself; a file that cannot be written.
pub fn simulate(folder: &Path) -> Result<Vec<Job>, Box<dyn std::error::Error + Send + Sync>> {
    let conditions = CONDITIONS.iter().copied().flatten().step_by(ONE_IN);
    let mut specs: Vec<_> = conditions
        .map(|own| (own.spec(0), Some(own.name.to_owned())))
        .collect();
    for (row, index) in SEARCHED {
        specs.push((power::spec_of(row, index)?, None));
    }
    let mut jobs = Vec::new();
    for (k, (spec, condition)) in specs.into_iter().enumerate() {
        let file = folder.join(format!("{k}.csv"));
        std::fs::write(&file, to_csv(&mut spec.run()?.recording))?;
        jobs.push(Job {
            file: file.to_string_lossy().into_owned(),
            gravity: spec.gravity,
            condition,
        });
    }
    Ok(jobs)
}

/// What the sessions give.
pub fn outcomes(jobs: &[Job]) -> Vec<Outcome> {
    let outcome = |job: &Job| run(job).unwrap_or_else(|refusal| refused(&refusal));
    jobs.iter().map(outcome).collect()
}

fn refused(refusal: &Error) -> Outcome {
    let text = refusal.to_string();
    Outcome {
        said: vec![text.chars().filter(|c| !c.is_ascii_digit()).collect()],
        numbers: Vec::new(),
    }
}

fn run(job: &Job) -> Result<Outcome, Error> {
    let recording = Recording::read(Path::new(&job.file), &ReadOptions::default())?;
    let recordings = [recording];
    match job.condition.as_deref().and_then(condition) {
        Some(condition) => {
            let spec = condition.spec(0);
            let mut outcome = Outcome::default();
            for method in [Method::Joint, Method::Stepwise] {
                let mut request = Request {
                    gravity: spec.gravity,
                    method,
                    ..Request::default()
                };
                (condition.ask)(&spec, &mut request);
                let calibration = calibrate(&recordings, &[], &request)?.calibration;
                outcome.said.extend(kinds(&calibration.warnings));
                outcome.said.extend(kinds(&calibration.failed_gates));
                for sensor in [Sensor::Accelerometer, Sensor::Gyroscope] {
                    let triad = calibration.triad(sensor);
                    let numbers = triad.into_iter().flat_map(|triad| {
                        let values = triad.t.iter().flatten().chain(&triad.bias);
                        let errors = triad.t_std.iter().flatten().chain(&triad.bias_std);
                        values.zip(errors).filter_map(|(v, s)| Some([*v, (*s)?]))
                    });
                    outcome.numbers.extend(numbers);
                }
            }
            Ok(outcome)
        }
        None => {
            let found = discover(&recordings, &discover::Request::new(job.gravity))?.findings;
            let faults = found.integrity.iter().map(|fault| fault.name.to_string());
            let named = found.effects.iter().map(|effect| effect.name.clone());
            let formula = found.proposed.iter().map(|own| own.equation.clone());
            let open = found.unexplained.iter().map(|own| own.shape());
            let numbers = found.effects.iter().flat_map(|effect| {
                let own = effect.parameters.iter();
                own.filter_map(|p| Some([p.value, p.std?]))
            });
            Ok(Outcome {
                numbers: numbers.collect(),
                said: faults.chain(named).chain(formula).chain(open).collect(),
            })
        }
    }
}

fn kinds(findings: &Findings) -> impl Iterator<Item = String> {
    findings.iter().map(|found| found.kind.name().to_owned())
}

/// Compares two runs of the same sessions.
pub fn moved(before: &[Outcome], after: &[Outcome]) -> Moved {
    let mut moved = Moved::default();
    for (before, after) in before.iter().zip(after) {
        let is_near = |(a, b): (&[f64; 2], &[f64; 2])| {
            (a[0] - b[0]).abs() <= MOVES * a[1] && (a[1] - b[1]).abs() <= MOVES * a[1]
        };
        let are_near = before.numbers.len() == after.numbers.len()
            && before.numbers.iter().zip(&after.numbers).all(is_near);
        if before.said != after.said {
            moved.said += 1;
        } else if !are_near {
            moved.numbers += 1;
        }
    }
    moved
}
