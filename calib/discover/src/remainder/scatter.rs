//! A bias that wanders otherwise than at random: scatter of one axis, with a memory of seconds to minutes.

use faer::{Mat, Side};
use sensor::Sensor;

use crate::rank::Level;
use crate::score::log_tail;
use crate::state::State;

/// Memories tried, s.
const MEMORIES: [f64; 3] = [10.0, 30.0, 100.0];

/// Variances tried, from a hundredth of the noise in what the data show best on.
const VARIANCES: i32 = 16;
const LEAST: f64 = 1e-2;
const STEP: f64 = 2.0;

/// More scatter of one axis than the noise allows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scatter {
    /// The sensor.
    pub sensor: Sensor,
    /// The axis.
    pub axis: usize,
    /// Its memory, s.
    pub memory: f64,
    /// `ln p`, the memories tried paid for.
    pub log_p: f64,
}

/// The test of every axis of every sensor.
///
/// A bias on one axis with covariance `θ K`, `K_st = exp(−|s − t|/τ)` over the chunks, against none, by the likelihood
/// ratio `2 max (LL(θ, k) − LL(0, k₀))`: the walk's density `k` is profiled under both, or it takes what wanders
/// for a walk. Where nothing is missing, `θ` is at the edge of what it may be and the ratio is nothing in half of the
/// cases and `χ²₁` in the others (Self & Liang 1987).
pub(super) fn scatters(state: &State, levels: &[Level]) -> Vec<Scatter> {
    let Some(nothing) = levels.first().map(|l| l.whitened.log_likelihood()) else {
        return Vec::new();
    };
    let mut all = Vec::new();
    for sensor in [Sensor::Accelerometer, Sensor::Gyroscope] {
        let means: Vec<_> = state
            .sensitivities
            .means
            .iter()
            .filter(|m| m.sensor == sensor)
            .collect();
        if means.is_empty() {
            continue;
        }
        let recording =
            |chunk: usize| state.fit.data.rests[state.fit.data.chunks[chunk].rest].recording;
        let places = means.iter().map(|m| (recording(m.chunk), m.truth.time));
        let times: Vec<(usize, f64)> = places.collect();
        let kernels: Vec<_> = MEMORIES
            .into_iter()
            .filter_map(|memory| Some((memory, kernel_factor(&times, memory)?)))
            .collect();
        for axis in 0..3 {
            let columns = state
                .projected
                .columns(biases_of(state, sensor, axis).as_ref());
            let mut best = (0.0, MEMORIES[0]);
            for level in levels.iter().filter(|l| l.of.is_none_or(|s| s == sensor)) {
                let lost = 2.0 * (level.whitened.log_likelihood() - nothing);
                let biases = Biases::of(&level.whitened.columns(&columns), &level.whitened.z);
                for (memory, factor) in &kernels {
                    let ratio = lost + biases.gain(factor);
                    if ratio > best.0 {
                        best = (ratio, *memory);
                    }
                }
            }
            all.push(Scatter {
                sensor,
                axis,
                memory: best.1,
                log_p: log_tail(best.0, 1.0) + (0.5 * MEMORIES.len() as f64).ln(),
            });
        }
    }
    all
}

/// A bias of its own for every chunk on one axis of a sensor (`m × n`), white-whitened.
fn biases_of(state: &State, sensor: Sensor, axis: usize) -> Mat<f64> {
    let means = state.sensitivities.means.iter();
    let rows: Vec<usize> = means
        .filter(|m| m.sensor == sensor)
        .map(|m| m.row)
        .collect();
    let mut columns = Mat::zeros(state.rows(), rows.len());
    for (k, row) in rows.into_iter().enumerate() {
        columns[(row + axis, k)] = 1.0;
    }
    state.whitened(columns)
}

/// `L` of `K = L Lᵀ`, for chunks of recordings at times since their start: no bias remembers another recording, and what
/// differs between recordings as a whole is a bias of each and no wandering.
fn kernel_factor(times: &[(usize, f64)], memory: f64) -> Option<Mat<f64>> {
    let n = times.len();
    let alike = |i: usize, j: usize| {
        let ((one, a), (other, b)) = (times[i], times[j]);
        let fades = (-(a - b).abs() / memory).exp();
        if one == other { fades } else { 0.0 }
    };
    let mut kernel = Mat::from_fn(n, n, alike);
    if times.iter().any(|(recording, _)| *recording != times[0].0) {
        let share = Mat::from_fn(n, n, |i, j| {
            let own = times
                .iter()
                .filter(|(recording, _)| *recording == times[i].0);
            let same = times[i].0 == times[j].0;
            f64::from(u8::from(i == j)) - f64::from(u8::from(same)) / own.count() as f64
        });
        kernel = &share * kernel * share.transpose();
    }
    for k in 0..n {
        kernel[(k, k)] += 1e-9;
    }
    Some(kernel.llt(Side::Lower).ok()?.L().to_owned())
}

/// What the data say of the biases of the chunks.
struct Biases {
    /// `BᵀB` (`n × n`), `B` their whitened columns.
    gram: Mat<f64>,
    /// `Bᵀ z` (`n × 1`).
    right: Mat<f64>,
}

impl Biases {
    fn of(columns: &Mat<f64>, z: &Mat<f64>) -> Self {
        Self {
            gram: columns.transpose() * columns,
            right: columns.transpose() * z,
        }
    }

    /// `2 max_θ (LL(θ) − LL(0))` for `V = I + θ B L Lᵀ Bᵀ`: with `d` the eigenvalues of `Lᵀ BᵀB L` and `u` those
    /// parts of `z`, `Σ θ u²/(1 + θ d) − ln(1 + θ d)`.
    fn gain(&self, factor: &Mat<f64>) -> f64 {
        let gram = factor.transpose() * (&self.gram * factor);
        let Ok(parts) = gram.self_adjoint_eigen(Side::Lower) else {
            return 0.0;
        };
        let seen = parts.U().transpose() * (factor.transpose() * &self.right);
        let sizes: Vec<f64> = parts.S().column_vector().iter().copied().collect();
        let largest = sizes.iter().copied().fold(0.0, f64::max);
        let at = |theta: f64| -> f64 {
            let of = |(k, d): (usize, &f64)| {
                let grown = 1.0 + theta * d.max(0.0);
                theta * seen[(k, 0)].powi(2) / grown - grown.ln()
            };
            sizes.iter().enumerate().map(of).sum()
        };
        (0..VARIANCES)
            .map(|k| at(LEAST * STEP.powi(k) / largest.max(f64::MIN_POSITIVE)))
            .fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;

    fn biases(random: &mut rand_chacha::ChaCha8Rng, wanders: f64) -> (Biases, Vec<(usize, f64)>) {
        let times = (0..40)
            .map(|k| (0, 10.0 * f64::from(k)))
            .collect::<Vec<_>>();
        let b = Mat::from_fn(60, 40, |i, k| if i == k || i == k + 20 { 0.7 } else { 0.0 });
        let mut draw = |n: usize| -> Mat<f64> {
            Mat::from_fn(n, 1, |_, _| StandardNormal.sample(&mut *random))
        };
        let wander = kernel_factor(&times, 30.0).unwrap() * draw(40);
        let z = draw(60) + &b * (wander * faer::Scale(wanders));
        (Biases::of(&b, &z), times)
    }

    #[test]
    fn the_ratio_is_nothing_in_half_of_the_quiet_sessions_and_rarely_large() {
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(11);
        let sessions = 2000;
        let mut gains = Vec::new();
        for _ in 0..sessions {
            let (biases, times) = biases(&mut random, 0.0);
            gains.push(biases.gain(&kernel_factor(&times, 30.0).unwrap()));
        }
        let share = |limit: f64| {
            let over = gains.iter().filter(|g| **g > limit).count();
            over as f64 / f64::from(sessions)
        };
        // Half of χ²₁ beyond 2.706 is 5 %; 2000 sessions leave 0.5 % of standard error.
        assert!(share(2.706) < 0.06, "{}", share(2.706));
        assert!(share(2.706) > 0.02, "{}", share(2.706));
        assert!(share(1e-9) < 0.6, "{}", share(1e-9));
    }

    #[test]
    fn a_bias_that_wanders_by_twice_the_noise_shows() {
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(12);
        let (biases, times) = biases(&mut random, 2.0);
        assert!(biases.gain(&kernel_factor(&times, 30.0).unwrap()) > 20.0);
    }

    #[test]
    fn what_differs_between_recordings_is_no_wandering() {
        let times: Vec<(usize, f64)> = (0..12).map(|k| (k / 7, 10.0 * k as f64)).collect();
        let factor = kernel_factor(&times, 30.0).unwrap();
        let kernel = &factor * factor.transpose();
        let by_recording = Mat::from_fn(12, 2, |k, r| f64::from(u8::from(times[k].0 == r)));
        // What is added to the diagonal is left of it.
        assert!((&kernel * by_recording).norm_max() < 2e-9);
        assert!(kernel[(0, 0)] > 0.3 && kernel[(0, 8)].abs() < 1e-12);
    }
}
