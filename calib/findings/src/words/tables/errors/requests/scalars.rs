//! Words of sensors of one dimension that cannot be calibrated.

use crate::kind::Kind;
use crate::words::entry::Entry;

pub(in super::super::super) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::ScalarOutside,
        "no reading of the {name} lies within the time of the recording ({from} to {to})",
        "give its times on the clock of the recording",
        Vec::new,
    ),
    Entry::error(
        Kind::ScalarNeeds,
        "the {name} needs the {quantity}, which cannot be known of one instant of this recording",
        "record it too, or take it out of the sensor's equation",
        Vec::new,
    ),
    Entry::error(
        Kind::ScalarFewMeans,
        "the {name} has {parameters:parameter} to find, and {means:static interval} with a known true value",
        "give the true values beside the readings, and hold the device still more often",
        Vec::new,
    ),
    Entry::error(
        Kind::ScalarUndetermined,
        "the readings of the {name} do not say how large {what} is",
        "record where more of what it depends on changes, or take it out of the sensor's equation",
        Vec::new,
    ),
    Entry::error(
        Kind::ScalarUnsolved,
        "the equation of the {name} cannot be solved[: {why}][: no true value gives the reading {reading} at {time}]",
        "write the equation so that the reading changes with the true value everywhere",
        Vec::new,
    ),
];
