//! Words of what the readings themselves show of a sensor.

use crate::kind::Kind;
use crate::level::Level;
use crate::remedy::Remedy;

use crate::words::entry::Entry;

pub(super) const ENTRIES: &[Entry] = &[
    Entry {
        kind: Kind::Saturated,
        level: Level::Care,
        severity: 0.5,
        reason: "the {sensor} is saturated on {axis}",
        text: "{sensor} {axis} is saturated at {limit} in {rows:row}[ between rows {from_row} and {to_row}]: its range ends \
               there, and the true value is larger",
        advice: "",
        remedies: || vec![Remedy::LargerRange, Remedy::TurnSlower],
    },
    Entry {
        kind: Kind::Quantised,
        level: Level::Care,
        severity: 0.05,
        reason: "the {sensor} reads in steps wider than its noise",
        text: "the {sensor} reads in steps of {step} on {axes}, wider than its noise ({noise}): no mean at rest is known \
               better than to {error}",
        advice: "",
        remedies: || vec![Remedy::RawReadings],
    },
    Entry {
        kind: Kind::DeadZone,
        level: Level::Care,
        severity: 0.5,
        reason: "the {sensor} reads small rates as zero",
        text: "the {sensor} reads exactly zero on {axes} and nothing between zero and {least}: a dead zone, or readings \
               from a fusion filter. The errors of slow turns cannot be known[, and neither can the bias, for {share} of \
               the readings at rest are zero]",
        advice: "",
        remedies: || vec![Remedy::Uncalibrated],
    },
    Entry {
        kind: Kind::Frozen,
        level: Level::Remark,
        severity: 0.05,
        reason: "the readings of the {sensors} stand still for a while",
        text: "{rows:row} repeated the reading of the {sensors} before, in {places:place} ({listed}): frozen readings, left \
               out",
        advice: "",
        remedies: || vec![Remedy::RecordAgain],
    },
    Entry {
        kind: Kind::ErasedTail,
        level: Level::Remark,
        severity: 0.001,
        reason: "the end of the recording is erased memory",
        text: "from row {first_row} (t = {t0}) on, the last {rows:row} repeated one reading on all axes: erased memory, \
               left out",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::Rezeroed,
        level: Level::Care,
        severity: 0.5,
        reason: "the device sets the zero of the {sensor} anew while it rests",
        text: "the bias of the {sensor} jumps {after} into the static intervals, by {size} (rms over {intervals} of them): \
               the device sets its zero anew while it rests. Turns and rests are then read about different zeros",
        advice: "",
        remedies: || vec![Remedy::Uncalibrated],
    },
    Entry {
        kind: Kind::Spikes,
        level: Level::Remark,
        severity: 0.001,
        reason: "single readings of the {sensor} were replaced",
        text: "the {sensor} has {count:single reading} on {axes} far from both neighbours, by up to {largest} (rows \
               {listed}): transfer errors or knocks. The mean of the neighbours replaces each",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::Vibration,
        level: Level::Care,
        severity: 0.1,
        reason: "the device did not lie still in {intervals}",
        text: "the {sensor} is up to {ratio} times noisier in {intervals} than in the others, as from vibration or a hand",
        advice: "",
        remedies: || vec![Remedy::LayDown],
    },
    Entry {
        kind: Kind::NoiseChanged,
        level: Level::Care,
        severity: 0.1,
        reason: "the noise of the {sensor} changes part of the way",
        text: "the {sensor} is up to {ratio} times noisier in {intervals} than in the others: a fan or a motor runs there, \
               or the range or the filter was changed",
        advice: "",
        remedies: || vec![Remedy::RecordAgain, Remedy::Split],
    },
    Entry {
        kind: Kind::HandHeld,
        level: Level::Care,
        severity: 0.1,
        reason: "the device was held in the hand and never lies still",
        text: "the device never lies still: its rate wavers by {rate} in the quietest stretches, as in a hand",
        advice: "",
        remedies: || vec![Remedy::LayDown],
    },
    Entry {
        kind: Kind::SlowerSensor,
        level: Level::Remark,
        severity: 0.001,
        reason: "the {sensor} is slower than the rows",
        text: "the {sensor} is {ratio} times slower than the rows, and its readings are held between: \
               {repetitions:repetition} left out",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::OneSensorOnly,
        level: Level::Remark,
        severity: 0.001,
        reason: "the recording has no {missing}[ and no {neither}]",
        text: "no {missing}[ and no {neither}]: {only} only[ (columns not used: {unused})]",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::NoSensor,
        level: Level::Care,
        severity: 1.0,
        reason: "the recording has no sensor",
        text: "no sensor[ (columns not used: {unused})]",
        advice: "",
        remedies: || vec![Remedy::LookInto],
    },
    Entry {
        kind: Kind::SignTurned,
        level: Level::Remark,
        severity: 0.001,
        reason: "the accelerometer's sign was turned",
        text: "the accelerometer reads -1 g on the axis that points up in files of {system}: its sign is turned",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::CorrectedBySystem,
        level: Level::Care,
        severity: 0.1,
        reason: "{system} had corrected the readings before",
        text: "{system} has corrected {columns} by its own calibration, and a calibration from here is on top of that[. \
               {raw} has what the sensor reads]",
        advice: "",
        remedies: || vec![Remedy::Uncalibrated],
    },
    Entry {
        kind: Kind::CorrectionUndone,
        level: Level::Remark,
        severity: 0.001,
        reason: "the correction by {system} was taken off again",
        text: "{columns} is what {system} has corrected: {parameters} taken off again",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::FilteredBefore,
        level: Level::Care,
        severity: 0.1,
        reason: "{system} had filtered the readings before",
        text: "{system} has taken the mean of its start off {gyro}, and has filtered {accel}",
        advice: "",
        remedies: || vec![Remedy::Uncalibrated],
    },
    Entry {
        kind: Kind::GravityAdded,
        level: Level::Care,
        severity: 0.3,
        reason: "the accelerometer is put together of two worked-out columns",
        text: "the accelerometer is the sum of `{linear}`, .. and gravity `{gravity}`, ..: the system has worked both out, \
               and a calibration is on top of its own",
        advice: "",
        remedies: || vec![Remedy::Uncalibrated],
    },
    Entry {
        kind: Kind::GravityNotAdded,
        level: Level::Remark,
        severity: 0.001,
        reason: "`{linear}` holds gravity already",
        text: "`{linear}` holds gravity already: `{gravity}` is not added to it",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::Averaged,
        level: Level::Remark,
        severity: 0.001,
        reason: "the {sensor} was read as means over blocks",
        text: "the {sensor} was sampled at {rate}, and no hand turns so fast: it is read as means over {block} samples (a \
               boxcar filter, then {then})",
        advice: "",
        remedies: Vec::new,
    },
];
