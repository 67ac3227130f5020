//! A bias that wanders otherwise than at random: scatter of one axis, with a memory of seconds to minutes.

use faer::linalg::solvers::Solve;
use faer::{Mat, Side};
use findings::{Finding, Kind};
use sensor::Sensor;

use super::biases::{AtLevel, Biases, OfSensor};
use crate::family::beside;
use crate::score::log_tail;

/// Memories tried, s.
const MEMORIES: [f64; 3] = [10.0, 30.0, 100.0];

findings::tuning! {
    /// Variances tried.
    VARIANCES: i32 = 16;
    /// The least of them, as a share of the noise in what the data show best.
    LEAST: f64 = 1e-2;
    /// Ratio of one to the one before.
    STEP: f64 = 2.0;

    /// Products by which the largest eigenvalue is found: a little off moves all variances tried by as little.
    POWERS: usize = 100;
}

/// More scatter of one axis than the noise allows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scatter {
    /// The sensor.
    pub sensor: Sensor,
    /// The axis.
    pub axis: usize,
    /// Its memory, s.
    pub memory: f64,
    /// The likelihood ratio.
    pub statistic: f64,
    /// `ln p`, the memories tried paid for.
    pub log_p: f64,
}

impl Scatter {
    /// Returns true if its correlation time is at most the shortest one tried, that of one static interval: it need not
    /// depend on time at all.
    pub fn is_forgotten(&self) -> bool {
        self.memory <= MEMORIES[0]
    }

    /// The finding. Jumps to and fro have the covariance of a wandering.
    pub fn finding(&self) -> Finding {
        let kind = match self.is_forgotten() {
            true => Kind::BIAS_SCATTERS,
            false => Kind::BIAS_WANDERS,
        };
        Finding::of(kind)
            .of_sensor(self.sensor)
            .detail("axis", ["x", "y", "z"][self.axis])
            .number("memory", self.memory, "s")
    }
}

/// The test of every axis of every sensor.
///
/// A bias on one axis with covariance `θ K`, `K_st = exp(−|s − t|/τ)` over the chunks, against none, by the likelihood
/// ratio `2 max (LL(θ, k) − LL(0, k₀))`: the walk's density `k` is profiled under both, or it takes what wanders
/// for a walk. Where nothing is missing, `θ` is at the edge of what it may be and the ratio is nothing in half of the
/// cases and `χ²₁` in the others (Self & Liang 1987).
pub(super) fn scatters(sensors: &[OfSensor]) -> Vec<Scatter> {
    sensors.iter().flat_map(of_sensor).collect()
}

fn of_sensor(own: &OfSensor) -> Vec<Scatter> {
    let times = &own.times;
    let is_alone = times.iter().all(|(recording, _)| *recording == times[0].0);
    let kernel = |memory: f64| {
        let of = |chunks: &Vec<usize>| {
            let of_part: Vec<(usize, f64)> = chunks.iter().map(|&k| times[k]).collect();
            kernel_factor(&of_part, memory, is_alone)
        };
        let factors = own.together.iter().map(of);
        Some((memory, factors.collect::<Option<Vec<_>>>()?))
    };
    let kernels: Vec<_> = MEMORIES.into_iter().filter_map(kernel).collect();
    let of_axis = |(axis, levels): (usize, &Vec<AtLevel>)| {
        let mut best = (0.0, MEMORIES[0]);
        for level in levels {
            for (memory, factors) in &kernels {
                let ratio = 2.0 * level.gained + level.biases.gain(factors);
                if ratio > best.0 {
                    best = (ratio, *memory);
                }
            }
        }
        Scatter {
            sensor: own.sensor,
            axis,
            memory: best.1,
            statistic: best.0,
            log_p: log_tail(best.0, 1.0) + (0.5 * MEMORIES.len() as f64).ln(),
        }
    };
    own.axes.iter().enumerate().map(of_axis).collect()
}

/// `L` of `K = L Lᵀ`, for chunks of recordings at times since their start: no bias remembers another recording, and where
/// there are several what differs between them as a whole is a bias of each and no wandering.
fn kernel_factor(times: &[(usize, f64)], memory: f64, is_alone: bool) -> Option<Mat<f64>> {
    let n = times.len();
    let alike = |i: usize, j: usize| {
        let ((one, a), (other, b)) = (times[i], times[j]);
        let fades = (-(a - b).abs() / memory).exp();
        if one == other { fades } else { 0.0 }
    };
    let mut kernel = Mat::from_fn(n, n, alike);
    if !is_alone {
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

impl Biases {
    /// `2 max_θ (LL(θ) − LL(0))` for `V = I + θ B L Lᵀ Bᵀ`, `L` recording by recording: with `d` the eigenvalues of
    /// `Lᵀ diag(G_p) L` and `u` those parts of `z`, `Σ θ u²/(1 + θ d) − ln(1 + θ d)`, and what recordings share put right.
    fn gain(&self, factors: &[Mat<f64>]) -> f64 {
        let mut sizes = Vec::new();
        let (mut seen, mut taken) = (Vec::new(), Vec::new());
        for (own, factor) in self.parts.iter().zip(factors) {
            if factor.ncols() == 0 {
                continue;
            }
            let gram = factor.transpose() * (&own.gram * factor);
            let Ok(parts) = gram.self_adjoint_eigen(Side::Lower) else {
                return 0.0;
            };
            sizes.extend(parts.S().column_vector().iter().copied());
            let right = parts.U().transpose() * (factor.transpose() * &own.right);
            seen.extend(right.col(0).iter().copied());
            if self.shared > 0 {
                taken.push(&own.taken * factor * parts.U());
            }
        }
        let taken = beside(&taken, self.shared);
        let largest = largest(&sizes, &taken);
        let at = |theta: f64| -> f64 {
            let of = |(k, d): (usize, &f64)| {
                let grown = 1.0 + theta * d.max(0.0);
                theta * seen[k].powi(2) / grown - grown.ln()
            };
            let alone: f64 = sizes.iter().enumerate().map(of).sum();
            alone + by_shared(theta, &sizes, &seen, &taken)
        };
        (0..VARIANCES.get())
            .map(|k| at(LEAST.get() * STEP.get().powi(k) / largest.max(f64::MIN_POSITIVE)))
            .fold(0.0, f64::max)
    }
}

/// Computes the contribution of `Y` (`s × n`) to `θ uᵀ M⁻¹ u − ln |M|`, `M = E − θ YᵀY` with the diagonal `E = 1 + θ d`:
/// `wᵀ K⁻¹ w − ln |K|` with `K = I − θ Y E⁻¹ Yᵀ` and `w = θ Y E⁻¹ u` (Woodbury).
fn by_shared(theta: f64, sizes: &[f64], seen: &[f64], taken: &Mat<f64>) -> f64 {
    let s = taken.nrows();
    if s == 0 {
        return 0.0;
    }
    let grown = |k: usize| 1.0 + theta * sizes[k].max(0.0);
    let weighed = Mat::from_fn(s, taken.ncols(), |i, k| theta * taken[(i, k)] / grown(k));
    let inner = Mat::<f64>::identity(s, s) - &weighed * taken.transpose();
    let Ok(factor) = inner.llt(Side::Lower) else {
        return f64::NEG_INFINITY;
    };
    let w = &weighed * Mat::from_fn(seen.len(), 1, |k, _| seen[k]);
    let moved = factor.solve(&w);
    let log_determinant: f64 = (0..s).map(|k| 2.0 * factor.L()[(k, k)].ln()).sum();
    (w.transpose() * moved)[(0, 0)] - log_determinant
}

/// The largest eigenvalue of `diag(d) − YᵀY`, by powers.
fn largest(sizes: &[f64], taken: &Mat<f64>) -> f64 {
    let greatest = sizes.iter().copied().fold(0.0, f64::max);
    if taken.nrows() == 0 {
        return greatest;
    }
    let n = sizes.len();
    let mut v = Mat::from_fn(n, 1, |k, _| sizes[k].max(0.0).sqrt());
    let mut found = 0.0;
    for _ in 0..POWERS.get() {
        let norm = v.norm_l2();
        if norm == 0.0 || !norm.is_finite() {
            return greatest;
        }
        v *= faer::Scale(norm.recip());
        let shared = taken.transpose() * (taken * &v);
        let next = Mat::from_fn(n, 1, |k, _| sizes[k] * v[(k, 0)] - shared[(k, 0)]);
        found = (v.transpose() * &next)[(0, 0)];
        v = next;
    }
    found
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;
    use crate::remainder::biases::Own;

    fn alone(b: &Mat<f64>, z: &Mat<f64>) -> Biases {
        let own = Own {
            gram: b.transpose() * b,
            right: b.transpose() * z,
            taken: Mat::zeros(0, b.ncols()),
        };
        Biases {
            parts: vec![own],
            shared: 0,
        }
    }

    #[test]
    fn recordings_that_share_parameters_gain_what_all_chunks_together_gain() {
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(13);
        let mut draw = |rows: usize, columns: usize| -> Mat<f64> {
            Mat::from_fn(rows, columns, |_, _| StandardNormal.sample(&mut random))
        };
        // Two recordings of 12 rows and 5 chunks, of which 3 directions over all rows are taken out.
        let blocks = [draw(12, 5), draw(12, 5)];
        let whole = Mat::from_fn(24, 10, |i, k| match i / 12 == k / 5 {
            true => blocks[i / 12][(i % 12, k % 5)],
            false => 0.0,
        });
        let basis = estimate::methods::joint::orthonormal(&draw(24, 3));
        let out = |a: &Mat<f64>| a - &basis * (basis.transpose() * a);
        let z = out(&(draw(24, 1) + &whole * draw(10, 1)));
        let times: Vec<(usize, f64)> = (0..10).map(|k| (k / 5, 10.0 * (k % 5) as f64)).collect();
        let factor = |times: &[(usize, f64)]| kernel_factor(times, 30.0, false).unwrap();
        let together = alone(&out(&whole), &z).gain(&[factor(&times)]);
        let taken = basis.transpose() * &whole;
        let own = |part: usize| Own {
            gram: blocks[part].transpose() * &blocks[part],
            right: blocks[part].transpose() * z.as_ref().subrows(12 * part, 12),
            taken: taken.as_ref().subcols(5 * part, 5).to_owned(),
        };
        let cut = Biases {
            parts: vec![own(0), own(1)],
            shared: 3,
        };
        let cut = cut.gain(&[factor(&times[..5]), factor(&times[5..])]);
        assert!(
            together > 1.0 && (cut / together - 1.0).abs() < 1e-6,
            "{cut} {together}"
        );
    }

    fn biases(random: &mut rand_chacha::ChaCha8Rng, wanders: f64) -> (Biases, Vec<(usize, f64)>) {
        let times = (0..40)
            .map(|k| (0, 10.0 * f64::from(k)))
            .collect::<Vec<_>>();
        let b = Mat::from_fn(60, 40, |i, k| if i == k || i == k + 20 { 0.7 } else { 0.0 });
        let mut draw = |n: usize| -> Mat<f64> {
            Mat::from_fn(n, 1, |_, _| StandardNormal.sample(&mut *random))
        };
        let wander = kernel_factor(&times, 30.0, true).unwrap() * draw(40);
        let z = draw(60) + &b * (wander * faer::Scale(wanders));
        (alone(&b, &z), times)
    }

    #[test]
    fn the_ratio_is_nothing_in_half_of_the_quiet_sessions_and_rarely_large() {
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(11);
        let sessions = 2000;
        let mut gains = Vec::new();
        for _ in 0..sessions {
            let (biases, times) = biases(&mut random, 0.0);
            gains.push(biases.gain(&[kernel_factor(&times, 30.0, true).unwrap()]));
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
        assert!(biases.gain(&[kernel_factor(&times, 30.0, true).unwrap()]) > 20.0);
    }

    #[test]
    fn what_differs_between_recordings_is_no_wandering() {
        let times: Vec<(usize, f64)> = (0..12).map(|k| (k / 7, 10.0 * k as f64)).collect();
        let factor = kernel_factor(&times, 30.0, false).unwrap();
        let kernel = &factor * factor.transpose();
        let by_recording = Mat::from_fn(12, 2, |k, r| f64::from(u8::from(times[k].0 == r)));
        // What is added to the diagonal is left of it.
        assert!((&kernel * by_recording).norm_max() < 2e-9);
        assert!(kernel[(0, 0)] > 0.3 && kernel[(0, 8)].abs() < 1e-12);
    }
}
