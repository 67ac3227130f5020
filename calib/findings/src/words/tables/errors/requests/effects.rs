//! Words of effects that a model cannot have.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::Entry;

pub(in super::super::super) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::EffectNeedsSensor,
        "the effect {effect} needs the {quantity}, which cannot be known: the recording has no {sensor}",
        "record it too, or leave the effect out",
        Vec::new,
    ),
    Entry::error(
        Kind::EffectNeedsErrors,
        "the effect {effect} needs the {quantity}, which cannot be known: nothing is known of the errors of the {sensor}",
        "calibrate both sensors, or leave the effect out",
        Vec::new,
    ),
    Entry::error(
        Kind::EffectNeedsField,
        "the effect {effect} needs the {quantity}, which only effects of the magnetometer can know",
        "leave the effect out",
        Vec::new,
    ),
    Entry::error(
        Kind::EffectNeedsTemperature,
        "the effect {effect} needs the {quantity}, which cannot be known: no temperature was recorded",
        "record it, or leave the effect out",
        Vec::new,
    ),
    Entry::error(
        Kind::EffectNeedsRests,
        "the effect {effect} needs the {quantity}, which takes at least {least:static interval} to know, and there are {rests}",
        "let the device lie still in between, or leave the effect out",
        Vec::new,
    ),
    Entry::error(
        Kind::EffectNeedsMeans,
        "the effect {effect} needs the {quantity}, which a file of static means does not hold",
        "calibrate from the recording itself",
        Vec::new,
    ),
    Entry::error(
        Kind::EffectNeedsStart,
        "the effect {effect} needs the time since the start of the recording that its {parameter} = {value} was found in ({inputs}), and what that is here cannot be known",
        "calibrate with recordings from one side of the instant only",
        Vec::new,
    ),
    Entry::error(
        Kind::EffectNeedsHeading,
        "the effect {effect} needs the orientation of the device, which cannot be known: its {parameter} is against the heading of another recording ({inputs})",
        "calibrate by the joint method with the latitude instead, which keeps it out of the calibration",
        || vec![Remedy::set_to(OptionName::Method, "joint")],
    ),
    Entry::error(
        Kind::EffectNeedsAttitude,
        "the effect {effect} needs the orientation of the device, which the stepwise method does not know before it has calibrated the gyroscope",
        "leave the effect out",
        || vec![Remedy::set_to(OptionName::Method, "joint")],
    ),
    Entry::error(
        Kind::EffectNeedsInstant,
        "the effect {effect} needs the time {parameter}, which a calibration cannot find",
        "leave the effect out",
        || vec![Remedy::Discover],
    ),
    Entry::error(
        Kind::EffectSilentAtRest,
        "the {parameter} of the effect {effect} shows only where the {quantities} is not zero, and a calibration sees the accelerometer at static intervals, where it is",
        "leave the effect out",
        || vec![Remedy::Discover],
    ),
    Entry::error(
        Kind::EffectsAlike,
        "{parameters} cannot be told apart: they need the direction of the specific force, and the stepwise method knows only its size at static intervals",
        "",
        || vec![Remedy::set_to(OptionName::Method, "joint")],
    ),
    Entry::error(
        Kind::EffectCostly,
        "the effect {effect} took more steps than a fit of this recording may take, without getting anywhere: it changes too fast with what it depends on, or is too costly",
        "write it with fewer functions of smaller arguments",
        Vec::new,
    ),
    Entry::error(
        Kind::EffectNoNumber,
        "the effect {effect} is no number at a specific force of {force} m/s² and a rate of {rate} rad/s with parameters {parameters}",
        "write it so that it is a number in every motion",
        Vec::new,
    ),
    Entry::error(
        Kind::OwnEffectSuspected,
        "the model holds {effects}, an effect of your own: if a calibration without it works, its formula is the reason",
        "calibrate without it once",
        Vec::new,
    ),
    Entry::error(
        Kind::EffectNotHere,
        "the calibration has the effect {effect}, and this program does not know what it does",
        "load it with the crate that has it (`load_with`)",
        Vec::new,
    ),
    Entry::error(
        Kind::EffectsLookFurther,
        "the calibration has effects that look at more than one reading",
        "use `apply`",
        Vec::new,
    ),
];
