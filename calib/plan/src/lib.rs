//! Optimal design of the placements and turns of a hand-held calibration.
//!
//! ```text
//! directions ──► exchange (V, D) ──► sequence: order and ways ──► Plan ──► words, predictions
//!  26, tilts     relaxation: bound    both sensors' information
//! placements there ──► coverage: covered, unknown, wanted ◄── REQUIREMENT
//!                  └─► next: one more, while a session goes on
//! ```
//!
//! The accelerometer measures a placement by the norm of its reading, `‖T (A − b)‖ = g`: one row `h(u)` of nine. The
//! gyroscope's error rotates the propagated direction of gravity through a turn. Its component along gravity is
//! unobservable, so the order and the way of the turns matter. The criterion is the mean square error of a corrected
//! reading over all directions.
//!
//! The noise is white within a static interval and a turn. Further errors of the device (misfit of the model, random
//! walk of the biases) are `placement` and `turn` of [`Noise`]. The earth's rotation is taken as known.

#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

mod accelerometer;
mod direction;
mod exchange;
mod next;
mod protocol;
mod relaxation;
mod requirement;
mod sequence;
mod session;
mod turn;
mod turn_words;

pub use accelerometer::{
    FORCE_NAMES, FORCE_PARAMETERS, FORCE_PLACES, ForceMatrix, ForceRow, error_weights,
    force_covariance, force_information, force_row, placement_error, reading_error,
};
pub use direction::{
    Words, axes_up, corners, edges, faces, faces_edges_corners, tilts, whole_angles,
};
pub use exchange::{Criterion, exchange};
pub use next::{next_placement, session_efficiency, worth};
pub use protocol::{
    Known, Plan, Protocol, Step, best, finest, follow, force_part, plan, plan_session, recorded,
};
pub use relaxation::{Efficiency, d_efficiency, efficiency, relaxation, weighted_information};
pub use requirement::{
    Coverage, REQUIREMENT, Requirement, Wanted, axes_wanted, best_next, coverage, fewest,
    is_determined,
};
pub use sequence::{Sequence, sequence, session_of};
pub use session::{
    Information, Noise, PARAMETERS, Prediction, Timing, information_of, parameter_names, predict,
    session_information,
};
pub use turn::{Carried, Leg, Pace, Speed, Turn, Way, ways};
