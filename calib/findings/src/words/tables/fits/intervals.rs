//! Words of static intervals and turns.

use crate::kind::Kind;
use crate::level::Level;
use crate::remedy::{OptionName, Remedy, Setting};

use crate::words::entry::Entry;
use crate::words::tables::reading::IF_EXACT;

pub(in super::super) const ENTRIES: &[Entry] = &[
    Entry {
        kind: Kind::PlacementsApart,
        level: Level::Bad,
        severity: 2.0,
        reason: "placements disagree with each other, as if the sensor slipped in its case",
        text: "some placements disagree with the others though nothing shook the device: {places}. The sensor may have slipped in its case. The calibration is made without these placements",
        advice: "",
        remedies: || vec![Remedy::FixSensor],
    },
    Entry {
        kind: Kind::TurnLost,
        level: Level::Remark,
        severity: 0.02,
        reason: "a turn cannot be used",
        text: "{at} is not used: {fault}",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::IntervalGap,
        level: Level::Remark,
        severity: 0.01,
        reason: "samples are missing in a static interval",
        text: "{at} misses samples for {gap} from t = {gap_from} on",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::ShakyIntervals,
        level: Level::Care,
        severity: 0.03,
        reason: "{shaken} of {all} static intervals shake, as in a hand",
        text: "{shaken} of {all} static intervals shake more than the quiet parts of the recording, as a device in a hand does. The program weights each by its own noise",
        advice: "",
        remedies: || vec![Remedy::LayDown],
    },
    Entry {
        kind: Kind::DeviceSways,
        level: Level::Remark,
        severity: 0.02,
        reason: "the device sways while it should rest",
        text: "the device sways while it should rest, as in a hand or by a slow slip. Turns then begin and end a little beside the mean direction",
        advice: "lay the device down in the next recording",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::RestsSwing,
        level: Level::Remark,
        severity: 0.02,
        reason: "readings of the {sensor} swing with a period of {period} at rest",
        text: "readings of the {sensor} swing at rest with a period of {period}, by {size} to either side. A fan, a machine, waves or wind may move the device",
        advice: "stop what moves the device, or lay it elsewhere, if the calibration is not good enough",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::BiasStepped,
        level: Level::Remark,
        severity: 0.02,
        reason: "the zero of the sensor jumps within a static interval",
        text: "{at}: the zero of the sensor (its bias) jumps within this interval. The program does not use the interval's mean[ (off by {force})][ (shakes at t = {shaken}, {times} times as much as usual)]",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::Creep,
        level: Level::Care,
        severity: 0.05,
        reason: "the readings drift in {at}",
        text: "[{at}: ]the readings drift[ by {size}] while the device should rest, as when it slowly slips or warms up. The program fits the drift[ ({angle} in all, up to {slope} in the accelerometer's reading)]",
        advice: IF_EXACT,
        remedies: || vec![Remedy::RecordAgain],
    },
    Entry {
        kind: Kind::Settling,
        level: Level::Care,
        severity: 0.02,
        reason: "the device settled in {at}",
        text: "[{at}: ]the device still moved[ by {size}] for some seconds after it was laid down, as on a cushion that gives way. The program corrects for this move[ ({slip} in all)]",
        advice: IF_EXACT,
        remedies: || vec![Remedy::RecordAgain],
    },
    Entry {
        kind: Kind::MountSlip,
        level: Level::Care,
        severity: 0.05,
        reason: "the device moved in {at}",
        text: "[{at}: ]the device moved[ by {size}] while it should have rested, as a slipping mount does. The program corrects for this move[ ({slip} at once)]",
        advice: IF_EXACT,
        remedies: || vec![Remedy::RecordAgain],
    },
    Entry {
        kind: Kind::DisturbedInterval,
        level: Level::Care,
        severity: 0.03,
        reason: "something touched the device in {at}",
        text: "[{at}: ]something touched or pushed the device[, by {size}]. The program does not use the accelerometer's reading in this interval[ (off by {force})][ (shakes at t = {shaken}, {times} times as much as usual)][ (this cut a {cut} in two, and the shorter part counts as part of a turn)]",
        advice: IF_EXACT,
        remedies: || vec![Remedy::RecordAgain],
    },
    Entry {
        kind: Kind::RateExcursion,
        level: Level::Remark,
        severity: 0.02,
        reason: "the mean rate of rotation is off in one static interval",
        text: "[{at}: ]the mean rate of rotation is off[ by {size}] in this interval alone. The program does not use it[ (shakes at t = {shaken}, {times} times as much as usual)]",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::TurnMissed,
        level: Level::Care,
        severity: 0.1,
        reason: "{at} misses gravity, and is not used",
        text: "[{at}: ]the turn misses gravity[ by {size},] by far more than the noise: it does not lead to the direction of gravity that the accelerometer reads after it. The program does not use the turn[ (shakes at t = {shaken}, {times} times as much as usual)]",
        advice: IF_EXACT,
        remedies: || vec![Remedy::RecordAgain],
    },
    Entry {
        kind: Kind::LongTurn,
        level: Level::Remark,
        severity: 0.02,
        reason: "a turn lasts long and may hide a static interval",
        text: "{at} lasts {length}, and the program found no static interval (time at rest) in it. It finds short ones with a smaller least length, and shaky ones with a higher threshold",
        advice: "nothing has to be done if the device did not rest in it",
        remedies: || {
            vec![Remedy::IfWrong {
                any_of: vec![
                    Setting::to(OptionName::MinStatic, "1"),
                    Setting {
                        option: OptionName::Multiplier,
                        value: None,
                    },
                ],
            }]
        },
    },
    Entry {
        kind: Kind::NotStill,
        level: Level::Bad,
        severity: 3.0,
        reason: "the device shook in {at}",
        text: "the readings of the accelerometer shake by {spread} in {at}: the device was not still",
        advice: "",
        remedies: || vec![Remedy::LayDown],
    },
    Entry {
        kind: Kind::IntervalDisagrees,
        level: Level::Bad,
        severity: 1.0,
        reason: "{at} disagrees with the others",
        text: "{at} disagrees with the others by {size} (chance does that in {p} of recordings). The device may have been touched, or have slipped. Leaving the interval out is enough while ten others remain",
        advice: "",
        remedies: || vec![Remedy::LeaveOut, Remedy::RecordAgain],
    },
    Entry {
        kind: Kind::IntervalsLeftOut,
        level: Level::Care,
        severity: 0.01,
        reason: "only {most} of {all} static intervals are used",
        text: "the program uses only {most} of {all} static intervals, because more take too long: numbers {first} to {last} ({where}), with the most directions. It numbers intervals and turns from the first of these",
        advice: "cut the recording into parts to use all",
        remedies: || {
            vec![Remedy::OtherMethod {
                method: "stepwise".into(),
            }]
        },
    },
    Entry {
        kind: Kind::ShortIntervals,
        level: Level::Remark,
        severity: 0.005,
        reason: "the static intervals are short",
        text: "static intervals (rests) of {least} and more are used, because too few last 2.5 s",
        advice: IF_EXACT,
        remedies: || vec![Remedy::RestLonger],
    },
    Entry {
        kind: Kind::OffFace,
        level: Level::Remark,
        severity: 0.01,
        reason: "a placement lies on no face",
        text: "the placement {label} lies on no face: no axis is near the vertical. The program does not use it",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::FaceTwice,
        level: Level::Remark,
        severity: 0.001,
        reason: "a face was taken more than once",
        text: "the placements have {face}. The program uses the one nearest to gravity",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::PlacementsTilted,
        level: Level::Care,
        severity: 1.0,
        reason: "the six placements are tilted by {tilt}",
        text: "the six placements are tilted by about {tilt} rms[, and at most {most} is expected]. This method takes every face as level",
        advice: "",
        remedies: || {
            vec![
                Remedy::Level,
                Remedy::OtherMethod {
                    method: "joint".into(),
                },
            ]
        },
    },
];
