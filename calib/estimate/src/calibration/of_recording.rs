//! A calibration of several recordings as that of one of them.

use findings::{Finding, Kind};
use std::borrow::Cow;

use recording::Recording;
use recording::intervals::is_of;
use sensor::Sensor;

use super::{Calibration, RecordingBias, Triad};

findings::tuning! {
    /// Biases of two recordings that differ by so many standard errors are not the same.
    DIFFERENT: f64 = 3.0;
}

impl Calibration {
    /// The calibration as it holds for one recording: with the biases of this one, where it was made from it among others; for
    /// any other with those that stand for the device ([`Triad::bias`]).
    pub fn of_recording(&self, recording: &Recording) -> Cow<'_, Self> {
        let triads = Sensor::ALL.into_iter().filter_map(|s| self.triad(s));
        if triads.into_iter().all(|triad| triad.recordings.is_empty()) {
            return Cow::Borrowed(self);
        }
        let own = self.input_of(recording).map(|input| &input.recording);
        let mut alone = self.clone();
        for sensor in Sensor::ALL {
            let Some(triad) = alone.triad_mut(sensor) else {
                continue;
            };
            let found = own.and_then(|own| triad.bias_in(own));
            triad.recordings.clear();
            if let Some(found) = found {
                (triad.bias, triad.bias_std) = (found.bias, found.bias_std);
                triad.bias_time = None;
            }
        }
        Cow::Owned(alone)
    }

    /// The calibration with the biases that stand for the device, whichever recording it is applied to.
    pub(crate) fn with_one_bias(&self) -> Self {
        let mut alone = self.clone();
        for sensor in Sensor::ALL {
            if let Some(triad) = alone.triad_mut(sensor) {
                triad.recordings.clear();
            }
        }
        alone
    }

    /// Warns about a recording that is none of the calibration's own, where the biases differ between these.
    pub fn doubts_biases_of(&self, recording: &Recording) -> Option<Finding> {
        let differ = |sensor: Sensor| {
            let triad = self.triad(sensor)?;
            let most = largest_difference(&triad.recordings)?;
            let unit = triad
                .units
                .as_ref()
                .map_or_else(String::new, |units| format!(" {}", units.reading));
            Some(format!("{} by {most:.2e}{unit}", sensor.name()))
        };
        let differ: Vec<String> = Sensor::ALL.into_iter().filter_map(differ).collect();
        let last = self.provenance.inputs.last()?;
        (!differ.is_empty() && self.was_made_from(recording) == Some(false)).then(|| {
            Finding::of(Kind::BIASES_DIFFER)
                .in_recording(&recording.name)
                .detail("how", differ.join(", "))
                .detail("last", last.recording.clone())
        })
    }
}

impl Triad {
    /// States the bias of every recording. For the device stands their mean, weighed by their errors, or where they differ that of the last.
    pub(crate) fn state_biases(&mut self, recordings: Vec<RecordingBias>) {
        if let Some(common) = mean(&recordings).or_else(|| recordings.last().cloned()) {
            (self.bias, self.bias_std) = (common.bias, common.bias_std);
        }
        self.recordings = recordings;
    }

    /// Returns true if the bias is the mean of those of several recordings.
    pub fn has_mean_bias(&self) -> bool {
        let last = self.recordings.last();
        last.is_some_and(|last| last.bias != self.bias)
    }

    /// The bias that a recording has, where each has its own; of one in parts the mean of theirs, or where these differ that of the last.
    pub fn bias_in(&self, recording: &str) -> Option<RecordingBias> {
        let mut all = self.recordings.iter();
        let whole = all.find(|bias| bias.recording == recording);
        whole.cloned().or_else(|| {
            let parts = self.recordings.iter();
            let parts = parts.filter(|bias| is_of(&bias.recording, recording));
            let parts: Vec<RecordingBias> = parts.cloned().collect();
            mean(&parts).or_else(|| parts.last().cloned())
        })
    }
}

/// The mean of biases that do not differ, weighed by their errors.
fn mean(biases: &[RecordingBias]) -> Option<RecordingBias> {
    let mut mean = biases.last()?.clone();
    if largest_difference(biases).is_some() {
        return None;
    }
    for axis in 0..3 {
        let (mut sum, mut weights) = (0.0, 0.0);
        for own in biases {
            let weight = own.bias_std[axis]?.powi(-2);
            sum += weight * own.bias[axis];
            weights += weight;
        }
        if !weights.is_finite() {
            return None;
        }
        (mean.bias[axis], mean.bias_std[axis]) = (sum / weights, Some(weights.sqrt().recip()));
    }
    Some(mean)
}

/// The largest difference of two recordings on an axis that is more than chance.
fn largest_difference(biases: &[RecordingBias]) -> Option<f64> {
    let pairs = biases
        .iter()
        .enumerate()
        .flat_map(|(k, a)| biases[..k].iter().map(move |b| (a, b)));
    let of_axes = pairs.flat_map(|(a, b)| {
        (0..3).filter_map(move |axis| {
            let change = (a.bias[axis] - b.bias[axis]).abs();
            let std = a.bias_std[axis]?.hypot(b.bias_std[axis]?);
            (change > DIFFERENT.get() * std).then_some(change)
        })
    });
    of_axes.reduce(f64::max)
}
