//! One device: its recordings to a calibration and a record.

use ::findings::{Front, Kind};
use std::path::{Path, PathBuf};
use std::str::FromStr;

use calib::calibrate::{Method, Request, calibrate};
use calib::calibration::effect_named;
use calib::discover::{self, Findings};
use calib::gravity::Gravity;
use calib::limits::{Limits, built_in, judge, not_kept, parameter};
use calib::prior::Prior;
use calib::recording::ReadOptions;
use calib::recording::shown::shown;
use calib::{Calibration, Error, Recording};

use crate::hash;
use crate::manifest::{Device, DeviceOptions};
use crate::record::{Finding, Misfit, Parameter, Record, Status};

/// Calibration options that all devices share.
#[derive(Clone, Debug)]
pub struct Options {
    /// The calibration.
    pub request: Request,
    /// Options of the reader of the recordings.
    pub read: ReadOptions,
    /// Request for an effect search, `None` for no search. With a search, `cal.json` holds the final model.
    pub discover: Option<discover::Request>,
    /// Limits that a device must keep in addition to the built-in ones.
    pub limits: Option<Limits>,
    /// Prior distribution of the parameters, from devices of the same type.
    pub prior: Option<Prior>,
    /// Everything above and the version, as text: what it is hashed by.
    pub text: String,
}

/// Result of one device: its record and its calibration.
#[derive(Clone, Debug)]
pub struct Computed {
    /// Its record.
    pub record: Record,
    /// Its `cal.json`.
    pub calibration: Option<String>,
}

impl Options {
    /// SHA-256 of a device's inputs, its options, the others and the version.
    ///
    /// # Errors
    /// An input that cannot be read.
    pub(crate) fn key(&self, device: &Device) -> Result<String, crate::Error> {
        let inputs = hash::of_inputs(&device.inputs)?;
        // Lot, station and time stand in the record.
        let own = serde_json::to_string(device).unwrap_or_default();
        Ok(hash::of_text(&format!("{inputs}\n{own}\n{}", self.text)))
    }

    /// Calibrates a device; whatever goes wrong is in its record.
    pub(crate) fn compute(&self, device: &Device, index: usize, key: String) -> Computed {
        let record = empty(device, index, key);
        match self.calibrated(device) {
            Ok((calibration, findings)) => recorded(record, &calibration, findings.as_ref()),
            Err(error) => {
                let mut record = refused(record, status_of(&error), error.text(Front::CommandLine));
                if is_of_system(&error) {
                    // The disk has failed, not the device: it is tried again.
                    record.key.clear();
                }
                Computed {
                    record,
                    calibration: None,
                }
            }
        }
    }

    fn calibrated(&self, device: &Device) -> Result<(Calibration, Option<Findings>), Error> {
        let request = with_own(&self.request, &device.options)?;
        let read = read_with_own(&self.read, &device.options)?;
        let mut recordings = Vec::new();
        for path in &device.inputs {
            recordings.extend(recordings_at(path, &read)?);
        }
        let (mut calibration, findings) = match &self.discover {
            Some(discover) => {
                let request = discover::Request {
                    gravity: request.gravity,
                    gravity_source: request.gravity_source,
                    latitude: request.latitude,
                    detector: request.detector,
                    choose_multiplier: request.choose_multiplier,
                    ..discover.clone()
                };
                let found = discover::discover(&recordings, &request)?.findings;
                (found.calibration.clone(), Some(found))
            }
            None => (calibrate(&recordings, &[], &request)?.calibration, None),
        };
        if let Some(prior) = &self.prior {
            prior.inform(&mut calibration)?;
        }
        let mut lines = self
            .limits
            .as_ref()
            .map_or_else(Vec::new, |l| judge(l, &calibration));
        lines.extend(built_in(&calibration));
        calibration.state_limits(lines);
        Ok((calibration, findings))
    }
}

/// The recordings at a path: one, or where a folder is none, each of its members.
fn recordings_at(path: &Path, options: &ReadOptions) -> Result<Vec<Recording>, Error> {
    let read = |path: &Path| {
        let all = Recording::read_all(path, options)?;
        Ok(all
            .into_iter()
            .map(Recording::decimated)
            .collect::<Vec<_>>())
    };
    let whole = read(path);
    let members: Vec<PathBuf> = match (&whole, path.is_dir()) {
        // Of a recording on a disk that fails a part would be another recording.
        (Err(error), true) if !is_of_system(error) => hash::members(path).unwrap_or_default(),
        _ => Vec::new(),
    };
    if members.len() < 2 {
        return whole;
    }
    let each: Result<Vec<_>, _> = members.iter().map(|member| read(member)).collect();
    match (each, whole) {
        (Err(error), _) if is_of_system(&error) => Err(error),
        (Err(_), Err(first)) => Err(first),
        (each, _) => each.map(|each| each.into_iter().flatten().collect()),
    }
}

fn with_own(request: &Request, own: &DeviceOptions) -> Result<Request, Error> {
    let mut request = request.clone();
    if own.gravity.is_some() || own.latitude.is_some() {
        let latitude = own.latitude.or(request.latitude);
        let gravity = Gravity::of(own.gravity, latitude, None);
        (request.gravity, request.gravity_source) = (gravity.value, gravity.source);
        request.latitude = latitude;
    }
    request.method = match own.method.as_deref() {
        None => request.method,
        Some("auto") => Method::Auto,
        Some("stepwise") => Method::Stepwise,
        Some("joint") => Method::Joint,
        Some(other) => {
            let found = ::findings::Finding::of(Kind::DEVICE_METHOD);
            return Err(Error::usage(found.detail("method", shown(other))));
        }
    };
    if let Some(names) = &own.effects {
        let effect = |name: &String| {
            effect_named(name).ok_or_else(|| {
                let found = ::findings::Finding::of(Kind::DEVICE_EFFECT);
                Error::usage(found.detail("effect", shown(name)))
            })
        };
        request.effects = names.iter().map(effect).collect::<Result<_, _>>()?;
    }
    if let Some(multiplier) = own.multiplier {
        (request.detector.multiplier, request.choose_multiplier) = (multiplier, false);
    }
    if let Some(length) = own.min_static {
        (request.detector.min_static, request.detector.may_shorten) = (length, false);
    }
    Ok(request)
}

fn read_with_own(read: &ReadOptions, own: &DeviceOptions) -> Result<ReadOptions, Error> {
    let mut read = read.clone();
    read.rate = own.rate.or(read.rate);
    if let Some(text) = &own.accel_unit {
        read.accel_unit = Some(unit("accel_unit", text)?);
    }
    if let Some(text) = &own.gyro_unit {
        read.gyro_unit = Some(unit("gyro_unit", text)?);
    }
    if let Some(text) = &own.mag_unit {
        read.mag_unit = Some(unit("mag_unit", text)?);
    }
    Ok(read)
}

fn unit<U: FromStr>(column: &str, text: &str) -> Result<U, Error> {
    text.parse().map_err(|_| {
        let found = ::findings::Finding::of(Kind::DEVICE_UNIT).detail("column", column);
        Error::usage(found.detail("unit", shown(text)))
    })
}

/// A record with nothing in it yet.
pub(crate) fn empty(device: &Device, index: usize, key: String) -> Record {
    Record {
        index,
        id: device.id.clone(),
        lot: device.lot.clone(),
        station: device.station.clone(),
        time: device.time.clone(),
        status: Status::Pass,
        exit: 0,
        key,
        cal_sha256: None,
        reasons: Vec::new(),
        limits: Vec::new(),
        parameters: Vec::new(),
        misfit: Misfit::default(),
        warnings: 0,
        verdict: None,
        findings: Vec::new(),
        calibration_verdict: None,
        belongs: None,
    }
}

/// The record of a device without a calibration.
pub(crate) fn refused(record: Record, status: Status, reason: String) -> Record {
    Record {
        status,
        exit: status.exit(),
        reasons: vec![reason],
        ..record
    }
}

/// True where the system has not let a file be read.
fn is_of_system(error: &Error) -> bool {
    let of_system = [Kind::UNREADABLE, Kind::READING_STOPPED];
    of_system.contains(&error.finding().kind)
}

fn status_of(error: &Error) -> Status {
    match error {
        Error::Usage(_) | Error::Parts { .. } => Status::Usage,
        Error::NotEnough(_) => Status::NotEnough,
        Error::NotConverged(_) | Error::Solver(_) => Status::NotConverged,
        Error::Output { .. } => Status::Output,
        _ => Status::Input,
    }
}

fn recorded(record: Record, calibration: &Calibration, findings: Option<&Findings>) -> Computed {
    let mut reasons: Vec<String> = calibration.failed_gates.texts(Front::CommandLine);
    reasons.extend(
        not_kept(&calibration.limits)
            .into_iter()
            .map(|line| line.name.clone()),
    );
    let belongs = calibration.prior.as_ref().map(|used| used.belongs);
    if belongs == Some(false) {
        reasons.push("prior".to_owned());
    }
    let status = match (calibration.not_calibrated.is_empty(), reasons.is_empty()) {
        (false, _) => Status::NotEnough,
        (_, true) => Status::Pass,
        (_, false) => Status::Fail,
    };
    let (force, rate) = (
        calibration.accelerometer.as_ref(),
        calibration.gyroscope.as_ref(),
    );
    let turned = rate.filter(|t| t.dynamic_intervals.is_some());
    let parameters = calibration.parameters.iter().filter_map(|name| {
        let (value, std) = parameter(calibration, name)?;
        Some(Parameter {
            name: name.clone(),
            value,
            std,
        })
    });
    let text = serde_json::to_string_pretty(calibration).map(|text| text + "\n");
    let Ok(text) = text else {
        let reason = ::findings::Finding::of(Kind::FORMAT_UNWRITABLE)
            .detail("format", "calibration")
            .detail("reason", "JSON");
        let reason = reason.text(Front::CommandLine);
        return Computed {
            record: refused(record, Status::Bug, reason),
            calibration: None,
        };
    };
    let record = Record {
        status,
        exit: status.exit(),
        cal_sha256: Some(hash::of_text(&text)),
        reasons,
        limits: calibration.limits.clone(),
        parameters: parameters.collect(),
        misfit: Misfit {
            residual_mm_s2: force.map(|t| 1e3 * t.residual_rms),
            accelerometer_chi2: force.and_then(|t| t.reduced_chi2),
            static_intervals: force.and_then(|t| t.static_intervals),
            residual_deg: turned.map(|t| t.residual_rms),
            gyroscope_chi2: turned.and_then(|t| t.reduced_chi2),
            turns: turned.and_then(|t| t.dynamic_intervals),
        },
        warnings: calibration.warnings.len(),
        verdict: findings.map(|f| f.verdict.name().to_owned()),
        findings: findings.map_or_else(Vec::new, |f| f.effects.iter().map(finding).collect()),
        calibration_verdict: Some(calibration.verdict()),
        belongs,
        ..record
    };
    Computed {
        record,
        calibration: Some(text),
    }
}

fn finding(effect: &discover::EffectFinding) -> Finding {
    Finding {
        name: effect.name.clone(),
        adjusted_p_value: effect.adjusted_p_value,
        held_out_gap: [effect.held_out_gap_before, effect.held_out_gap_after],
    }
}
