//! Calibrations on a recording: what is left of each, and what speaks against the comparison.

use ::findings::{Finding, Findings, Front};
use std::path::Path;

use calib::calibrate::{STANDARD_GRAVITY, changes_part_way, implausible};
use calib::intervals::Segmentation;
use calib::limits::{LimitLine, Limits, Residuals, judge_on};
use calib::methods::cut;
use calib::readings::{symptoms, without_spikes};
use calib::recording::figure;
use calib::{Calibration, Evaluation, Recording, evaluate};

use crate::commands::calibrate::limits;
use crate::commands::shared::inputs::{
    DetectorArgs, DeviceArgs, gates_of, load, named_file, read_for, spinner,
};
use crate::exit::Failure;
use crate::pages::evaluation::{self, Next};
use crate::read_args::ReadArgs;
use crate::report::Level;
use crate::show;

/// Calibrations with what to call them, and the files that they are of.
pub struct Calibrations<'a> {
    /// The files, in the order in which they were given.
    pub files: Vec<(String, &'a Path)>,
    /// The calibrations with their names.
    pub all: Vec<(String, Calibration)>,
}

impl<'a> Calibrations<'a> {
    /// Reads those that `[NAME=]FILE` names; refuses two of one name.
    pub fn named(given: &'a [String]) -> Result<Self, Failure> {
        let (mut files, mut all) = (Vec::new(), Vec::new());
        for named in given {
            let (name, path) = named_file(named);
            if files.iter().any(|(other, _)| *other == name) {
                return Err(Failure::usage(format!(
                    "--calibration {named}: another one is called {name}"
                ))
                .advise("name them apart (NAME=FILE)"));
            }
            all.push((name.clone(), load(path)?));
            files.push((name, path));
        }
        Ok(Self { files, all })
    }
}

/// A calibration's name with its residuals held against limits.
pub type JudgedLimits = Vec<(String, Vec<LimitLine>)>;

/// A recording with the residuals of raw readings and of every calibration.
pub struct Compared {
    /// The recording.
    pub recording: Recording,
    /// Its static intervals and turns.
    pub segmentation: Segmentation,
    /// Residuals of the raw readings, then of each calibration, by name.
    pub rows: Vec<(String, Evaluation)>,
    /// Warnings about the recording and the comparison, one text each.
    pub warnings: Vec<String>,
    /// Doubts that a calibration is for this recording, of each.
    doubts: Vec<Vec<Finding>>,
}

/// The recording that calibrations are compared on, and how it is read and cut.
pub struct Asked<'a> {
    /// File or folder.
    pub recording: &'a Path,
    /// Detector of its static intervals.
    pub detector: &'a DetectorArgs,
    /// Use on a recording of another unit or device.
    pub device: DeviceArgs,
    /// Options of reading.
    pub read: &'a ReadArgs,
}

/// Measures the calibrations on the recording, with all that speaks against a comparison.
pub fn compared(
    asked: &Asked<'_>,
    calibrations: &Calibrations<'_>,
    gravities: &Gravities,
) -> Result<Compared, Failure> {
    let calibrations = &calibrations.all;
    let (detector, choose) = asked.detector.detector()?;
    let first = calibrations.first().map(|(_, calibration)| calibration);
    let recording = read_for(first, asked.recording, asked.read)?.decimated();
    let mut warnings = recording.warnings.clone();
    warnings.extend(gravities.differ(calibrations));
    let doubts = doubted(asked.device, calibrations, &recording, &mut warnings)?;
    let progress = spinner("comparing");
    let segmentation = cut(&recording, &detector, choose, gravities.raw)?.segmentation;
    let measure = |c, gravity| evaluate(&recording, &segmentation, c, gravity);
    let mut rows: Vec<(String, Evaluation)> = vec![("raw".into(), measure(None, gravities.raw)?)];
    for ((name, calibration), own) in calibrations.iter().zip(&doubts) {
        let mut left = measure(Some(calibration), gravities.of_calibration(calibration))?;
        // What is doubted altogether misses by more than its errors, too.
        match own.is_empty() {
            true => warnings.extend(
                left.warnings
                    .iter()
                    .map(|doubt| said_of(calibrations, name, doubt)),
            ),
            false => left.warnings = own.clone().into(),
        }
        rows.push((name.clone(), left));
    }
    progress.finish_and_clear();
    // What is wrong with the readings is in every misfit.
    let spikes = without_spikes(&recording).map_or_else(Vec::new, |(_, found)| found);
    let symptoms = symptoms(&recording, &segmentation);
    let found = symptoms.iter().chain(&spikes);
    warnings.extend(found.map(|found| found.in_recording(&recording)));
    // Misfits of a recording in which something changes say nothing of a calibration.
    let gyroscope = first.zip(rows.get(1)).and_then(|(calibration, (_, left))| {
        let t = calibration.gyroscope.as_ref()?.base().t;
        Some((t, left.direction_rms?.to_radians()))
    });
    let changes = changes_part_way(&recording, &segmentation, gravities.raw, gyroscope);
    warnings.extend(changes);
    let said = implausible(&recording, &segmentation, first, gravities.raw);
    warnings.extend(said.gates);
    warnings.extend(said.warnings);
    Ok(Compared {
        warnings: warnings.texts(Front::CommandLine),
        recording,
        segmentation,
        rows,
        doubts,
    })
}

/// The doubts that each calibration is for a recording; they and its gates become warnings, which say of several calibrations whose they are.
fn doubted(
    device: DeviceArgs,
    calibrations: &[(String, Calibration)],
    recording: &Recording,
    warnings: &mut Findings,
) -> Result<Vec<Vec<Finding>>, Failure> {
    let mut all = Vec::new();
    for (name, calibration) in calibrations {
        warnings
            .extend(gates_of(calibration).map(|text| said_of(calibrations, name, &text.into())));
        let doubts = device.doubts(calibration, &[recording])?;
        let of_biases = calibration.doubts_biases_of(recording);
        for doubt in doubts.iter().chain(&of_biases) {
            warnings.push(said_of(calibrations, name, doubt));
        }
        all.push(doubts);
    }
    Ok(all)
}

/// A doubt about a calibration, which says of several whose it is.
fn said_of(calibrations: &[(String, Calibration)], name: &str, doubt: &Finding) -> Finding {
    match calibrations.len() {
        1 => doubt.clone(),
        _ => format!("{}: {}", show::name(name), doubt.text(Front::CommandLine)).into(),
    }
}

impl Compared {
    /// The residuals held against limits; empty without these.
    pub fn judged_by(
        &self,
        limits: Option<&Limits>,
        calibrations: &[(String, Calibration)],
    ) -> JudgedLimits {
        let left = self.rows.iter().skip(1);
        let judged = |((name, c), (_, e)): (&(String, Calibration), &(String, Evaluation))| {
            let left = Residuals {
                at_rest: e.modulus_rms,
                after_turn: e.direction_rms,
            };
            Some((name.clone(), judge_on(limits?, c, left)))
        };
        calibrations.iter().zip(left).filter_map(judged).collect()
    }

    /// Level of the best calibration, a sentence on it, and next steps.
    pub fn verdict(
        &self,
        calibrations: &[(String, Calibration)],
        judged: &JudgedLimits,
    ) -> (Level, String, Vec<Next>) {
        let failed = calibrations.iter();
        let failed = failed.map(|(name, calibration)| failing(name, calibration, judged));
        let failed: Vec<Option<String>> = failed.collect();
        let seen = (&self.segmentation, &self.warnings[..]);
        evaluation::judged(&self.rows, (&self.doubts, &failed), seen)
    }
}

/// Why not to use a calibration: a limit, or a gate of its own recordings.
fn failing(
    name: &str,
    calibration: &Calibration,
    judged: &[(String, Vec<LimitLine>)],
) -> Option<String> {
    let own = judged.iter().find(|(other, _)| other == name);
    let limit = own.and_then(|(_, lines)| limits::failing(lines));
    let gate = || {
        let failed = !calibration.failed_gates.is_empty();
        failed.then(|| "a quality gate of its own recording".to_owned())
    };
    limit.or_else(gate)
}

/// The gravity that each row is compared with.
pub struct Gravities {
    given: Option<f64>,
    raw: f64,
}

impl Gravities {
    /// Builds the reference gravities: the given value, else each calibration's own. The raw readings take that of the
    /// first.
    pub fn of(given: Option<f64>, calibrations: &[(String, Calibration)]) -> Self {
        let first = calibrations
            .first()
            .map(|(_, calibration)| calibration.gravity);
        let raw = given.or(first).unwrap_or(STANDARD_GRAVITY);
        Self { given, raw }
    }

    fn of_calibration(&self, calibration: &Calibration) -> f64 {
        self.given.unwrap_or(calibration.gravity)
    }

    /// Returns the gravity of each row, m/s²: the raw readings, then the calibrations.
    pub fn rows(&self, calibrations: &[(String, Calibration)]) -> Vec<f64> {
        let own = calibrations.iter().map(|(_, c)| self.of_calibration(c));
        std::iter::once(self.raw).chain(own).collect()
    }

    /// Returns a note if the gravities differ.
    fn differ(&self, calibrations: &[(String, Calibration)]) -> Option<String> {
        let is_other = |(_, c): &(String, Calibration)| self.of_calibration(c) != self.raw;
        calibrations.iter().any(is_other).then(|| {
            let own = calibrations.iter().map(|(name, c)| format!("{} {} m/s²", show::name(name), figure(c.gravity)));
            format!(
                "the calibrations were made for different gravities ({}): each is compared with its own, the raw readings with \
                 that of the first; --gravity compares all with one",
                own.collect::<Vec<_>>().join(", ")
            )
        })
    }
}
