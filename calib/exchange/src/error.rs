//! Why nothing is written or read.

use std::fmt;
use std::path::PathBuf;

use calib::recording::shown::shown_path;
use findings::{Finding, Kind, OptionName, Remedy};

/// A calibration that a target cannot hold, or a file that is another than it should be. The words are those of
/// [`Error::finding`].
#[derive(Debug)]
#[non_exhaustive]
pub enum Error {
    /// A sensor is missing.
    Lacks {
        /// The target.
        target: &'static str,
        /// The sensor.
        what: &'static str,
    },
    /// The axes are left-handed.
    LeftHanded {
        /// The target.
        target: &'static str,
        /// The sensor.
        sensor: &'static str,
    },
    /// Axes of one sensor point against the other's, which the target cannot hold.
    Flipped {
        /// The target.
        target: &'static str,
        /// The sensor.
        sensor: &'static str,
        /// The axis.
        axis: &'static str,
        /// The diagonal element of `T`.
        value: f64,
        /// All axes of the sensor that are flipped, as the option takes them.
        flip: String,
    },
    /// Settings that this target cannot follow.
    Settings(Box<Finding>),
    /// A text to be imported is something else.
    Input(Box<Finding>),
    /// Numbers that cannot be written.
    Format(Box<Finding>),
    /// A file of several that does not exist.
    Missing(PathBuf),
}

impl Error {
    pub(crate) fn settings(found: Finding) -> Self {
        Self::Settings(Box::new(found))
    }

    pub(crate) fn input(found: Finding) -> Self {
        Self::Input(Box::new(found))
    }

    pub(crate) fn format(found: Finding) -> Self {
        Self::Format(Box::new(found))
    }

    /// A parameter lies beyond the range that the target takes.
    pub(crate) fn outside(
        target: &'static str,
        name: String,
        value: f64,
        (least, most): (f64, f64),
    ) -> Self {
        let found = Finding::of(Kind::PARAMETER_OUTSIDE)
            .detail("target", target)
            .detail("name", name)
            .detail("value", value.to_string())
            .detail("least", least.to_string());
        Self::format(found.detail("most", most.to_string()))
    }

    /// A writer of another project refuses the calibration.
    pub(crate) fn unwritten(reason: &dyn fmt::Display) -> Self {
        let found = Finding::of(Kind::FORMAT_UNWRITABLE).detail("format", "calibration");
        Self::format(found.detail("reason", reason.to_string()))
    }

    /// The finding that ended the work.
    pub fn finding(&self) -> Finding {
        match self {
            Self::Lacks { target, what } => Finding::of(Kind::SENSOR_LACKING)
                .detail("target", *target)
                .detail("what", *what),
            Self::LeftHanded { target, sensor } => Finding::of(Kind::EXPORT_LEFT_HANDED)
                .detail("target", *target)
                .detail("of", *sensor),
            Self::Flipped {
                target,
                sensor,
                axis,
                value,
                flip,
            } => Finding::of(Kind::SIGN_NOT_KEPT)
                .detail("target", *target)
                .detail("of", *sensor)
                .detail("axis", *axis)
                .detail("value", value.to_string())
                .only_remedies([Remedy::set_to(OptionName::Flip, flip)]),
            Self::Settings(found) | Self::Input(found) | Self::Format(found) => (**found).clone(),
            Self::Missing(path) => Finding::of(Kind::PIECE_MISSING).in_file(shown_path(path)),
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.finding().fmt(f)
    }
}

impl std::error::Error for Error {}
