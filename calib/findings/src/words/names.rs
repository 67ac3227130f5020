//! Names of what a calibration is judged by, as sentences have them.

/// The norm of specific force in static intervals.
pub const NORM_AT_REST: &str = "length of the accelerometer's reading at rest";
/// The rate in static intervals.
pub const RATE_AT_REST: &str = "rate of rotation at rest";
/// The direction of gravity, carried through turns.
pub const DIRECTION: &str = "direction of gravity after turns";

/// A remainder that goes with the square of the specific force.
pub const QUADRATIC: &str = "the square of the accelerometer's reading";
/// A remainder that goes with the sign of the specific force.
pub const ASYMMETRY: &str = "the sign of the accelerometer's reading";
/// A remainder that goes with the cube of the specific force.
pub const CUBIC: &str = "the cube of the accelerometer's reading";
/// A remainder that goes with the placement before.
pub const HISTORY: &str = "the placement before";
/// A remainder that goes with the specific force.
pub const FORCE: &str = "the accelerometer's reading itself";

/// Why a sensor is not calibrated: no turn.
pub const NO_TURN: &str = "no turn can be used";
/// Why a sensor is not calibrated: too few turns.
pub const FEW_TURNS: &str = "too few turns can be used";
/// Why a sensor is not calibrated: turns that leave a parameter open.
pub const OPEN_TURNS: &str = "the turns leave a parameter open";
