//! Many starts, few minima.

use crate::error::Error;
use crate::linear::vector::{add, norm, scaled_norm};
use crate::minimise::scaling::unit_if_zero;
use crate::options::Options;
use crate::parameters::{Mask, Parameters};
use crate::report::Report;
use crate::residual::Problem;
use crate::solve::solve;

/// Distance `‖D (x − y)‖` of two minima, relative to their sizes, below which they are one.
const SAME: f64 = 1e-6;

/// A minimum with the starts that lead to it.
#[derive(Clone, Debug)]
pub struct Minimum {
    /// The fit that came out lowest.
    pub report: Report,
    /// The starts, by their place.
    pub starts: Vec<usize>,
}

/// Minima that many starts lead to.
#[derive(Clone, Debug)]
pub struct MultiStart {
    /// Minima that differ, the lowest first.
    pub minima: Vec<Minimum>,
    /// Fits that did not converge, with the place of their start.
    pub unfinished: Vec<(usize, Report)>,
    /// Starts that cannot be solved from, and why.
    pub failed: Vec<(usize, Error)>,
}

impl MultiStart {
    /// The lowest minimum, if any start converged.
    pub fn best(&self) -> Option<&Report> {
        self.minima.first().map(|minimum| &minimum.report)
    }
}

/// Solves from every start and keeps the minima that differ: two are the same where
/// `‖D (x − y)‖ ≤ 1e-6 (‖D x‖ + ‖r‖)`, with the column norms `D` of the Jacobian, whatever the units.
///
/// ```
/// use stillpoint_solver::{DualNum, Jet, Mask, Options, Parameters, from_fn, multi_start, spread};
///
/// let well = from_fn(|x: &[Jet], out: &mut Vec<Jet>| out.push(x[0] * x[0] - 4.0));
/// let starts: Vec<Parameters> = spread(&[-5.0], &[4.0], 8).iter().map(|x| Parameters::unnamed(x)).collect();
/// let found = multi_start(&well, &starts, &Mask::all(1), &Options::default());
/// assert_eq!(found.minima.len(), 2); // −2 and 2
/// ```
pub fn multi_start(
    problem: &dyn Problem,
    starts: &[Parameters],
    mask: &Mask,
    options: &Options,
) -> MultiStart {
    let (mut minima, mut unfinished, mut failed) = (Vec::<Minimum>::new(), Vec::new(), Vec::new());
    for (start, parameters) in starts.iter().enumerate() {
        match solve(problem, parameters, mask, options) {
            Err(error) => failed.push((start, error)),
            Ok(report) if !report.termination.converged() => unfinished.push((start, report)),
            Ok(report) => {
                let scale = column_norms(problem, &report, mask);
                let same = minima
                    .iter_mut()
                    .find(|known| is_same(&known.report, &report, mask, &scale));
                match same {
                    Some(known) => {
                        known.starts.push(start);
                        if report.cost < known.report.cost {
                            known.report = report;
                        }
                    }
                    None => minima.push(Minimum {
                        report,
                        starts: vec![start],
                    }),
                }
            }
        }
    }
    minima.sort_by(|a, b| a.report.cost.total_cmp(&b.report.cost));
    MultiStart {
        minima,
        unfinished,
        failed,
    }
}

fn column_norms(problem: &dyn Problem, report: &Report, mask: &Mask) -> Vec<f64> {
    let free = mask.free_indices();
    let jacobian = problem.linearize(report.parameters.values(), &free, &mut Vec::new());
    let columns = (0..jacobian.ncols()).map(|k| norm(jacobian.col_as_slice(k)));
    columns.map(unit_if_zero).collect()
}

fn is_same(a: &Report, b: &Report, mask: &Mask, scale: &[f64]) -> bool {
    let free = |report: &Report| -> Vec<f64> {
        let values = report.parameters.values();
        mask.free_indices().iter().map(|&k| values[k]).collect()
    };
    let (x, y) = (free(a), free(b));
    let apart = scaled_norm(&add(&x, -1.0, &y), scale);
    let size = scaled_norm(&x, scale).max(scaled_norm(&y, scale));
    apart <= SAME * (size + norm(&b.residuals))
}

/// `count` points spread evenly between `lower` and `upper` (Halton's sequence: no seed, the same points
/// every time). Source: Halton, "On the efficiency of certain quasi-random sequences", 1960.
///
/// ```
/// let points = stillpoint_solver::spread(&[0.0, -1.0], &[1.0, 1.0], 50);
/// assert!(points.len() == 50 && points.iter().all(|p| (0.0..=1.0).contains(&p[0]) && (-1.0..=1.0).contains(&p[1])));
/// ```
pub fn spread(lower: &[f64], upper: &[f64], count: usize) -> Vec<Vec<f64>> {
    let bases = primes(lower.len().min(upper.len()));
    let point = |i: usize| {
        let place = |(k, &base): (usize, &usize)| {
            lower[k] + (upper[k] - lower[k]) * radical_inverse(i, base)
        };
        bases.iter().enumerate().map(place).collect()
    };
    (1..=count).map(point).collect()
}

/// The digits of `i` in a base, mirrored at the point.
fn radical_inverse(mut i: usize, base: usize) -> f64 {
    let (mut value, mut place) = (0.0, 1.0 / base as f64);
    while i > 0 {
        value += place * (i % base) as f64;
        i /= base;
        place /= base as f64;
    }
    value
}

fn primes(count: usize) -> Vec<usize> {
    let is_prime = |n: &usize| {
        (2..*n)
            .take_while(|d| d * d <= *n)
            .all(|d| !n.is_multiple_of(d))
    };
    (2..).filter(is_prime).take(count).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_spread_over_the_box() {
        let points = spread(&[0.0, -1.0], &[1.0, 1.0], 64);
        for k in 0..4 {
            let quarter = (0.25 * f64::from(k), 0.25 * f64::from(k + 1));
            let inside = points
                .iter()
                .filter(|p| p[0] >= quarter.0 && p[0] < quarter.1);
            assert_eq!(inside.count(), 16, "{k}");
        }
        let mean: f64 = points.iter().map(|p| p[1]).sum::<f64>() / 64.0;
        assert!(mean.abs() < 0.05, "{mean}");
    }
}
