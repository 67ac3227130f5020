//! Words of recordings whose placements and turns do not determine the parameters.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::{Entry, error, error_by, error_with};

/// How turns come out that can be used.
fn whole_turns() -> Vec<Remedy> {
    vec![
        Remedy::TurnSlower,
        Remedy::LoseNoSamples,
        Remedy::FreezeNoRows,
        Remedy::BothSensors,
    ]
}

pub(in crate::words::tables) fn words(kind: Kind) -> Option<Entry> {
    Some(match kind {
        Kind::Requirement => error(
            "record at least {least} placements in all ({advised} are better), with each face up once and down once. Hold the device still for at least {rest} in each, and turn no faster than {fastest}",
            "",
        ),
        Kind::PlacementsLeaveOpen => error_by(
            "{count:placement}, {distinct} of which differ by more than 20°: they determine only {rank} of the accelerometer's {free} unknowns: {parameters} cannot be found from them[; no placement has {missing}]",
            vec![Remedy::Plan],
        ),
        Kind::PlacementsTooFew => error_by(
            "{count:placement}, {distinct} of which differ by more than 20°: with {free} unknowns nothing is left to check the result with[; {weakest} is known to {error} only][; {unknown} is not known][; no placement has {missing}]",
            vec![Remedy::Plan],
        ),
        Kind::PlacementsTellLittle => error_by(
            "{count:placement}, {distinct} of which differ by more than 20°: they do not determine {parameters} well enough[; {weakest} is known to {error} only][; {unknown} is not known][; no placement has {missing}]",
            vec![Remedy::Plan],
        ),
        Kind::PlacementsInPlane => error_by(
            "{count:placement}, {distinct} of which differ by more than 20°: all lie near one plane, so that errors across it cannot be found[; no placement has {missing}]",
            vec![Remedy::Plan],
        ),
        Kind::DirectionsTooFew => error_by(
            "{count:placement}, {distinct} of which differ by more than 20°: from only {directions} directions, however often recorded, {parameters} cannot be found[; no placement has {missing}]",
            vec![Remedy::Plan],
        ),
        Kind::TurnsLeaveOpen => error(
            "{count:turn} determine only {rank} of the gyroscope's {free} unknowns: {parameters} cannot be found from them",
            "turn the device about its {axes} too, by half a turn or more while that axis lies level",
        ),
        Kind::TurnsTooFew => error(
            "{count:turn} leave nothing to check the gyroscope's {free} unknowns with: at least {least} turns are needed",
            "turn the device about its {axes} too, by half a turn or more while that axis lies level",
        ),
        Kind::TurnsTellLittle => error(
            "{count:turn} do not determine {parameters} well enough",
            "turn the device about its {axes} too, by half a turn or more while that axis lies level",
        ),
        Kind::TurnsMissing => error_by(
            "the recording has no turn between two static intervals",
            vec![Remedy::TurnEachAxis],
        ),
        Kind::TurnsUnusable => error_by(
            "none of {count:turn} can be used[; {gaps} with samples missing][; {frozen} with one reading repeated][; {saturated} faster than the gyroscope can read][; {empty} without samples]",
            whole_turns(),
        ),
        Kind::TurnsUsableFew => error_by(
            "{usable} of {count:turn} can be used[, and {least} or more are needed][; {gaps} with samples missing][; {frozen} with one reading repeated][; {saturated} faster than the gyroscope can read][; {empty} without samples]",
            vec![
                Remedy::TurnEachAxis,
                Remedy::TurnSlower,
                Remedy::LoseNoSamples,
                Remedy::FreezeNoRows,
                Remedy::BothSensors,
            ],
        ),
        Kind::TurnsUsableOpen => error_by(
            "{usable} of {count:turn} can be used, and they do not determine all unknowns of the gyroscope[; {gaps} with samples missing][; {frozen} with one reading repeated][; {saturated} faster than the gyroscope can read][; {empty} without samples]",
            whole_turns(),
        ),
        Kind::NeverStill => error_with(
            "no static interval was found: the device is never still for long enough[ (the quietest seconds and their spread: {quietest})]",
            "record again and lay the device down for {rest} or longer in every placement; if it lay that long already, stop what shakes it",
            vec![Remedy::any_of([
                OptionName::MinStatic,
                OptionName::Multiplier,
            ])],
        ),
        Kind::NeverQuiet => error_with(
            "no quiet stretch is long enough to show a device at rest (in the quietest the rate wavers by {rate})",
            "record again and lay the device down for 5 s or longer in every placement; if it lay that long already, stop what shakes it",
            vec![Remedy::set(OptionName::Multiplier)],
        ),
        Kind::QuietNotStatic => error(
            "the program found {found:static interval}, too few for a calibration, and {count:quiet stretch} that it cannot use. The first: {first}",
            "record again and lay the device on a firm support in every placement instead of holding it",
        ),
        Kind::AllStatic => error_by(
            "the recording is all static: one rest of {length} and no turn",
            vec![Remedy::Plan],
        ),
        Kind::OneStaticInterval => error_by(
            "one static interval was found, of {length}, and motion in the rest of {whole}. Perhaps the device was held still for less than the program looks for",
            vec![
                Remedy::Plan,
                Remedy::examples([(OptionName::Window, "0.2"), (OptionName::MinStatic, "0.4")]),
            ],
        ),
        Kind::NoSphere => error(
            "the means of the readings in {count:placement} at rest do not have one length, as gravity would give them. So the program cannot tell the accelerometer's unit",
            "correct the columns of the accelerometer if they are the wrong ones; if they are right, record again with the device still in every placement",
        ),
        Kind::NoGravityAtRest => error(
            "{at} has no accelerometer samples or shows no gravity",
            "record this placement again",
        ),
        Kind::NoRest => error(
            "no rest of the {sensor} was found: the device is never still for long enough",
            "record this placement again and lay the device down for 5 s or longer",
        ),
        Kind::FaceMissing => error(
            "six positions: no rest with {missing}[, {also}]",
            "record every axis once up and once down",
        ),
        Kind::RestTooShort => error(
            "the longest rest is {longest}, too short to find the bias (the reading at rest)",
            "put the device down for more than {least}",
        ),
        Kind::RestsTooFew => error(
            "{rests:rest}: the bias of the {sensor} needs at least {least} in different orientations",
            "lay the device down in more orientations",
        ),
        Kind::RestsInPlane => error(
            "the orientations of the rests are too alike to tell the biases of the three axes apart (condition number {condition})",
            "record again with each of the six faces up once",
        ),
        _ => return None,
    })
}
