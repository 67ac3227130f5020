//! Words of effects that a model cannot have.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::{Entry, error, error_by, error_with};

pub(in crate::words::tables) fn words(kind: Kind) -> Option<Entry> {
    Some(match kind {
        Kind::EffectNeedsSensor => error(
            "the effect {effect} needs the {quantity}, which cannot be known: the recording has no {sensor}",
            "record it too, or leave the effect out",
        ),
        Kind::EffectNeedsErrors => error(
            "the effect {effect} needs the {quantity}, which cannot be known: nothing is known of the errors of the {sensor}",
            "calibrate both sensors, or leave the effect out",
        ),
        Kind::EffectNeedsField => error(
            "the effect {effect} needs the {quantity}, which only effects of the magnetometer can know",
            "leave the effect out",
        ),
        Kind::EffectNeedsTemperature => error(
            "the effect {effect} needs the {quantity}, which cannot be known: no temperature was recorded",
            "record it, or leave the effect out",
        ),
        Kind::EffectNeedsRests => error(
            "the effect {effect} needs the {quantity}, which takes at least {least:static interval} to know, and there are {rests}",
            "let the device lie still in between, or leave the effect out",
        ),
        Kind::EffectNeedsMeans => error(
            "the effect {effect} needs the {quantity}, which a file of static means does not hold",
            "calibrate from the recording itself",
        ),
        Kind::EffectNeedsStart => error(
            "the calibration has a source of error ({effect}) that changes at the time {parameter} = {value} of {inputs}. The program cannot know that moment in this recording",
            "calibrate again from recordings that lie all before or all after that moment",
        ),
        Kind::EffectNeedsHeading => error(
            "the calibration has a source of error ({effect}) whose parameter {parameter} depends on the heading of the device (its compass direction) in {inputs}. In this recording the program cannot know it",
            "calibrate again with the latitude and by the joint method (the usual one), which keeps it out of the calibration",
        ),
        Kind::EffectNeedsAttitude => error_with(
            "the effect {effect} needs the orientation of the device, which the stepwise method does not know before it has calibrated the gyroscope",
            "leave the effect out",
            vec![Remedy::set_to(OptionName::Method, "joint")],
        ),
        Kind::EffectNeedsInstant => error_with(
            "the source of error {effect} begins at an unknown time ({parameter}), and a calibration cannot find such a time",
            "leave it out of the model",
            vec![Remedy::Discover],
        ),
        Kind::EffectSilentAtRest => error_with(
            "the {parameter} of the effect {effect} shows only where the {quantities} is not zero, and a calibration sees the accelerometer at static intervals, where it is",
            "leave the effect out",
            vec![Remedy::Discover],
        ),
        Kind::EffectsAlike => error_by(
            "the stepwise method cannot tell {parameters} apart: at rest it looks only at the length of the accelerometer's reading, not at its direction",
            vec![Remedy::set_to(OptionName::Method, "joint")],
        ),
        Kind::EffectCostly => error(
            "your source of error {effect} took more steps than a fit of this recording may take. Its formula changes too fast with its quantities, or is too long",
            "write the formula with fewer functions and smaller arguments",
        ),
        Kind::EffectNoNumber => error(
            "the formula of your source of error {effect} gives no number, as in a division by zero. It happens at the corrected accelerometer reading {force} m/s² and the rate {rate} rad/s, with the parameters {parameters}",
            "write the formula so that it is a number in every motion",
        ),
        Kind::OwnEffectSuspected => error(
            "the model holds [an effect of your own ({effect})][effects of your own ({effects})]: a wrong formula may be the reason",
            "calibrate once without your own effects; if that works, correct their formulas; if it fails too, look for the reason in the recording",
        ),
        Kind::EffectNotHere => error(
            "the calibration has a source of error ({effect}) that this program does not know",
            "use the program that made the calibration, or in Rust load it with the crate that defines {effect} (`load_with`)",
        ),
        Kind::EffectsLookFurther => error(
            "the calibration has sources of error that depend on more than one reading, so single readings cannot be corrected",
            "correct the whole recording by `apply`",
        ),
        _ => return None,
    })
}
