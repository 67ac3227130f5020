//! Recordings to placements, and the turns between them.

use recording::Recording;
use recording::averages::median;
use recording::intervals::{Moments, Segmentation};
use recording::readings::Range;
use sensor::{Base, Sensor};

use super::inertial::Inertial;
use super::source::{Collected, Source};
use super::turns::walk_of;
use crate::calibrate::noise::long_run;
use crate::calibration::Calibration;
use crate::methods::joint::Channel;
use crate::methods::magnetic::{Placement, Rest};
use crate::truth::{Models, Truth};

findings::tuning! {
    /// A mean is not better known than to this share of it, such as where coarse steps hide the noise.
    LEAST_NOISE: f64 = 1e-5;
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
        let models = Models::of_recording(calibration, &recording.name);
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

/// Returns the reduced chi-square of the turns' directions, at least 1.
fn direction_misfit(calibration: &Calibration) -> f64 {
    let own = calibration.misfit.iter();
    let direction = own.filter(|r| r.channel == Channel::Direction);
    direction.map(|r| r.reduced_chi2).fold(1.0, f64::max)
}

impl Source<'_> {
    fn collect(&self, collected: &mut Collected) {
        let statics = self.segmentation.statics.iter().enumerate();
        let range = Range::of(&self.field.values);
        let moments = statics.map(|(k, rest)| {
            let samples = self.field.between(rest.span.from, rest.span.to);
            let samples = &self.field.values[samples];
            let whole = range.spoils(samples).is_none();
            (k, whole.then(|| Moments::of(samples)).flatten())
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
            let least = LEAST_NOISE.get() * placement.mean.norm();
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
            part: self.number,
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
        let of = |(k, rest): (usize, &recording::intervals::StaticInterval)| {
            let sensing = self.models.gyroscope.as_ref()?;
            let moments = rest.gyroscope?;
            let scale = Base::from_parameters(&sensing.parameters).scale();
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
}
