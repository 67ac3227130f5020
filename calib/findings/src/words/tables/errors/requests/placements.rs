//! Words of recordings whose placements and turns do not determine the parameters.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::Entry;

pub(in super::super::super) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::Requirement,
        "record at least {least} placements ({advised} are better), with each face up once and down once. Hold the device still for {rest} in each, and turn it by at most {fastest} in between",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::PlacementsLeaveOpen,
        "{count:placement}, {distinct} of which differ by more than 20°: {parameters} cannot be found from them[; no placement has {missing}]",
        "",
        || vec![Remedy::Plan],
    ),
    Entry::error(
        Kind::PlacementsTooFew,
        "{count:placement}, {distinct} of which differ by more than 20°: with {free} unknowns nothing is left to check the result with[; {weakest} is known to {error} only][; {unknown} is not known][; no placement has {missing}]",
        "",
        || vec![Remedy::Plan],
    ),
    Entry::error(
        Kind::PlacementsTellLittle,
        "{count:placement}, {distinct} of which differ by more than 20°: they do not determine {parameters} well enough[; {weakest} is known to {error} only][; {unknown} is not known][; no placement has {missing}]",
        "",
        || vec![Remedy::Plan],
    ),
    Entry::error(
        Kind::PlacementsInPlane,
        "{count:placement}, {distinct} of which differ by more than 20°: all lie near one plane, so that errors across it cannot be found[; no placement has {missing}]",
        "",
        || vec![Remedy::Plan],
    ),
    Entry::error(
        Kind::DirectionsTooFew,
        "{count:placement}, {distinct} of which differ by more than 20°: from only {directions} directions, however often recorded, {parameters} cannot be found[; no placement has {missing}]",
        "",
        || vec![Remedy::Plan],
    ),
    Entry::error(
        Kind::TurnsLeaveOpen,
        "{count:turn} determine only {rank} of the gyroscope's {free} unknowns: {parameters} cannot be found from them",
        "turn the device about its {axes} too, by half a turn or more while that axis lies level",
        Vec::new,
    ),
    Entry::error(
        Kind::TurnsTooFew,
        "{count:turn} leave nothing to check the gyroscope's {free} unknowns with: at least {least} turns are needed",
        "turn the device about its {axes} too, by half a turn or more while that axis lies level",
        Vec::new,
    ),
    Entry::error(
        Kind::TurnsTellLittle,
        "{count:turn} do not determine {parameters} well enough",
        "turn the device about its {axes} too, by half a turn or more while that axis lies level",
        Vec::new,
    ),
    Entry::error(
        Kind::TurnsMissing,
        "the recording has no turn between two static intervals",
        "",
        || vec![Remedy::TurnEachAxis],
    ),
    Entry::error(
        Kind::TurnsUnusable,
        "none of {count:turn} can be used[; {gaps} with samples missing][; {frozen} with one reading repeated][; {saturated} faster than the gyroscope can read][; {empty} without samples]",
        "",
        || vec![Remedy::TurnEachAxis],
    ),
    Entry::error(
        Kind::TurnsUsableFew,
        "{usable} of {count:turn} can be used[, and {least} or more are needed][; {gaps} with samples missing][; {frozen} with one reading repeated][; {saturated} faster than the gyroscope can read][; {empty} without samples]",
        "",
        || vec![Remedy::TurnEachAxis],
    ),
    Entry::error(
        Kind::TurnsUsableOpen,
        "{usable} of {count:turn} can be used, and they do not determine all unknowns of the gyroscope[; {gaps} with samples missing][; {frozen} with one reading repeated][; {saturated} faster than the gyroscope can read][; {empty} without samples]",
        "",
        || vec![Remedy::TurnEachAxis],
    ),
    Entry::error(
        Kind::NeverStill,
        "no static interval was found: the device is never still for long enough[ (the quietest seconds and their spread: {quietest})]",
        "lay the device down for {rest} between the turns",
        || {
            vec![Remedy::any_of([
                OptionName::MinStatic,
                OptionName::Multiplier,
            ])]
        },
    ),
    Entry::error(
        Kind::NeverQuiet,
        "no quiet stretch is long enough to show a device at rest (in the quietest the rate wavers by {rate})",
        "lay the device down for 5 s between the turns",
        || vec![Remedy::set(OptionName::Multiplier)],
    ),
    Entry::error(
        Kind::QuietNotStatic,
        "the recording has {found:static interval}; {count:quiet stretch} are none, the first: {first}",
        "lay the device down instead of holding it",
        Vec::new,
    ),
    Entry::error(
        Kind::AllStatic,
        "the recording is all static: one rest of {length} and no turn",
        "",
        || vec![Remedy::Plan],
    ),
    Entry::error(
        Kind::NoSphere,
        "the means of the readings in {count:placement} at rest do not have one length, as gravity would give them. So the program cannot tell the accelerometer's unit",
        "check the columns of the accelerometer",
        || vec![Remedy::Plan],
    ),
    Entry::error(
        Kind::NoGravityAtRest,
        "{at} has no accelerometer samples or shows no gravity",
        "record this placement again",
        Vec::new,
    ),
    Entry::error(
        Kind::NoRest,
        "no rest of the {sensor} was found: the device is never still for long enough",
        "lay the device down in each placement",
        Vec::new,
    ),
    Entry::error(
        Kind::FaceMissing,
        "six positions: no rest with {missing}[, {also}]",
        "record every axis once up and once down",
        Vec::new,
    ),
    Entry::error(
        Kind::RestTooShort,
        "the longest rest is {longest}, too short to find the bias (the reading at rest)",
        "put the device down for more than {least}",
        Vec::new,
    ),
    Entry::error(
        Kind::RestsTooFew,
        "{rests:rest}: the bias of the {sensor} needs at least {least} in different orientations",
        "lay the device down in more orientations",
        Vec::new,
    ),
    Entry::error(
        Kind::RestsInPlane,
        "the rests do not tell the three axes apart (condition {condition}): they are too alike",
        "turn the device further between the rests",
        Vec::new,
    ),
];
