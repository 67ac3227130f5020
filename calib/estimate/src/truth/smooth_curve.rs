//! A smooth curve through noisy readings, and its derivative.
//!
//! A cubic spline `y(t) = Σ_j c_j B_j(t)` on even knots, the third differences of its coefficients penalised (a P-spline):
//! `min Σᵢ wᵢ (yᵢ − y(tᵢ))² + λ Σ_j (Δ³c_j)²`. The weight λ is that of the largest restricted likelihood: of readings `y` that
//! are such a curve with white third differences, and white noise. A curve that asks for more stiffness gets it, and less where
//! the readings show more than noise.
//!
//! Source: Eilers and Marx, *Flexible smoothing with B-splines and penalties*, Statistical Science 11, 1996.

/// Order of the differences, and rows that a row of the normal equations is coupled to on either side.
const ORDER: usize = 3;
/// `Δ³`.
const DIFFERENCE: [f64; ORDER + 1] = [-1.0, 3.0, -3.0, 1.0];

findings::tuning! {
    /// Knots at most: stamps that are wrong by days do not fill the memory.
    MOST_KNOTS: usize = 10_000;

    /// Steps of the stiffness: `λ = w (τ/h)⁶`, `w` the weight of the readings in one knot interval `h`, and `τ` from `h` to `32 h`
    /// in steps of √2. By `λ` the curve forgets within about τ. Beyond 32 knots, rounding would show (λ = 10⁹ w).
    STEPS: i32 = 11;
}

/// A row of a symmetric banded matrix: the diagonal, and what follows it.
type Row = [f64; ORDER + 1];

/// One reading.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reading {
    pub t: f64,
    pub value: f64,
    pub weight: f64,
}

/// A cubic spline on even knots.
#[derive(Clone, Debug)]
pub(super) struct SmoothCurve {
    start: f64,
    end: f64,
    /// Between knots, s.
    spacing: f64,
    coefficients: Vec<f64>,
}

impl SmoothCurve {
    /// Through readings in order of time, with knots every `spacing`; `None` of too few readings for a parabola and its noise,
    /// or where they are all at one time.
    pub fn through(readings: &[Reading], spacing: f64) -> Option<Self> {
        let (first, last) = (readings.first()?, readings.last()?);
        let length = last.t - first.t;
        if readings.len() <= ORDER + 1 || !(length > 0.0 && length.is_finite()) {
            return None;
        }
        let spacing = spacing.max(length / MOST_KNOTS.get() as f64);
        let mut curve = Self {
            start: first.t,
            end: last.t,
            spacing,
            coefficients: vec![0.0; (length / spacing).ceil() as usize + ORDER],
        };
        let middle = readings.iter().map(|r| r.value).sum::<f64>() / readings.len() as f64;
        let sums = Sums::of(readings, &curve, middle);
        let fits =
            (0..STEPS.get()).filter_map(|step| sums.fit(2.0_f64.powf(0.5 * f64::from(step))));
        let (_, coefficients) = fits.max_by(|a, b| a.0.total_cmp(&b.0))?;
        curve.coefficients = coefficients.iter().map(|c| c + middle).collect();
        Some(curve)
    }

    /// Its derivative, per second; constant outside of the readings.
    pub fn slope(&self, t: f64) -> f64 {
        let (knot, u) = self.place(t);
        let v = 1.0 - u;
        let slopes = [
            -0.5 * v * v,
            u * (1.5 * u - 2.0),
            0.5 + u * (1.0 - 1.5 * u),
            0.5 * u * u,
        ];
        self.sum(knot, slopes) / self.spacing
    }

    /// The mean of its derivative from one time to another.
    pub fn mean_slope(&self, from: f64, to: f64) -> f64 {
        let [inner_from, inner_to] = [from, to].map(|t| t.clamp(self.start, self.end));
        if inner_to > inner_from {
            (self.at(inner_to) - self.at(inner_from)) / (inner_to - inner_from)
        } else {
            self.slope(0.5 * (from + to))
        }
    }

    fn at(&self, t: f64) -> f64 {
        let (knot, u) = self.place(t);
        self.sum(knot, values(u))
    }

    /// The knot before `t`, and the part of its interval that has passed.
    fn place(&self, t: f64) -> (usize, f64) {
        let x = (t.clamp(self.start, self.end) - self.start) / self.spacing;
        let knot = (x as usize).min(self.coefficients.len() - ORDER - 1);
        (knot, x - knot as f64)
    }

    fn sum(&self, knot: usize, parts: Row) -> f64 {
        let near = &self.coefficients[knot..=knot + ORDER];
        near.iter().zip(parts).map(|(c, part)| c * part).sum()
    }
}

/// The four cubic B-splines that are not zero, at part `u` of a knot interval.
fn values(u: f64) -> Row {
    let v = 1.0 - u;
    [
        v * v * v / 6.0,
        (4.0 + u * u * (3.0 * u - 6.0)) / 6.0,
        (4.0 + v * v * (3.0 * v - 6.0)) / 6.0,
        u * u * u / 6.0,
    ]
}

/// The normal equations of the readings without the penalty.
struct Sums {
    normal: Vec<Row>,
    right: Vec<f64>,
    /// `Σ w y²`
    square: f64,
    /// Weight of the readings in one knot interval.
    weight: f64,
    readings: usize,
}

impl Sums {
    fn of(readings: &[Reading], curve: &SmoothCurve, middle: f64) -> Self {
        let count = curve.coefficients.len();
        let mut sums = Self {
            normal: vec![[0.0; ORDER + 1]; count],
            right: vec![0.0; count],
            square: 0.0,
            weight: 0.0,
            readings: readings.len(),
        };
        for reading in readings {
            let (knot, u) = curve.place(reading.t);
            let (parts, y) = (values(u), reading.value - middle);
            for (i, part) in parts.iter().enumerate() {
                let weighted = reading.weight * part;
                sums.right[knot + i] += weighted * y;
                for (k, other) in parts[i..].iter().enumerate() {
                    sums.normal[knot + i][k] += weighted * other;
                }
            }
            sums.square += reading.weight * y * y;
            sums.weight += reading.weight;
        }
        sums.weight /= (count - ORDER) as f64;
        sums
    }

    /// Restricted log-likelihood and coefficients at the stiffness `τ/h`: `½(n − 3) ln λ − ½ ln|N + λP| − ½(m − 3) ln S` for
    /// `m` readings, `n` coefficients and the sum `S` at its minimum.
    fn fit(&self, tau: f64) -> Option<(f64, Vec<f64>)> {
        let lambda = self.weight * tau.powi(2 * ORDER as i32);
        let mut rows = self.normal.clone();
        for first in 0..rows.len() - ORDER {
            for (i, a) in DIFFERENCE.iter().enumerate() {
                for (k, b) in DIFFERENCE[i..].iter().enumerate() {
                    rows[first + i][k] += lambda * a * b;
                }
            }
        }
        let log_determinant = factorise(&mut rows)?;
        let coefficients = solve(&rows, &self.right);
        let explained: f64 = self
            .right
            .iter()
            .zip(&coefficients)
            .map(|(r, c)| r * c)
            .sum();
        // The difference of two sums of squares is good to their rounding.
        let left = (self.square - explained).max(1e-13 * self.square + f64::MIN_POSITIVE);
        let curved = (rows.len() - ORDER) as f64 * lambda.ln();
        let noisy = (self.readings - ORDER) as f64 * left.ln();
        Some((0.5 * (curved - log_determinant - noisy), coefficients))
    }
}

/// `A = L D Lᵀ` in place: the diagonal holds `D`, what follows it the column of `L`. The logarithm of the determinant;
/// `None` unless positive definite.
fn factorise(rows: &mut [Row]) -> Option<f64> {
    let mut log_determinant = 0.0;
    for j in 0..rows.len() {
        let pivot = rows[j][0];
        if !(pivot > 0.0 && pivot.is_finite()) {
            return None;
        }
        log_determinant += pivot.ln();
        let column = rows[j];
        let reach = ORDER.min(rows.len() - 1 - j);
        for i in 1..=reach {
            let factor = column[i] / pivot;
            for k in i..=reach {
                rows[j + i][k - i] -= factor * column[k];
            }
            rows[j][i] = factor;
        }
    }
    Some(log_determinant)
}

fn solve(factors: &[Row], right: &[f64]) -> Vec<f64> {
    let mut x = right.to_vec();
    for (j, row) in factors.iter().enumerate() {
        let own = x[j];
        for (next, factor) in x[j + 1..].iter_mut().zip(&row[1..]) {
            *next -= factor * own;
        }
    }
    for (j, row) in factors.iter().enumerate().rev() {
        let after: f64 = x[j + 1..].iter().zip(&row[1..]).map(|(x, l)| x * l).sum();
        x[j] = x[j] / row[0] - after;
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    fn readings(of: impl Fn(f64) -> f64) -> Vec<Reading> {
        let reading = |k: u32| Reading {
            t: 3.0 + 1.7 * f64::from(k),
            value: of(3.0 + 1.7 * f64::from(k)),
            weight: 1.0,
        };
        (0..100).map(reading).collect()
    }

    #[test]
    fn a_parabola_is_its_own_curve_however_stiff() {
        let parabola = |t: f64| 20.0 + 0.3 * t - 2e-3 * t * t;
        let curve = SmoothCurve::through(&readings(parabola), 4.0).unwrap();
        for t in [3.0, 50.5, 171.3] {
            assert!((curve.at(t) - parabola(t)).abs() < 1e-5, "{t}");
            assert!((curve.slope(t) - (0.3 - 4e-3 * t)).abs() < 1e-6, "{t}");
        }
        let mean = 0.3 - 4e-3 * 45.0;
        assert!((curve.mean_slope(40.0, 50.0) - mean).abs() < 1e-6);
        assert_eq!(curve.slope(1e6), curve.slope(171.3));
    }

    #[test]
    fn the_slope_is_the_derivative_of_the_curve() {
        let curve = SmoothCurve::through(&readings(|t| (0.1 * t).sin()), 4.0).unwrap();
        for t in [4.0, 7.0, 61.9, 165.0] {
            let by_differences = curve.mean_slope(t - 1e-3, t + 1e-3);
            assert!((curve.slope(t) - by_differences).abs() < 1e-7, "{t}");
        }
    }

    #[test]
    fn too_few_readings_or_all_at_once_are_no_curve() {
        assert!(SmoothCurve::through(&readings(|t| t)[..4], 4.0).is_none());
        let mut at_once = readings(|t| t);
        at_once.iter_mut().for_each(|r| r.t = 1.0);
        assert!(SmoothCurve::through(&at_once, 4.0).is_none());
    }
}
