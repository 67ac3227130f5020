//! Words of static intervals that are given, missing or too few.

use crate::remedy::{OptionName, Remedy};
use crate::words::entry::{error, error_with};

kinds! {
    /// A sensor has no samples.
    NO_SAMPLES = "no_samples" => error_with(
        "the accelerometer or the gyroscope has no samples",
        "look in the file which of the two has no readings and record that sensor again",
        vec![Remedy::set(OptionName::Sensor)],
    ),
    /// A recording is shorter than the detector's window.
    TOO_SHORT = "too_short" => error(
        "the recording has {length} of samples, and the search for rests looks at windows of {window}",
        "record longer: hold the device still for 5 s in each of at least ten placements",
    ),
    /// Samples are too few for the detector.
    SAMPLED_SLOWLY = "sampled_slowly" => error(
        "the recording has a sample every {step} ({rate}), too few to follow a turn. The search for rests needs {least} or more in {window}",
        "record at 100 Hz or more",
    ),
    /// A table of static intervals has other columns.
    SECTIONS_COLUMNS = "sections_columns" => error(
        "columns {columns} found; t0,t1 (seconds) or start,stop (sample numbers) expected",
        "correct the header",
    ),
    /// A table of static intervals cannot be read.
    SECTIONS_UNREADABLE = "sections_unreadable" => error(
        "this line of the file of intervals cannot be read: {reason}",
        "correct the line",
    ),
    /// A static interval lies outside the recording.
    SAMPLES_OUTSIDE = "samples_outside" => error(
        "samples {from} to {to} found, within 1 to {count} expected",
        "correct the line",
    ),
    /// A static interval is empty.
    INTERVAL_EMPTY = "interval_empty" => error(
        "the interval {from} to {to} is empty: it ends before or where it starts",
        "correct the line",
    ),
    /// A static interval begins before the end of the one above.
    INTERVALS_OVERLAP = "intervals_overlap" => error(
        "this interval starts at {from} s, before the end of the one above ({end} s)",
        "correct the line",
    ),
    /// A table has no static interval for a recording.
    NO_INTERVALS = "no_intervals" => error(
        "the file of intervals has no interval for {named}",
        "add one for it",
    ),
    /// An instant that is left out lies within no static interval.
    NO_INTERVAL_THERE = "no_interval_there" => error(
        "no static interval at t = {instant} s that could be left out[; the nearest lasts from {from} to {to} s]",
        "name a time within a static interval",
    ),
}
