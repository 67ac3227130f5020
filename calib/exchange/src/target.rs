//! A tool that calibrations are written for.

use calib::noise::NoiseSummary;
use findings::Finding;
use nalgebra::Vector3;
use sensor::Base;

use crate::error::Error;
use crate::kept::Kept;
use crate::loss::{Loss, losses};
use crate::source::Source;

/// Inputs of a target in addition to the calibration.
#[derive(Clone, Debug, Default)]
pub struct Settings {
    /// Index of the sensor among several of a kind, from 0.
    pub instance: usize,
    /// Noise densities as `allan` writes them.
    pub noise: Option<NoiseSummary>,
    /// The text of the parameters that were in force while the recording was made, where its readings were corrected by
    /// them.
    pub logged_with: Option<String>,
}

/// Form of the output: one file or several.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// One file, called as the user says.
    File,
    /// A folder with files of these names.
    Folder(&'static [&'static str]),
}

/// Output of a target: the contents of its files, in the order of [`Form`].
#[derive(Clone, Debug, Default)]
pub struct Written {
    /// Contents.
    pub files: Vec<Vec<u8>>,
    /// Notes for the user about the output.
    pub notes: Vec<Finding>,
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
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// Its name.
    pub name: &'static str,
    /// In one line: tool, file, rule.
    pub about: &'static str,
    /// Its files.
    pub form: Form,
    /// Returns the corrections that the tool of the target applies to a reading.
    pub keeps: fn(&Source<'_>) -> Kept,
    /// Returns its files' contents, or what the target cannot hold.
    pub write: fn(&Source<'_>, &Settings) -> Result<Written, Error>,
}

/// Files and what they do not hold.
#[derive(Clone, Debug)]
pub struct Export {
    /// Contents, in the order of the target's [`Form`].
    pub files: Vec<Vec<u8>>,
    /// Losses of the export, with sizes for this device.
    pub lost: Vec<Loss>,
    /// Notes for the user about the output.
    pub notes: Vec<Finding>,
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
pub fn export(target: &Target, source: &Source<'_>, settings: &Settings) -> Result<Export, Error> {
    let Written { files, mut notes } = (target.write)(source, settings)?;
    notes.extend(source.on_top_of(target.name));
    notes.extend(source.without_biases());
    notes.extend(
        source
            .calibration
            .edited()
            .map(|edited| Finding::from(edited.in_words())),
    );
    Ok(Export {
        files,
        lost: losses(source, &(target.keeps)(source)),
        notes,
    })
}

/// The matrix alone.
pub(crate) fn matrix_alone(base: &Base<f64>) -> Base<f64> {
    Base {
        t: base.t,
        bias: Vector3::zeros(),
    }
}
