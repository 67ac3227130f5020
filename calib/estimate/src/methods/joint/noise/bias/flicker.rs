//! Flicker noise of a bias, as a covariance of the rows.

use std::f64::consts::PI;
use std::ops::Range;

use faer::Mat;
use nalgebra::{DMatrix, Matrix2x3};

use crate::methods::joint::blocks::covariance::Covariance;
use crate::methods::joint::noise::chain::{Chain, Link};
use crate::methods::joint::noise::exposure::{Path, paths, put};
use crate::methods::joint::noise::stations::Stations;
use crate::methods::joint::noise::weights::White;

findings::tuning! {
    /// Shortest time constant, s: faster ones are white to a mean over seconds.
    SHORTEST: f64 = 0.4;

    /// Ratio of neighbouring time constants: the sum of the processes then ripples by less than 5 % about `1/f`.
    RATIO: f64 = 4.0;

    /// The longest time constant is beyond so many times the length of the recordings: slower ones are a constant bias.
    BEYOND: f64 = 8.0;

    /// After so many time constants nothing is left of a state.
    FORGOTTEN: f64 = 40.0;
}

/// Variance of the slope of a line through a window of length `T` in flicker noise of unit instability, times `T²`:
/// `9/π`, from `−144/(π T²) ∫∫ x y ln|x − y| dx dy = 144/(16 π T²)` over the unit square about zero.
pub const IN_SLOPE: f64 = 9.0 / PI;

/// Flicker noise of unit bias instability as a sum of Gauss–Markov processes `σ² exp(−|t|/τ_k)`, the `τ_k` evenly
/// spaced in their logarithm.
///
/// One process has the two-sided density `2σ²τ/(1 + (2πfτ)²)`; the sum over `ln τ` in steps of `δ` is `σ²/(2fδ)`, so that
/// `σ² = B²δ/π` makes `B²/(2πf)`, whose Allan deviation is flat at `√(2 ln 2/π) B` (IEEE Std 952-1997, annex C).
#[derive(Clone, Debug)]
pub struct Flicker {
    taus: Vec<f64>,
}

impl Flicker {
    /// For recordings that last `length` seconds.
    pub fn lasting(length: f64) -> Self {
        let mut taus = vec![SHORTEST.get()];
        while taus.last().is_some_and(|tau| *tau < BEYOND.get() * length) && taus.len() < 16 {
            taus.push(SHORTEST.get() * RATIO.get().powi(taus.len() as i32));
        }
        Self { taus }
    }

    /// Variance of one process.
    fn variance() -> f64 {
        RATIO.get().ln() / PI
    }

    /// A mean over `[from, to]`, times `sign`.
    pub fn of_mean(
        &self,
        rows: Range<usize>,
        recording: usize,
        (from, to): (f64, f64),
        sign: f64,
    ) -> Fading {
        let length = (to - from).max(1e-9);
        let unit = DMatrix::<f64>::identity(3, 3);
        let fading = |tau: &f64| &unit * (sign * -(-length / tau).exp_m1() * tau / length);
        // ∫∫ exp(−|s − t|/τ) ds dt / T² = 2 (x − 1 + e⁻ˣ)/x², x = T/τ; by its series where that cancels.
        let own = |tau: &f64| {
            let x = length / tau;
            if x < 1e-3 {
                1.0 - x / 3.0
            } else {
                2.0 * (x + (-x).exp_m1()) / (x * x)
            }
        };
        let shares: Vec<DMatrix<f64>> = self.taus.iter().map(fading).collect();
        let own: f64 = self.taus.iter().map(own).sum();
        Fading {
            rows,
            recording,
            begin: from,
            end: to,
            head: shares.clone(),
            tail: shares,
            own: [0, 1, 2].map(|axis| {
                let mut of_axis = DMatrix::zeros(3, 3);
                of_axis[(axis, axis)] = Self::variance() * own;
                of_axis
            }),
        }
    }

    /// Samples at times `t` with the weights `gains` (2 × 3).
    pub fn of_samples(
        &self,
        rows: Range<usize>,
        recording: usize,
        t: &[f64],
        gains: &[Matrix2x3<f64>],
    ) -> Fading {
        let (begin, end) = match (t.first(), t.last()) {
            (Some(a), Some(b)) => (*a, *b),
            _ => (0.0, 0.0),
        };
        let mut own = [nalgebra::Matrix2::<f64>::zeros(); 3];
        let (mut head, mut tail) = (Vec::new(), Vec::new());
        for tau in &self.taus {
            let (mut from_begin, mut so_far) = (Matrix2x3::zeros(), Matrix2x3::<f64>::zeros());
            let mut before = begin;
            for (t, g) in t.iter().zip(gains) {
                so_far *= (-(t - before) / tau).exp();
                before = *t;
                for (axis, own) in own.iter_mut().enumerate() {
                    let (g, before) = (g.column(axis), so_far.column(axis));
                    let cross = g * before.transpose();
                    *own += g * g.transpose() + cross + cross.transpose();
                }
                so_far += g;
                from_begin += g * (-(t - begin) / tau).exp();
            }
            let dynamic = |m: &Matrix2x3<f64>| DMatrix::from_iterator(2, 3, m.iter().copied());
            head.push(dynamic(&from_begin));
            tail.push(dynamic(&so_far));
        }
        Fading {
            rows,
            recording,
            begin,
            end,
            head,
            tail,
            own: own
                .map(|own| DMatrix::from_iterator(2, 2, own.iter().map(|v| v * Self::variance()))),
        }
    }

    /// Covariance of all `m` rows, of flicker on one axis.
    ///
    /// Rows of one recording do not overlap in time: of an earlier and a later group `C = Σ σ² e^(−gap/τ) tail headᵀ`.
    pub fn covariance(&self, all: &[Fading], axis: usize, m: usize) -> Covariance {
        let of_path = |path: Path<'_, Fading>| {
            let mut c = Mat::zeros(path.rows.len(), path.rows.len());
            for (k, (one, own)) in path.items.iter().enumerate() {
                put(&mut c, own, own, &one.own[axis]);
                for (other, at) in &path.items[..k] {
                    let (early, late) = if one.begin <= other.begin {
                        ((one, own), (other, at))
                    } else {
                        ((other, at), (one, own))
                    };
                    let block = self.between(early.0, late.0, axis);
                    put(&mut c, early.1, late.1, &block);
                    put(&mut c, late.1, early.1, &block.transpose());
                }
            }
            (path.rows, c)
        };
        let paths = paths(all, |one| (one.recording, one.rows.clone()));
        Covariance::of_blocks(m, paths.into_iter().map(of_path).collect())
    }

    /// The same as what is passed on along the recordings.
    pub fn chain(&self, all: &[Fading], axis: usize, stations: &Stations) -> Chain {
        let width = self.taus.len();
        let of_row = stations.of_first_row(stations.rows());
        let mut at: Vec<Option<&Fading>> = vec![None; stations.all().len()];
        for one in all {
            if let Some(station) = of_row[one.rows.start] {
                at[station] = Some(one);
            }
        }
        let mut before: Option<(usize, f64)> = None;
        let links = at.into_iter().flatten().map(|one| {
            let d = one.rows.len();
            let gap = before
                .filter(|(recording, _)| *recording == one.recording)
                .map_or(0.0, |(_, end)| (one.begin - end).max(0.0));
            before = Some((one.recording, one.end));
            // The state is that at the end of the group, of which its begin is so many time constants ahead.
            let ahead = |tau: &f64| ((one.end - one.begin).max(0.0) / tau).min(FORGOTTEN.get());
            let kept = |tau: &f64| (-gap / tau - ahead(tau)).exp();
            let gives = |i: usize, k: usize| one.head[k][(i, axis)] * ahead(&self.taus[k]).exp();
            let takes = |i: usize, k: usize| one.tail[k][(i, axis)] * Self::variance();
            let link = Link {
                own: one.own[axis].clone(),
                gives: DMatrix::from_fn(d, width, gives),
                takes: DMatrix::from_fn(d, width, takes),
                keeps: self.taus.iter().map(kept).collect(),
            };
            (one.rows.start, link)
        });
        Chain::of_links(stations, width, links)
    }

    /// Covariance of an earlier and a later group of rows.
    fn between(&self, early: &Fading, late: &Fading, axis: usize) -> DMatrix<f64> {
        let gap = (late.begin - early.end).max(0.0);
        let mut block = DMatrix::zeros(early.rows.len(), late.rows.len());
        for (k, tau) in self.taus.iter().enumerate() {
            let decay = (-gap / tau).exp();
            if decay > 1e-9 {
                block += early.tail[k].column(axis)
                    * late.head[k].column(axis).transpose()
                    * (decay * Self::variance());
            }
        }
        block
    }
}

/// Integral `∫ w(t) b(t) dt` of a bias with flicker noise over a group of `d` rows, axis by axis.
#[derive(Clone, Debug)]
pub struct Fading {
    rows: Range<usize>,
    recording: usize,
    begin: f64,
    end: f64,
    /// Per time constant `∫ w e^(−(t − begin)/τ) dt` (d × 3).
    head: Vec<DMatrix<f64>>,
    /// Per time constant `∫ w e^(−(end − t)/τ) dt` (d × 3).
    tail: Vec<DMatrix<f64>>,
    /// Its own covariance (d × d), of every axis.
    own: [DMatrix<f64>; 3],
}

impl Fading {
    /// The same of rows that the white noise has whitened.
    #[must_use]
    pub fn whitened(mut self, white: &White) -> Self {
        let first = self.rows.start;
        for part in self.head.iter_mut().chain(&mut self.tail) {
            white.apply_block(first, part);
        }
        for own in &mut self.own {
            white.apply_block(first, own);
            own.transpose_mut();
            white.apply_block(first, own);
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The covariance of means over windows, x axis only.
    fn of_windows(windows: &[(f64, f64)]) -> Mat<f64> {
        let flicker = Flicker::lasting(500.0);
        let all: Vec<Fading> = windows
            .iter()
            .enumerate()
            .map(|(k, w)| flicker.of_mean(3 * k..3 * k + 3, 0, *w, 1.0))
            .collect();
        let c = flicker.covariance(&all, 0, 3 * windows.len()).to_dense();
        Mat::from_fn(windows.len(), windows.len(), |i, k| c[(3 * i, 3 * k)])
    }

    #[test]
    fn the_allan_variance_is_flat_at_two_ln_two_over_pi() {
        // At 4 s the sum begins to end.
        for (tau, ripple) in [(4.0, 0.07), (10.0, 0.04), (30.0, 0.04), (100.0, 0.04)] {
            let c = of_windows(&[(0.0, tau), (tau, 2.0 * tau)]);
            let allan = 0.5 * (c[(0, 0)] + c[(1, 1)] - 2.0 * c[(0, 1)]);
            let exact = 2.0 * 2f64.ln() / PI;
            assert!(
                (allan / exact - 1.0).abs() < ripple,
                "{tau}: {allan} {exact}"
            );
        }
    }

    #[test]
    fn contrasts_of_windows_have_the_covariance_of_a_logarithm() {
        // K(t) = −ln|t|/π for contrasts; the mean of ln|s − t| over two windows by second differences of
        // F(t) = t² (ln|t| − 3/2)/2.
        let windows = [(0.0, 8.0), (11.0, 19.0), (60.0, 66.0), (300.0, 308.0)];
        let c = of_windows(&windows);
        let f = |t: f64| 0.5 * t * t * (t.abs().max(1e-300).ln() - 1.5);
        let exact = |a: (f64, f64), b: (f64, f64)| {
            let sum = f(b.1 - a.0) - f(b.0 - a.0) - f(b.1 - a.1) + f(b.0 - a.1);
            -sum / (PI * (a.1 - a.0) * (b.1 - b.0))
        };
        for i in 0..4 {
            for k in 0..i {
                let (a, b) = (windows[i], windows[k]);
                let found = c[(i, i)] + c[(k, k)] - 2.0 * c[(i, k)];
                let expected = exact(a, a) + exact(b, b) - 2.0 * exact(b, a);
                assert!((found / expected - 1.0).abs() < 0.04, "{found} {expected}");
            }
        }
    }

    #[test]
    fn many_samples_are_their_mean() {
        let flicker = Flicker::lasting(100.0);
        let t: Vec<f64> = (0..2000)
            .map(|k| 3.0 + (f64::from(k) + 0.5) * 4e-3)
            .collect();
        let gains = vec![Matrix2x3::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0) / 2000.0; 2000];
        let samples = flicker.of_samples(0..2, 0, &t, &gains);
        let mean = flicker.of_mean(2..5, 0, (20.0, 28.0), 1.0);
        let same = flicker.of_mean(0..3, 0, (3.0, 11.0), 1.0);
        let by_samples = flicker
            .covariance(&[samples, mean.clone()], 0, 5)
            .to_dense();
        let moved = Fading { rows: 3..6, ..mean };
        let by_means = flicker.covariance(&[same, moved], 0, 6).to_dense();
        for (i, k, j, l) in [(0, 0, 0, 0), (0, 2, 0, 3)] {
            let ratio = by_samples[(i, k)] / by_means[(j, l)];
            assert!((ratio - 1.0).abs() < 1e-3, "{ratio}");
        }
    }
}
