//! Words of sensors of one dimension that cannot be calibrated.

use crate::kind::Kind;
use crate::words::entry::{Entry, error};

pub(in crate::words::tables) fn words(kind: Kind) -> Option<Entry> {
    Some(match kind {
        Kind::ScalarOutside => error(
            "no reading of the {name} lies within the time of the recording ({from} to {to})",
            "give its times on the clock of the recording",
        ),
        Kind::ScalarNeeds => error(
            "the {name} needs the {quantity}, which cannot be known of one instant of this recording",
            "record it too, or take it out of the sensor's equation",
        ),
        Kind::ScalarFewMeans => error(
            "the {name} has {parameters:parameter} to find, and {means:static interval} with a known true value",
            "give the true values beside the readings, and hold the device still more often",
        ),
        Kind::ScalarUndetermined => error(
            "the readings of the {name} do not say how large {what} is",
            "record where more of what it depends on changes, or take it out of the sensor's equation",
        ),
        Kind::ScalarUnsolved => error(
            "the equation of the {name} cannot be solved[: {why}][: no true value gives the reading {reading} at {time}]",
            "write the equation so that the reading changes with the true value everywhere",
        ),
        _ => return None,
    })
}
