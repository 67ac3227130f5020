//! Words of sensors of one dimension that cannot be calibrated.

use crate::words::entry::error;

kinds! {
    /// No reading of a sensor of one dimension lies within its recording.
    SCALAR_OUTSIDE = "scalar_outside" => error(
        "no reading of the {name} lies within the time of the recording ({from} to {to})",
        "give its times on the clock of the recording",
    ),
    /// A sensor of one dimension looks at what cannot be known.
    SCALAR_NEEDS = "scalar_needs" => error(
        "the {name} needs the {quantity}, which cannot be known of one instant of this recording",
        "record it too, or take it out of the sensor's equation",
    ),
    /// Too few static intervals say what a sensor of one dimension should have read.
    SCALAR_FEW_MEANS = "scalar_few_means" => error(
        "the {name} has {parameters:parameter} to find, and {means:static interval} with a known true value",
        "give the true values beside the readings, and hold the device still more often",
    ),
    /// The readings of a sensor of one dimension leave a parameter open.
    SCALAR_UNDETERMINED = "scalar_undetermined" => error(
        "the readings of the {name} do not say how large {what} is",
        "record where more of what it depends on changes, or take it out of the sensor's equation",
    ),
    /// The model of a sensor of one dimension does not fit, or no signal gives a reading.
    SCALAR_UNSOLVED = "scalar_unsolved" => error(
        "the equation of the {name} cannot be solved[: {why}][: no true value gives the reading {reading} at {time}]",
        "write the equation so that the reading changes with the true value everywhere",
    ),
}
