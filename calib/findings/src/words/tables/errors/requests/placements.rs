//! Words of recordings whose placements and turns do not determine the parameters.

use crate::remedy::{OptionName, Remedy};
use crate::words::entry::{error, error_by, error_with};

/// How turns come out that can be used.
fn whole_turns() -> Vec<Remedy> {
    vec![
        Remedy::TurnSlower,
        Remedy::LoseNoSamples,
        Remedy::FreezeNoRows,
        Remedy::BothSensors,
    ]
}

kinds! {
    /// Requirement on the placements of a recording.
    REQUIREMENT = "requirement" => error(
        "record at least {least} placements in all ({advised} are better), with each face up once and down once. Hold the device still for at least {rest} in each, and turn no faster than {fastest}",
        "",
    ),
    /// Placements leave a combination of parameters open.
    PLACEMENTS_LEAVE_OPEN = "placements_leave_open" => error_by(
        "{count:placement}, {distinct} of which differ by more than 20°: they determine only {rank} of the accelerometer's {free} unknowns: {parameters} cannot be found from them[; no placement has {missing}]",
        vec![Remedy::Plan],
    ),
    /// Placements are no more than the parameters.
    PLACEMENTS_TOO_FEW = "placements_too_few" => error_by(
        "{count:placement}, {distinct} of which differ by more than 20°: with {free} unknowns nothing is left to check the result with[; {weakest} is known to {error} only][; {unknown} is not known][; no placement has {missing}]",
        vec![Remedy::Plan],
    ),
    /// Placements tell some parameters too badly.
    PLACEMENTS_TELL_LITTLE = "placements_tell_little" => error_by(
        "{count:placement}, {distinct} of which differ by more than 20°: they do not determine {parameters} well enough[; {weakest} is known to {error} only][; {unknown} is not known][; no placement has {missing}]",
        vec![Remedy::Plan],
    ),
    /// Placements lie near one plane.
    PLACEMENTS_IN_PLANE = "placements_in_plane" => error_by(
        "{count:placement}, {distinct} of which differ by more than 20°: all lie near one plane, so that errors across it cannot be found[; no placement has {missing}]",
        vec![Remedy::Plan],
    ),
    /// Placements repeat too few directions.
    DIRECTIONS_TOO_FEW = "directions_too_few" => error_by(
        "{count:placement}, {distinct} of which differ by more than 20°: from only {directions} directions, however often recorded, {parameters} cannot be found[; no placement has {missing}]",
        vec![Remedy::Plan],
    ),
    /// Turns leave a combination of parameters open.
    TURNS_LEAVE_OPEN = "turns_leave_open" => error(
        "{count:turn} determine only {rank} of the gyroscope's {free} unknowns: {parameters} cannot be found from them",
        "turn the device about its {axes} too, by half a turn or more while that axis lies level",
    ),
    /// Turns are no more than the parameters.
    TURNS_TOO_FEW = "turns_too_few" => error(
        "{count:turn} leave nothing to check the gyroscope's {free} unknowns with: at least {least} turns are needed",
        "turn the device about its {axes} too, by half a turn or more while that axis lies level",
    ),
    /// Turns tell some parameters too badly.
    TURNS_TELL_LITTLE = "turns_tell_little" => error(
        "{count:turn} do not determine {parameters} well enough",
        "turn the device about its {axes} too, by half a turn or more while that axis lies level",
    ),
    /// There is no turn between two static intervals.
    TURNS_MISSING = "turns_missing" => error_by(
        "the recording has no turn between two static intervals",
        vec![Remedy::TurnEachAxis],
    ),
    /// No turn can be used.
    TURNS_UNUSABLE = "turns_unusable" => error_by(
        "none of {count:turn} can be used[; {gaps} with samples missing][; {frozen} with one reading repeated][; {saturated} faster than the gyroscope can read][; {empty} without samples]",
        whole_turns(),
    ),
    /// Too few turns can be used.
    TURNS_USABLE_FEW = "turns_usable_few" => error_by(
        "{usable} of {count:turn} can be used[, and {least} or more are needed][; {gaps} with samples missing][; {frozen} with one reading repeated][; {saturated} faster than the gyroscope can read][; {empty} without samples]",
        vec![
            Remedy::TurnEachAxis,
            Remedy::TurnSlower,
            Remedy::LoseNoSamples,
            Remedy::FreezeNoRows,
            Remedy::BothSensors,
        ],
    ),
    /// The turns that can be used leave a parameter open.
    TURNS_USABLE_OPEN = "turns_usable_open" => error_by(
        "{usable} of {count:turn} can be used, and they do not determine all unknowns of the gyroscope[; {gaps} with samples missing][; {frozen} with one reading repeated][; {saturated} faster than the gyroscope can read][; {empty} without samples]",
        whole_turns(),
    ),
    /// The device is never still for long enough.
    NEVER_STILL = "never_still" => error_with(
        "no static interval was found: the device is never still for long enough[ (the quietest seconds and their spread: {quietest})]",
        "record again and lay the device down for {rest} or longer in every placement; if it lay that long already, stop what shakes it",
        vec![Remedy::any_of([
            OptionName::MinStatic,
            OptionName::Multiplier,
        ])],
    ),
    /// No stretch is quiet enough for a device at rest.
    NEVER_QUIET = "never_quiet" => error_with(
        "no quiet stretch is long enough to show a device at rest (in the quietest the rate wavers by {rate})",
        "record again and lay the device down for 5 s or longer in every placement; if it lay that long already, stop what shakes it",
        vec![Remedy::set(OptionName::Multiplier)],
    ),
    /// Quiet stretches are no static intervals.
    QUIET_NOT_STATIC = "quiet_not_static" => error(
        "the program found {found:static interval}, too few for a calibration, and {count:quiet stretch} that it cannot use. The first: {first}",
        "record again and lay the device on a firm support in every placement instead of holding it",
    ),
    /// The device was not turned.
    ALL_STATIC = "all_static" => error_by(
        "the recording is all static: one rest of {length} and no turn",
        vec![Remedy::Plan],
    ),
    /// A single static interval was found in a recording that moves.
    ONE_STATIC_INTERVAL = "one_static_interval" => error_by(
        "one static interval was found, of {length}, and motion in the rest of {whole}. Perhaps the device was held still for less than the program looks for",
        vec![
            Remedy::Plan,
            Remedy::examples([(OptionName::Window, "0.2"), (OptionName::MinStatic, "0.4")]),
        ],
    ),
    /// Static means lie on no sphere.
    NO_SPHERE = "no_sphere" => error(
        "the means of the readings in {count:placement} at rest do not have one length, as gravity would give them. So the program cannot tell the accelerometer's unit",
        "correct the columns of the accelerometer if they are the wrong ones; if they are right, record again with the device still in every placement",
    ),
    /// A static interval shows no gravity.
    NO_GRAVITY_AT_REST = "no_gravity_at_rest" => error(
        "{at} has no accelerometer samples or shows no gravity",
        "record this placement again",
    ),
    /// A recording has no static interval of its sensor.
    NO_REST = "no_rest" => error(
        "no rest of the {sensor} was found: the device is never still for long enough",
        "record this placement again and lay the device down for 5 s or longer",
    ),
    /// A face of the device is in no placement.
    FACE_MISSING = "face_missing" => error(
        "six positions: no rest with {missing}[, {also}]",
        "record every axis once up and once down",
    ),
    /// No rest is long enough for a bias.
    REST_TOO_SHORT = "rest_too_short" => error(
        "the longest rest is {longest}, too short to find the bias (the reading at rest)",
        "put the device down for more than {least}",
    ),
    /// There are too few rests for a bias.
    RESTS_TOO_FEW = "rests_too_few" => error(
        "{rests:rest}: the bias of the {sensor} needs at least {least} in different orientations",
        "lay the device down in more orientations",
    ),
    /// Rests do not tell the axes apart.
    RESTS_IN_PLANE = "rests_in_plane" => error(
        "the orientations of the rests are too alike to tell the biases of the three axes apart (condition number {condition})",
        "record again with each of the six faces up once",
    ),
}
