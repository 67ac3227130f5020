//! Identification of the noise terms of a recording, with confidence intervals.

use super::covariance::{PairCovariance, variance};
use super::interval::{Interval, Scatter, invert};
use super::octaves::{FEWEST_POINTS, Octaves};
use super::term::NoiseTerm;
use crate::allan::{AllanCurve, AllanPoint};

findings::tuning! {
    /// Octaves in which the memory of the readings shows by itself.
    NEAR: usize = 7;

    /// Octaves further on, beyond which it is the long times that the terms miss.
    APART: usize = 2;

    /// Octaves left out beyond those that a memory evidently shapes.
    MARGIN: usize = 1;

    /// Confidence of the interval of one measured point.
    POINT_CONFIDENCE: f64 = 0.95;
}

/// A noise coefficient with its interval, in the unit of [`NoiseTerm::unit`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The term.
    pub term: NoiseTerm,
    /// Its coefficient; zero where the fit does without.
    pub value: f64,
    /// The five intervals of an axis hold together with 95 % confidence (each with 99 %).
    pub interval: Interval,
}

impl Estimate {
    /// Returns true if the data need this term.
    pub fn is_seen(&self) -> bool {
        self.interval.lower > 0.0
    }
}

/// The noise terms of one axis.
#[derive(Clone, Debug, PartialEq)]
pub struct NoiseTerms {
    /// In the order of [`NoiseTerm::ALL`].
    pub estimates: [Estimate; 5],
    /// Relative misfit of `σ²` that the five terms leave beyond their scatter (a filter or a
    /// resonance of the sensor, say); zero where they suffice. The intervals include it.
    pub model_error: f64,
    /// Shortest averaging time fitted, s: longer than a sample where readings that are near in time go together.
    pub shortest_tau: f64,
    /// Longest averaging time fitted, s.
    pub longest_tau: f64,
    /// False if the recording tells no term: the readings have a memory too long for it, or steps wider than their noise.
    pub is_known: bool,
    /// Squared coefficients; that of quantisation is negative where a memory takes off more than rounding adds.
    squares: [f64; 5],
    step: f64,
}

impl NoiseTerms {
    /// The estimate of one term.
    pub fn get(&self, term: NoiseTerm) -> &Estimate {
        &self.estimates[term as usize]
    }

    /// The fitted Allan deviation at `tau`, which is no shorter than the shortest fitted.
    pub fn deviation(&self, tau: f64) -> f64 {
        variance(tau, &self.squares).max(0.0).sqrt()
    }

    /// Returns true if the terms were fitted to times as short as `tau`.
    pub fn reach(&self, tau: f64) -> bool {
        // Times are products of the same step.
        tau > self.shortest_tau * (1.0 - 1e-9)
    }

    /// The same where the readings come in steps wider than their noise: a term may hide within a step if its deviation exceeds half
    /// of one at no time, and what is seen may be the rounding.
    pub fn within_steps(mut self, step: f64) -> Self {
        for estimate in &mut self.estimates {
            let times = [self.step, self.longest_tau];
            let largest = times
                .map(|tau| estimate.term.variance(tau))
                .into_iter()
                .fold(0.0, f64::max);
            let hidden = 0.5 * step / largest.sqrt();
            estimate.interval.lower = 0.0;
            estimate.interval.upper = estimate.interval.upper.max(hidden);
        }
        self.is_known = false;
        self
    }

    /// The same where the mean drifts as no noise does: what grows with time may be the drift, and is bounded only.
    pub fn beside_a_drift(mut self) -> Self {
        for estimate in &mut self.estimates {
            if matches!(
                estimate.term,
                NoiseTerm::RandomWalk | NoiseTerm::BiasInstability
            ) {
                estimate.interval.lower = 0.0;
            }
        }
        self
    }

    /// The same where bridges stand for a share of the samples: a bridge adds at most 1.5 times the variance of those in whose place it
    /// is.
    pub fn with_bridges(mut self, share: f64) -> Self {
        for estimate in &mut self.estimates {
            estimate.interval.lower /= 1.0 + 0.75 * share;
        }
        self
    }

    /// 95 % confidence interval of one measured point, from the scatter that the terms imply.
    pub fn interval(&self, point: &AllanPoint) -> Interval {
        let theta = self.squares;
        let implied = variance(point.tau, &theta);
        let scatter =
            PairCovariance::new([point.factor; 2], [point.places; 2], self.step).at(&theta);
        let relative = scatter / (implied * implied);
        let squares = invert(POINT_CONFIDENCE.get(), point.deviation.powi(2), |v| {
            Scatter {
                variance: relative * v * v,
                third: 2.0 * (relative * v * v).powi(2) / v.max(f64::MIN_POSITIVE),
            }
        });
        Interval {
            lower: squares.lower.sqrt(),
            upper: squares.upper.sqrt(),
        }
    }
}

/// Fits the five noise terms to the octaves of a curve.
///
/// Generalised least squares of `σ²(τ)` with the full covariance of the overlapping estimates, which
/// depends on the terms and is iterated; squared coefficients are held at or above zero. The
/// intervals do not assume that any term is absent: they come from the fit of all five with either
/// sign, so that two terms that this recording cannot tell apart both have wide ones. An upper end
/// is never below what the recording could have seen (that of an estimate of zero).
///
/// Where the five terms miss the curve by more than it scatters (at the 1 % level), the shortest times are left out, an
/// octave after the other, until they do not: a filter in the sensor makes readings go together that are near in time, and
/// only longer means have the density that the terms are defined by. Where too few octaves are left, no term is bounded. Where
/// the long times miss the terms, every point gets the relative model error that makes the misfit as large as expected.
///
/// `None` with fewer than six octaves (about 256 samples), or where the signal never changes.
pub fn identify(curve: &AllanCurve) -> Option<NoiseTerms> {
    let all = Octaves::of(curve)?;
    let free = without_memory(&all);
    let is_known = free.is_some();
    let mut octaves = free.unwrap_or(all);
    octaves.fit_model_error();
    let squares = octaves.settle()?;
    let fit = octaves.weighted(&squares)?;
    let squares = fit.nonnegative(None);
    let bounds = |term: NoiseTerm| match is_known && !hides(&octaves, term) {
        true => fit.interval(term as usize),
        false => None,
    };
    let estimates = NoiseTerm::ALL.map(|term| {
        let bounds = bounds(term).unwrap_or(UNBOUNDED);
        let square = squares[term as usize].max(0.0);
        let interval = Interval {
            lower: bounds.lower.min(square).sqrt(),
            upper: bounds.upper.max(square).sqrt(),
        };
        Estimate {
            term,
            value: square.sqrt(),
            interval,
        }
    });
    Some(NoiseTerms {
        estimates,
        model_error: octaves.model_error,
        shortest_tau: octaves.points.first()?.tau,
        longest_tau: octaves.points.last()?.tau,
        is_known,
        squares,
        step: curve.step,
    })
}

const UNBOUNDED: Interval = Interval {
    lower: 0.0,
    upper: f64::INFINITY,
};

/// What a memory takes off looks like rounding, of either sign: nothing is known of rounding beside it.
fn hides(octaves: &Octaves, term: NoiseTerm) -> bool {
    octaves.has_memory && term == NoiseTerm::Quantisation
}

/// The octaves from one on at which the readings have no memory left: the octave after the first from which on the five
/// terms explain the curve. `None` where too few octaves are left.
///
/// Where they do so only from much longer times on, the long times are what they miss (a daily swing, say), and the octaves
/// after the first alone decide.
fn without_memory(all: &Octaves) -> Option<Octaves> {
    let count = all.points.len();
    let last = count - FEWEST_POINTS.get();
    let first = |octaves: usize| {
        let is_explained = |start: &usize| {
            let to = count.min(start + octaves);
            all.part(*start..to).are_explained()
        };
        (0..=last).find(is_explained)
    };
    let start = match (first(count), first(NEAR.get())) {
        (Some(whole), Some(near)) if whole > near + APART.get() => near,
        (whole, near) => whole.or(near)?,
    };
    match start {
        0 => Some(all.clone()),
        start => (start + MARGIN.get() <= last).then(|| all.part(start + MARGIN.get()..count)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::allan::AllanAccumulator;

    /// White noise of density 1 at 50 Hz: SplitMix64, sums of twelve.
    fn white(samples: usize, seed: u64) -> Vec<f64> {
        let mut state = seed;
        let mut uniform = move || {
            state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
            let z = (state ^ (state >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
            let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
            ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
        };
        let mut normal = move || (0..12).map(|_| uniform()).sum::<f64>() - 6.0;
        (0..samples).map(|_| normal() * 50f64.sqrt()).collect()
    }

    /// One pole with its corner at `corner` Hz, at 50 Hz.
    fn low_pass(values: &[f64], corner: f64) -> Vec<f64> {
        let keeps = (-std::f64::consts::TAU * corner / 50.0).exp();
        let filtered = values.iter().scan(0.0, |last, value| {
            *last = keeps * *last + (1.0 - keeps) * value;
            Some(*last)
        });
        filtered.collect()
    }

    fn fit(values: Vec<f64>) -> NoiseTerms {
        identify(&AllanCurve::of(values, 0.02)).unwrap()
    }

    /// A filter leaves the density at low frequency, which is 1, as it is: the mean of many files shows a bias that
    /// one hides in its scatter.
    #[test]
    fn a_filter_does_not_change_the_white_noise() {
        type Filter = fn(&[f64]) -> Vec<f64>;
        let filters: [(&str, Filter, f64); 4] = [
            ("20 Hz", |v| low_pass(v, 20.0), 0.01),
            ("5 Hz", |v| low_pass(v, 5.0), 0.015),
            ("1 Hz", |v| low_pass(v, 1.0), 0.03),
            (
                "mean of five",
                |v| v.windows(5).map(|w| w.iter().sum::<f64>() / 5.0).collect(),
                0.02,
            ),
        ];
        for (name, filter, tolerance) in filters {
            let fits: Vec<NoiseTerms> = (0..12)
                .map(|seed| fit(filter(&white(45_500, seed))[500..].to_vec()))
                .collect();
            let of = |fit: &NoiseTerms| *fit.get(NoiseTerm::WhiteNoise);
            let mean = fits.iter().map(|fit| of(fit).value).sum::<f64>() / 12.0;
            assert!((mean - 1.0).abs() < tolerance, "{name}: {mean}");
            // Each holds with 99 %.
            let held = fits
                .iter()
                .filter(|fit| of(fit).interval.holds(1.0))
                .count();
            assert!(held >= 11, "{name}: {held}");
            assert!(
                fits.iter()
                    .all(|fit| fit.shortest_tau > 0.03 && fit.model_error == 0.0),
                "{name}"
            );
        }
    }

    /// Twelve pieces of 100 s show nothing of means over more than half of that.
    #[test]
    fn beside_gaps_no_longer_means_are_fitted_than_the_pieces_hold() {
        let values = white(60_000, 5);
        let mut pieces = AllanAccumulator::new();
        for (k, value) in values.iter().enumerate() {
            if k % 5000 == 0 {
                pieces.gap();
            }
            pieces.push(*value);
        }
        let (pieces, whole) = (identify(&pieces.finish(0.02)).unwrap(), fit(values));
        assert!(pieces.longest_tau < 50.0 && whole.longest_tau > 100.0);
    }

    #[test]
    fn white_noise_is_fitted_from_one_sample_on() {
        for seed in 0..12 {
            let found = fit(white(45_000, seed));
            assert!(found.shortest_tau < 0.021 && found.is_known, "{seed}");
        }
    }

    #[test]
    fn a_filter_with_too_few_octaves_beyond_it_leaves_the_terms_unbounded() {
        let found = fit(low_pass(&white(2500, 1), 1.0)[500..].to_vec());
        assert!(!found.is_known);
        let is_open = |e: &Estimate| !e.is_seen() && e.interval.upper.is_infinite();
        assert!(found.estimates.iter().all(is_open));
    }

    /// Readings that a filter makes wander have no white noise at its times, and as much as ever beyond.
    #[test]
    fn a_strong_filter_is_not_taken_for_a_walk_of_the_bias() {
        for (samples, corner) in [(1000, 1.0), (2000, 0.4), (4000, 0.3), (20_000, 0.3)] {
            for seed in 0..12 {
                let values = low_pass(&white(samples + 500, seed), corner);
                let found = *fit(values[500..].to_vec()).get(NoiseTerm::WhiteNoise);
                assert!(
                    found.interval.holds(1.0),
                    "{samples} {corner} {seed}: {found:?}"
                );
            }
        }
    }
}
