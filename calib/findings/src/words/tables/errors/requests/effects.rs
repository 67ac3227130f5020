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
        "the calibration has a source of error ({effect}) that changes at the time {parameter} = {value} of {inputs}. The program cannot know that moment in this recording",
        "calibrate again from recordings that lie all before or all after that moment",
        Vec::new,
    ),
    Entry::error(
        Kind::EffectNeedsHeading,
        "the calibration has a source of error ({effect}) whose parameter {parameter} depends on the heading of the device (its compass direction) in {inputs}. In this recording the program cannot know it",
        "calibrate again with the latitude and by the joint method (the usual one), which keeps it out of the calibration",
        Vec::new,
    ),
    Entry::error(
        Kind::EffectNeedsAttitude,
        "the effect {effect} needs the orientation of the device, which the stepwise method does not know before it has calibrated the gyroscope",
        "leave the effect out",
        || vec![Remedy::set_to(OptionName::Method, "joint")],
    ),
    Entry::error(
        Kind::EffectNeedsInstant,
        "the source of error {effect} begins at an unknown time ({parameter}), and a calibration cannot find such a time",
        "leave it out of the model",
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
        "the stepwise method cannot tell {parameters} apart: at rest it looks only at the length of the accelerometer's reading, not at its direction",
        "",
        || vec![Remedy::set_to(OptionName::Method, "joint")],
    ),
    Entry::error(
        Kind::EffectCostly,
        "your source of error {effect} took more steps than a fit of this recording may take. Its formula changes too fast with its quantities, or is too long",
        "write the formula with fewer functions and smaller arguments",
        Vec::new,
    ),
    Entry::error(
        Kind::EffectNoNumber,
        "the formula of your source of error {effect} gives no number, as in a division by zero. It happens at the corrected accelerometer reading {force} m/s² and the rate {rate} rad/s, with the parameters {parameters}",
        "write the formula so that it is a number in every motion",
        Vec::new,
    ),
    Entry::error(
        Kind::OwnEffectSuspected,
        "the model holds [an effect of your own ({effect})][effects of your own ({effects})]: a wrong formula may be the reason",
        "calibrate once without your own effects; if that works, correct their formulas; if it fails too, look for the reason in the recording",
        Vec::new,
    ),
    Entry::error(
        Kind::EffectNotHere,
        "the calibration has a source of error ({effect}) that this program does not know",
        "use the program that made the calibration, or in Rust load it with the crate that defines {effect} (`load_with`)",
        Vec::new,
    ),
    Entry::error(
        Kind::EffectsLookFurther,
        "the calibration has sources of error that depend on more than one reading, so single readings cannot be corrected",
        "correct the whole recording by `apply`",
        Vec::new,
    ),
];
