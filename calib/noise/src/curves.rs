//! Allan curves of whole sensors: three axes, time stamps, gaps.

use nalgebra::Vector3;
use recording::intervals::Span;
use recording::{Recording, Stream};

use super::allan::{AllanAccumulator, AllanCurve};
use super::stillness::{Spreads, Stillness};

/// Samples looked at before the sampling interval is known.
const HEAD: usize = 256;

/// A step longer than this many sampling intervals is a gap.
const GAP_STEPS: f64 = 1.5;

/// The curves of the three axes of a sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct SensorCurves {
    /// x, y, z.
    pub axes: [AllanCurve; 3],
    /// Gaps that no difference reaches across.
    pub gaps: usize,
}

/// The curves of a recording at rest.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RecordingCurves {
    /// Accelerometer, m/s².
    pub accelerometer: Option<SensorCurves>,
    /// Gyroscope, rad/s.
    pub gyroscope: Option<SensorCurves>,
    /// When the recording was at rest, as the curves assume.
    pub stillness: Stillness,
}

impl RecordingCurves {
    /// Of a recording in memory, or of the stretch `within` of it.
    pub fn of(recording: &Recording, within: Option<Span>) -> Self {
        let mut accumulator = RecordingAccumulator::default();
        let RecordingAccumulator {
            accelerometer,
            gyroscope,
        } = &mut accumulator;
        feed(accelerometer, recording.accelerometer.as_ref(), within);
        feed(gyroscope, recording.gyroscope.as_ref(), within);
        accumulator.finish()
    }
}

fn feed(sensor: &mut SensorAccumulator, stream: Option<&Stream>, within: Option<Span>) {
    let Some(stream) = stream else { return };
    let samples = within.map_or(0..stream.len(), |span| stream.between(span.from, span.to));
    stream.t[samples.clone()]
        .iter()
        .zip(&stream.values[samples])
        .for_each(|(&t, v)| sensor.push(t, *v));
}

/// Both sensors of a recording, sample by sample.
#[derive(Debug, Default)]
pub(super) struct RecordingAccumulator {
    pub(super) accelerometer: SensorAccumulator,
    pub(super) gyroscope: SensorAccumulator,
}

impl RecordingAccumulator {
    /// The curves, and whether they are of a rest.
    pub(super) fn finish(mut self) -> RecordingCurves {
        let sensors = [&mut self.accelerometer, &mut self.gyroscope];
        let stillness = Stillness::of(sensors.map(|sensor| std::mem::take(&mut sensor.spreads)));
        RecordingCurves {
            accelerometer: self.accelerometer.finish(),
            gyroscope: self.gyroscope.finish(),
            stillness,
        }
    }
}

impl SensorCurves {
    /// Of a stream in memory; `None` with fewer than two samples.
    pub fn of(stream: &Stream) -> Option<Self> {
        let mut accumulator = SensorAccumulator::default();
        feed(&mut accumulator, Some(stream), None);
        accumulator.finish()
    }
}

/// Three [`AllanAccumulator`]s behind one clock.
#[derive(Debug, Default)]
pub struct SensorAccumulator {
    axes: [AllanAccumulator; 3],
    spreads: Spreads,
    head: Vec<(f64, Vector3<f64>)>,
    limit: Option<f64>,
    last: Option<f64>,
    time: f64,
    steps: usize,
    gaps: usize,
}

impl SensorAccumulator {
    /// The next sample; stamps ascend.
    pub fn push(&mut self, t: f64, value: Vector3<f64>) {
        self.spreads.push(t, &value);
        match self.limit {
            Some(limit) => self.add(t, value, limit),
            None => {
                self.head.push((t, value));
                if self.head.len() == HEAD {
                    self.settle();
                }
            }
        }
    }

    /// The curves; the sampling interval is the mean step without gaps. `None` with fewer than two
    /// samples.
    pub fn finish(mut self) -> Option<SensorCurves> {
        if self.limit.is_none() {
            self.settle();
        }
        let step = self.time / self.steps as f64;
        (self.steps > 0).then(|| SensorCurves {
            axes: self.axes.map(|axis| axis.finish(step)),
            gaps: self.gaps,
        })
    }

    /// Takes the sampling interval from the samples held back, and lets them through.
    fn settle(&mut self) {
        let head = std::mem::take(&mut self.head);
        let (t, values) = head.iter().copied().unzip();
        let step = Stream { t, values }.median_step().unwrap_or(f64::INFINITY);
        let limit = GAP_STEPS * step;
        self.limit = Some(limit);
        head.into_iter()
            .for_each(|(t, value)| self.add(t, value, limit));
    }

    fn add(&mut self, t: f64, value: Vector3<f64>, limit: f64) {
        if let Some(last) = self.last.replace(t) {
            if t - last > limit {
                self.axes.iter_mut().for_each(AllanAccumulator::gap);
                self.gaps += 1;
            } else {
                self.time += t - last;
                self.steps += 1;
            }
        }
        self.axes
            .iter_mut()
            .zip(value.iter())
            .for_each(|(axis, y)| axis.push(*y));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sampling_interval_is_the_mean_step_without_gaps() {
        let mut t: Vec<f64> = (0..1000).map(|k| f64::from(k) * 0.01).collect();
        t[500..].iter_mut().for_each(|t| *t += 60.0);
        let values = t.iter().map(|t| Vector3::new(t.sin(), 0.0, 1.0)).collect();
        let curves = SensorCurves::of(&Stream { t, values }).unwrap();
        assert_eq!(curves.gaps, 1);
        assert!((curves.axes[0].step - 0.01).abs() < 1e-12);
        assert_eq!(curves.axes[0].samples, 1000);
    }

    #[test]
    fn a_handful_of_samples_has_curves_and_one_sample_has_none() {
        let stream = |n: usize| Stream {
            t: (0..n).map(|k| k as f64).collect(),
            values: vec![Vector3::x(); n],
        };
        assert_eq!(SensorCurves::of(&stream(1)), None);
        assert_eq!(
            SensorCurves::of(&stream(5)).unwrap().axes[1].points.len(),
            2
        );
    }
}
