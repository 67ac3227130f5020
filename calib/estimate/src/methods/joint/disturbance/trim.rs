//! The part of a rest that no motion leaks into.

use nalgebra::Vector3;
use recording::intervals::Span;
use recording::{Stream, is_before};

findings::tuning! {
    /// Length of the means that are compared with those of the middle, s.
    BATCH: f64 = 0.1;
    /// Longest part of either end that is searched for motion, s.
    ENDS: f64 = 1.5;
    /// The same as a share of the static interval.
    SHARE: f64 = 0.25;
    /// A mean this many standard deviations off is motion.
    OFF: f64 = 4.0;
    /// A stretch that shakes by so many standard deviations more than the middle is the end of a motion.
    SHAKES: f64 = 5.0;
    /// Margin cut off in any case, s: it holds motion that is still smaller than the noise.
    GUARD: f64 = 0.1;
    /// Largest share of the static interval that is cut off either end: some of a short one remains in any case.
    MOST_CUT: f64 = 1.0 / 3.0;
    /// Differences below this share of the reading are rounding.
    ROUNDING: f64 = 1e-12;
    /// The same of the cube root of a variance.
    ROOT_ROUNDING: f64 = 1e-8;
}

/// Cuts off what is not like the middle, in any of the streams.
pub fn quiet_part<'a>(streams: impl Iterator<Item = &'a Stream>, rest: Span) -> Span {
    let mut part = Span {
        from: rest.from + GUARD.get(),
        to: rest.to - GUARD.get(),
    };
    for stream in streams {
        let own = quiet_in(stream, rest);
        part.from = part.from.max(own.from);
        part.to = part.to.min(own.to);
    }
    let most = MOST_CUT.get() * rest.length();
    Span {
        from: part.from.min(rest.from + most),
        to: part.to.max(rest.to - most),
    }
}

fn quiet_in(stream: &Stream, rest: Span) -> Span {
    let ends = ENDS.get().min(SHARE.get() * rest.length());
    let (first, last) = (rest.from + ends, rest.to - ends);
    let batches = batches(stream, rest);
    let middle: Vec<&Batch> = batches
        .iter()
        .filter(|b| !is_before(b.span.from, first) && !is_before(last, b.span.to))
        .collect();
    let means = Usual::of(middle.iter().map(|b| b.mean));
    let roots = Usual::of(middle.iter().map(|b| b.root));
    let moves = |b: &&Batch| {
        (0..3).any(|i| {
            let scale = b.mean[i].abs() + 1.0;
            let off = (b.mean - means.centre)[i].abs()
                > OFF.get() * means.spread[i] + ROUNDING.get() * scale;
            off || (b.root - roots.centre)[i]
                > SHAKES.get() * roots.spread[i] + ROOT_ROUNDING.get() * scale
        })
    };
    let from = batches
        .iter()
        .filter(|b| is_before(b.span.from, first))
        .rfind(moves);
    let to = batches
        .iter()
        .filter(|b| is_before(last, b.span.to))
        .find(moves);
    Span {
        from: from.map_or(rest.from, |b| b.span.to) + GUARD.get(),
        to: to.map_or(rest.to, |b| b.span.from) - GUARD.get(),
    }
}

/// Mean and standard deviation of something over the middle.
struct Usual {
    centre: Vector3<f64>,
    spread: Vector3<f64>,
}

impl Usual {
    fn of(values: impl Iterator<Item = Vector3<f64>>) -> Self {
        let values: Vec<Vector3<f64>> = values.collect();
        let count = values.len() as f64;
        let centre = values.iter().sum::<Vector3<f64>>() / count;
        let squares: Vector3<f64> = values.iter().map(|v| (v - centre).map(|d| d * d)).sum();
        Self {
            centre,
            spread: (squares / (count - 1.0)).map(f64::sqrt),
        }
    }
}

/// A short stretch of samples.
struct Batch {
    span: Span,
    mean: Vector3<f64>,
    /// Cube root of the variance, which is nearly normal for normal noise.
    root: Vector3<f64>,
}

/// The samples of neighbouring stretches.
fn batches(stream: &Stream, rest: Span) -> Vec<Batch> {
    (0..rest.stretches(BATCH.get()))
        .filter_map(|k| {
            let span = Span {
                from: rest.from + k as f64 * BATCH.get(),
                to: rest.from + (k + 1) as f64 * BATCH.get(),
            };
            let samples = &stream.values[stream.between(span.from, span.to)];
            let count = samples.len() as f64;
            let mean = samples.iter().sum::<Vector3<f64>>() / count;
            let squares: Vector3<f64> = samples.iter().map(|v| (v - mean).map(|d| d * d)).sum();
            (!samples.is_empty()).then(|| Batch {
                span,
                mean,
                root: (squares / count).map(f64::cbrt),
            })
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slow_start_of_motion_is_cut_off_and_stillness_kept() {
        let t: Vec<f64> = (0..1000).map(|k| f64::from(k) * 0.01).collect();
        let values = t
            .iter()
            .map(|&t| {
                Vector3::new(
                    0.01 * (t * 3e3).sin() + (t - 9.3).max(0.0).powi(2),
                    0.0,
                    9.8,
                )
            })
            .collect();
        let stream = Stream { t, values };
        let part = quiet_part(
            [&stream].into_iter(),
            Span {
                from: 0.0,
                to: 10.0,
            },
        );
        assert!((0.1..0.5).contains(&part.from), "{part:?}");
        assert!((9.0..9.45).contains(&part.to), "{part:?}");
    }

    #[test]
    fn a_knock_at_the_begin_is_cut_off_and_one_in_the_middle_is_left_to_others() {
        let spec = simulate::Spec::still(7, 30.0);
        let mut stream = spec.run().unwrap().recording.accelerometer.unwrap();
        let rest = Span {
            from: 10.0,
            to: 18.0,
        };
        let before = quiet_part([&stream].into_iter(), rest);
        let mut knock = |at: usize| {
            for k in at..at + 10 {
                stream.values[k].z += 0.3 * (k as f64 * 2.0).sin();
            }
        };
        knock(1_050);
        knock(1_400);
        let after = quiet_part([&stream].into_iter(), rest);
        assert!(before.from < 10.5, "{before:?}");
        assert!((after.from - 10.7).abs() < 1e-9, "{after:?}");
        assert_eq!(before.to, after.to);
    }

    #[test]
    fn a_third_of_a_short_rest_is_left_whatever_its_ends_do() {
        let t: Vec<f64> = (0..100).map(|k| f64::from(k) * 0.01).collect();
        // Motion at both ends of a rest of .6 s: to be sure, .35 s would go at either.
        let beside = |t: f64| (t - 0.5).abs() > 0.13;
        let value = |&t: &f64| Vector3::new(if beside(t) { 30.0 * t } else { 1e-3 * t }, 0.0, 9.8);
        let values = t.iter().map(value).collect();
        let stream = Stream { t, values };
        let rest = Span { from: 0.2, to: 0.8 };
        let part = quiet_part([&stream].into_iter(), rest);
        assert!(part.length() > 0.19, "{part:?}");
        assert!(part.from > rest.from && part.to < rest.to, "{part:?}");
    }
}
