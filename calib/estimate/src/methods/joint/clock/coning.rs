//! From window means of the rate to the rotation over each window: coning terms of any width.

use nalgebra::Vector3;

/// Windows on either side of the one being integrated.
pub const REACH: usize = 3;
/// Windows that the rotation over one of them is taken from.
pub const WINDOWS: usize = 2 * REACH + 1;

/// The same, filled up to what vector registers hold.
const PADDED: usize = WINDOWS + 1;

/// Nodes of the Gauss–Legendre rule on [−1, 1] with five points: exact to degree 9 and, by symmetry
/// of what is integrated here, enough for the products of degree 13 after splitting the window.
const NODES: [(f64, f64); 5] = [
    (0.0, 128.0 / 225.0),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
    (0.906_179_845_938_664, 0.236_926_885_056_189_08),
    (-0.906_179_845_938_664, 0.236_926_885_056_189_08),
];

/// The second Magnus term of a window as a bilinear form of the angles of the windows around it.
///
/// A sample is the mean of the rate over its window, so `θ_k = ω̄_k h_k` is exact. Over window 0 the
/// rotation vector is
///
/// `φ = θ₀ + ½ Σ_ab K_ab θ_a × θ_b`, `K_ab = −K_ba`,
///
/// where `½ ΣΣ` is `½ ∫ α × ω dt` (`α` the angle since the begin of the window) of the polynomial
/// rate that has the window means of the `2·3 + 1` windows around. With one neighbour on either side
/// the only weight is the classical `1/24 · θ₀ × (θ₁ − θ₋₁)`, exact for a rate linear in time; with
/// three it keeps a hand's tremor of 10 Hz at 100 samples per second. What is left out are the terms
/// of third order in the angle.
#[derive(Clone, Copy, Debug)]
pub struct Coning {
    /// `K_cb`, one array over `c` for every `b`, zero beyond.
    columns: [[f64; PADDED]; WINDOWS],
    /// `w_c`, where the samples are at instants: the angle over window 0 is `Σ_c w_c θ_c`, and not `θ₀`.
    direct: Option<[f64; WINDOWS]>,
}

impl Coning {
    /// Builds the terms for samples that are means over their windows.
    pub fn new() -> Self {
        Self {
            columns: weights(angles_since, rates),
            direct: None,
        }
    }

    /// Builds the terms for samples at the middles of their windows, `θ_k = ω_k h_k`: the rate is the polynomial
    /// through them.
    pub fn at_instants() -> Self {
        Self {
            columns: weights(instants_angles_since, instants_rates),
            direct: Some(instants_angles_since(-0.5, 0.5)),
        }
    }

    /// The weights `w_c` of the angles in the angle over the middle window, where they are not that window's alone.
    pub fn direct(&self) -> Option<&[f64; WINDOWS]> {
        self.direct.as_ref()
    }

    /// The rotation vector over the middle one of seven windows with the given angles (rad), and per window
    /// the `v` with `∂φ = ∂θ₀ + Σ_c ∂θ_c × v_c`: `v_c = Σ_b K_cb θ_b`.
    #[inline(always)]
    pub fn rotation(
        &self,
        angles: &[Vector3<f64>; WINDOWS],
    ) -> (Vector3<f64>, [Vector3<f64>; WINDOWS]) {
        // Axis by axis over all windows at once: this is the innermost loop of every fit.
        let mut by_axis = [[0.0; PADDED]; 3];
        for (angle, weights) in angles.iter().zip(&self.columns) {
            for (sums, angle) in by_axis.iter_mut().zip(angle.iter()) {
                for (sum, weight) in sums.iter_mut().zip(weights) {
                    *sum += weight * angle;
                }
            }
        }
        let [x, y, z] = &by_axis;
        let sums = std::array::from_fn(|c| Vector3::new(x[c], y[c], z[c]));
        let mut twice = Vector3::zeros();
        for (angle, sum) in angles.iter().zip(&sums) {
            twice += angle.cross(sum);
        }
        let angle = match &self.direct {
            Some(direct) => angles.iter().zip(direct).map(|(a, w)| a * *w).sum(),
            None => angles[REACH],
        };
        (angle + twice * 0.5, sums)
    }
}

/// `K_cb` for a rate of which `angle` gives the integrals and `rate` the values, per unit angle of each window.
fn weights(
    angle: impl Fn(f64, f64) -> [f64; WINDOWS],
    rate: impl Fn(f64) -> [f64; WINDOWS],
) -> [[f64; PADDED]; WINDOWS] {
    let mut columns = [[0.0; PADDED]; WINDOWS];
    // Four parts of the window: the rule is then exact to rounding.
    let parts = 4;
    for part in 0..parts {
        let half = 0.5 / f64::from(parts);
        let middle = -0.5 + half * f64::from(2 * part + 1);
        for (node, weight) in NODES {
            let t = middle + half * node;
            let (angle, rate) = (angle(-0.5, t), rate(t));
            for a in 0..WINDOWS {
                for b in 0..WINDOWS {
                    let term = angle[a] * rate[b] - angle[b] * rate[a];
                    columns[b][a] += 0.5 * weight * half * term;
                }
            }
        }
    }
    columns
}

/// Value at `t` of the polynomials that are 1 at one sample's instant and 0 at the others.
fn instants_rates(t: f64) -> [f64; WINDOWS] {
    let at = |k: usize| k as f64 - REACH as f64;
    std::array::from_fn(|a| {
        let others = (0..WINDOWS).filter(|&b| b != a);
        others.map(|b| (t - at(b)) / (at(a) - at(b))).product()
    })
}

/// Their integrals.
fn instants_angles_since(from: f64, to: f64) -> [f64; WINDOWS] {
    let half = 0.5 * (to - from);
    let mut sums = [0.0; WINDOWS];
    for (node, weight) in NODES {
        let rates = instants_rates(from + half * (1.0 + node));
        for (sum, rate) in sums.iter_mut().zip(rates) {
            *sum += weight * half * rate;
        }
    }
    sums
}

/// Place of edge `j` of the windows, in windows from the middle of window 0.
fn edge(j: usize) -> f64 {
    j as f64 - 0.5 - REACH as f64
}

/// Lagrange polynomial of edge `j` at `t`, and its derivative.
fn lagrange(j: usize, t: f64) -> (f64, f64) {
    let (mut value, mut slope) = (1.0, 0.0);
    for i in (0..=WINDOWS).filter(|&i| i != j) {
        let width = edge(j) - edge(i);
        slope = slope * (t - edge(i)) / width + value / width;
        value *= (t - edge(i)) / width;
    }
    (value, slope)
}

/// Angle from `from` to `to` per unit angle of each window: the polynomial through the sums at the edges.
fn angles_since(from: f64, to: f64) -> [f64; WINDOWS] {
    std::array::from_fn(|a| {
        (a + 1..=WINDOWS)
            .map(|j| lagrange(j, to).0 - lagrange(j, from).0)
            .sum()
    })
}

/// Rate at `t` per unit angle of each window.
fn rates(t: f64) -> [f64; WINDOWS] {
    std::array::from_fn(|a| (a + 1..=WINDOWS).map(|j| lagrange(j, t).1).sum())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rate_linear_in_time_has_the_classical_term() {
        let (a, b) = (
            Vector3::new(0.1, -0.2, 0.05),
            Vector3::new(0.02, 0.01, -0.03),
        );
        let angles = std::array::from_fn(|k| a + b * (k as f64 - 3.0));
        let (phi, _) = Coning::new().rotation(&angles);
        assert!((phi - (a + a.cross(&b) / 12.0)).norm() < 1e-16);
    }

    #[test]
    fn a_cubic_rate_has_its_integral() {
        // ω = p + q t³: α = p (t + ½) + q (t⁴ − 1/16)/4, and ½ ∫ α × ω over the window is
        // ½ p × q [1/80 − (1/80 − 1/16)/4] = ½ p × q (1/80 + 1/80) = p × q / 80.
        let (p, q) = (
            Vector3::new(0.3, 0.1, -0.2),
            Vector3::new(-0.02, 0.05, 0.01),
        );
        let mean = |k: f64| p + q * (k * k * k + 0.25 * k);
        let angles = std::array::from_fn(|k| mean(k as f64 - 3.0));
        let (phi, _) = Coning::new().rotation(&angles);
        assert!((phi - (p + p.cross(&q) / 80.0)).norm() < 1e-15);
    }

    #[test]
    fn samples_at_instants_have_the_integral_of_their_polynomial() {
        // ω = p + q t²: ∫ ω = p + q/12, and ½ ∫ α × ω = ½ p × q [∫ (t + ½) t² − ∫ (t³ + ⅛)/3] = 0 by symmetry but for
        // ∫ ½ t² = 1/24 and ∫ 1/24.
        let (p, q) = (
            Vector3::new(0.3, 0.1, -0.2),
            Vector3::new(-0.02, 0.05, 0.01),
        );
        let at = |k: f64| p + q * (k * k);
        let angles = std::array::from_fn(|k| at(k as f64 - 3.0));
        let (phi, _) = Coning::at_instants().rotation(&angles);
        assert!((phi - (p + q / 12.0)).norm() < 1e-15);
        // ω = p + q t: ½ ∫ α × ω = p × q / 12, as of means.
        let angles = std::array::from_fn(|k| p + q * (k as f64 - 3.0));
        let (phi, _) = Coning::at_instants().rotation(&angles);
        assert!((phi - (p + p.cross(&q) / 12.0)).norm() < 1e-15);
    }

    #[test]
    fn the_derivative_is_that_of_differences() {
        let coning = Coning::new();
        let angles: [Vector3<f64>; WINDOWS] = std::array::from_fn(|k| {
            Vector3::new((k as f64).sin(), (k as f64 * 1.3).cos(), 0.1 * k as f64)
        });
        let (_, sums) = coning.rotation(&angles);
        for c in 0..7 {
            for axis in 0..3 {
                let mut step = Vector3::zeros();
                step[axis] = 1e-6;
                let at = |sign: f64| {
                    let mut moved = angles;
                    moved[c] += step * sign;
                    coning.rotation(&moved).0
                };
                let difference = (at(1.0) - at(-1.0)) / 2e-6;
                let direct = if c == 3 {
                    step / 1e-6
                } else {
                    Vector3::zeros()
                };
                let exact = direct + (step / 1e-6).cross(&sums[c]);
                assert!((difference - exact).norm() < 1e-9);
            }
        }
    }
}
