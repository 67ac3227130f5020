//! ArduPilot: a parameter file as Mission Planner and MAVProxy load it.

use std::collections::HashMap;
use std::fmt::Write as _;

use nalgebra::Vector3;
use sensor::Base;

use crate::error::Error;
use crate::kept::Kept;
use crate::source::{Source, by_axis, diagonal};
use crate::target::{Settings, Target, Written};

/// What ArduPilot takes for a scale factor, and for an offset in m/s²: `@Range: 0.8 1.2` of `ACCSCAL_X` and `-3.5 3.5` of
/// `ACCOFFS_X` in `AP_InertialSensor_Params.cpp`. Its own calibration refuses other scale factors too, but offsets from
/// 1 g on only (`AccelCalibrator::accept_result`).
const SCALES: (f64, f64) = (0.8, 1.2);
const OFFSETS: (f64, f64) = (-3.5, 3.5);

/// `accel −= offset; accel *= scale` per axis, `gyro −= offset`
/// (`_rotate_and_correct_accel` and `_rotate_and_correct_gyro` in `AP_InertialSensor_Backend.cpp`).
///
/// A log holds readings that were corrected already, by `s` and `o`: a calibration `d`, `b` of those makes
/// `d (s (raw − o) − b) = s d (raw − (o + b / s))`.
#[derive(Debug)]
pub struct ArduPilot;

impl Target for ArduPilot {
    fn name(&self) -> &'static str {
        "ardupilot"
    }

    fn about(&self) -> &'static str {
        "ArduPilot parameters (INS_ACCOFFS_X, INS_ACCSCAL_X, INS_GYROFFS_X, ...); --logged-with the parameters of the log"
    }

    fn keeps(&self, source: &Source<'_>) -> Kept {
        Kept::offsets_and_scales_of(source)
    }

    fn write(&self, source: &Source<'_>, settings: &Settings) -> Result<Written, Error> {
        source.needs_si("ardupilot")?;
        source.needs_signs("ardupilot")?;
        let names = Names::of(settings.instance)?;
        let before = settings.logged_with.as_deref().map(parameters);
        let before = before.transpose()?;
        let logged = |name: &str, default: f64| {
            let known = before.as_ref();
            Vector3::from(crate::source::AXES.map(|axis| {
                let value = known.and_then(|p| p.get(&format!("{name}_{axis}")));
                value.copied().unwrap_or(default)
            }))
        };
        let mut text = source.provenance("#");
        let mut put = |name: &str, values: Vector3<f64>, limits: Option<(f64, f64)>| {
            for (axis, value) in by_axis(values) {
                let name = format!("{name}_{axis}");
                if let Some((least, most)) = limits.filter(|(a, b)| !(*a..=*b).contains(&value)) {
                    return Err(Error::Range {
                        target: "ardupilot",
                        name,
                        value,
                        least,
                        most,
                        next: "was the recording made with its parameters in force (--logged-with), or is a unit wrong?",
                    });
                }
                let _ = writeln!(text, "{name},{:?}", value as f32);
            }
            Ok(())
        };
        if let Some(base) = &source.accelerometer {
            let (o, s) = (logged(&names.offset, 0.0), logged(&names.scale, 1.0));
            let raw = on_top(base, &o, &s);
            put(&names.offset, raw.bias, Some(OFFSETS))?;
            put(&names.scale, raw.t.diagonal(), Some(SCALES))?;
        }
        if let Some(base) = &source.gyroscope {
            put(&names.gyro, base.bias + logged(&names.gyro, 0.0), None)?;
        }
        let mut notes = vec![
            "ArduPilot measures the gyroscope's offsets again at every start unless INS_GYR_CAL is 0".to_owned(),
        ];
        if before.is_none() {
            notes.push(
                "ArduPilot logs readings that its parameters have corrected: if the recording is from its log, give those \
                 parameters by --logged-with FILE.param"
                    .into(),
            );
        }
        Ok(Written {
            notes,
            ..Written::text(text)
        })
    }
}

/// A calibration of readings that were corrected by an offset and a scale, for the readings before.
fn on_top(base: &Base<f64>, offset: &Vector3<f64>, scale: &Vector3<f64>) -> Base<f64> {
    Base {
        t: diagonal(&base.t) * nalgebra::Matrix3::from_diagonal(scale),
        bias: offset + base.bias.component_div(scale),
    }
}

/// What the parameters of an instance are called.
struct Names {
    offset: String,
    scale: String,
    gyro: String,
}

impl Names {
    fn of(instance: usize) -> Result<Self, Error> {
        let [acc, gyro] = match instance {
            0 => ["INS_ACC", "INS_GYR"],
            1 => ["INS_ACC2", "INS_GYR2"],
            2 => ["INS_ACC3", "INS_GYR3"],
            _ => {
                let what = format!("--instance {instance}: ArduPilot has parameters for 0 to 2");
                return Err(Error::Settings(what));
            }
        };
        Ok(Self {
            offset: format!("{acc}OFFS"),
            scale: format!("{acc}SCAL"),
            gyro: format!("{gyro}OFFS"),
        })
    }
}

/// `NAME,VALUE` or `NAME VALUE`, a line each; `#` begins a comment.
fn parameters(text: &str) -> Result<HashMap<String, f64>, Error> {
    let mut all = HashMap::new();
    for (k, line) in text.lines().enumerate() {
        let line = line.split('#').next().unwrap_or_default().trim();
        let mut parts = line.split([',', ' ', '\t']).filter(|part| !part.is_empty());
        let Some(name) = parts.next() else { continue };
        let value = parts.next().and_then(|v| v.parse().ok());
        let value = value
            .filter(|v: &f64| v.is_finite())
            .ok_or_else(|| Error::Input {
                place: format!("line {}: ", k + 1),
                what: "a parameter's name and a number expected, as in INS_ACCOFFS_X,0.12".into(),
            })?;
        all.insert(name.to_owned(), value);
    }
    Ok(all)
}
