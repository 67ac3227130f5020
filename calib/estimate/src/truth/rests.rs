//! Kinematics of static intervals: their history and their vibration.

use effects::covariates::{last_changes, vibrations};
use nalgebra::Vector3;
use recording::intervals::{Moments, Segmentation, Span, StaticInterval, Turn};
use recording::{Recording, Stream};
use sensor::{Kinematics, Sensor, Since};

use super::sensing::{Models, Sensing};
use super::supposed::unneeded;
use super::thermal::Thermal;

/// A static interval and the truth in it.
#[derive(Clone, Copy, Debug)]
pub(super) struct KnownRest {
    pub span: Span,
    pub known: Kinematics<f64>,
    /// When the turn before it ended, s.
    pub turned: f64,
}

findings::tuning! {
    /// A device turns as long as its rate is beyond this, rad/s, ...
    TURNING: f64 = 0.02;
    /// ... and beyond so many times what the interval after it scatters.
    OF_SCATTER: f64 = 5.0;

    /// Rounds at most in which a change of force is judged with the errors that its own sign makes taken off.
    ROUNDS: usize = 5;
}

/// All of a recording that begins at `start`.
pub(super) fn of(
    recording: &Recording,
    segmentation: &Segmentation,
    models: &Models,
    thermal: &Thermal,
) -> Vec<KnownRest> {
    let start = recording.start();
    let statics = &segmentation.statics;
    let sensing = models.accelerometer.as_ref();
    let shaking = shaking(statics.iter().map(|rest| rest.accelerometer), sensing);
    let known = |(rest, vibration): (&StaticInterval, Vector3<f64>)| {
        let [temperature_rate, warming] = thermal.over(rest.span.from, rest.span.to);
        let mut known = Kinematics {
            time: 0.5 * (rest.span.from + rest.span.to) - start,
            vibration,
            temperature_rate,
            warming,
            ..unneeded()
        };
        known.temperature = rest.temperature.unwrap_or(known.temperature);
        KnownRest {
            span: rest.span,
            known,
            turned: rest.span.from,
        }
    };
    let mut rests: Vec<KnownRest> = statics.iter().zip(shaking).map(known).collect();
    give_last_turns(&mut rests, recording, segmentation, models);
    if let Some(sensing) = sensing {
        give_forces(&mut rests, statics, sensing);
    }
    rests
}

/// The specific force of every interval, with all else that is known of it, and where it came from.
fn give_forces(rests: &mut [KnownRest], statics: &[StaticInterval], sensing: &Sensing) {
    for _ in 0..ROUNDS.get() {
        let mut last = Vector3::zeros();
        for (own, rest) in rests.iter_mut().zip(statics) {
            if let Some(mean) = rest.accelerometer {
                last = sensing.correct(&sensing.unit.to_si(&mean.mean), &own.known);
            }
            own.known.specific_force = last;
        }
        let forces: Vec<Vector3<f64>> = rests.iter().map(|r| r.known.specific_force).collect();
        let mut settled = true;
        for (own, sign) in rests.iter_mut().zip(last_changes(&forces)) {
            settled &= own.known.last_change == sign;
            own.known.last_change = sign;
        }
        if settled {
            break;
        }
    }
}

/// Sets the last turn of every interval: the rotation vector (rad) of the turn that ended with it, or of the last one
/// before.
///
/// The sum of the readings less what the gyroscope reads in the interval before: its own bias is gone, and a model of it is
/// not needed.
fn give_last_turns(
    rests: &mut [KnownRest],
    recording: &Recording,
    segmentation: &Segmentation,
    models: &Models,
) {
    let Some(stream) = &recording.gyroscope else {
        return;
    };
    for turn in &segmentation.turns {
        let before = segmentation.statics.get(turn.from);
        let still = before.and_then(|rest| rest.gyroscope);
        let Some((rest, still)) = rests.get_mut(turn.from + 1).zip(still) else {
            continue;
        };
        let rates = Rates {
            stream,
            sensing: models.get(Sensor::Gyroscope),
            still,
        };
        rest.known.last_turn = rates.rotation(turn);
        rest.turned = rates.ended(turn).unwrap_or(rest.span.from);
    }
    let mut last = Vector3::zeros();
    for rest in rests {
        if rest.known.last_turn == Vector3::zeros() {
            rest.known.last_turn = last;
        }
        last = rest.known.last_turn;
        rest.known.since_turn = Since {
            from: rest.span.from - rest.turned,
            to: rest.span.to - rest.turned,
        };
    }
}

/// The rates of a turn, less what the gyroscope reads in the interval before it.
struct Rates<'a> {
    stream: &'a Stream,
    sensing: Option<&'a Sensing>,
    still: Moments,
}

impl Rates<'_> {
    /// At sample `k`, rad/s.
    fn at(&self, k: usize) -> Vector3<f64> {
        self.in_si(&(self.stream.values[k] - self.still.mean))
    }

    /// A difference of readings, or a sum of such: the bias and the zero of the unit are gone, a matrix is left.
    fn in_si(&self, raw: &Vector3<f64>) -> Vector3<f64> {
        self.sensing.map_or(*raw, |sensing| sensing.slope(raw))
    }

    /// `Σ w Δt` over a turn, rad.
    fn rotation(&self, turn: &Turn) -> Vector3<f64> {
        let (t, values) = (&self.stream.t, &self.stream.values);
        let pairs = turn.samples.clone().zip(turn.samples.clone().skip(1));
        let twice_still = self.still.mean * 2.0;
        let sum = pairs
            .map(|(a, b)| (values[a] + values[b] - twice_still) * (0.5 * (t[b] - t[a])))
            .sum();
        self.in_si(&sum)
    }

    /// When a turn ends: the last sample that turns.
    fn ended(&self, turn: &Turn) -> Option<f64> {
        let scatter = self.still.covariance.trace().max(0.0).sqrt();
        let scale = self.sensing.map_or(1.0, |s| s.unit.scale.abs());
        let least = TURNING.get().max(OF_SCATTER.get() * scatter * scale);
        let last = turn
            .samples
            .clone()
            .rev()
            .find(|&k| self.at(k).norm() > least)?;
        self.stream.t.get(last).copied()
    }
}

/// The static interval that `t` lies in, or the last one before it.
pub(super) fn last_before(rests: &[KnownRest], t: f64) -> Option<&KnownRest> {
    let after = rests.partition_point(|rest| rest.span.from <= t);
    rests.get(after.checked_sub(1)?)
}

/// Mean square of the vibration in every interval, (m/s²)²: zero where there are no samples.
fn shaking(
    moments: impl Iterator<Item = Option<Moments>>,
    sensing: Option<&Sensing>,
) -> Vec<Vector3<f64>> {
    let variance = |m: Option<Moments>| {
        sensing
            .zip(m)
            .map(|(s, m)| s.spread(&m.covariance))
            .unwrap_or_else(|| Vector3::repeat(f64::INFINITY))
    };
    let variances: Vec<Vector3<f64>> = moments.map(variance).collect();
    let finite = |v: f64| if v.is_finite() { v } else { 0.0 };
    vibrations(&variances)
        .into_iter()
        .map(|v| v.map(finite))
        .collect()
}
