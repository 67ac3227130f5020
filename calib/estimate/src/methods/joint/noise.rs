//! The noise of one sensor, as the recording itself shows it.

pub(crate) mod bias;
pub(crate) mod centred;
pub(crate) mod chain;
pub(crate) mod exposure;
pub(crate) mod likelihood;
mod long_run;
pub(crate) mod mixed;
pub(crate) mod overstated;
pub(crate) mod rounding;
pub(crate) mod rows;
pub(crate) mod scatter;
pub(crate) mod sequence;
pub(crate) mod stations;
pub(crate) mod walk_filter;
pub(crate) mod walks;
pub(crate) mod weights;

use std::ops::Range;

use nalgebra::Vector3;
use recording::averages::{median, quantile};
use recording::readings::DeadZone;
use recording::{INSTANT, Stream};

use self::long_run::{RESTLESS, long_run, restless_long_run, scatter_within};
use self::scatter::{FLOOR, scatter};
use super::data::mean::Mean;

findings::tuning! {
    /// Longest batches whose means show noise that does not average out, s.
    BATCH: f64 = 1.0;
    /// So many of them a stretch should have.
    BATCHES: f64 = 6.0;

    /// Length of the windows whose variances show how many samples are independent, s.
    WINDOW: f64 = 0.2;

    /// Stretches with more than this many times the variance of the quietest quarter are not quiet, ...
    QUIET: f64 = 1.5;
    /// ... if they exceed it by so many standard errors of a variance: chance lets short ones spread so far.
    QUIET_ERRORS: f64 = 4.0;

    /// The share of the stretches that is quiet in any usable recording: on a table that vibrates now and then, half may shake.
    QUIETEST: f64 = 0.25;

    /// Readings that stay the same within every rest are frozen between steps of more than so many times the floor: smaller
    /// ones are rounding of noise-free readings.
    FROZEN: f64 = 1e3;

    /// Largest distance of a reading from the grid of its converter, in steps.
    OFF_GRID: f64 = 0.05;

    /// A least significant bit beyond this many standard deviations no longer averages out.
    DITHERED: f64 = 2.0;
}

/// Standard deviations per axis, near SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SensorNoise {
    /// Standard deviation of one sample (3).
    pub white: Vector3<f64>,
    /// Standard deviation of long means over what white noise would give; 1 where the noise is not
    /// coloured (3).
    pub long_run: Vector3<f64>,
    /// The same of what restless stretches shake by beyond the quiet ones: less than 1 where it averages out sooner than
    /// white noise, as the hum of a machine does (3).
    pub restless_long_run: Vector3<f64>,
    /// Smallest step between two readings; 0 where they are continuous (3).
    pub step: Vector3<f64>,
    /// Variance by rounding that no number of samples takes off a mean (3).
    pub rounding: Vector3<f64>,
    /// Share of the samples that are as good as independent for a variance: 1 of white normal noise, less where
    /// neighbours agree or tails are heavy (3).
    pub freedom: Vector3<f64>,
    /// Median time between samples, s.
    pub interval: f64,
}

impl SensorNoise {
    /// Measures the noise in stretches of rest: the pooled variance of the quiet ones, how the means of
    /// batches of up to a second spread, and how the variances of short windows do.
    ///
    /// `None` without a stretch of two samples.
    pub fn measure(stream: &Stream, rests: &[Range<usize>]) -> Option<Self> {
        let interval = stream.median_step()?;
        let batch = batch(rests, interval)?;
        let window = samples(WINDOW.get(), interval).max(4);
        let least = stream.least_steps();
        let axes = [0, 1, 2].map(|axis| {
            let parts = parts(stream, rests, axis);
            Axis::measure(&parts, batch, window, least[axis])
        });
        let [x, y, z] = axes;
        let (x, y, z) = (x?, y?, z?);
        Some(Self {
            white: Vector3::new(x.white, y.white, z.white),
            long_run: Vector3::new(x.long_run, y.long_run, z.long_run),
            restless_long_run: Vector3::new(
                x.restless_long_run,
                y.restless_long_run,
                z.restless_long_run,
            ),
            step: Vector3::new(x.step, y.step, z.step),
            rounding: Vector3::new(x.rounding, y.rounding, z.rounding),
            freedom: Vector3::new(x.freedom, y.freedom, z.freedom),
            interval,
        })
    }

    /// The same of a sensor with dead zones, `scale` the unit of its readings: at rest they step by the width of the zone
    /// where they are zero.
    pub(crate) fn with_dead_zones(mut self, zones: [Option<DeadZone>; 3], scale: f64) -> Self {
        for (axis, zone) in zones.into_iter().enumerate() {
            let Some(zone) = zone else { continue };
            let step = 2.0 * zone.edge * scale;
            if zone.hides_the_bias() {
                self.step[axis] = self.step[axis].max(step);
            }
            let error = zone.error_of_mean() * scale;
            self.rounding[axis] = self.rounding[axis].max(error * error);
        }
        self
    }

    /// Variance of readings that flip evenly between two levels; 0 where the noise is wider than a step (3).
    pub fn variance_of_flips(&self) -> Vector3<f64> {
        Vector3::from_fn(|i, _| {
            if self.rounding[i] > 0.0 {
                (0.5 * self.step[i]).powi(2)
            } else {
                0.0
            }
        })
    }

    /// [`SensorNoise::long_run`] alone, averaged over the axes; 1 where it cannot be measured.
    pub fn long_run_of(stream: &Stream, rests: &[Range<usize>]) -> f64 {
        let interval = stream.median_step();
        let Some(batch) = interval.and_then(|interval| batch(rests, interval)) else {
            return 1.0;
        };
        let of = |axis: usize| {
            let parts = parts(stream, rests, axis);
            let quiet = quiet(&parts);
            white(&quiet).map_or(1.0, |white| long_run(&quiet, batch, white))
        };
        [0, 1, 2].map(of).iter().sum::<f64>() / 3.0
    }

    /// Variance of the mean of `count` samples (3).
    pub fn variance_of_mean(&self, count: usize) -> Vector3<f64> {
        Vector3::from_fn(|i, _| {
            let sampled = (self.white[i] * self.long_run[i]).powi(2) / count as f64;
            sampled + self.rounding[i]
        })
    }

    /// The same of a mean whose own samples may scatter more than the quiet ones, as on a table that vibrates: what they
    /// scatter by beyond them is added then, axis by axis.
    pub fn variance_of(&self, mean: &Mean) -> Vector3<f64> {
        self.variance_of_mean(mean.count) + self.restless(mean) / mean.count as f64
    }

    /// Returns the variance of a restless mean's samples beyond the quiet ones, as it counts in a long sum; 0 for a
    /// quiet mean (3).
    pub fn restless(&self, mean: &Mean) -> Vector3<f64> {
        Vector3::from_fn(|i, _| {
            let quiet = self.white[i].powi(2);
            let beyond = mean.variance[i] - quiet;
            if beyond > (RESTLESS.get() - 1.0) * quiet {
                beyond * self.restless_long_run[i].powi(2)
            } else {
                0.0
            }
        })
    }

    /// Variance of a sample as its part in a long sum counts (3). In a turn readings pass many steps, and what rounding
    /// makes of each is independent of the next: `LSB²/12`, which readings at rest do not show where steps are wide.
    pub fn variance_in_sum(&self) -> Vector3<f64> {
        Vector3::from_fn(|i, _| {
            let rounded = if self.rounding[i] > 0.0 {
                self.step[i].powi(2) / 12.0
            } else {
                0.0
            };
            (self.white[i] * self.long_run[i]).powi(2) + rounded
        })
    }
}

struct Axis {
    white: f64,
    long_run: f64,
    restless_long_run: f64,
    step: f64,
    rounding: f64,
    freedom: f64,
}

impl Axis {
    /// `least` is the smallest step of the whole recording: readings that never change at rest show none.
    fn measure(parts: &[Vec<f64>], batch: usize, window: usize, least: f64) -> Option<Self> {
        // What restless parts shake by says nothing of the noise of the others.
        let quiet = quiet(parts);
        let mut white = white(&quiet)?;
        let frozen =
            white <= FLOOR.get() && least.is_finite() && least > FROZEN.get() * FLOOR.get();
        let step = if frozen { least } else { smallest_step(parts) };
        let coarse = step > DITHERED.get() * white;
        if coarse {
            white = rounding::spread(parts, step).max(FLOOR.get());
        }
        let mut long_run = long_run(&quiet, batch, white);
        if coarse {
            // Coarse steps hide how means spread.
            long_run = long_run.max(1.0);
        }
        Some(Self {
            white,
            long_run,
            restless_long_run: restless_long_run(parts, batch, (white, long_run)),
            step,
            rounding: if coarse {
                rounding::of_means(parts, step, white)
            } else {
                0.0
            },
            freedom: freedom(&quiet, window),
        })
    }
}

/// Samples in a length of time, s.
fn samples(length: f64, interval: f64) -> usize {
    ((length + INSTANT.get()) / interval).round() as usize
}

/// Samples in a batch: [`BATCHES`] in the usual stretch, of [`BATCH`] at most.
fn batch(rests: &[Range<usize>], interval: f64) -> Option<usize> {
    let lengths: Vec<f64> = rests.iter().map(|r| r.len() as f64 * interval).collect();
    let length = (median(lengths)? / BATCHES.get()).min(BATCH.get());
    Some(samples(length, interval).max(1))
}

/// The readings of an axis in each stretch that has two.
fn parts(stream: &Stream, rests: &[Range<usize>], axis: usize) -> Vec<Vec<f64>> {
    let of = |r: &Range<usize>| stream.values[r.clone()].iter().map(|v| v[axis]).collect();
    rests
        .iter()
        .map(of)
        .filter(|part: &Vec<f64>| part.len() > 1)
        .collect()
}

/// The quiet among the stretches.
fn quiet(parts: &[Vec<f64>]) -> Vec<&[f64]> {
    let scatters: Vec<(f64, f64)> = parts.iter().map(|p| scatter(p)).collect();
    let variances: Vec<f64> = scatters.iter().map(|(s, dof)| s / dof).collect();
    let degrees = median(scatters.iter().map(|(_, dof)| *dof)).unwrap_or(1.0);
    let factor = QUIET
        .get()
        .max(1.0 + QUIET_ERRORS.get() * (2.0 / degrees).sqrt());
    let most = factor * quantile(&variances, QUIETEST.get()).unwrap_or(0.0);
    let own = parts.iter().zip(&variances);
    own.filter(|(_, variance)| **variance <= most)
        .map(|(part, _)| part.as_slice())
        .collect()
}

/// Standard deviation of a sample in these stretches.
fn white(quiet: &[&[f64]]) -> Option<f64> {
    let (sum, dof) = scatter_within(quiet);
    (dof > 0.0).then(|| f64::max((sum / dof).sqrt(), FLOOR.get()))
}

/// Share of the samples that are independent, by how the variances of windows of `window` samples spread: with
/// `ν` degrees of freedom their cube root spreads by `√(2/9ν)` of its middle (Wilson and Hilferty 1931).
/// The lower half decides, as touches lie in the upper.
fn freedom(parts: &[&[f64]], window: usize) -> f64 {
    let mut roots: Vec<f64> = parts
        .iter()
        .flat_map(|part| part.chunks_exact(window))
        .map(|w| scatter(w).0.cbrt())
        .collect();
    roots.sort_by(f64::total_cmp);
    let at = |share: f64| roots.get((share * roots.len() as f64) as usize).copied();
    let (Some(low), Some(middle)) = (at(0.158_655), at(0.5)) else {
        return 1.0;
    };
    let spread = (middle - low) / middle;
    if spread > 0.0 {
        (2.0 / (9.0 * spread * spread) / (window - 1) as f64).clamp(1.0 / window as f64, 1.0)
    } else {
        1.0
    }
}

/// The step of a converter: the smallest difference between two readings that differ, where readings
/// repeat and all lie on the grid it makes; 0 elsewhere.
fn smallest_step(parts: &[Vec<f64>]) -> f64 {
    let mut all: Vec<f64> = parts.iter().flatten().copied().collect();
    all.sort_by(f64::total_cmp);
    let count = all.len();
    all.dedup();
    let gaps = all.windows(2).map(|w| w[1] - w[0]);
    let step = gaps.fold(f64::INFINITY, f64::min);
    let Some(first) = all.first() else { return 0.0 };
    let on_grid = |v: &f64| {
        let steps = (v - first) / step;
        (steps - steps.round()).abs() < OFF_GRID.get()
    };
    let repeats = 2 * all.len() <= count;
    if all.len() > 1 && repeats && all.iter().all(on_grid) {
        step
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use simulate::Spec;

    use super::*;

    fn measured(spec: &Spec) -> SensorNoise {
        let stream = spec.run().unwrap().recording.accelerometer.unwrap();
        let rests: Vec<_> = (0..stream.len() / 800)
            .map(|k| 800 * k..800 * (k + 1))
            .collect();
        SensorNoise::measure(&stream, &rests).unwrap()
    }

    fn at_placements(spec: &Spec) -> SensorNoise {
        let simulation = simulate::Simulation::new(spec).unwrap();
        let stream = simulation.run().unwrap().recording.accelerometer.unwrap();
        let rests = simulation.placements().into_iter();
        let rests: Vec<_> = rests
            .map(|(from, to)| stream.between(from + 0.5, to - 0.5))
            .collect();
        SensorNoise::measure(&stream, &rests).unwrap()
    }

    #[test]
    fn white_noise_is_measured_and_not_called_coloured() {
        let noise = measured(&Spec::still(1, 240.0));
        for axis in 0..3 {
            // 2e-3 m/s²/√Hz at 100 Hz; 24000 samples leave 0.5 %, four of them.
            assert!((noise.white[axis] / 0.02 - 1.0).abs() < 0.02);
            assert_eq!(noise.long_run[axis], 1.0);
            assert_eq!(noise.step[axis], 0.0);
        }
    }

    #[test]
    fn the_long_run_of_coloured_noise_is_that_of_its_density_at_low_frequency() {
        // White noise of the same density at low frequency has 0.02 m/s² per sample.
        let changes: [&dyn Fn(&mut Spec); 3] = [
            &|s| s.accelerometer.low_pass = Some(20.0),
            &|s| s.accelerometer.low_pass = Some(5.0),
            &|s| s.accelerometer.correlation = 0.9,
        ];
        for change in changes {
            let mut spec = Spec::still(1, 480.0);
            change(&mut spec);
            let noise = measured(&spec);
            for axis in 0..3 {
                let sum = noise.white[axis] * noise.long_run[axis] / 0.02;
                // 420 degrees of freedom: 3.5 %; batches of a second miss 5 % of the slowest.
                assert!((sum - 1.0).abs() < 0.15, "{sum}");
            }
        }
    }

    #[test]
    fn heavy_tails_and_neighbours_that_agree_leave_fewer_independent_samples() {
        let of = |change: &dyn Fn(&mut Spec)| {
            let mut spec = Spec::still(1, 240.0);
            change(&mut spec);
            measured(&spec).freedom.mean()
        };
        assert!(of(&|_| {}) > 0.85);
        // The kurtosis of 6 makes 2/5 of a normal sample of each.
        let laplace = of(&|s| {
            s.accelerometer.distribution = simulate::Distribution::Laplace;
        });
        assert!((0.25..0.6).contains(&laplace), "{laplace}");
        assert!(of(&|s| s.accelerometer.correlation = 0.9) < 0.5);
    }

    #[test]
    fn a_tremor_averages_out_over_its_periods() {
        let mut spec = Spec::still(1, 240.0);
        spec.unsteady = Some(simulate::Unsteady {
            tremor: 5e-3,
            share: 1.0,
            ..simulate::Unsteady::default()
        });
        let stream = spec.run().unwrap().recording.gyroscope.unwrap();
        let rests: Vec<_> = (0..stream.len() / 800)
            .map(|k| 800 * k..800 * (k + 1))
            .collect();
        let noise = SensorNoise::measure(&stream, &rests).unwrap();
        assert!(noise.long_run.max() < 0.5, "{noise:?}");
    }

    #[test]
    fn the_hum_of_a_machine_averages_out_over_its_periods_and_white_vibration_does_not() {
        let of = |frequency: Option<f64>| {
            let mut spec = Spec::hand_held(1);
            spec.vibration = Some(simulate::Vibration {
                rms: 0.2,
                frequency,
                ..simulate::Vibration::default()
            });
            at_placements(&spec).restless_long_run
        };
        let hum = of(Some(23.0));
        assert!(hum.max() < 0.3, "{hum}");
        assert!(of(None).min() >= 1.0, "{}", of(None));
    }

    #[test]
    fn where_half_of_the_placements_vibrate_the_noise_is_that_of_the_others() {
        // Of this session the placement of median variance vibrates.
        let mut spec = Spec::hand_held(2);
        for rms in [0.05, 0.4] {
            spec.vibration = Some(simulate::Vibration {
                rms,
                ..simulate::Vibration::default()
            });
            let noise = at_placements(&spec);
            // 0.02 m/s² a sample, white.
            assert!(noise.white.max() < 0.022, "{}", noise.white);
            assert_eq!(noise.long_run, Vector3::repeat(1.0));
            // It was .05. A thousand windows tell it to a tenth.
            assert!(noise.freedom.min() > 0.7, "{}", noise.freedom);
        }
    }

    #[test]
    fn flicker_noise_is_coloured() {
        let mut spec = Spec::still(1, 240.0);
        spec.accelerometer.instability = 1e-2;
        assert!(measured(&spec).long_run.min() > 1.2);
    }

    #[test]
    fn steps_wider_than_the_noise_do_not_average_out() {
        let mut spec = Spec::still(1, 240.0);
        spec.accelerometer.step = 0.1;
        let noise = measured(&spec);
        assert!((noise.step - Vector3::repeat(0.1)).norm() < 1e-12);
        assert!(noise.variance_of_mean(1_000_000).min() > 0.09f64.powi(2) / 12.0);
    }

    #[test]
    fn a_noise_free_recording_keeps_a_positive_weight() {
        let noise = measured(&Spec::still(1, 60.0).noise_free());
        assert!(noise.white.min() > 0.0 && noise.white.max() < 1e-8);
    }
}
