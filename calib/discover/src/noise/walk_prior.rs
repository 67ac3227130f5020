//! Random walks of a bias at which a claim is tried, and the prior probability of each.
//!
//! A walk is measured in the unit `σ / √T`: `σ` is the white standard error of a static mean, `T` the length of the session, so that a
//! walk of one unit moves a bias by one standard error of a mean from the first static interval to the last.

use estimate::methods::joint::{BiasNoise, Data};
use sensor::Sensor;

use super::level::{Level, SCATTERS};
use super::projected::Projected;

findings::tuning! {
    /// Lowest walk above zero, in units of `σ / √T`.
    LOWEST: f64 = 0.15;

    /// Ratio of one walk to the one below it.
    RATIO: f64 = 1.7;

    /// Fewest walks above zero: the highest of them is 18 units.
    FEWEST: i32 = 10;
    /// Most walks above zero. There are more than the fewest where the likeliest walk is higher, for what is far from every walk that is
    /// tried makes any fault evident.
    MOST: i32 = 40;

    /// Median of the log-normal part of the prior, in units of `σ / √T`.
    MEDIAN: f64 = 0.8;
    /// Its width, as a standard deviation of the logarithm.
    WIDTH: f64 = 1.0;

    /// Probability that the walk is as the log-normal part says; else any walk is as likely as another.
    USUAL: f64 = 0.95;

    /// Steps are cut into so many from two below the likeliest walk to one above it: a long session knows its walk to a fifth.
    FINER: i32 = 3;
}

/// The walks of one sensor in units of `σ / √T`, through the likeliest and up to one beyond it, with the logarithm of their prior
/// probabilities, which add up to one.
fn prior(likeliest: f64) -> Vec<(f64, f64)> {
    // Steps of the likeliest above the lowest: the whole part is its place, the rest moves all walks.
    let place = (likeliest / LOWEST.get()).max(1.0).ln() / RATIO.get().ln();
    let (moved, place) = (place.fract(), place as i32);
    let count = (place + 2).clamp(FEWEST.get(), MOST.get());
    let is_near = |k: i32| likeliest > 0.0 && (place - 2..=place).contains(&k);
    let steps = (0..count).flat_map(|k| {
        let parts = if is_near(k) { FINER.get() } else { 1 };
        let part = 1.0 / f64::from(parts);
        (0..parts).map(move |i| (f64::from(k) + f64::from(i) * part, part))
    });
    let walk = |step: f64| LOWEST.get() * RATIO.get().powf(step + moved);
    // Zero stands one step below the lowest.
    let steps: Vec<(f64, f64)> = std::iter::once((-1.0, 1.0)).chain(steps).collect();
    let usual = |&(step, width): &(f64, f64)| {
        width * (-0.5 * ((walk(step) / MEDIAN.get()).ln() / WIDTH.get()).powi(2)).exp()
    };
    let all: f64 = steps.iter().map(usual).sum();
    let widths: f64 = steps.iter().map(|(_, width)| width).sum();
    let probability =
        |own: &(f64, f64)| USUAL.get() * usual(own) / all + (1.0 - USUAL.get()) * own.1 / widths;
    let of = |own: &(f64, f64)| {
        let walk = if own.0 < 0.0 { 0.0 } else { walk(own.0) };
        (walk, probability(own).ln())
    };
    steps.iter().map(of).collect()
}

/// The unit of a sensor's walk, `σ / √T`, in m/s²/√s or rad/s/√s: the median over the static intervals and axes of every recording, of several
/// recordings the largest. `None` without static means.
fn unit(data: &Data, sensor: Sensor) -> Option<f64> {
    let of_recording = |recording: usize| {
        let noise = data.sources[recording].noise(sensor)?;
        let own = || data.rests.iter().filter(|rest| rest.recording == recording);
        let length = own().next_back()?.span.to - own().next()?.span.from;
        let mut errors: Vec<f64> = own()
            .filter_map(|rest| {
                let means = data.chunks[rest.chunks.clone()].iter();
                let means = means.filter_map(|chunk| chunk.mean(sensor));
                let count = means.map(|mean| mean.count).sum::<usize>();
                (count > 0).then(|| (noise.variance_of_mean(count).sum() / 3.0).sqrt())
            })
            .collect();
        errors.sort_by(f64::total_cmp);
        let middle = *errors.get(errors.len() / 2)?;
        (length > 0.0).then(|| middle / length.sqrt())
    };
    (0..data.sources.len())
        .filter_map(of_recording)
        .reduce(f64::max)
}

/// The likeliest noise; then for each sensor the walks of the prior, with the likeliest flicker and without it; then shares of the scatter
/// of turns. Noise that was given is the only level.
pub fn walk_levels(
    projected: &Projected,
    data: &Data,
    noise: BiasNoise,
    is_given: bool,
) -> Vec<Level> {
    let log_prior = if is_given { 0.0 } else { f64::NEG_INFINITY };
    let likeliest = Level::at(projected, (noise, 1.0), None, log_prior);
    let mut levels: Vec<Level> = likeliest.into_iter().collect();
    if is_given {
        return levels;
    }
    for sensor in [Sensor::Accelerometer, Sensor::Gyroscope] {
        let Some(unit) = unit(data, sensor) else {
            continue;
        };
        let flickers: &[f64] = if noise.flickers(sensor) {
            &[1.0, 0.0]
        } else {
            &[1.0]
        };
        for flicker in flickers {
            let noise = noise.with_shares(sensor, 1.0, *flicker);
            let Some(along) = projected.along_walk(noise, sensor) else {
                continue;
            };
            let likeliest = noise.walk[usize::from(sensor == Sensor::Gyroscope)] / unit;
            levels.extend(prior(likeliest).into_iter().map(|(walk, log_prior)| {
                let (noise, whitened) = along.at(walk * unit);
                Level {
                    noise,
                    scatter: 1.0,
                    whitened,
                    of: Some(sensor),
                    log_prior: log_prior - (flickers.len() as f64).ln(),
                }
            }));
        }
    }
    if projected.scatters {
        let each = -(SCATTERS.len() as f64).ln();
        let at = |share: &f64| Level::at(projected, (noise, *share), None, each);
        levels.extend(SCATTERS.iter().filter_map(at));
    }
    levels
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_prior_probabilities_add_up_to_one_and_the_usual_walk_is_likeliest() {
        let prior = prior(0.0);
        let sum: f64 = prior.iter().map(|(_, log)| log.exp()).sum();
        assert!((sum - 1.0).abs() < 1e-12);
        let likeliest = prior.iter().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
        assert!((likeliest.0 / MEDIAN.get()).ln().abs() <= 0.5 * RATIO.get().ln());
        assert_eq!(prior[0].0, 0.0);
    }

    #[test]
    fn the_likeliest_walk_is_within_those_that_are_tried() {
        for likeliest in [0.0, 3.0, 40.0, 2000.0] {
            let prior = super::prior(likeliest);
            assert!(prior.last().unwrap().0 > likeliest);
            let nearest = prior.iter().map(|(walk, _)| (walk - likeliest).abs());
            assert!(nearest.fold(f64::INFINITY, f64::min) < 1e-9 * likeliest.max(1.0));
            let sum: f64 = prior.iter().map(|(_, log)| log.exp()).sum();
            assert!((sum - 1.0).abs() < 1e-12);
        }
    }
}
