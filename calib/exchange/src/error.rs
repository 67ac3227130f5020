//! Why nothing is written or read.

use std::path::PathBuf;

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
    /// Axes of one sensor point against the other's, which the target cannot hold.
    #[error(
        "{target} keeps no sign of an axis, and the {sensor}'s scale factor of {axis} is {value}; read it with the other sign, \
         as in `calibrate --flip {flip}`"
    )]
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
