//! Words of effects that a model cannot have.

use crate::remedy::{OptionName, Remedy};
use crate::words::entry::{error, error_by, error_with};

kinds! {
    /// An effect looks at a sensor that was not recorded.
    EFFECT_NEEDS_SENSOR = "effect_needs_sensor" => error(
        "the effect {effect} needs the {quantity}, which cannot be known: the recording has no {sensor}",
        "record it too, or leave the effect out",
    ),
    /// An effect looks at a sensor whose errors are not known.
    EFFECT_NEEDS_ERRORS = "effect_needs_errors" => error(
        "the effect {effect} needs the {quantity}, which cannot be known: nothing is known of the errors of the {sensor}",
        "calibrate both sensors, or leave the effect out",
    ),
    /// An effect of another sensor looks at the magnetic field.
    EFFECT_NEEDS_FIELD = "effect_needs_field" => error(
        "the effect {effect} needs the {quantity}, which only effects of the magnetometer can know",
        "leave the effect out",
    ),
    /// An effect looks at the temperature, and none was recorded.
    EFFECT_NEEDS_TEMPERATURE = "effect_needs_temperature" => error(
        "the effect {effect} needs the {quantity}, which cannot be known: no temperature was recorded",
        "record it, or leave the effect out",
    ),
    /// An effect looks at what static intervals tell, and there are too few.
    EFFECT_NEEDS_RESTS = "effect_needs_rests" => error(
        "the effect {effect} needs the {quantity}, which takes at least {least:static interval} to know, and there are {rests}",
        "let the device lie still in between, or leave the effect out",
    ),
    /// An effect looks at more than a file of means has.
    EFFECT_NEEDS_MEANS = "effect_needs_means" => error(
        "the effect {effect} needs the {quantity}, which a file of static means does not hold",
        "calibrate from the recording itself",
    ),
    /// An effect with an instant is used on another recording.
    EFFECT_NEEDS_START = "effect_needs_start" => error(
        "the calibration has a source of error ({effect}) that changes at the time {parameter} = {value} of {inputs}. The program cannot know that moment in this recording",
        "calibrate again from recordings that lie all before or all after that moment",
    ),
    /// An effect with a heading is used on another recording.
    EFFECT_NEEDS_HEADING = "effect_needs_heading" => error(
        "the calibration has a source of error ({effect}) whose parameter {parameter} depends on the heading of the device (its compass direction) in {inputs}. In this recording the program cannot know it",
        "calibrate again with the latitude and by the joint method (the usual one), which keeps it out of the calibration",
    ),
    /// An effect of the accelerometer looks at the attitude, which its method does not know yet.
    EFFECT_NEEDS_ATTITUDE = "effect_needs_attitude" => error_with(
        "the effect {effect} needs the orientation of the device, which the stepwise method does not know before it has calibrated the gyroscope",
        "leave the effect out",
        vec![Remedy::set_to(OptionName::Method, "joint")],
    ),
    /// An effect has an instant, by which a fit has no derivative.
    EFFECT_NEEDS_INSTANT = "effect_needs_instant" => error_with(
        "the source of error {effect} begins at an unknown time ({parameter}), and a calibration cannot find such a time",
        "leave it out of the model",
        vec![Remedy::Discover],
    ),
    /// A parameter of an effect shows in no static interval.
    EFFECT_SILENT_AT_REST = "effect_silent_at_rest" => error_with(
        "the {parameter} of the effect {effect} shows only where the {quantities} is not zero, and a calibration sees the accelerometer at static intervals, where it is",
        "leave the effect out",
        vec![Remedy::Discover],
    ),
    /// Parameters of effects change the norm of specific force alike.
    EFFECTS_ALIKE = "effects_alike" => error_by(
        "the stepwise method cannot tell {parameters} apart: at rest it looks only at the length of the accelerometer's reading, not at its direction",
        vec![Remedy::set_to(OptionName::Method, "joint")],
    ),
    /// An effect of the user takes more steps than it may.
    EFFECT_COSTLY = "effect_costly" => error(
        "your source of error {effect} took more steps than a fit of this recording may take. Its formula changes too fast with its quantities, or is too long",
        "write the formula with fewer functions and smaller arguments",
    ),
    /// An effect of the user is no number somewhere.
    EFFECT_NO_NUMBER = "effect_no_number" => error(
        "the formula of your source of error {effect} gives no number, as in a division by zero. It happens at the corrected accelerometer reading {force} m/s² and the rate {rate} rad/s, with the parameters {parameters}",
        "write the formula so that it is a number in every motion",
    ),
    /// An effect of the user may be why a fit fails.
    OWN_EFFECT_SUSPECTED = "own_effect_suspected" => error(
        "the model holds [an effect of your own ({effect})][effects of your own ({effects})]: a wrong formula may be the reason",
        "calibrate once without your own effects; if that works, correct their formulas; if it fails too, look for the reason in the recording",
    ),
    /// A calibration has an effect that this program does not know.
    EFFECT_NOT_HERE = "effect_not_here" => error(
        "the calibration has a source of error ({effect}) that this program does not know",
        "use the program that made the calibration, or in Rust load it with the crate that defines {effect} (`load_with`)",
    ),
    /// A calibration with effects is to correct single readings.
    EFFECTS_LOOK_FURTHER = "effects_look_further" => error(
        "the calibration has sources of error that depend on more than one reading, so single readings cannot be corrected",
        "correct the whole recording by `apply`",
    ),
}
