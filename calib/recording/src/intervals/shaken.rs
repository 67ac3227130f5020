//! Rests on a table that vibrates.

use nalgebra::Vector3;

use super::Moments;
use super::spans::Span;
use crate::averages::median;
use crate::recording::Stream;

findings::tuning! {
    /// Length of the stretches whose means are compared, s.
    STRETCH: f64 = 0.5;

    /// Means of stretches may vary by so many times what independent samples of the same spread would: a hand
    /// that carries the device moves them by far more.
    STEADY: f64 = 4.0;

    /// A machine shakes evenly: the loudest stretch varies by no more than so many times the middle one (variances). A knock does.
    EVEN: f64 = 10.0;
}

/// Selects static intervals on a vibrating table from `turned`, the spans in which the gyroscope shows no motion: none of `quiet`
/// touches them, and the mean of specific force is constant.
pub(super) fn shaken(accelerometer: &Stream, turned: &[Span], quiet: &[Span]) -> Vec<Span> {
    turned
        .iter()
        .copied()
        .filter(|span| !quiet.iter().any(|rest| rest.touches(span)))
        .filter(|&span| is_steady(accelerometer, span))
        .collect()
}

fn is_steady(stream: &Stream, span: Span) -> bool {
    let stretches: Vec<Moments> = (0..span.stretches(STRETCH.get()))
        .filter_map(|k| {
            let from = span.from + STRETCH.get() * k as f64;
            Moments::of(&stream.values[stream.between(from, from + STRETCH.get())])
        })
        .collect();
    let variances = || stretches.iter().map(|m| m.covariance.trace());
    let loudest = variances().fold(0.0, f64::max);
    if median(variances()).is_none_or(|middle| loudest > EVEN.get() * middle) {
        return false;
    }
    let means: Vec<Vector3<f64>> = stretches.iter().map(|m| m.mean).collect();
    let Some(between) = Moments::of(&means).filter(|_| means.len() > 1) else {
        return false;
    };
    let share = (means.len() as f64).recip();
    (0..3).all(|i| {
        let expected = |m: &Moments| m.covariance[(i, i)] / m.count as f64;
        let of_samples = share * stretches.iter().map(expected).sum::<f64>();
        between.covariance[(i, i)] <= STEADY.get() * of_samples
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 100 Hz for twelve seconds: still, from 4 s on shaken at 23 Hz, from 8 s on also carried about.
    fn stream() -> Stream {
        let t: Vec<f64> = (0..1200).map(|k| 0.01 * f64::from(k)).collect();
        let value = |&t: &f64| {
            let shake = if t < 4.0 { 0.01 } else { 0.4 };
            let carried = if t < 8.0 { 0.0 } else { 0.5 * (3.0 * t).sin() };
            let wave = (145.0 * t + 40.0 * (1.7 * t).sin()).sin();
            Vector3::new(shake * wave + carried, 0.02 * wave, 9.8 + shake * wave)
        };
        let values = t.iter().map(value).collect();
        Stream { t, values }
    }

    #[test]
    fn a_table_that_vibrates_is_a_rest_and_a_hand_that_carries_is_none() {
        let span = |from: f64, to: f64| Span { from, to };
        let turned = [span(0.0, 4.0), span(4.0, 8.0), span(8.0, 12.0)];
        let found = shaken(&stream(), &turned, &[span(0.5, 3.5)]);
        assert_eq!(found, [span(4.0, 8.0)]);
    }
}
