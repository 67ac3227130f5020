//! Location and scatter that outliers do not move.
//!
//! Orthogonalised Gnanadesikan–Kettenring estimate (Maronna & Zamar 2002, Technometrics 44, section 2) over medians and median
//! absolute deviations, two rounds, reweighted at the 0.9 quantile.

use calib::methods::chance;
use nalgebra::{DMatrix, DVector, SymmetricEigen};
use statrs::distribution::{ChiSquared, ContinuousCDF};

/// Median absolute deviation of a normal distribution times this is its standard deviation.
const OF_NORMAL: f64 = 1.482_602_218_505_602;
/// Share of a normal sample that the reweighting keeps.
const KEPT: f64 = 0.9;

/// The median; NaN of nothing.
pub fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    match sorted.len() {
        0 => f64::NAN,
        n if n % 2 == 1 => sorted[n / 2],
        n => 0.5 * (sorted[n / 2 - 1] + sorted[n / 2]),
    }
}

/// Standard deviation by the median absolute deviation.
pub fn spread(values: &[f64]) -> f64 {
    let centre = median(values);
    let deviations: Vec<f64> = values.iter().map(|v| (v - centre).abs()).collect();
    OF_NORMAL * median(&deviations)
}

/// Location and covariance of a sample, half of which may be anything.
pub fn robust_location_scatter(sample: &[DVector<f64>]) -> (DVector<f64>, DMatrix<f64>) {
    let p = sample.first().map_or(0, DVector::len);
    let column =
        |sample: &[DVector<f64>], k: usize| sample.iter().map(|v| v[k]).collect::<Vec<f64>>();
    let scale = DVector::from_fn(p, |k, _| match spread(&column(sample, k)) {
        s if s > 0.0 => s,
        _ => 1.0,
    });
    let unit: Vec<DVector<f64>> = sample.iter().map(|v| v.component_div(&scale)).collect();
    // Columns of `basis` carry scores back to parameters.
    let (mut scores, mut basis) = (unit.clone(), DMatrix::identity(p, p));
    for _ in 0..2 {
        let d = DVector::from_fn(p, |k, _| match spread(&column(&scores, k)) {
            s if s > 0.0 => s,
            _ => 1.0,
        });
        let y: Vec<DVector<f64>> = scores.iter().map(|v| v.component_div(&d)).collect();
        let pair = |i: usize, j: usize| {
            if i == j {
                return 1.0;
            }
            let (a, b) = (column(&y, i), column(&y, j));
            let of = |sign: f64| {
                spread(
                    &a.iter()
                        .zip(&b)
                        .map(|(a, b)| a + sign * b)
                        .collect::<Vec<_>>(),
                )
                .powi(2)
            };
            let (sum, difference) = (of(1.0), of(-1.0));
            (sum - difference) / (sum + difference).max(f64::MIN_POSITIVE)
        };
        let mut correlation = DMatrix::identity(p, p);
        for i in 0..p {
            for j in 0..i {
                let r = pair(i, j);
                (correlation[(i, j)], correlation[(j, i)]) = (r, r);
            }
        }
        let axes = SymmetricEigen::new(correlation).eigenvectors;
        scores = y.iter().map(|v| axes.transpose() * v).collect();
        basis = basis * DMatrix::from_diagonal(&d) * axes;
    }
    let centre = DVector::from_fn(p, |k, _| median(&column(&scores, k)));
    let widths = DVector::from_fn(p, |k, _| match spread(&column(&scores, k)) {
        s if s > 0.0 => s,
        _ => 1e-12,
    });
    let distance = |v: &DVector<f64>| (v - &centre).component_div(&widths).norm_squared();
    let distances: Vec<f64> = scores.iter().map(distance).collect();
    let (location, covariance) = reweighted(&unit, &distances, p).unwrap_or_else(|| {
        let squares = DMatrix::from_diagonal(&widths.component_mul(&widths));
        (&basis * &centre, &basis * squares * basis.transpose())
    });
    let back = DMatrix::from_diagonal(&scale);
    (location.component_mul(&scale), &back * covariance * &back)
}

/// Mean and covariance of what is nearer than the quantile, made consistent for a normal sample.
fn reweighted(
    sample: &[DVector<f64>],
    distances: &[f64],
    p: usize,
) -> Option<(DVector<f64>, DMatrix<f64>)> {
    let freedom = ChiSquared::new(p as f64).ok()?;
    let quantile = freedom.inverse_cdf(KEPT);
    let limit = quantile * median(distances) / freedom.inverse_cdf(0.5);
    let near: Vec<&DVector<f64>> = sample
        .iter()
        .zip(distances)
        .filter(|(_, d)| **d <= limit)
        .map(|(v, _)| v)
        .collect();
    if near.len() <= 2 * p {
        return None;
    }
    let n = near.len() as f64;
    let mean = near.iter().fold(DVector::zeros(p), |sum, v| sum + *v) / n;
    let mut covariance = DMatrix::zeros(p, p);
    for v in near {
        let d = v - &mean;
        covariance += &d * d.transpose();
    }
    // Croux & Haesbroeck 1999: what cutting at the quantile takes off a normal covariance.
    let consistent = KEPT / ChiSquared::new(p as f64 + 2.0).ok()?.cdf(quantile);
    Some((mean, covariance * (consistent / (n - 1.0))))
}

/// A device far from the others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outlier {
    /// Its place in the sample.
    pub index: usize,
    /// Mahalanobis distance.
    pub distance: f64,
    /// Chance of a device being so far out, over the whole sample (Bonferroni).
    pub p_value: f64,
    /// The parameter in which it is furthest.
    pub parameter: usize,
    /// By how many standard deviations.
    pub deviation: f64,
}

/// Devices that chance does not explain at `alpha` over the whole sample, the furthest first.
pub fn outliers(sample: &[DVector<f64>], alpha: f64) -> Vec<Outlier> {
    let p = sample.first().map_or(0, DVector::len);
    if p == 0 || sample.len() < 3 * p {
        return Vec::new();
    }
    let (centre, scatter) = robust_location_scatter(sample);
    // Of a device that had no say in a covariance of `m` others the distance is an F (Hardin & Rocke 2005, JCGS 14, section 3).
    let (m, q) = (KEPT * sample.len() as f64, p as f64);
    let to_f = m * (m - q) / (q * (m + 1.0) * (m - 1.0));
    let Some(factor) = scatter.clone().cholesky() else {
        return Vec::new();
    };
    let far = |(index, v): (usize, &DVector<f64>)| {
        let d = v - &centre;
        let squared = d.dot(&factor.solve(&d));
        let p_value = (chance::of_f(squared * to_f, [q, m - q]) * sample.len() as f64).min(1.0);
        let z = |k: usize| d[k] / scatter[(k, k)].sqrt();
        let parameter = (0..p).max_by(|a, b| z(*a).abs().total_cmp(&z(*b).abs()))?;
        (p_value < alpha).then(|| Outlier {
            index,
            distance: squared.sqrt(),
            p_value,
            parameter,
            deviation: z(parameter),
        })
    };
    let mut found: Vec<Outlier> = sample.iter().enumerate().filter_map(far).collect();
    found.sort_by(|a, b| b.distance.total_cmp(&a.distance));
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Quantiles of a normal distribution in an order that mixes them, correlated.
    fn sample() -> Vec<DVector<f64>> {
        let normal = statrs::distribution::Normal::standard();
        let n = 997;
        let quantile = |k: usize| normal.inverse_cdf((k as f64 + 0.5) / n as f64);
        (0..n)
            .map(|k| {
                let (a, b) = (quantile(k), quantile(k * 389 % n));
                DVector::from_vec(vec![3.0 + a, 1e-3 * (0.8 * a + 0.6 * b)])
            })
            .collect()
    }

    #[test]
    fn a_fifth_of_outliers_moves_neither_location_nor_scatter() {
        let mut sample = sample();
        for v in sample.iter_mut().step_by(5) {
            *v = DVector::from_vec(vec![50.0, -0.1]);
        }
        let (centre, scatter) = robust_location_scatter(&sample);
        assert!(
            (centre[0] - 3.0).abs() < 0.1 && centre[1].abs() < 1e-4,
            "{centre}"
        );
        // A fifth on one side moves a median absolute deviation by a third, its square by three quarters; most of that is taken back.
        assert!((0.9..1.3).contains(&scatter[(0, 0)]), "{scatter}");
        let correlation = scatter[(0, 1)] / (scatter[(0, 0)] * scatter[(1, 1)]).sqrt();
        assert!((correlation - 0.8).abs() < 0.05, "{scatter}");
        assert_eq!(outliers(&sample, 0.01).len(), 200);
    }

    #[test]
    fn a_clean_sample_has_its_own_scatter_and_no_outliers() {
        let (_, scatter) = robust_location_scatter(&sample());
        assert!((scatter[(0, 0)] - 1.0).abs() < 0.05, "{scatter}");
        assert!((scatter[(1, 1)] * 1e6 - 1.0).abs() < 0.07, "{scatter}");
        assert!(outliers(&sample(), 0.01).is_empty());
    }
}
