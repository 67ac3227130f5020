//! Allan curves of whole sensors: three axes, time stamps, gaps.

use nalgebra::Vector3;
use recording::intervals::Span;
use recording::{AccelUnit, GyroUnit, Recording, Stream, bursts};
use sensor::Sensor;

use super::allan::{AllanAccumulator, AllanCurve};
use super::samples::changes::{Drift, Step, drift, steps};
use super::samples::coarse::Coarse;
use super::samples::held::{Held, Repeats};
use super::samples::lost::{Piece, Regular};
use super::samples::outliers::{Outliers, WithoutOutliers};
use super::samples::stillness::{Spreads, Stillness};

/// The curves of the three axes of a sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct SensorCurves {
    /// x, y, z; samples that were bridged count.
    pub axes: [AllanCurve; 3],
    /// Gaps that no difference reaches across.
    pub gaps: usize,
    /// Single samples and short stretches that are missing, bridged by straight lines; samples.
    pub bridged: usize,
    /// Single samples far from their neighbours, which are left out.
    pub outliers: Outliers,
    /// By axis, steps of the readings that are wider than their noise.
    pub coarse: [Option<Coarse>; 3],
    /// Steps of the mean, by axis; none where a step of the readings explains them.
    pub steps: [Vec<Step>; 3],
    /// Drift of the mean, by axis, where it has no steps.
    pub drift: [Option<Drift>; 3],
    /// Readings that repeat the one before.
    pub held: Held,
    /// From the first sample to the last, s.
    pub covered: Span,
    /// True if the readings are counts, false if they are in SI units.
    pub in_counts: bool,
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
    /// Computes the curves of a recording in memory, or of the stretch `within` of it; stamps that come in bursts are brought to an even
    /// clock.
    pub fn of(recording: &Recording, within: Option<Span>) -> Self {
        let mut accumulator = RecordingAccumulator::default();
        let RecordingAccumulator {
            accelerometer,
            gyroscope,
        } = &mut accumulator;
        feed(accelerometer, recording.accelerometer.as_ref(), within);
        feed(gyroscope, recording.gyroscope.as_ref(), within);
        let mut curves = accumulator.finish();
        for described in &recording.description.sensors {
            let (own, counts) = match described.sensor {
                Sensor::Accelerometer => (&mut curves.accelerometer, AccelUnit::Counts.name()),
                Sensor::Gyroscope => (&mut curves.gyroscope, GyroUnit::Counts.name()),
                Sensor::Magnetometer => continue,
            };
            if let Some(own) = own {
                own.in_counts = described.unit == counts;
            }
        }
        curves
    }
}

fn feed(sensor: &mut SensorAccumulator, stream: Option<&Stream>, within: Option<Span>) {
    let Some(stream) = stream else { return };
    let samples = within.map_or(0..stream.len(), |span| stream.between(span.from, span.to));
    let even = bursts(&stream.t).map(|found| found.even);
    even.as_ref().unwrap_or(&stream.t)[samples.clone()]
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
        let force = self.accelerometer.spreads();
        let moving = force.never_rest().then(|| force.covered()).flatten();
        let sensors = [&mut self.accelerometer, &mut self.gyroscope];
        let stillness = match moving {
            Some(whole) => Stillness::nowhere(whole),
            None => Stillness::of(sensors.map(|sensor| sensor.spreads().clone())),
        };
        RecordingCurves {
            accelerometer: self.accelerometer.finish(),
            gyroscope: self.gyroscope.finish(),
            stillness,
        }
    }
}

impl SensorCurves {
    /// Computes the curves of a stream in memory; `None` with fewer than two samples.
    pub fn of(stream: &Stream) -> Option<Self> {
        let mut accumulator = SensorAccumulator::default();
        feed(&mut accumulator, Some(stream), None);
        accumulator.finish()
    }
}

/// Three [`AllanAccumulator`]s behind one clock, fed without outliers.
#[derive(Debug, Default)]
pub struct SensorAccumulator {
    without_outliers: WithoutOutliers,
    cleaned: Cleaned,
}

impl SensorAccumulator {
    /// The next sample; stamps ascend.
    pub fn push(&mut self, t: f64, value: Vector3<f64>) {
        let cleaned = &mut self.cleaned;
        let mut out = |t: f64, value: Vector3<f64>| cleaned.push(t, value);
        self.without_outliers.push(t, value, &mut out);
    }

    /// The curves; the sampling interval is the mean step without gaps. `None` with fewer than two
    /// samples.
    pub fn finish(mut self) -> Option<SensorCurves> {
        self.end();
        let outliers = self.without_outliers.found().clone();
        self.cleaned.finish(outliers)
    }

    /// The spreads of all samples.
    fn spreads(&mut self) -> &Spreads {
        self.end();
        &self.cleaned.spreads
    }

    /// Hands on the samples that are not judged yet.
    fn end(&mut self) {
        let cleaned = &mut self.cleaned;
        let mut out = |t: f64, value: Vector3<f64>| cleaned.push(t, value);
        self.without_outliers.finish(&mut out);
    }
}

/// The curves of samples that are no outliers.
#[derive(Debug, Default)]
struct Cleaned {
    regular: Regular,
    sums: Sums,
    spreads: Spreads,
    repeats: Repeats,
}

/// Sums over evenly spaced samples, piece by piece.
#[derive(Debug, Default)]
struct Sums {
    axes: [AllanAccumulator; 3],
    gaps: usize,
    bridged: usize,
}

impl Sums {
    fn add(&mut self, piece: Piece) {
        let value = match piece {
            Piece::Read(value) => value,
            Piece::Bridge(value) => {
                self.bridged += 1;
                value
            }
            Piece::Gap => {
                self.axes.iter_mut().for_each(AllanAccumulator::gap);
                self.gaps += 1;
                return;
            }
        };
        let axes = self.axes.iter_mut().zip(value.iter());
        axes.for_each(|(axis, y)| axis.push(*y));
    }
}

impl Cleaned {
    fn push(&mut self, t: f64, value: Vector3<f64>) {
        self.spreads.push(t, &value);
        self.repeats.push(t, &value);
        let sums = &mut self.sums;
        self.regular.push(t, value, &mut |piece| sums.add(piece));
    }

    fn finish(mut self, outliers: Outliers) -> Option<SensorCurves> {
        let sums = &mut self.sums;
        let step = self.regular.finish(&mut |piece| sums.add(piece))?;
        let covered = self.spreads.covered()?;
        let coarse = self.spreads.coarse();
        let means = self.spreads.means();
        // What is smaller than a step of the readings may be the step.
        let is_seen = |k: usize, size: f64| coarse[k].is_none_or(|coarse| size.abs() > coarse.step);
        let steps: [Vec<Step>; 3] = std::array::from_fn(|k| {
            let all = steps(&means[k]).into_iter();
            all.filter(|step| is_seen(k, step.size)).collect()
        });
        let drift = std::array::from_fn(|k| {
            let is_steady = steps[k].is_empty();
            let drift = is_steady.then(|| drift(&means[k])).flatten();
            drift.filter(|drift| is_seen(k, drift.change))
        });
        // Readings of three coarse axes repeat for as long as nothing reaches the next step.
        let held = match coarse.iter().all(Option::is_some) {
            true => Held::default(),
            false => self.repeats.held(),
        };
        Some(SensorCurves {
            axes: self.sums.axes.map(|axis| axis.finish(step)),
            gaps: self.sums.gaps,
            bridged: self.sums.bridged,
            outliers,
            coarse,
            steps,
            drift,
            held,
            covered,
            in_counts: false,
        })
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

    /// A number between 0 and 1 for every place, as if by chance.
    fn by_chance(k: usize) -> f64 {
        let z = (k as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        let z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    #[test]
    fn samples_lost_singly_leave_the_curve_as_it_was() {
        let stream = |is_lost: &dyn Fn(usize) -> bool| {
            let kept: Vec<usize> = (0..40_000).filter(|&k| !is_lost(k)).collect();
            Stream {
                t: kept.iter().map(|&k| k as f64 * 0.01).collect(),
                values: kept
                    .iter()
                    .map(|&k| Vector3::repeat(by_chance(k)))
                    .collect(),
            }
        };
        let whole = SensorCurves::of(&stream(&|_| false)).unwrap();
        let lossy = SensorCurves::of(&stream(&|k| k % 1999 == 1000)).unwrap();
        assert_eq!((lossy.gaps, lossy.bridged), (0, 20));
        let pairs = whole.axes[0].points.iter().zip(&lossy.axes[0].points);
        for (a, b) in pairs.filter(|(a, _)| a.factor < 2500) {
            assert!((b.deviation / a.deviation - 1.0).abs() < 0.1, "{a:?} {b:?}");
        }
        assert_eq!(whole.axes[0].points.len(), lossy.axes[0].points.len());
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
