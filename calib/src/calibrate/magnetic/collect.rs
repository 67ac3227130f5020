//! Recordings to placements and heading changes.

use nalgebra::{Matrix3, Vector3};
use sensor::attitude::Attitude;
use sensor::{Base, Sensor};

use super::inertial::Inertial;
use crate::averages::median;
use crate::calibrate::noise::long_run;
use crate::calibration::Calibration;
use crate::intervals::{Moments, Segmentation, Turn};
use crate::methods::joint::Channel;
use crate::methods::magnetic::{HeadingChange, Placement, Rest};
use crate::recording::{Recording, Stream};
use crate::truth::{Models, Truth};

/// A mean is not better known than to this share of it, such as where coarse steps hide the noise.
const LEAST_NOISE: f64 = 1e-5;

/// What is measured, of all recordings.
#[derive(Debug, Default)]
pub struct Collected {
    pub placements: Vec<Placement>,
    pub changes: Vec<HeadingChange>,
    /// Density of the walk of the gyroscope's bias, rad/s/√s.
    pub walk: f64,
}

/// Placements and turns of the recordings with a magnetometer, its readings times `unit`.
pub fn collect<'a>(
    recordings: impl Iterator<Item = (&'a Recording, &'a Segmentation)>,
    calibration: &Calibration,
    inertial: &Inertial,
    unit: f64,
) -> Collected {
    let mut collected = Collected::default();
    for (number, (recording, segmentation)) in recordings.enumerate() {
        let Some(field) = &recording.magnetometer else {
            continue;
        };
        let mut models = Models::of(calibration);
        own_biases(&mut models, calibration, &recording.name);
        let source = Source {
            number,
            recording,
            segmentation,
            field: &field.stream,
            unit,
            truth: Truth::as_far_as_known(recording, Some(segmentation), models.clone()),
            models,
            inertial,
            misfit: direction_misfit(calibration),
            colour: long_run(recording.gyroscope.as_ref(), segmentation),
        };
        source.collect(&mut collected);
    }
    collected.walk = walk_of(&collected);
    collected
}

/// How much more the turns scatter than their noise, squared.
fn direction_misfit(calibration: &Calibration) -> f64 {
    let own = calibration.misfit.iter();
    let direction = own.filter(|r| r.channel == Channel::Direction);
    direction.map(|r| r.reduced_chi2).fold(1.0, f64::max)
}

/// The biases that this recording has where each has its own.
fn own_biases(models: &mut Models, calibration: &Calibration, recording: &str) {
    for (sensing, triad) in [
        (&mut models.accelerometer, &calibration.accelerometer),
        (&mut models.gyroscope, &calibration.gyroscope),
    ] {
        let (Some(sensing), Some(triad)) = (sensing, triad) else {
            continue;
        };
        let own = triad
            .recordings
            .iter()
            .find(|own| own.recording == recording);
        if let Some(own) = own {
            sensing.parameters[9..12].copy_from_slice(&own.bias);
        }
    }
}

/// One recording.
struct Source<'a> {
    number: usize,
    recording: &'a Recording,
    segmentation: &'a Segmentation,
    field: &'a Stream,
    unit: f64,
    truth: Truth<'a>,
    models: Models,
    inertial: &'a Inertial,
    /// How much more the turns scatter than their noise, squared.
    misfit: f64,
    /// How much more means of the rate scatter than white noise of the same samples would.
    colour: f64,
}

impl Source<'_> {
    fn collect(&self, collected: &mut Collected) {
        let statics = self.segmentation.statics.iter().enumerate();
        let moments = statics.map(|(k, rest)| {
            let samples = self.field.between(rest.span.from, rest.span.to);
            (k, Moments::of(&self.field.values[samples]))
        });
        let moments: Vec<(usize, Option<Moments>)> = moments.collect();
        let variances = moments.iter().filter_map(|(_, m)| *m);
        let variances = variances
            .filter(|m| m.count > 1)
            .map(|m| m.covariance.trace() / 3.0);
        let Some(variance) = median(variances) else {
            return;
        };
        let coloured = long_run(Some(self.field), self.segmentation);
        let rates = self.rates();
        let first = collected.placements.len();
        let mut interval_before = None;
        for (k, moments) in moments {
            let Some(mut placement) = moments.and_then(|m| self.placement(k, &m)) else {
                continue;
            };
            let count = moments.map_or(1, |m| m.count) as f64;
            let least = LEAST_NOISE * placement.mean.norm();
            placement.noise = ((variance / count).sqrt() * coloured * self.unit).max(least);
            placement.rate = rates[k];
            let place = collected.placements.len();
            collected.placements.push(placement);
            if place > first && interval_before.is_some_and(|before| before + 1 == k) {
                let pair = &collected.placements[place - 1..];
                let turn = self
                    .segmentation
                    .turns
                    .iter()
                    .find(|turn| turn.from + 1 == k);
                let sound = turn.filter(|turn| turn.fault.is_none());
                let change =
                    sound.and_then(|turn| self.change(turn, place - 1, &pair[0], &pair[1]));
                collected.changes.extend(change);
            }
            interval_before = Some(k);
        }
    }

    fn placement(&self, k: usize, field: &Moments) -> Option<Placement> {
        let rest = &self.segmentation.statics[k];
        let accelerometer = self.models.accelerometer.as_ref()?;
        let raw = rest.accelerometer?.mean;
        let known = self.truth.at_rest(k);
        let force = known.specific_force;
        let up = force.try_normalize(0.0)?;
        let base = Base::from_parameters(&accelerometer.parameters);
        let moved = self.inertial.by_error(
            Sensor::Accelerometer,
            &self.recording.name,
            &base.t,
            &(raw - base.bias),
        );
        Some(Placement {
            recording: self.number,
            interval: k,
            span: rest.span,
            mean: field.mean * self.unit,
            noise: 0.0,
            up,
            tilt: moved.iter().map(|by| up.cross(by) / force.norm()).collect(),
            known,
            rate: None,
            is_used: true,
        })
    }

    /// The mean rate of every static interval, corrected.
    fn rates(&self) -> Vec<Option<Rest>> {
        let of = |(k, rest): (usize, &crate::intervals::StaticInterval)| {
            let sensing = self.models.gyroscope.as_ref()?;
            let moments = rest.gyroscope?;
            let scale = Base::from_parameters(&sensing.parameters)
                .t
                .determinant()
                .abs()
                .cbrt();
            Some(Rest {
                mean: sensing.correct(&moments.mean, &self.truth.at_rest(k)),
                noise: (moments.white_of_mean() * self.colour * scale).max(f64::MIN_POSITIVE),
            })
        };
        self.segmentation
            .statics
            .iter()
            .enumerate()
            .map(of)
            .collect()
    }

    /// The rotation about the vertical in a turn from one placement to the next.
    fn change(
        &self,
        turn: &Turn,
        from: usize,
        before: &Placement,
        after: &Placement,
    ) -> Option<HeadingChange> {
        let stream = self.recording.gyroscope.as_ref()?;
        let sensing = self.models.gyroscope.as_ref()?;
        let (rest_before, rest_after) = (before.rate?, after.rate?);
        let (t, raw) = (
            &stream.t[turn.samples.clone()],
            &stream.values[turn.samples.clone()],
        );
        let still = self.still(turn)?;
        let offset = 0.5 * (rest_before.mean + rest_after.mean);
        let rates: Vec<Vector3<f64>> = self
            .truth
            .along(t, raw)
            .iter()
            .map(|known| known.angular_rate - offset)
            .collect();
        let mut attitude = Attitude::identity();
        let (mut by_rate, mut sums) = (Vector3::zeros(), Matrix3::zeros());
        let mut squares = 0.0;
        for k in 0..t.len().checked_sub(1)? {
            let step = t[k + 1] - t[k];
            let up = attitude.into_body(&before.up);
            attitude = attitude.then(&Attitude::exp(&(0.5 * step * (rates[k] + rates[k + 1]))));
            let up = 0.5 * (up + attitude.into_body(&before.up)) * step;
            by_rate += up;
            sums += up * (0.5 * (raw[k] + raw[k + 1]) - still).transpose();
            squares += step * step;
        }
        let scale = Base::from_parameters(&sensing.parameters)
            .t
            .determinant()
            .abs()
            .cbrt();
        let white = scale * self.sample_noise(turn)?;
        Some(HeadingChange {
            from,
            angle: turned(&attitude, before, after)?,
            by_rate,
            by_error: self.inertial.by_difference(Sensor::Gyroscope, &sums),
            noise: (white * white * squares * self.misfit)
                .sqrt()
                .max(f64::MIN_POSITIVE),
        })
    }

    /// Raw mean of the rests on both sides.
    fn still(&self, turn: &Turn) -> Option<Vector3<f64>> {
        let rest = |k: usize| Some(self.segmentation.statics.get(k)?.gyroscope?.mean);
        Some(0.5 * (rest(turn.from)? + rest(turn.from + 1)?))
    }

    /// Standard deviation of an axis of a raw sample, with what its colour adds over a turn.
    fn sample_noise(&self, turn: &Turn) -> Option<f64> {
        let rest = |k: usize| {
            Some(
                self.segmentation
                    .statics
                    .get(k)?
                    .gyroscope?
                    .covariance
                    .trace(),
            )
        };
        let variance = (rest(turn.from)? + rest(turn.from + 1)?) / 6.0;
        Some(variance.sqrt() * self.colour)
    }
}

/// From the reference of one placement to that of the other, about the vertical, rad.
///
/// What the gyroscope misses of gravity's direction is taken off by the shortest rotation: it turns nothing about the
/// vertical.
fn turned(attitude: &Attitude<f64>, before: &Placement, after: &Placement) -> Option<f64> {
    let [from, to] = [before, after].map(Placement::reference);
    let foretold = attitude.into_body(&before.up);
    let axis = attitude.into_body(&from.column(0).into_owned());
    let back = nalgebra::Rotation3::rotation_between(&foretold, &after.up)?;
    let axis = back * axis;
    let (x, y) = (to.column(0), to.column(1));
    // The other's x axis as seen from the carried one: counter-clockwise about up.
    Some((-axis.dot(&y)).atan2(axis.dot(&x)))
}

/// The walk of the rate offsets that their noise does not explain, by moments, rad/s/√s.
fn walk_of(collected: &Collected) -> f64 {
    let (mut square, mut time) = (0.0, 0.0);
    for change in &collected.changes {
        let pair = [change.from, change.from + 1].map(|k| &collected.placements[k]);
        let (Some(before), Some(after)) = (pair[0].rate, pair[1].rate) else {
            continue;
        };
        let moved = (after.mean - before.mean).norm_squared() / 3.0;
        square += moved - before.noise.powi(2) - after.noise.powi(2);
        let middle = |p: &Placement| 0.5 * (p.span.from + p.span.to);
        time += middle(pair[1]) - middle(pair[0]);
    }
    if time > 0.0 {
        (square / time).max(0.0).sqrt()
    } else {
        0.0
    }
}
