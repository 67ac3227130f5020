//! A tool that calibrations are written for.

use std::path::PathBuf;

use calib::noise::NoiseSummary;
use nalgebra::{Matrix3, Vector3};
use sensor::Base;

use crate::loss::{Loss, losses};
use crate::source::Source;

/// What a target asks for beside the calibration.
#[derive(Clone, Debug, Default)]
pub struct Settings {
    /// Which of several sensors of a kind, from 0.
    pub instance: usize,
    /// Noise densities as `allan` writes them.
    pub noise: Option<NoiseSummary>,
    /// The text of the parameters that were in force while the recording was made, where its readings were corrected by
    /// them.
    pub logged_with: Option<String>,
}

/// What a target's tool makes of a reading, in the frame of the calibration.
#[derive(Clone, Debug, Default)]
pub struct Kept {
    /// `f = T (A − b)` of the accelerometer, if it is corrected.
    pub accelerometer: Option<Base<f64>>,
    /// `w = T (W − b)` of the gyroscope.
    pub gyroscope: Option<Base<f64>>,
    /// Whether `G f` is taken off the rate.
    pub g_sensitivity: bool,
    /// Whether the form holds every effect of the calibration.
    pub effects: bool,
    /// Whether it holds standard errors and covariance.
    pub errors: bool,
}

impl Kept {
    /// Both sensors in full.
    pub fn base_of(source: &Source<'_>) -> Self {
        Self {
            accelerometer: source.accelerometer,
            gyroscope: source.gyroscope,
            ..Self::default()
        }
    }

    /// Offsets of both sensors and the accelerometer's scale factors: flight controllers.
    pub fn offsets_and_scales_of(source: &Source<'_>) -> Self {
        let offset_and_scale = |base: &Base<f64>| Base {
            t: crate::source::diagonal(&base.t),
            bias: base.bias,
        };
        let offset_alone = |base: &Base<f64>| Base {
            t: Matrix3::identity(),
            bias: base.bias,
        };
        Self {
            accelerometer: source.accelerometer.as_ref().map(offset_and_scale),
            gyroscope: source.gyroscope.as_ref().map(offset_alone),
            ..Self::default()
        }
    }

    /// Everything.
    pub fn all_of(source: &Source<'_>) -> Self {
        Self {
            g_sensitivity: true,
            effects: true,
            errors: true,
            ..Self::base_of(source)
        }
    }
}

/// Whether a target writes one file or several.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// One file, called as the user says.
    File,
    /// A folder with files of these names.
    Folder(&'static [&'static str]),
}

/// What a target wrote: the contents of its files, in the order of [`Form`].
#[derive(Clone, Debug, Default)]
pub struct Written {
    /// Contents.
    pub files: Vec<Vec<u8>>,
    /// What the user has to know or do.
    pub notes: Vec<String>,
}

impl Written {
    /// One text.
    pub fn text(text: String) -> Self {
        Self {
            files: vec![text.into_bytes()],
            notes: Vec::new(),
        }
    }
}

/// A tool that calibrations are written for.
pub trait Target: Sync + std::fmt::Debug {
    /// What `--to` calls it.
    fn name(&self) -> &'static str;

    /// In one line: tool, file, rule.
    fn about(&self) -> &'static str;

    /// Its files.
    fn form(&self) -> Form {
        Form::File
    }

    /// What its tool makes of a reading.
    fn keeps(&self, source: &Source<'_>) -> Kept;

    /// Its files' contents.
    ///
    /// # Errors
    /// What the target cannot hold.
    fn write(&self, source: &Source<'_>, settings: &Settings) -> Result<Written, Error>;
}

/// Files and what they do not hold.
#[derive(Clone, Debug)]
pub struct Export {
    /// Contents, in the order of the target's [`Form`].
    pub files: Vec<Vec<u8>>,
    /// What is lost, the sizes for this device.
    pub lost: Vec<Loss>,
    /// What the user has to know or do.
    pub notes: Vec<String>,
}

/// Writes a calibration for a target.
///
/// # Errors
/// What the target cannot hold.
///
/// # Examples
/// ```
/// use stillpoint_exchange::{Settings, Source, by_name, export, import};
///
/// let yaml = "accelerometers:\n  M: [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\ngyroscopes:\n  M: [[1, 0, 0], [0, 1, 0], \
///             [0, 0, 1]]\n  A: [[0, 0, 0], [0, 0, 0], [0, 0, 0]]\n  C_gyro_i: [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\n";
/// let calibration = import::kalibr(yaml)?;
/// let target = by_name("rust").ok_or("unknown")?;
/// let export = export(target, &Source::new(&calibration), &Settings::default())?;
/// assert!(String::from_utf8_lossy(&export.files[0]).contains("pub fn correct_accelerometer"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn export(
    target: &dyn Target,
    source: &Source<'_>,
    settings: &Settings,
) -> Result<Export, Error> {
    let Written { files, notes } = target.write(source, settings)?;
    Ok(Export {
        files,
        lost: losses(source, &target.keeps(source)),
        notes,
    })
}

/// What a target cannot hold, or a file that is not what it should be.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A sensor is missing.
    #[error(
        "the calibration has no {what}, and {target} wants one; calibrate a recording of both sensors"
    )]
    Lacks {
        /// The target.
        target: &'static str,
        /// The sensor.
        what: &'static str,
    },
    /// The calibration is of readings in another unit.
    #[error(
        "the calibration is of readings of the {sensor} in {unit}, and {target} corrects readings in {si}; calibrate a \
         recording in {si}, as {target} logs it"
    )]
    Unit {
        /// The target.
        target: &'static str,
        /// The sensor.
        sensor: &'static str,
        /// What was found.
        unit: String,
        /// What is expected.
        si: &'static str,
    },
    /// A number lies beyond what the target takes.
    #[error("{name} would be {value}, and {target} takes {least} to {most}; {next}")]
    Range {
        /// The target.
        target: &'static str,
        /// The parameter.
        name: String,
        /// Its value.
        value: f64,
        /// The least.
        least: f64,
        /// The largest.
        most: f64,
        /// What to do.
        next: &'static str,
    },
    /// The axes are left-handed.
    #[error(
        "{target} wants right-handed axes, and the {sensor}'s are left-handed (det T < 0); read one axis with the other sign \
         (`calibrate --flip`)"
    )]
    LeftHanded {
        /// The target.
        target: &'static str,
        /// The sensor.
        sensor: &'static str,
    },
    /// An option that this target cannot follow.
    #[error("{0}")]
    Settings(String),
    /// A text to be imported is something else.
    #[error("{place}{what}")]
    Input {
        /// Line and column, or entry.
        place: String,
        /// What was found and what was expected.
        what: String,
    },
    /// Numbers that cannot be written.
    #[error("{0}")]
    Format(String),
    /// A file of several that does not exist.
    #[error("{0}: missing")]
    Missing(PathBuf),
}

/// The matrix alone.
pub(crate) fn matrix_alone(base: &Base<f64>) -> Base<f64> {
    Base {
        t: base.t,
        bias: Vector3::zeros(),
    }
}
