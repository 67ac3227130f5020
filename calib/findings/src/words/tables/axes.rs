//! Words of units, ranges and axes that the fit shows.

use crate::kind::Kind;
use crate::level::Level;
use crate::remedy::{OptionName, Remedy};

use crate::words::entry::Entry;

pub(super) const ENTRIES: &[Entry] = &[
    Entry {
        kind: Kind::AxisUnit,
        level: Level::Bad,
        severity: 30.0,
        reason: "{axis} of the {sensor} has another unit or range",
        text: "{axis} of the {sensor} reads {times} what {others} read of the same {what}: it has another unit or range",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::CountsDiffer,
        level: Level::Care,
        severity: 1.0,
        reason: "the axes of the {sensor} differ in their range",
        text: "the axes of the {sensor} read {x}, {y} and {z} counts per m/s², which differ by {share}. They may not all have one range",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::ScaleOff,
        level: Level::Care,
        severity: 3.0,
        reason: "the {sensor} reads {share} {more} on all axes",
        text: "the {sensor} reads gravity as {reads}, {share} {more} than {gravity}, on all axes alike[. {so}]",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::ZeroOff,
        level: Level::Bad,
        severity: 30.0,
        reason: "the zero of {axis} lies where no sensor has it",
        text: "{axis} of the {sensor} has its zero at {bias}, as no sensor has: {why}",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::ReadingsInG,
        level: Level::Care,
        severity: 0.001,
        reason: "the readings look like units of g",
        text: "the readings of the accelerometer look like units of g. The calibration's matrix carries them to m/s²",
        remedies: || vec![Remedy::set_to(OptionName::AccelUnit, "g")],
    },
    Entry {
        kind: Kind::RawCounts,
        level: Level::Remark,
        severity: 0.0001,
        reason: "the readings are raw counts",
        text: "the readings of the {sensor} are raw counts: one is about {scale}[, and zero lies near {zero}]",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::GravityMissed,
        level: Level::Bad,
        severity: 10.0,
        reason: "the gyroscope misses gravity by {missed} after the fit",
        text: "the gyroscope misses gravity by {missed} rms after the fit. A sensor may be mounted or logged with other axes, or the stamps may not be those of the samples",
        remedies: || vec![Remedy::LookInto],
    },
    Entry {
        kind: Kind::AxesNotShown,
        level: Level::Bad,
        severity: 10.0,
        reason: "the turns do not show the gyroscope's axes",
        text: "the gyroscope's matrix is that of no sensor (its determinant is negative and no axis is flipped): the turns do not show its axes",
        remedies: || vec![Remedy::TurnBetween],
    },
    Entry {
        kind: Kind::LeftHanded,
        level: Level::Bad,
        severity: 30.0,
        reason: "the gyroscope's axes are left-handed",
        text: "the gyroscope's axes are left-handed against the accelerometer's: {axes}",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::AxesTurned,
        level: Level::Remark,
        severity: 0.01,
        reason: "the gyroscope's axes are turned against the accelerometer's",
        text: "the gyroscope's axes are turned against the accelerometer's{axes}. The calibration's matrix turns them back[. {or}]",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::GyroscopeScaleOff,
        level: Level::Bad,
        severity: 30.0,
        reason: "the gyroscope's scale is {ratio} on all axes",
        text: "the gyroscope's scale is {ratio} on all axes: its unit or its rate is wrong, for no sensor errs so",
        remedies: || vec![Remedy::set(OptionName::Rate)],
    },
    Entry {
        kind: Kind::ReadingsInDegrees,
        level: Level::Care,
        severity: 0.001,
        reason: "the gyroscope's unit looks like {unit}",
        text: "the readings of the gyroscope look like {unit}[ that were read as {read}]. The calibration's matrix carries them to rad/s",
        remedies: Vec::new,
    },
];
