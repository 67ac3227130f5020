//! Static intervals in which the readings swing with one period, as beside a fan or on a boat.

use std::f64::consts::TAU;

use nalgebra::{Complex, Vector3};

use crate::averages::median;
use crate::readings::of_sensor::OfSensor;
use crate::readings::symptom::Symptom;

findings::tuning! {
    /// Length of the pieces that are looked at, s.
    LENGTH: f64 = 6.0;
    /// Fewest pieces that show what is common to all.
    FEWEST: usize = 5;
    /// Most pieces that are looked at.
    MOST: usize = 24;

    /// Lowest frequency that is looked for, Hz: a slower one is drift to a piece.
    SLOWEST: f64 = 0.3;
    /// Highest, Hz: a faster one is a vibration that the mean of an interval does not feel.
    FASTEST: f64 = 5.0;

    /// Steps between frequencies, in `1 / LENGTH`.
    STEP: f64 = 0.25;

    /// Readings are averaged to so many a second first.
    RATE: f64 = 25.0;

    /// A period is evident where its power is so many times the usual one of all frequencies ...
    EVIDENT: f64 = 8.0;
    /// ... and of those beside it.
    STANDS_OUT: f64 = 4.0;

    /// Frequencies beside, as a difference in `1 / LENGTH`: beyond what one period spreads over.
    BESIDE: f64 = 2.5;
}

/// The period with the most power in most static intervals; `None` where none stands out.
pub(in crate::readings) fn found(of: &OfSensor<'_>) -> Option<Symptom> {
    let pieces = pieces(of);
    if pieces.len() < FEWEST.get() {
        return None;
    }
    let frequencies = frequencies(of)?;
    let power = |frequency: f64| {
        let of_piece = |piece: &Vec<Vector3<f64>>| power(piece, frequency / RATE.get());
        median(pieces.iter().map(of_piece)).unwrap_or(0.0)
    };
    let powers: Vec<f64> = frequencies.iter().map(|&f| power(f)).collect();
    let usual = median(powers.iter().copied())?;
    let (best, &highest) = powers
        .iter()
        .enumerate()
        .max_by(|a, b| a.1.total_cmp(b.1))?;
    let apart = (BESIDE.get() / STEP.get()) as usize;
    // At an end of the band the power is that of what lies beyond.
    if best == 0 || best + 1 == powers.len() {
        return None;
    }
    let beside = [best.checked_sub(apart), Some(best + apart)];
    let beside = beside
        .into_iter()
        .filter_map(|place| powers.get(place?))
        .fold(0.0, |a: f64, &b| a.max(b));
    let is_evident = highest > EVIDENT.get() * usual && highest > STANDS_OUT.get() * beside;
    is_evident.then(|| Symptom::Swing {
        sensor: of.sensor,
        period: 1.0 / frequencies[best],
        size: (highest - usual).sqrt(),
    })
}

/// Readings (averaged to [`RATE`]) of pieces of static intervals, spread evenly over those that are long enough.
fn pieces(of: &OfSensor<'_>) -> Vec<Vec<Vector3<f64>>> {
    let spans = of.moments.iter().map(|(k, _)| of.statics[*k].span);
    let starts = spans.flat_map(|span| {
        let count = (span.length() / LENGTH.get()) as usize;
        (0..count).map(move |i| span.from + LENGTH.get() * i as f64)
    });
    let starts: Vec<f64> = starts.collect();
    let every = starts.len().div_ceil(MOST.get()).max(1);
    let bins = (LENGTH.get() * RATE.get()) as usize;
    let piece = |start: f64| -> Option<Vec<Vector3<f64>>> {
        let bin = |k: usize| {
            let from = start + k as f64 / RATE.get();
            let own = &of.stream.values[of.stream.between(from, from + 1.0 / RATE.get())];
            let sum = own.iter().sum::<Vector3<f64>>();
            (!own.is_empty()).then(|| sum / own.len() as f64)
        };
        (0..bins).map(bin).collect()
    };
    starts
        .into_iter()
        .step_by(every)
        .filter_map(piece)
        .collect()
}

/// The frequencies that the samples can show, Hz; `None` where they are too slow.
fn frequencies(of: &OfSensor<'_>) -> Option<Vec<f64>> {
    let rate = of.stream.median_step()?.recip();
    if rate < 1.2 * RATE.get() {
        return None;
    }
    let step = STEP.get() / LENGTH.get();
    let count = ((FASTEST.get() - SLOWEST.get()) / step) as usize;
    Some(
        (0..=count)
            .map(|k| SLOWEST.get() + step * k as f64)
            .collect(),
    )
}

/// The squared amplitude of a swing of `frequency` (per sample), summed over the axes: of readings less their line, under a Hann window.
fn power(values: &[Vector3<f64>], frequency: f64) -> f64 {
    let n = values.len() as f64;
    let middle = 0.5 * (n - 1.0);
    let mean = values.iter().sum::<Vector3<f64>>() / n;
    let spread = n * (n * n - 1.0) / 12.0;
    let moment: Vector3<f64> = values
        .iter()
        .enumerate()
        .map(|(k, v)| v * (k as f64 - middle))
        .sum();
    let slope = moment / spread;
    let turn = Complex::from_polar(1.0, -TAU * frequency);
    let bell = Complex::from_polar(1.0, TAU / (n - 1.0));
    let (mut phase, mut place) = (Complex::new(1.0, 0.0), Complex::new(1.0, 0.0));
    let mut sums = Vector3::from_element(Complex::new(0.0, 0.0));
    let mut weights = 0.0;
    for (k, v) in values.iter().enumerate() {
        let left = v - mean - slope * (k as f64 - middle);
        let weight = 0.5 * (1.0 - place.re);
        weights += weight;
        for axis in 0..3 {
            sums[axis] += phase * (weight * left[axis]);
        }
        phase *= turn;
        place *= bell;
    }
    4.0 * sums.iter().map(Complex::norm_sqr).sum::<f64>() / (weights * weights)
}

#[cfg(test)]
mod tests {
    use sensor::Sensor;

    use super::*;
    use crate::intervals::{Segmentation, Span};
    use crate::recording::Recording;
    use crate::recording::stream::Stream;

    const SAMPLES: f64 = 100.0;

    #[test]
    fn the_amplitude_of_a_swing_is_what_its_power_says() {
        let swing = |k: usize| Vector3::new(0.3, -0.1, 0.0) * (TAU * 0.04 * k as f64 + 1.0).sin();
        let values: Vec<Vector3<f64>> = (0..150).map(swing).collect();
        assert!((power(&values, 0.04).sqrt() - 0.1_f64.sqrt()).abs() < 0.01);
        assert!(power(&values, 0.12) < 1e-4);
    }

    /// What is found in eight rests with noise of 0.02 m/s² beside `more`.
    fn beside_noise(more: impl Fn(f64) -> Vector3<f64>) -> Option<Symptom> {
        let mut state = 1_u64;
        let mut random = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            ((state >> 33) as f64 / f64::from(1_u32 << 31) - 0.5) * 12f64.sqrt()
        };
        let t: Vec<f64> = (0..8_000).map(|k| k as f64 / SAMPLES).collect();
        let mut noise = || Vector3::from_fn(|_, _| 0.02 * random());
        let values = t.iter().map(|t| Vector3::z() * 9.81 + noise() + more(*t));
        let recording = Recording {
            accelerometer: Some(Stream {
                values: values.collect(),
                t,
            }),
            ..Recording::default()
        };
        let span = |k: u32| Span {
            from: 10.0 * f64::from(k) + 1.0,
            to: 10.0 * f64::from(k) + 9.0,
        };
        let spans: Vec<Span> = (0..8).map(span).collect();
        let cut = Segmentation::from_spans(&recording, &spans, 10.0);
        found(&OfSensor::new(Sensor::Accelerometer, &recording, &cut).unwrap())
    }

    #[test]
    fn a_fan_is_found_by_its_period_and_noise_drift_and_a_knock_are_none() {
        let fan = beside_noise(|t| Vector3::x() * 0.02 * (TAU * 1.25 * t).sin());
        let Some(Symptom::Swing { period, size, .. }) = fan else {
            panic!("{fan:?}");
        };
        assert!((period - 0.8).abs() < 0.02 && (size - 0.02).abs() < 0.003);
        assert_eq!(beside_noise(|_| Vector3::zeros()), None);
        assert_eq!(
            beside_noise(|t| Vector3::y() * 1e-2 * (0.3 * t).sin()),
            None
        );
        let knock = |t: f64| if (23.0..23.2).contains(&t) { 3.0 } else { 0.0 };
        assert_eq!(beside_noise(|t| Vector3::x() * knock(t)), None);
    }
}
