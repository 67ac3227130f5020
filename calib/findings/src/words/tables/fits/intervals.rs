//! Words of static intervals and turns.

use crate::remedy::{OptionName, Remedy, Setting};

use crate::words::entry::{Entry, UseOfResult, bad, care, remark};
use crate::words::tables::reading::IF_EXACT;

kinds! {
    /// Placements disagree with each other though nothing shook.
    PLACEMENTS_APART = "placements_apart" => Entry {
        reason: "placements disagree with each other, as if the sensor slipped in its case",
        text: "some placements disagree with the others though nothing shook the device: {places}. The sensor may have slipped in its case. The calibration is made without these placements",
        remedies: vec![Remedy::FixSensor],
        ..bad(2.0)
    },
    /// A turn cannot be used.
    TURN_LOST = "turn_lost" => Entry {
        reason: "a turn cannot be used",
        text: "{at} is not used: {fault}",
        ..remark(0.02)
    },
    /// Samples are missing within a static interval.
    INTERVAL_GAP = "interval_gap" => Entry {
        reason: "samples are missing in a static interval",
        text: "{at} misses samples for {gap} from t = {gap_from} on",
        ..remark(0.01)
    },
    /// Most static intervals shake as if held in a hand.
    SHAKY_INTERVALS = "shaky_intervals" => Entry {
        reason: "{shaken} of {all} static intervals shake, as in a hand",
        text: "{shaken} of {all} static intervals shake more than the quiet parts of the recording, as a device in a hand does. The program weights each by its own noise",
        remedies: vec![Remedy::LayDown],
        ..care(0.03)
    },
    /// The device sways while it should rest.
    DEVICE_SWAYS = "device_sways" => Entry {
        reason: "the device sways while it should rest",
        text: "the device sways while it should rest, as in a hand or by a slow slip. Turns then begin and end a little beside the mean direction",
        advice: "lay the device down in the next recording",
        ..remark(0.02)
    },
    /// The readings swing with one period in the static intervals.
    RESTS_SWING = "rests_swing" => Entry {
        reason: "readings of the {sensor} swing with a period of {period} at rest",
        text: "readings of the {sensor} swing at rest with a period of {period}, by {size} to either side. A fan, a machine, waves or wind may move the device",
        advice: "stop what moves the device, or lay it elsewhere, if the calibration is not good enough",
        ..remark(0.02)
    },
    /// The device turns slowly in many static intervals.
    RESTS_TURN = "rests_turn" => Entry {
        reason: "the device turned slowly in {count} of {of} static intervals: its support moved",
        text: "the device turned slowly in {count} of {of} static intervals, by {angle} within {length} in the middle one: accelerometer and gyroscope agree on it. A soft surface gives way, a vehicle or a boat sways",
        advice: "lay the device on a hard surface that does not move",
        remedies: vec![Remedy::RecordAgain],
        ..care(0.1)
    },
    /// A bias steps within a static interval.
    BIAS_STEPPED = "bias_stepped" => Entry {
        reason: "the zero of the sensor jumps within a static interval",
        text: "{at}: the zero of the sensor (its bias) jumps within this interval. The program does not use the interval's mean[ (off by {force})][ (shakes at t = {shaken}, {times} times as much as usual)]",
        ..remark(0.02)
    },
    /// The readings drift while the device should rest.
    CREEP = "creep" => Entry {
        reason: "the readings drift in {at}",
        text: "[{at}: ]the readings drift[ by {size}] while the device should rest, as when it slowly slips or warms up. The program fits the drift[ ({angle} in all, up to {slope} in the accelerometer's reading)]",
        advice: IF_EXACT,
        use_of_result: UseOfResult::Conditional,
        remedies: vec![Remedy::RecordAgain],
        ..care(0.05)
    },
    /// The device settles after it was laid down.
    SETTLING = "settling" => Entry {
        reason: "the device settled in {at}",
        text: "[{at}: ]the device still moved[ by {size}] for some seconds after it was laid down, as on a cushion that gives way. The program corrects for this move[ ({slip} in all)]",
        advice: IF_EXACT,
        use_of_result: UseOfResult::Conditional,
        remedies: vec![Remedy::RecordAgain],
        ..care(0.02)
    },
    /// The device moves while it should rest.
    MOUNT_SLIP = "mount_slip" => Entry {
        reason: "the device moved in {at}",
        text: "[{at}: ]the device moved[ by {size}] while it should have rested, as a slipping mount does. The program corrects for this move[ ({slip} at once)]",
        advice: IF_EXACT,
        use_of_result: UseOfResult::Conditional,
        remedies: vec![Remedy::RecordAgain],
        ..care(0.05)
    },
    /// Something touched or pushed the device.
    DISTURBED_INTERVAL = "disturbed_interval" => Entry {
        reason: "something touched the device in {at}",
        text: "[{at}: ]something touched or pushed the device[, by {size}]. The program does not use the accelerometer's reading in this interval[ (off by {force})][ (shakes at t = {shaken}, {times} times as much as usual)][ (this cut a {cut} in two, and the shorter part counts as part of a turn)]",
        advice: IF_EXACT,
        use_of_result: UseOfResult::Conditional,
        remedies: vec![Remedy::RecordAgain],
        ..care(0.03)
    },
    /// The mean rate of one static interval is off.
    RATE_EXCURSION = "rate_excursion" => Entry {
        reason: "the mean rate of rotation is off in one static interval",
        text: "[{at}: ]the mean rate of rotation is off[ by {size}] in this interval alone. The program does not use it[ (shakes at t = {shaken}, {times} times as much as usual)]",
        ..remark(0.02)
    },
    /// A turn misses gravity by more than the noise.
    TURN_MISSED = "turn_missed" => Entry {
        reason: "{at} misses gravity, and is not used",
        text: "[{at}: ]the turn misses gravity[ by {size},] by far more than the noise: it does not lead to the direction of gravity that the accelerometer reads after it. The program does not use the turn[ (shakes at t = {shaken}, {times} times as much as usual)]",
        advice: IF_EXACT,
        use_of_result: UseOfResult::Conditional,
        remedies: vec![Remedy::RecordAgain],
        ..care(0.1)
    },
    /// A turn lasts so long that it may hide a static interval.
    LONG_TURN = "long_turn" => Entry {
        reason: "a turn lasts long and may hide a static interval",
        text: "{at} lasts {length}, and the program found no static interval (time at rest) in it. It finds short ones with a smaller least length, and shaky ones with a higher threshold",
        advice: "nothing has to be done if the device did not rest in it",
        remedies: vec![Remedy::IfWrong {
            any_of: vec![
                Setting::to(OptionName::MinStatic, "1"),
                Setting {
                    option: OptionName::Multiplier,
                    value: None,
                },
            ],
        }],
        ..remark(0.02)
    },
    /// The device shook in a static interval.
    NOT_STILL = "not_still" => Entry {
        reason: "the device shook in {at}",
        text: "the readings of the accelerometer shake by {spread} in {at}: the device was not still",
        remedies: vec![Remedy::LayDown],
        ..bad(3.0)
    },
    /// One static interval disagrees with all others.
    INTERVAL_DISAGREES = "interval_disagrees" => Entry {
        reason: "{at} disagrees with the others",
        text: "{at} disagrees with the others by {size} (chance does that in {p} of recordings). The device may have been touched, or have slipped. Leaving the interval out is enough while ten others remain",
        remedies: vec![Remedy::LeaveOut, Remedy::RecordAgain],
        ..bad(1.0)
    },
    /// Static intervals are short.
    SHORT_INTERVALS = "short_intervals" => Entry {
        reason: "the static intervals are short",
        text: "static intervals (rests) of {least} and more are used, because too few last 2.5 s",
        advice: IF_EXACT,
        use_of_result: UseOfResult::Conditional,
        remedies: vec![Remedy::RestLonger],
        ..remark(0.005)
    },
    /// A placement lies on no face.
    OFF_FACE = "off_face" => Entry {
        reason: "a placement lies on no face",
        text: "the placement {label} lies on no face: no axis is near the vertical. The program does not use it",
        ..remark(0.01)
    },
    /// A face was taken more than once.
    FACE_TWICE = "face_twice" => Entry {
        reason: "a face was taken more than once",
        text: "the placements have {face}. The program uses the one nearest to gravity",
        ..remark(0.001)
    },
    /// The six placements are tilted.
    PLACEMENTS_TILTED = "placements_tilted" => Entry {
        reason: "the six placements are tilted by {tilt}",
        text: "the six placements are tilted by about {tilt} rms[, and at most {most} is expected]. This method takes every face as level",
        advice: "record twelve placements with turns between them and use the joint method",
        remedies: vec![Remedy::Level],
        ..care(1.0)
    },
}
