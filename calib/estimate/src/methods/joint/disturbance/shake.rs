//! Touches: short windows of a rest that shake more than the rest of the recording.

use nalgebra::Vector3;
use recording::averages::quantile;
use recording::intervals::Span;
use recording::{INSTANT, Stream};
use statrs::function::erf::erfc;

use crate::methods::joint::noise::scatter::FLOOR;

findings::tuning! {
    /// Length of a window, s.
    WINDOW: f64 = 0.25;

    /// Touches are reported where chance would show one in so many recordings.
    CHANCE: f64 = 0.001;

    /// The square of a sample counts as so many times the usual variance at most.
    FAR: f64 = 9.0;

    /// The quantile of windows by which a stretch has a usual variance of its own.
    LOW: f64 = 0.25;
    /// So many windows that takes.
    ENOUGH: usize = 3;

    /// A stretch with so many times the usual variance shakes throughout, and now more and now less: a hand and a machine are no
    /// white noise.
    RESTLESS: f64 = 1.5;

    /// The quantile one standard deviation below the median.
    BELOW: f64 = 0.158_655;

    /// A step between samples longer than this many median steps is a gap.
    GAP_STEPS: f64 = 5.0;
}

/// A window of a stretch that shakes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shake {
    /// The stretch, by its place among those given.
    pub stretch: usize,
    /// When it shakes most, s.
    pub time: f64,
    /// Standard deviation there over the usual.
    pub ratio: f64,
}

/// The stretches of rest with a window that chance does not explain, and its worst window.
///
/// Chance is what the recording shows: the cube root of a window's sum of squares about the mean of its
/// stretch is nearly normal (Wilson and Hilferty 1931), with the median and the lower spread of all windows.
/// So noise that a low pass, a held sample or heavy tails make uneven does not pass for a touch; white noise
/// is the least that is granted. Squares are over the usual variance, the median of all windows, or that of
/// the stretch itself where it shakes throughout, as on a table that vibrates; what such a stretch does by chance is seen in its own
/// windows. `step` is the converter's.
pub fn shakes(stream: &Stream, stretches: &[Span], step: &Vector3<f64>) -> Vec<Shake> {
    let Some(interval) = stream.median_step().filter(|s| *s > 0.0) else {
        return Vec::new();
    };
    let count = (((WINDOW.get() + INSTANT.get()) / interval).round() as usize).max(4);
    let cut: Vec<Stretch<'_>> = stretches
        .iter()
        .map(|span| Stretch::of(stream, *span, count))
        .collect();
    let every: Vec<Vector3<f64>> = cut.iter().flat_map(|s| s.variances.clone()).collect();
    if every.is_empty() {
        return Vec::new();
    }
    let [low, middle] = [LOW.get(), 0.5].map(|share| quantile3(&every, share));
    let least = step.map(|s| (0.25 * s * s).max(FLOOR.get() * FLOOR.get()));
    let least = middle.sup(&least);
    let in_stretch = |(k, stretch): (usize, &Stretch<'_>)| {
        let own = stretch.usual(&low, &middle);
        let windows = stretch.windows(k, count, &own.sup(&least));
        (windows, (0..3).any(|i| own[i] > RESTLESS.get() * least[i]))
    };
    let by_stretch: Vec<(Vec<Window>, bool)> = cut.iter().enumerate().map(in_stretch).collect();
    let windows = || by_stretch.iter().flat_map(|(windows, _)| windows);
    let law = Law::of(windows(), count);
    let laws: Vec<Law> = by_stretch
        .iter()
        .map(|(windows, is_restless)| match is_restless {
            true => law.of_restless(windows, count),
            false => law,
        })
        .collect();
    let mut found: Vec<Shake> = Vec::new();
    for window in windows().filter(|w| laws[w.stretch].is_beyond_chance(w)) {
        let shake = Shake {
            stretch: window.stretch,
            time: window.time,
            ratio: window.ratio,
        };
        match found.iter_mut().find(|f| f.stretch == shake.stretch) {
            Some(known) if known.ratio >= shake.ratio => {}
            Some(known) => *known = shake,
            None => found.push(shake),
        }
    }
    found
}

/// The samples of a stretch in windows.
struct Stretch<'a> {
    values: &'a [Vector3<f64>],
    times: &'a [f64],
    mean: Vector3<f64>,
    /// Mean square of each window, per axis.
    variances: Vec<Vector3<f64>>,
}

impl<'a> Stretch<'a> {
    fn of(stream: &'a Stream, span: Span, count: usize) -> Self {
        let range = stream.between(span.from, span.to);
        let values = &stream.values[range.clone()];
        let mean = values.iter().sum::<Vector3<f64>>() / values.len().max(1) as f64;
        let square = |part: &[Vector3<f64>]| {
            let sum: Vector3<f64> = part.iter().map(|v| (v - mean).map(|d| d * d)).sum();
            sum / count as f64
        };
        Self {
            values,
            times: &stream.t[range],
            mean,
            variances: values.chunks_exact(count).map(square).collect(),
        }
    }

    /// Its own usual variance: its lower quartile against that of all, so that a touch of most of it does
    /// not count as usual.
    fn usual(&self, low: &Vector3<f64>, middle: &Vector3<f64>) -> Vector3<f64> {
        if self.variances.len() < ENOUGH.get() {
            return Vector3::zeros();
        }
        let own = quantile3(&self.variances, LOW.get());
        Vector3::from_fn(|i, _| {
            if low[i] > 0.0 {
                middle[i] * own[i] / low[i]
            } else {
                own[i]
            }
        })
    }

    /// The windows, against the usual variance. The square of a sample counts as [`FAR`] at most: single
    /// samples far off are spikes.
    fn windows(&self, stretch: usize, count: usize, usual: &Vector3<f64>) -> Vec<Window> {
        let of = |(k, part): (usize, &[Vector3<f64>])| {
            let (mut sum, mut whole) = (0.0, 0.0);
            for v in part {
                let squares = (v - self.mean).map(|d| d * d).component_div(usual);
                whole += squares.sum();
                sum += squares.map(|s| s.min(FAR.get())).sum();
            }
            Window {
                stretch,
                time: self.times[k * count + count / 2],
                root: sum.cbrt(),
                ratio: (whole / (3.0 * count as f64)).sqrt(),
            }
        };
        self.values
            .chunks_exact(count)
            .enumerate()
            .map(of)
            .collect()
    }
}

struct Window {
    stretch: usize,
    time: f64,
    /// Cube root of the sum of squares over the usual.
    root: f64,
    ratio: f64,
}

/// Distribution of the cube roots by chance.
#[derive(Clone, Copy)]
struct Law {
    centre: f64,
    spread: f64,
    /// The probability that makes a touch.
    level: f64,
}

impl Law {
    fn of<'a>(windows: impl IntoIterator<Item = &'a Window>, count: usize) -> Self {
        let roots: Vec<f64> = windows.into_iter().map(|w| w.root).collect();
        let of_roots = |share| quantile(&roots, share).unwrap_or(0.0);
        let centre = of_roots(0.5);
        let below = centre - of_roots(BELOW.get());
        let n = 3.0 * count as f64;
        let least = n.cbrt() * (2.0 / (9.0 * n)).sqrt();
        // A quantile of so many windows is itself off by chance.
        let doubt = 1.0 + 2.0 / (roots.len() as f64).sqrt();
        Self {
            centre: centre.max(n.cbrt() * (1.0 - 2.0 / (9.0 * n))),
            spread: doubt * below.max(least),
            level: CHANCE.get() / roots.len() as f64,
        }
    }

    /// Returns the distribution for a stretch that shakes throughout: its own centre and spread, neither less than
    /// those of all stretches.
    fn of_restless(&self, own: &[Window], count: usize) -> Self {
        let own = Self::of(own, count);
        Self {
            centre: own.centre.max(self.centre),
            spread: own.spread.max(self.spread),
            level: self.level,
        }
    }

    fn is_beyond_chance(&self, window: &Window) -> bool {
        let z = (window.root - self.centre) / self.spread;
        0.5 * erfc(z * std::f64::consts::FRAC_1_SQRT_2) < self.level
    }
}

fn quantile3(values: &[Vector3<f64>], share: f64) -> Vector3<f64> {
    Vector3::from_fn(|axis, _| {
        let own: Vec<f64> = values.iter().map(|v| v[axis]).collect();
        quantile(&own, share).unwrap_or(0.0)
    })
}

/// The gaps in each of some rests.
pub fn gaps(stream: &Stream, rests: &[Span]) -> Vec<Vec<Span>> {
    let Some(step) = stream.median_step() else {
        return vec![Vec::new(); rests.len()];
    };
    let of = |rest: &Span| {
        stream.t[stream.between(rest.from, rest.to)]
            .windows(2)
            .filter(|w| w[1] - w[0] > GAP_STEPS.get() * step + INSTANT.get())
            .map(|w| Span {
                from: w[0],
                to: w[1],
            })
            .collect()
    };
    rests.iter().map(of).collect()
}

#[cfg(test)]
mod tests {
    use simulate::Spec;

    use super::*;

    fn eight_seconds(stream: &Stream) -> Vec<Span> {
        let end = stream.t[stream.len() - 1];
        (0..(end / 8.0) as usize)
            .map(|k| Span {
                from: 8.0 * k as f64,
                to: 8.0 * (k + 1) as f64,
            })
            .collect()
    }

    fn still(change: impl Fn(&mut Spec)) -> Stream {
        let mut spec = Spec::still(4, 400.0);
        change(&mut spec);
        spec.run().unwrap().recording.accelerometer.unwrap()
    }

    #[test]
    fn noise_of_any_kind_is_no_touch() {
        use simulate::{Distribution, Resampled, Vibration};
        let conditions: [&dyn Fn(&mut Spec); 6] = [
            &|s| s.accelerometer.low_pass = Some(5.0),
            &|s| s.accelerometer.correlation = 0.9,
            &|s| s.accelerometer.distribution = Distribution::Laplace,
            &|s| s.accelerometer.step = 0.16,
            &|s| {
                s.accelerometer.resampled = Some(Resampled {
                    rate: 50.0,
                    by: simulate::Between::Hold,
                });
            },
            &|s| s.vibration = Some(Vibration::default()),
        ];
        for (k, change) in conditions.into_iter().enumerate() {
            let stream = still(change);
            let step = Vector3::repeat(if k == 3 { 0.16 } else { 0.0 });
            assert_eq!(shakes(&stream, &eight_seconds(&stream), &step), [], "{k}");
        }
    }

    #[test]
    fn a_stretch_that_shakes_throughout_is_no_touch_and_one_that_shakes_in_part_is() {
        let mut stream = still(|_| {});
        let mut shake = |from: usize, to: usize| {
            for k in from..to {
                stream.values[k].x += 0.1 * (k as f64 * 1.1).sin();
            }
        };
        shake(8_000, 8_800);
        shake(16_200, 16_400);
        let found = shakes(&stream, &eight_seconds(&stream), &Vector3::zeros());
        let places: Vec<usize> = found.iter().map(|s| s.stretch).collect();
        assert_eq!(places, [20]);
    }

    #[test]
    fn a_stretch_that_a_hand_shakes_now_more_and_now_less_is_no_touch() {
        let mut stream = still(|_| {});
        // 8 Hz that swells and fades with 1.3 Hz, for the whole of one stretch.
        for k in 8_000..8_800 {
            let t = 0.01 * k as f64;
            let swell = 1.0 + 0.6 * (8.2 * t).sin();
            stream.values[k].y += 0.08 * swell * (50.0 * t).sin();
        }
        let found = shakes(&stream, &eight_seconds(&stream), &Vector3::zeros());
        assert_eq!(found, []);
    }

    #[test]
    fn a_touch_is_found_where_it_was_and_nothing_elsewhere() {
        let mut stream = still(|_| {});
        let stretches = eight_seconds(&stream);
        let none = Vector3::zeros();
        assert_eq!(shakes(&stream, &stretches, &none), []);
        for k in 10_000..10_050 {
            stream.values[k].y += 0.06 * (k as f64 * 0.3).sin();
        }
        let found = shakes(&stream, &stretches, &none);
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].stretch, 12);
        assert!((found[0].time - 100.2).abs() < 0.5);
    }
}
