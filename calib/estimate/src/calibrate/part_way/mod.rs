//! Changes part of the way through a recording: a bias, a scale factor, a sign, two columns, a clock, a turn.
//!
//! ```text
//! static intervals ──► force (norm of gravity) ──► directions ──► turns (gravity carried by the gyroscope)
//!                 └──► rate (static means)
//! ```
//! Every hypothesis is a base with one thing changed from one static interval on. It is named where what it leaves is
//! less than a third of what the base alone leaves (root mean square) and chance does that in one recording of ten
//! thousand, over all hypotheses. The base is fitted here and not taken over, so that it holds for every method.

mod change;
mod counted;
mod force;
mod hypothesis;
mod mirrored;
mod rate;
mod sure;
mod turn;
mod turn_sums;
mod turned;
mod turns;
mod weigh;
mod whole;

pub use counted::count_scale_changes;
pub(super) use whole::gyroscope_by_turns;

use change::{Change, Kind, Place};
use findings::Finding;
use nalgebra::{Matrix3, Vector3};
use recording::Recording;
use recording::intervals::Segmentation;
use turn::Rates;
use turn_sums::Turning;

findings::tuning! {
    /// A gyroscope that misses gravity by more than this after its fit is looked at from the readings on, rad.
    LOST: f64 = 0.035;

    /// Most turns: of more, every second, third, … one is looked at.
    MOST_TURNS: usize = 300;
    /// Most samples of the turns, likewise.
    MOST_SAMPLES: usize = 3_000_000;
}

/// Finds changes part of the way through a recording: a bias, a scale factor, a sign, two columns, a clock; and single
/// turns and static intervals that miss gravity. `gyroscope` is the matrix that it was calibrated with and the angle by
/// which it then misses gravity, rad; without it the turns are not looked at.
///
/// # Examples
/// ```
/// use stillpoint_estimate::calibrate::changes_part_way;
/// use recording::intervals::{Segmentation, Span};
/// use simulate::Spec;
///
/// let recording = Spec::hand_held(1).run()?.recording;
/// let rests = [Span { from: 0.0, to: 10.0 }];
/// let segmentation = Segmentation::from_spans(&recording, &rests, 10.0);
/// assert!(changes_part_way(&recording, &segmentation, 9.80665, None).is_empty());
/// # Ok::<(), recording::Error>(())
/// ```
pub fn changes_part_way(
    recording: &Recording,
    segmentation: &Segmentation,
    gravity: f64,
    gyroscope: Option<(Matrix3<f64>, f64)>,
) -> Vec<Finding> {
    let found = changes(recording, segmentation, gravity, gyroscope);
    let named = found
        .iter()
        .map(|change| change.finding().in_recording(&recording.name));
    named.collect()
}

fn changes(
    recording: &Recording,
    segmentation: &Segmentation,
    gravity: f64,
    gyroscope: Option<(Matrix3<f64>, f64)>,
) -> Vec<Change> {
    let rests = &segmentation.statics;
    let mut found = Vec::new();
    let Some(force) = force::force(rests, gravity) else {
        return rate::steps(rests);
    };
    found.extend(force.change);
    let mut is_read_otherwise = is_reflected(&found);
    let turns = turnings(recording, segmentation, &force.directions);
    if let Some((t, missed)) = gyroscope {
        let start = if missed > LOST.get() {
            let unit = mirrored::unit(&turns, t.determinant().abs().cbrt());
            Matrix3::from_diagonal_element(unit)
        } else {
            t
        };
        // Directions by a base that was fitted to both parts may be worse than those as read.
        let as_read = || {
            let directions = rests
                .iter()
                .map(|r| Some(r.accelerometer?.mean.normalize()));
            let turns = turnings(recording, segmentation, &directions.collect::<Vec<_>>());
            mirrored::change(&turns, &start)
        };
        let by_turns = || mirrored::change(&turns, &start).or_else(as_read);
        let lost = missed > LOST.get() && !is_read_otherwise;
        let reflected = lost.then(by_turns).flatten();
        is_read_otherwise |= reflected.is_some();
        match reflected {
            Some(change) => found.push(change),
            None => found.extend(turns::changes(&turns, &start)),
        }
    }
    // A bias that steps because its column does, or the unit, is no other finding.
    if !is_read_otherwise {
        found.extend(rate::steps(rests));
    }
    // Nor is a turn or a static interval that something changes in.
    let changed: Vec<Place> = found
        .iter()
        .filter(|c| !c.kind.is_single())
        .map(|c| c.place)
        .collect();
    found.retain(|c| {
        let inside = |p: &Place| c.place.after.1 >= p.after.1 && c.place.before.1 <= p.before.1;
        !c.kind.is_single() || !changed.iter().any(inside)
    });
    found
}

fn is_reflected(found: &[Change]) -> bool {
    found
        .iter()
        .any(|c| matches!(c.kind, Kind::Flipped(..) | Kind::Swapped(..)))
}

/// The sound turns between static intervals whose directions are known, or as many of them as the budget allows, evenly
/// over the recording.
fn turnings<'a>(
    recording: &'a Recording,
    segmentation: &Segmentation,
    directions: &[Option<Vector3<f64>>],
) -> Vec<Turning<'a>> {
    let Some(stream) = recording.gyroscope.as_ref() else {
        return Vec::new();
    };
    let statics = &segmentation.statics;
    let sound = || segmentation.turns.iter().filter(|t| t.fault.is_none());
    let samples: usize = sound().map(|turn| turn.samples.len()).sum();
    let by_turns = sound().count().div_ceil(MOST_TURNS.get());
    let stride = samples.div_ceil(MOST_SAMPLES.get()).max(by_turns).max(1);
    sound()
        .step_by(stride)
        .filter_map(|turn| {
            let (from, to) = (turn.from, turn.from + 1);
            let [before, after] = [from, to].map(|k| directions.get(k).copied().flatten());
            let [first, second] = [from, to].map(|k| statics.get(k).and_then(|r| r.gyroscope));
            Some(Turning {
                rates: Rates {
                    stream,
                    samples: turn.samples.clone(),
                    bias: 0.5 * (first?.mean + second?.mean),
                },
                before: before?,
                after: after?,
                place: Place {
                    after: (from, turn.span.from),
                    before: (to, turn.span.to),
                },
            })
        })
        .collect()
}
