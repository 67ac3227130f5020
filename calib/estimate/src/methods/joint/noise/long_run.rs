//! Long means beside samples: noise that averages out more slowly or sooner than white noise.

use recording::averages::median;

use super::scatter::{FLOOR, scatter};

findings::tuning! {
    /// Long-run over white standard deviation above which the noise is coloured, ...
    COLOURED: f64 = 1.12;
    /// ... if the ratio is above one by so many of its standard errors: both are the same where the stretches last three minutes in all.
    COLOURED_ERRORS: f64 = 2.0;

    /// Long-run over white standard deviation below which noise averages out sooner than white noise, as a hand's tremor and a machine's
    /// hum do over their periods, ...
    SOONER: f64 = 0.8;
    /// ... if the ratio is below one by so many of its standard errors.
    SOONER_ERRORS: f64 = 3.0;

    /// Long means are not believed to spread by less than this over what white noise would give.
    LEAST_LONG_RUN: f64 = 0.05;

    /// The density at low frequency is at most so many times what the longest batches show.
    FARTHER: f64 = 1.5;

    /// Batches of a stretch that spread by more than this many times the median variance are not quiet.
    LOUD: f64 = 4.0;

    /// A mean of samples with more than this many times the quiet variance has a noise of its own.
    pub(super) RESTLESS: f64 = 1.5;
}

/// Lengths of batches in shares of the longest: whatever the period of a vibration, one of them holds no full number of periods.
const SHORTER: [f64; 2] = [0.854, 0.618];

/// Sum of squares about the means of the stretches, and its degrees of freedom.
pub(super) fn scatter_within(parts: &[&[f64]]) -> (f64, f64) {
    let own = parts.iter().map(|part| scatter(part));
    own.fold((0.0, 0.0), |(sum, freedom), (own, of_own)| {
        (sum + own, freedom + of_own)
    })
}

/// Standard error of the ratio of a standard deviation by the means of batches to one that is known.
fn error_of_ratio(parts: &[&[f64]], batch: usize) -> f64 {
    let batches = parts.iter().map(|p| (p.len() / batch).saturating_sub(1));
    1.0 / (2.0 * batches.sum::<usize>().max(1) as f64).sqrt()
}

/// Standard deviation of long means over that of white noise; 1 where it is surely neither below [`SOONER`] nor above
/// [`COLOURED`].
///
/// Means over a time `T` of noise that resembles itself for a time `τ` fall short of the density at low frequency by a share
/// `τ/T`, those over `T/2` by twice that: what both say of means without end is `2 S(T) − S(T/2)`, `S` the variance
/// of a batch times its length.
pub(super) fn long_run(parts: &[&[f64]], batch: usize, white: f64) -> f64 {
    let whole = of_batches(parts, batch);
    let ratio = whole.sqrt() / white;
    let error = error_of_ratio(parts, batch);
    if ratio <= COLOURED.get().max(1.0 + COLOURED_ERRORS.get() * error) {
        let sooner =
            ratio < SOONER.get().min(1.0 - SOONER_ERRORS.get() * error) && white > FLOOR.get();
        return if sooner {
            let most = of_any_batches(parts, batch).sqrt() / white;
            most.clamp(LEAST_LONG_RUN.get(), 1.0)
        } else {
            1.0
        };
    }
    let half = of_batches(parts, batch / 2);
    let without_end = (2.0 * whole - half).clamp(whole, FARTHER.get() * whole);
    without_end.sqrt() / white
}

/// Standard deviation of long means over that of white noise, of what the restless parts scatter by beyond the quiet ones,
/// whose samples have the standard deviation `white` and whose long means `long_run` times as much; at least that of the
/// quiet ones unless it is surely below [`SOONER`].
pub(super) fn restless_long_run(
    parts: &[Vec<f64>],
    batch: usize,
    (white, long_run): (f64, f64),
) -> f64 {
    let usual = long_run.max(1.0);
    let shakes = |part: &&[f64]| {
        let (sum, freedom) = scatter(part);
        sum / freedom > RESTLESS.get() * white * white
    };
    let all = parts.iter().map(Vec::as_slice);
    let restless: Vec<&[f64]> = all.filter(shakes).collect();
    let (sum, freedom) = scatter_within(&restless);
    let error = error_of_ratio(&restless, batch);
    let whole = sum / f64::max(freedom, 1.0);
    let ratio = (of_batches(&restless, batch) / whole).sqrt();
    // Of all that the restless parts scatter by, quiet noise included: the test has no difference of two estimates in it.
    let sooner = ratio < SOONER.get().min(1.0 - SOONER_ERRORS.get() * error);
    if !sooner {
        return usual;
    }
    let beyond = of_any_batches(&restless, batch) - (white * long_run).powi(2);
    (beyond.max(0.0) / (whole - white * white))
        .sqrt()
        .clamp(LEAST_LONG_RUN.get(), usual)
}

/// The most by batches of this length and of some that are shorter: of full periods of a vibration nothing is left in the mean.
fn of_any_batches(parts: &[&[f64]], batch: usize) -> f64 {
    let shorter = SHORTER.map(|share| of_batches(parts, (share * batch as f64) as usize));
    shorter.into_iter().fold(of_batches(parts, batch), f64::max)
}

/// Variance of the means of batches times their length, those of touched stretches apart; 0 of none.
fn of_batches(parts: &[&[f64]], batch: usize) -> f64 {
    let batch = batch.max(1);
    let spreads: Vec<(f64, f64)> = parts
        .iter()
        .filter_map(|part| {
            let means: Vec<f64> = part
                .chunks_exact(batch)
                .map(|b| b.iter().sum::<f64>() / batch as f64)
                .collect();
            (means.len() > 2).then(|| scatter(&means))
        })
        .collect();
    let variances: Vec<f64> = spreads.iter().map(|(sum, dof)| sum / dof).collect();
    let usual = median(variances.iter().copied()).unwrap_or(0.0);
    pool(spreads.iter().zip(&variances), LOUD.get() * usual) * batch as f64
}

/// The pooled variance of those of at most `most`; 0 of none.
fn pool<'a>(parts: impl Iterator<Item = (&'a (f64, f64), &'a f64)>, most: f64) -> f64 {
    let (sum, dof) = parts
        .filter(|(_, variance)| **variance <= most)
        .fold((0.0, 0.0), |(s, d), ((sum, dof), _)| (s + sum, d + dof));
    if dof > 0.0 { sum / dof } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ten stretches of a vibration of 11 Hz at 100 Hz.
    fn vibrations() -> Vec<Vec<f64>> {
        let at = |k: u32| (std::f64::consts::TAU * 0.11 * f64::from(k)).sin();
        let stretch = |first: u32| (0..600).map(|k| at(733 * first + k)).collect();
        (0..10).map(stretch).collect()
    }

    #[test]
    fn batches_that_hold_full_periods_of_a_vibration_do_not_hide_what_it_leaves_in_other_means() {
        let parts = vibrations();
        let parts: Vec<&[f64]> = parts.iter().map(Vec::as_slice).collect();
        let white = 0.5_f64.sqrt();
        // A mean of T seconds is off by up to 1/(π f T): of one second, .02 in root mean square, where white noise makes .07.
        let share = long_run(&parts, 100, white);
        assert!((0.15..0.6).contains(&share), "{share}");
    }
}
