//! Words of what a search for missing effects names, and of what it leaves.

use crate::remedy::{OptionName, Remedy};

use crate::words::entry::{Entry, UseOfResult, care};
use crate::words::tables::reading::IF_EXACT;

/// Advice that separates an error of the device from an error of that day.
const ONCE_MORE: &str = "the calibration holds with the errors that it states; to see whether the device has this error, record it on another day and look whether it returns";

kinds! {
    /// The base models lack effects that the search names.
    EFFECT_NAMED = "effect_named" => Entry {
        reason: "the usual sensor model lacks {names}",
        text: "the sensors have errors beyond bias, scale factors and misalignments, most like {names}. The calibration of this search corrects them",
        advice: "keep this calibration",
        remedies: vec![Remedy::such_as(OptionName::Validation, "second.csv")],
        ..care(0.1)
    },
    /// Turns miss something because the rate jumps between samples.
    UNDERSAMPLED_MOTION = "undersampled_motion" => Entry {
        reason: "the rate of rotation jumps between samples",
        text: "the rate of rotation jumps between samples, so that {share} ({low} to {high}) of each jump is missing in the angle. The turns miss gravity by {angle} (rms), most of it expected in turns {turns}",
        advice: "use this calibration if its standard errors are small enough for you; if not, put the device down more gently",
        use_of_result: UseOfResult::Conditional,
        remedies: vec![Remedy::SampleFaster, Remedy::FilterFirst],
        ..care(0.3)
    },
    /// The stamps of one recording are late in a way of their own.
    STAMPS_APART = "stamps_apart" => Entry {
        reason: "the stamps are {way} in this recording, unlike in the others",
        text: "the stamps of the accelerometer are {size} ± {error} {way} in this recording, unlike in the others. The calibration does not contain this offset, and its parameters do not depend on it",
        advice: "use this calibration, but shift the stamps of this recording before you combine its two sensors in motion",
        use_of_result: UseOfResult::Conditional,
        remedies: vec![Remedy::OneClock],
        ..care(0.1)
    },
    /// Samples are missing in one place.
    SAMPLES_MISSING = "samples_missing" => Entry {
        reason: "samples of the {which} are missing",
        text: "samples of the {which} are missing for {length}[ from t = {t0} on]",
        advice: "record again if the device was turning then",
        ..care(0.02)
    },
    /// A turn misses gravity where samples are lost.
    TURN_WITHOUT_SAMPLES = "turn_without_samples" => Entry {
        reason: "samples are lost in {at}",
        text: "[{at}: ]samples are lost in this turn, and it misses gravity by {size}: it does not lead to the direction of gravity that the accelerometer reads after it. The program does not use the turn",
        advice: IF_EXACT,
        use_of_result: UseOfResult::Conditional,
        remedies: vec![Remedy::RecordAgain],
        ..care(0.1)
    },
    /// Readings stand at the end of the range in a turn or a static interval.
    RANGE_REACHED = "range_reached" => Entry {
        reason: "the {sensor} reached the end of its range",
        text: "{count:sample} of the {sensor} reached the end of its range",
        advice: "turn more slowly, or record with a larger range",
        ..care(0.5)
    },
    /// The residual has a fine pattern over orientation.
    FINE_ORIENTATION = "fine_orientation" => Entry {
        reason: "the {sensor} has an unexplained error that changes with the orientation",
        text: "the {sensor} has an error that changes with the orientation, in a finer pattern than any in the list of known errors",
        advice: ONCE_MORE,
        ..care(0.1)
    },
    /// The residual changes slowly over time.
    SLOW_CHANGE = "slow_change" => Entry {
        reason: "the {sensor} has an unexplained error that changes slowly over time",
        text: "the {sensor} has an error that changes slowly over time",
        advice: ONCE_MORE,
        ..care(0.1)
    },
    /// The residual is periodic in time.
    PERIODIC_IN_TIME = "periodic_in_time" => Entry {
        reason: "the {sensor} has an unexplained error that is periodic in time",
        text: "the {sensor} has an error that is periodic in time[, with a period of {period}]",
        advice: ONCE_MORE,
        ..care(0.1)
    },
    /// The residual is fixed to a horizontal direction of the room.
    ROOM_DIRECTION = "room_direction" => Entry {
        reason: "the {sensor} feels a horizontal direction of the room",
        text: "the {sensor} has an error that points the same way in the room (as towards one wall), however the device is turned",
        advice: ONCE_MORE,
        ..care(0.1)
    },
    /// The residual is fixed to a horizontal direction of the room, as the earth's rotation is near the equator.
    ROOM_OR_EARTH = "room_or_earth" => Entry {
        reason: "the {sensor} feels a horizontal direction of the room",
        text: "the {sensor} has an error that points the same way in the room (as towards one wall), however the device is turned. Near the equator the rotation of the earth looks so",
        advice: ONCE_MORE,
        remedies: vec![Remedy::set(OptionName::Latitude)],
        ..care(0.1)
    },
    /// The residual relaxes after each turn.
    RELAXATION_AFTER_TURN = "relaxation_after_turn" => Entry {
        reason: "the {sensor} has an error after each turn that fades away",
        text: "{sensor}: an error after each turn that fades away and depends on the direction of the turn",
        advice: ONCE_MORE,
        ..care(0.1)
    },
    /// The residual is proportional to products of the rates of two axes.
    RATE_PRODUCTS = "rate_products" => Entry {
        reason: "the {sensor} has an error by products of two rates",
        text: "the {sensor} has an error that goes with the product of the rates of two axes",
        advice: ONCE_MORE,
        ..care(0.1)
    },
    /// A bias moves in one recording of several.
    BIAS_MOVES = "bias_moves" => Entry {
        reason: "the bias of the {sensor} moves in one recording",
        text: "{sensor}: the bias {moves} in {where}",
        advice: ONCE_MORE,
        ..care(0.1)
    },
    /// A bias jumps to and fro between two levels.
    BIAS_TWO_LEVELS = "bias_two_levels" => Entry {
        reason: "the bias of the {sensor} jumps between two levels",
        text: "{sensor}: the bias of axis {axis} jumps to and fro between two levels, {count} times",
        advice: ONCE_MORE,
        ..care(0.1)
    },
    /// A bias differs from static interval to static interval.
    BIAS_SCATTERS = "bias_scatters" => Entry {
        reason: "the bias of the {sensor} differs from interval to interval",
        text: "{sensor}: the bias of axis {axis} differs from static interval to static interval. Perhaps it goes with the placement, or it jumps in between",
        advice: ONCE_MORE,
        ..care(0.1)
    },
    /// A bias wanders with a memory.
    BIAS_WANDERS = "bias_wanders" => Entry {
        reason: "the bias of the {sensor} wanders",
        text: "{sensor}: the bias of axis {axis} wanders or jumps at random, within times of about {memory}",
        advice: ONCE_MORE,
        ..care(0.1)
    },
    /// There is more scatter than the noise explains.
    MORE_SCATTER = "more_scatter" => Entry {
        reason: "there is more scatter than the noise explains",
        text: "the readings differ from the model by more than their noise explains",
        advice: ONCE_MORE,
        ..care(0.1)
    },
    /// Readings drift within static intervals.
    DRIFT_AT_REST = "drift_at_rest" => Entry {
        reason: "readings of the {sensor} drift, sway or vibrate at rest",
        text: "readings of the {sensor} drift, sway or vibrate within static intervals by more than the noise",
        advice: ONCE_MORE,
        ..care(0.1)
    },
    /// The search ended before it was through.
    SEARCH_CUT_SHORT = "search_cut_short" => Entry {
        reason: "the search ended before it had tried everything",
        text: "the search for missing sources of error ended after {fits:fit}, because more would take too long with {count:static interval}. There may be more to find",
        advice: "cut the recording into parts with fewer static intervals, and search each",
        ..care(0.05)
    },
}
