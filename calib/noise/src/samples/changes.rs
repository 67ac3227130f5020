//! Changes of the mean within a rest that are no noise: steps, and drift in one direction.

use recording::averages::{NORMAL_OVER_MEDIAN, median};
use recording::intervals::Span;

/// Means on either side of a place that are compared, in blocks.
const WINDOWS: [usize; 5] = [2, 8, 32, 128, 512];

findings::tuning! {
    /// Windows that a record must hold for their usual difference to be known.
    HELD: usize = 16;

    /// A step is larger than so many times the usual difference.
    EVIDENT: f64 = 8.0;

    /// A step happens at once and lasts: nearer to it and farther from it the difference is the same up to this share.
    SAME: f64 = 0.6;
    /// Nearer is this part of the window.
    NEARER: usize = 8;
    /// Farther is so many blocks.
    FARTHER: usize = 16;
    /// A line that explains this share of the squares that a step explains is a slope; of a true step it explains three quarters.
    SLOPE: f64 = 0.9;
}

findings::tuning! {
    /// Steps that are kept.
    KEPT: usize = 20;

    /// Means that the record is divided into where a drift is looked for.
    PARTS: usize = 64;

    /// A curve explains so much of them that no random walk goes so smoothly: one leaves 5 % of its own.
    SMOOTH: f64 = 0.998;

    /// The same where what is left is white, as a random walk never leaves it.
    EXPLAINED: f64 = 0.9;
    /// The neighbours of what is left differ by this share of twice its variance.
    WHITE: f64 = 0.7;

    /// Slow cosines of the differences between parts, in half periods of the record.
    SLOW: usize = 6;
    /// The next ones that these are compared with.
    NEXT: usize = 15;

    /// The slow ones have so many times the power of the next. Of a random walk all have the same: one record of ten thousand has 10.
    MORE_POWER: f64 = 11.0;
}

/// Mean of a block of samples.
pub(crate) type Mean = (Span, f64);

/// A step of the mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// When, s.
    pub t: f64,
    /// By how much, in the unit of the samples.
    pub size: f64,
}

/// A drift of the mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drift {
    /// From when to when, s.
    pub span: Span,
    /// From the first sixteenth to the last, in the unit of the samples.
    pub change: f64,
}

/// Steps of a mean, in order.
///
/// The difference of the means on either side of every place is compared with the usual one, so that white noise, flicker
/// noise and a random walk of any size have their share; a step happens at once and lasts.
pub(crate) fn steps(means: &[Mean]) -> Vec<Step> {
    let mut found: Vec<Step> = Vec::new();
    let prefix = prefix(means);
    for width in WINDOWS
        .into_iter()
        .take_while(|w| HELD.get() * w <= means.len())
    {
        let differences = differences(means, &prefix, width);
        let Some(usual) = median(differences.iter().map(|d| d.1)) else {
            continue;
        };
        let away = differences.iter().map(|d| (d.1 - usual).abs());
        let scale = NORMAL_OVER_MEDIAN * median(away).unwrap_or(0.0);
        let mut evident: Vec<(usize, f64)> = differences
            .into_iter()
            .map(|(k, d)| (k, d - usual))
            .filter(|(_, d)| scale > 0.0 && d.abs() > EVIDENT.get() * scale)
            .collect();
        evident.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
        let reach = 2.0 * width as f64 * (means[1].0.from - means[0].0.from);
        for (k, size) in evident {
            let step = Step {
                t: means[k].0.from,
                size,
            };
            let is_known = found.iter().any(|s| (s.t - step.t).abs() <= reach);
            if !is_known && found.len() < KEPT.get() && is_abrupt(&prefix, k, width, size) {
                found.push(step);
            }
        }
    }
    found.sort_by(|a, b| a.t.total_cmp(&b.t));
    found
}

/// The mean after less the mean before, the block in which a step may lie left out; by the block.
fn differences(means: &[Mean], prefix: &[f64], width: usize) -> Vec<(usize, f64)> {
    let usual = means[means.len() - 1].0.to - means[0].0.from;
    let usual = usual / means.len() as f64;
    let whole = |k: &usize| {
        let lasts = means[k + width].0.to - means[k - width].0.from;
        lasts < 1.5 * usual * (2 * width + 1) as f64
    };
    (width..means.len() - width)
        .filter(whole)
        .map(|k| (k, difference(prefix, k, width)))
        .collect()
}

fn difference(prefix: &[f64], k: usize, width: usize) -> f64 {
    let after = prefix[k + 1 + width] - prefix[k + 1];
    let before = prefix[k] - prefix[k - width];
    (after - before) / width as f64
}

/// Returns true if a step happens within a part of the window, lasts, and is none of the places at which a slope has its luckiest noise.
fn is_abrupt(prefix: &[f64], k: usize, width: usize, size: f64) -> bool {
    let room = k.min(prefix.len() - 2 - k);
    let is_same = |width: usize| {
        (SAME.get()..1.0 / SAME.get()).contains(&(difference(prefix, k, width) / size))
    };
    let far = room.min(FARTHER.get().max(width));
    room >= 2 && is_same((width / NEARER.get()).max(2)) && is_same(far) && !is_slope(prefix, k, far)
}

/// Returns true if a line explains about as much of the squares within the window as a step in its middle does.
fn is_slope(prefix: &[f64], k: usize, width: usize) -> bool {
    let w = width as f64;
    let from_middle = |j: usize| j as f64 - k as f64;
    let mean = |j: usize| prefix[j + 1] - prefix[j];
    let along: f64 = (k - width..=k + width)
        .map(|j| from_middle(j) * mean(j))
        .sum();
    let by_line = along * along / (w * (w + 1.0) * (2.0 * w + 1.0) / 3.0);
    by_line > SLOPE.get() * 0.5 * w * difference(prefix, k, width).powi(2)
}

fn prefix(means: &[Mean]) -> Vec<f64> {
    let first = means.first().map_or(0.0, |m| m.1);
    let sums = means.iter().scan(0.0, |sum, (_, mean)| {
        *sum += mean - first;
        Some(*sum)
    });
    std::iter::once(0.0).chain(sums).collect()
}

/// A drift of a mean that goes so smoothly that no noise explains it: a curve of third order through the means, or differences between
/// parts that go together over a sixth of the record and more.
pub(crate) fn drift(means: &[Mean]) -> Option<Drift> {
    if means.len() < 2 * PARTS.get() {
        return None;
    }
    let prefix = prefix(means);
    let edge = |k: usize| k * means.len() / PARTS.get();
    let parts: Vec<f64> = (0..PARTS.get())
        .map(|k| (prefix[edge(k + 1)] - prefix[edge(k)]) / (edge(k + 1) - edge(k)) as f64)
        .collect();
    let left = without_polynomial(&parts, 3);
    let square = |values: &[f64]| values.iter().map(|v| v * v).sum::<f64>();
    let total = square(&without_polynomial(&parts, 0));
    let neighbours: f64 = left.windows(2).map(|w| (w[1] - w[0]).powi(2)).sum();
    let explained = 1.0 - square(&left) / total;
    let is_white = neighbours > 2.0 * WHITE.get() * square(&left);
    let is_curve = explained > SMOOTH.get() || (explained > EXPLAINED.get() && is_white);
    if !is_curve && power_of_slow_differences(&parts) < MORE_POWER.get() {
        return None;
    }
    let end = PARTS.get() / 16;
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    Some(Drift {
        span: Span {
            from: means[0].0.from,
            to: means[means.len() - 1].0.to,
        },
        change: mean(&parts[PARTS.get() - end..]) - mean(&parts[..end]),
    })
}

/// The mean power of the slow cosines in the differences of neighbours over that of the next ones: `F(6, 15)` of a random walk, less of
/// white or flicker noise.
fn power_of_slow_differences(parts: &[f64]) -> f64 {
    let differences: Vec<f64> = parts.windows(2).map(|w| w[1] - w[0]).collect();
    let half = std::f64::consts::PI / differences.len() as f64;
    let power = |j: usize| {
        let cosine = |k: usize| (half * j as f64 * (k as f64 + 0.5)).cos();
        let sum: f64 = differences
            .iter()
            .zip(0..)
            .map(|(d, k)| d * cosine(k))
            .sum();
        // The constant is twice as long as a cosine.
        sum * sum * if j == 0 { 0.5 } else { 1.0 }
    };
    let mean =
        |from: usize, count: usize| (from..from + count).map(power).sum::<f64>() / count as f64;
    mean(0, SLOW.get()) / mean(SLOW.get(), NEXT.get()).max(f64::MIN_POSITIVE)
}

/// The values less the polynomial through them, by orthogonal polynomials of their place.
fn without_polynomial(values: &[f64], order: usize) -> Vec<f64> {
    let n = values.len();
    let x = |k: usize| 2.0 * (k as f64 + 0.5) / n as f64 - 1.0;
    let mut basis: Vec<Vec<f64>> = Vec::new();
    let mut left = values.to_vec();
    for power in 0..=order {
        let mut column: Vec<f64> = (0..n).map(|k| x(k).powi(power as i32)).collect();
        for other in &basis {
            take_off(&mut column, other);
        }
        take_off(&mut left, &column);
        basis.push(column);
    }
    left
}

fn take_off(values: &mut [f64], column: &[f64]) {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let share = dot(values, column) / dot(column, column).max(f64::MIN_POSITIVE);
    values
        .iter_mut()
        .zip(column)
        .for_each(|(v, c)| *v -= share * c);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Means of a second with white noise of 1 and a random walk of `walk` a second.
    fn noise(seed: u64, count: usize, walk: f64) -> Vec<f64> {
        let mut state = seed.wrapping_mul(2_654_435_761).wrapping_add(12_345);
        let mut uniform = move || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as f64 / f64::from(1_u32 << 31) - 0.5
        };
        let mut normal = move || (0..12).map(|_| uniform()).sum::<f64>();
        let mut level = 0.0;
        (0..count)
            .map(|_| {
                level += walk * normal();
                level + normal()
            })
            .collect()
    }

    fn means(values: impl IntoIterator<Item = f64>) -> Vec<Mean> {
        let span = |k: f64| Span {
            from: k,
            to: k + 1.0,
        };
        values
            .into_iter()
            .zip(0..)
            .map(|(v, k)| (span(f64::from(k)), v))
            .collect()
    }

    #[test]
    fn a_step_is_found_with_its_time_and_size_beside_any_noise() {
        for walk in [0.0, 0.1] {
            let stepped = noise(3, 1200, walk).into_iter().enumerate();
            let stepped = stepped.map(|(k, v)| if k >= 305 { v + 8.0 } else { v });
            let found = steps(&means(stepped));
            let [step] = found[..] else {
                panic!("{walk}: {found:?}");
            };
            assert!(
                (step.t - 305.0).abs() <= 3.0 && (step.size - 8.0).abs() < 2.5,
                "{step:?}"
            );
        }
    }

    #[test]
    fn noise_and_excursions_have_no_steps() {
        for seed in 0..60 {
            let walk = [0.0, 0.03, 0.3, 3.0][seed as usize % 4];
            let mut quiet = noise(seed, 700, walk);
            assert_eq!(steps(&means(quiet.clone())), [], "seed {seed}");
            quiet[300] += 300.0 * walk.max(1.0);
            assert_eq!(steps(&means(quiet)), [], "seed {seed}, excursion");
        }
    }

    #[test]
    fn a_warm_up_and_a_ramp_are_drifts_and_a_random_walk_is_none() {
        for (walk, by) in [(0.0, 30.0), (0.02, 30.0)] {
            let clean = noise(5, 1800, walk);
            let warm = |k: usize| by * (1.0 - (-(k as f64) / 500.0).exp());
            let line = |k: usize| by * k as f64 / 1800.0;
            for shape in [&warm as &dyn Fn(usize) -> f64, &line] {
                let values = clean.iter().enumerate().map(|(k, v)| v + shape(k));
                let found = drift(&means(values)).unwrap();
                assert!((found.change / by - 0.9).abs() < 0.15, "{found:?}");
            }
        }
        for seed in 0..300 {
            let walk = [0.0, 0.03, 0.3, 3.0][seed as usize % 4];
            assert_eq!(drift(&means(noise(seed, 900, walk))), None, "seed {seed}");
        }
    }

    #[test]
    fn a_warm_up_is_a_step_in_one_of_forty_records_at_most() {
        let has_step = |seed: &u64| {
            let values = noise(*seed, 7000, 0.0).into_iter().zip(0..);
            let warm = values.map(|(v, k)| v + 8.0 * (1.0 - (-f64::from(k) / 400.0).exp()));
            !steps(&means(warm)).is_empty()
        };
        assert!((0..40).filter(has_step).count() <= 1);
    }

    #[test]
    fn a_warm_up_of_a_sixth_of_the_record_and_a_wave_are_drifts_beside_a_random_walk() {
        let shapes: [fn(f64) -> f64; 2] = [
            |share| 12.0 * (1.0 - (-6.0 * share).exp()),
            |share| 6.0 * (4.0 * std::f64::consts::PI * share).sin(),
        ];
        for (seed, shape) in (0..20).flat_map(|seed| shapes.map(|shape| (seed, shape))) {
            let values = noise(seed, 3600, 0.02).into_iter().zip(0..);
            let values = values.map(|(v, k)| v + shape(f64::from(k) / 3600.0));
            assert!(drift(&means(values)).is_some(), "seed {seed}");
        }
    }
}
