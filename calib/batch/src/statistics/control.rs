//! Control charts: is the line as it was?
//!
//! Constants of Montgomery, Introduction to Statistical Quality Control, appendix VI: `d2 = 1.128`, `D4 = 3.267` for moving
//! ranges of two, `c4` for standard deviations.

use statrs::function::gamma::ln_gamma;

/// Mean moving range of two per standard deviation.
const D2: f64 = std::f64::consts::FRAC_2_SQRT_PI;

/// A series with its centre and limits, which may differ from point to point.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// The series.
    pub points: Vec<f64>,
    /// Its centre.
    pub centre: f64,
    /// Lower and upper limit of each point, three standard deviations.
    pub limits: Vec<[f64; 2]>,
    /// Points beyond.
    pub beyond: Vec<usize>,
}

impl Chart {
    fn new(points: Vec<f64>, centre: f64, limits: Vec<[f64; 2]>) -> Self {
        let out = |(k, v): (usize, &f64)| (*v < limits[k][0] || *v > limits[k][1]).then_some(k);
        let beyond = points.iter().enumerate().filter_map(out).collect();
        Self {
            points,
            centre,
            limits,
            beyond,
        }
    }
}

/// Individuals and their moving ranges; none of fewer than three.
pub fn individuals(values: &[f64]) -> Option<(Chart, Chart)> {
    if values.len() < 3 {
        return None;
    }
    let ranges: Vec<f64> = values.windows(2).map(|w| (w[1] - w[0]).abs()).collect();
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let range = ranges.iter().sum::<f64>() / ranges.len() as f64;
    let width = 3.0 * range / D2;
    // The variance of a moving range of two: (2 − 4/π) σ².
    let upper = range * (1.0 + 3.0 * (2.0 - 4.0 / std::f64::consts::PI).sqrt() / D2);
    let limits = vec![[mean - width, mean + width]; values.len()];
    let own = Chart::new(values.to_vec(), mean, limits);
    let limits = vec![[0.0, upper]; ranges.len()];
    Some((own, Chart::new(ranges, range, limits)))
}

/// Mean standard deviation of a sample of `n` per standard deviation.
fn c4(n: usize) -> f64 {
    let n = n as f64;
    (2.0 / (n - 1.0)).sqrt() * (ln_gamma(n / 2.0) - ln_gamma((n - 1.0) / 2.0)).exp()
}

/// Means by lot, limits from the spreads within lots; lots of fewer than two are left out, and of fewer than two lots there is none.
pub fn means_by_lot(lots: &[Vec<f64>]) -> Option<Chart> {
    let lots: Vec<&Vec<f64>> = lots.iter().filter(|lot| lot.len() > 1).collect();
    let sigma = within(&lots)?;
    let means: Vec<f64> = lots.iter().map(|lot| mean(lot)).collect();
    let count: f64 = lots.iter().map(|lot| lot.len() as f64).sum();
    let centre = lots.iter().flat_map(|lot| lot.iter()).sum::<f64>() / count;
    let limit = |lot: &&Vec<f64>| {
        let width = 3.0 * sigma / (lot.len() as f64).sqrt();
        [centre - width, centre + width]
    };
    Some(Chart::new(means, centre, lots.iter().map(limit).collect()))
}

/// Standard deviations by lot.
pub fn spreads_by_lot(lots: &[Vec<f64>]) -> Option<Chart> {
    let lots: Vec<&Vec<f64>> = lots.iter().filter(|lot| lot.len() > 1).collect();
    let sigma = within(&lots)?;
    let limit = |lot: &&Vec<f64>| {
        let c4 = c4(lot.len());
        let width = 3.0 * sigma * (1.0 - c4 * c4).max(0.0).sqrt();
        [(c4 * sigma - width).max(0.0), c4 * sigma + width]
    };
    let points = lots.iter().map(|lot| deviation(lot)).collect();
    Some(Chart::new(points, sigma, lots.iter().map(limit).collect()))
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

fn deviation(values: &[f64]) -> f64 {
    let mean = mean(values);
    let squares: f64 = values.iter().map(|v| (v - mean).powi(2)).sum();
    (squares / (values.len() as f64 - 1.0)).sqrt()
}

/// Standard deviation within lots: the mean of unbiased ones.
fn within(lots: &[&Vec<f64>]) -> Option<f64> {
    let sum: f64 = lots.iter().map(|lot| deviation(lot) / c4(lot.len())).sum();
    (lots.len() > 1).then(|| sum / lots.len() as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constants_are_those_of_the_tables() {
        // Montgomery, appendix VI: c4 for 2, 5, 10, 25.
        for (n, expected) in [(2, 0.7979), (5, 0.9400), (10, 0.9727), (25, 0.9896)] {
            assert!((c4(n) - expected).abs() < 5e-5, "{n}");
        }
        let (_, ranges) = individuals(&[0.0, 1.0, 0.0, 1.0]).unwrap();
        // D4 = 3.267.
        assert!((ranges.limits[0][1] - 3.267).abs() < 1e-3, "{ranges:?}");
    }

    #[test]
    fn a_step_of_one_device_and_of_one_lot_is_seen() {
        let mut values: Vec<f64> = (0..40).map(|k| f64::from(k % 3)).collect();
        values[20] = 12.0;
        assert_eq!(individuals(&values).unwrap().0.beyond, [20]);
        let lot = |shift: f64| {
            (0..10)
                .map(|k| shift + f64::from(k % 3))
                .collect::<Vec<f64>>()
        };
        let lots = [lot(0.0), lot(0.1), lot(3.0), lot(0.0), lot(-0.1)];
        assert!(means_by_lot(&lots).unwrap().beyond.contains(&2));
        assert!(spreads_by_lot(&lots).unwrap().beyond.is_empty());
    }
}
