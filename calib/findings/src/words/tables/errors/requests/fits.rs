//! Words of fits that come to no end, and of magnetometers that no attitude determines.

use crate::remedy::{OptionName, Remedy};
use crate::words::entry::{error, error_with};

kinds! {
    /// The work was cancelled.
    CANCELLED = "cancelled" => error(
        "the work was cancelled before it had a result",
        "run it again",
    ),
    /// The solver refused the problem.
    SOLVER_REFUSED = "solver_refused" => error(
        "no calibration fits this recording: its numbers are too large, too small or not those of a sensor",
        "check the units and the columns of the recording",
    ),
    /// A fit does not come to an end.
    FIT_STOPPED = "fit_stopped" => error(
        "the fit of the {sensor} came to no end in {steps:step}[: its readings at rest still differ from gravity by {left}]",
        "[give the right gravity if {gravity} is not that of your place; else ]record again and keep the device still in every placement",
    ),
    /// A fit did not converge with the turns, and does without them.
    FIT_STOPPED_BY_TURNS = "fit_stopped_by_turns" => error_with(
        "the fit came to no end: the turns of the gyroscope do not lead to the directions that the accelerometer reads, which by itself can be calibrated. Perhaps the rates are filtered or not raw, or their axes are exchanged",
        "compare the rates with the description of the app or the data sheet, and record raw ones",
        vec![Remedy::set_to(OptionName::Sensor, "accelerometer")],
    ),
    /// A recording has nothing to calibrate.
    NOTHING_TO_CALIBRATE = "nothing_to_calibrate" => error(
        "the recording has nothing to calibrate: no placements of an accelerometer and no rests of a gyroscope",
        "record an accelerometer and a gyroscope, with the device at rest in at least ten placements",
    ),
    /// Two axes of a fit are the same.
    AXES_SAME = "axes_same" => error(
        "the six placements do not determine three different axes of the sensor: two of its axes look the same",
        "check that no column is given twice and that each axis was once up and once down",
    ),
    /// There is a magnetometer and nothing that tells how it was held.
    MAGNETOMETER_ALONE = "magnetometer_alone" => error(
        "the recording has a magnetometer alone: its offset and axes are found against gravity, which only the accelerometer sees",
        "record the accelerometer, and best the gyroscope, of the same device beside it, at rest in twelve orientations or more",
    ),
    /// Nothing tells how a magnetometer was held.
    ATTITUDE_NOT_SEEN = "attitude_not_seen" => error(
        "without an accelerometer the program cannot know how the device was held",
        "record the accelerometer too",
    ),
    /// The magnetometers of two recordings have different units.
    FIELD_UNITS_DIFFER = "field_units_differ" => error(
        "the magnetometer of this recording is in {unit}, that of {other} in {others}",
        "convert one of them, so that both files have one unit and say so",
    ),
    /// Attitudes do not determine a magnetometer.
    ATTITUDES_LEAVE_OPEN = "attitudes_leave_open" => error(
        "the orientations of the device do not determine the magnetometer's axes and offset[ ({open})][: its fit did not end ({ending})]",
        "record again with each of the six faces up once, and point the device to another heading (compass direction) each time",
    ),
    /// An axis of the magnetometer reads one value.
    FIELD_AXIS_CONSTANT = "field_axis_constant" => error(
        "axis {axis} of the magnetometer reads {value} throughout",
        "correct the column if it is the wrong one; if it is right, check the magnetometer",
    ),
    /// Too few attitudes have readings of the magnetometer.
    ATTITUDES_TOO_FEW = "attitudes_too_few" => error(
        "{count:static interval} with readings of the magnetometer are too few[: {least} at least are needed]",
        "record at rest in more orientations",
    ),
}
