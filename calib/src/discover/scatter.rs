//! A bias that wanders otherwise than at random: scatter of one axis, with a memory of seconds to minutes.

use faer::Mat;
use sensor::Sensor;

use super::projected::Whitened;
use super::score::log_tail;
use super::state::State;

/// Memories tried, s.
const MEMORIES: [f64; 3] = [10.0, 30.0, 100.0];

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
/// Of a bias on one axis with covariance `θ K`, `K_st = exp(−|s − t|/τ)` over the chunks, the score of `θ` at zero
/// is `zᵀV⁻¹ B K Bᵀ V⁻¹ z`, `B` the columns of the chunks' biases. Where nothing is missing it is a sum
/// of `χ²₁` with weights that are the eigenvalues of `K G`, `G = Bᵀ V⁻¹ B`; its tail is that of the scaled χ² of the same
/// mean and variance (Satterthwaite 1946).
pub fn scatters(state: &State, whitened: &Whitened) -> Vec<Scatter> {
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
        let times: Vec<f64> = means.iter().map(|m| m.truth.time).collect();
        for axis in 0..3 {
            let mut columns = Mat::zeros(state.rows(), means.len());
            for (k, mean) in means.iter().enumerate() {
                columns[(mean.row + axis, k)] = 1.0;
            }
            let b = whitened.columns(&state.projected.columns(state.whitened(columns).as_ref()));
            let best = MEMORIES
                .into_iter()
                .map(|memory| (tail(&b, &whitened.z, &times, memory), memory))
                .min_by(|a, b| a.0.total_cmp(&b.0));
            if let Some((log_p, memory)) = best {
                all.push(Scatter {
                    sensor,
                    axis,
                    memory,
                    log_p: log_p + (MEMORIES.len() as f64).ln(),
                });
            }
        }
    }
    all
}

fn tail(b: &Mat<f64>, z: &Mat<f64>, times: &[f64], memory: f64) -> f64 {
    let n = times.len();
    let kernel = Mat::from_fn(n, n, |i, j| {
        (-(times[i] - times[j]).abs() / memory).exp() + if i == j { 1e-9 } else { 0.0 }
    });
    let Ok(factor) = kernel.llt(faer::Side::Lower) else {
        return 0.0;
    };
    // K = L Lᵀ: the form is |Lᵀ Bᵀ z|², the weights the eigenvalues of (B L)ᵀ (B L).
    let spread = b * factor.L();
    let gram = spread.transpose() * &spread;
    let form = (spread.transpose() * z).squared_norm_l2();
    let trace: f64 = (0..n).map(|k| gram[(k, k)]).sum();
    let squares = gram.squared_norm_l2();
    if !(trace > 0.0 && squares > 0.0) {
        return 0.0;
    }
    log_tail(form * trace / squares, trace * trace / squares)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};

    #[test]
    fn one_in_twenty_of_quiet_sessions_is_in_the_upper_twentieth() {
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(11);
        let times: Vec<f64> = (0..40).map(|k| 10.0 * f64::from(k)).collect();
        let b = Mat::from_fn(60, 40, |i, k| if i == k || i == k + 20 { 0.7 } else { 0.0 });
        let sessions = 2000;
        let far = (0..sessions)
            .filter(|_| {
                let z = Mat::from_fn(60, 1, |_, _| StandardNormal.sample(&mut random));
                tail(&b, &z, &times, 30.0) < 0.05_f64.ln()
            })
            .count();
        // 2000 sessions leave 0.5 % of standard error; four, and the approximation of the tail.
        let share = far as f64 / f64::from(sessions);
        assert!((0.025..0.075).contains(&share), "{share}");
    }
}
