//! Recordings to a calibration.
//!
//! ```text
//! recordings ─ prepared ─► even stamps, no spikes, no copies
//!            ─ cut ──────► static intervals and turns
//!            ─ fit ──────► joint or stepwise, then the magnetometer; accelerometer alone where the turns do not suffice
//!            ─ inputs ───► provenance and seal
//! ```
//!
//! What is found on the way is a [`Finding`]: of the readings in `prepared`, of their cut in `cut` and `checks`, of the fit in `joint`, of what
//! changes within a recording in `part_way` and `after_turns`. `explained` takes back what another finding explains, and
//! [`findings::Verdict`] is the worst of those that stay.

mod after_turns;
mod assemble;
mod bias;
mod checks;
mod cut;
mod explained;
mod fit;
mod inputs;
mod joint;
mod left_out;
mod magnetic;
mod noise;
mod outcome;
pub mod own_effects;
mod part_way;
mod prepared;
pub(crate) mod request;
mod same_device;
mod scalar;
mod static_norm;
mod stepwise;
mod unusable_turns;

pub use bias::count_motion;
pub(crate) use checks::few_directions;
pub use checks::{
    Said, corrected_before, cut_towards_zero, implausible, implausible_base, not_in_one_plane,
    of_the_detector, readings_of_the_device, too_fast, untested_linearity, without_copies,
};
pub use cut::{leave_out, of_one_recording_each};
pub use explained::{is_read_otherwise, withdraw_explained};
pub use joint::{Account, LatitudeDoubt, is_determined, refuse_unobservable, written_down};
pub use magnetic::{FIELDS, beside_the_others};
pub use outcome::Outcome;
pub use part_way::{changes_part_way, count_scale_changes};
pub use prepared::Prepared;
pub use prepared::clocks::clocks_apart;
pub use recording::read_static_means;
pub use request::{Frame, GyroBias, Instant, Method, NOMINAL_RATES, Request};
pub use same_device::{Differences, differences, of_one_device};
pub use stepwise::gyroscope_data;

use findings::{Finding, Kind, Level};
use std::borrow::Borrow;

use recording::{Error, Recording};

use self::cut::Cut;
use self::fit::Fit;
use crate::calibration::Calibration;
use crate::methods::joint::ClockMode;

pub use crate::gravity::STANDARD_GRAVITY;

/// Calibrates one device from its recordings; the gyroscope from `gyro_recordings` where there are
/// any, else from the same.
///
/// # Errors
/// Recordings that cannot be cut, too few orientations, a parameter that the data do not determine,
/// a fit that does not converge.
pub fn calibrate<R: Borrow<Recording>>(
    recordings: &[R],
    gyro_recordings: &[R],
    request: &Request,
) -> Result<Outcome, Error> {
    let recordings: Vec<&Recording> = recordings.iter().map(R::borrow).collect();
    let gyro_recordings: Vec<&Recording> = gyro_recordings.iter().map(R::borrow).collect();
    let mut request = request.decided(&recordings);
    request.refuse_ignored()?;
    magnetic::refuse_alone(&recordings)?;
    let all = recordings.iter().chain(&gyro_recordings);
    request.effects = own_effects::granted(&request.effects, all.copied());
    let outcome = request
        .watch
        .over(|| in_steps(&recordings, &gyro_recordings, &request));
    own_effects::blamed(&request.effects, outcome)
}

/// Makes the recordings ready, cuts them, fits the sensors and writes down from what.
fn in_steps(
    recordings: &[&Recording],
    gyro_recordings: &[&Recording],
    request: &Request,
) -> Result<Outcome, Error> {
    let ready = prepared(recordings, request);
    let for_gyroscope = prepared(gyro_recordings, request);
    let (cut, found) = Cut::of(ready.all(), request)?;
    let (turning, found_in_turns) = Cut::of_turns(for_gyroscope.all(), request)?;
    let remarks = [
        ready.remarks.clone(),
        for_gyroscope.remarks.clone(),
        found,
        found_in_turns,
    ];
    let fit = Fit {
        recordings: &cut,
        turning: &turning,
        request,
        remarks: &remarks.into_iter().flatten().collect(),
    };
    let mut outcome = fit.run()?;
    say_clocks(&mut outcome.calibration, clocks_apart(&ready.originals));
    let mut inputs = ready.originals.clone();
    inputs.extend(&for_gyroscope.originals);
    inputs::state(&mut outcome, &inputs, request);
    Ok(outcome)
}

/// States that clocks are apart. One that forbids the use of the result is why static intervals of the two sensors look disturbed.
fn say_clocks(calibration: &mut Calibration, apart: Vec<Finding>) {
    if apart.iter().any(Finding::forbids_use) {
        let warnings = &mut calibration.warnings;
        warnings.retain(|found| found.kind != Kind::DISTURBED_INTERVAL);
    }
    let (gates, warnings): (Vec<Finding>, Vec<Finding>) = apart
        .into_iter()
        .partition(|found| found.level == Level::Bad);
    calibration.failed_gates.extend(gates);
    calibration.warnings.extend(warnings);
}

/// The recordings made ready. The stepwise method keeps stamps as they are, as published, unless an even clock is requested; the joint
/// method decides on a clock by itself.
fn prepared<'a>(recordings: &[&'a Recording], request: &Request) -> Prepared<'a> {
    let ready = Prepared::of(recordings.iter().copied());
    match (request.method, request.clock) {
        (Method::Stepwise, ClockMode::Even) => ready.on_even_clocks(),
        _ => ready,
    }
}
