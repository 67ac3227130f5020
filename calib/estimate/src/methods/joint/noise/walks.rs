//! Expected densities of random walks: the restricted likelihood, group by group of rows.

use super::mixed::{Mixed, Part};
use super::weights::Component;
use crate::methods::joint::blocks::columns::Columns;

findings::tuning! {
    /// Prior chance of no walk at all, over that of any. Every inertial sensor's bias walks, if often too little for a recording to
    /// show it: with as much chance on none as on any, one of 120 stated errors of effects that go with time was more than four
    /// standard errors off, with this one of 430.
    pub NO_WALK: f64 = 0.2;

    /// Sizes tried for an average.
    GRID: usize = 12;

    /// Sizes tried reach so far beyond the likeliest.
    BEYOND: f64 = 2.5;

    /// Beyond a size with this share of the likeliest one's weight nothing is left to try.
    NOTHING: f64 = 1e-7;

    /// Largest number of doublings of the range of sizes tried.
    DOUBLINGS: usize = 12;

    /// Rounds over the walks.
    ROUNDS: usize = 4;
    /// The relative change of a variance that ends them.
    SETTLED: f64 = 0.02;
}

/// Residuals and Jacobian under noise of which the densities of the walks are not known.
#[derive(Clone, Debug)]
pub struct Walks {
    mixed: Mixed,
    /// Number of walks.
    walks: usize,
    /// Variances of what is always there besides the white noise.
    fixed: Vec<f64>,
}

impl Walks {
    /// Builds the problem from residuals (`m`) and a Jacobian (`m × n`), both whitened by the white noise, with walks
    /// of unit density and other noise of a `fixed` variance.
    pub fn new(
        residuals: &[f64],
        jacobian: &Columns,
        walks: &[&Component],
        fixed: &[(&Component, f64)],
    ) -> Self {
        let others = fixed.iter().map(|(component, _)| *component);
        let all: Vec<&Component> = walks.iter().copied().chain(others).collect();
        Self {
            mixed: Mixed::new(residuals, jacobian, &all),
            walks: walks.len(),
            fixed: fixed.iter().map(|(_, variance)| *variance).collect(),
        }
    }

    /// The expected variance of every walk given the data, the others at theirs: an average over what
    /// the density may be, its prior chance spread evenly over sizes up to `usual`, with the same chance per size
    /// beyond where the data ask for it, and `none` times as much on no walk at all. The walks begin at the variances `from`.
    ///
    /// A walk at the edge of what a recording can show is most likely none in one of five; stating errors
    /// as if it were none is then wrong by a factor of two. The average is calibrated either way.
    pub fn expected(&self, usual: &[f64], none: f64, from: &[f64]) -> Vec<f64> {
        let none_at_all = vec![0.0; self.walks];
        let begun = |walks: &[f64]| {
            let theta = [walks, &self.fixed].concat();
            let parts = self.parts(&theta)?;
            Some((theta, parts))
        };
        let Some((mut theta, mut parts)) = begun(from).or_else(|| begun(&none_at_all)) else {
            return none_at_all;
        };
        // Those beside which another has moved since.
        let mut due = vec![true; self.walks];
        for _ in 0..ROUNDS.get() {
            for c in 0..self.walks {
                if !std::mem::take(&mut due[c]) {
                    continue;
                }
                let before = theta[c];
                theta[c] = self.average(c, &theta, (usual[c], none), &parts);
                if !self.update(c, &theta, &mut parts) {
                    return none_at_all;
                }
                if (theta[c] - before).abs() > SETTLED.get() * theta[c].max(before) {
                    let others = due.iter_mut().enumerate().filter(|(other, _)| *other != c);
                    others.for_each(|(_, due)| *due = true);
                }
            }
        }
        theta.truncate(self.walks);
        theta
    }

    fn parts(&self, theta: &[f64]) -> Option<Vec<Part>> {
        (0..self.mixed.lines())
            .map(|line| self.mixed.part(line, theta))
            .collect()
    }

    /// The expected variance of walk `c`.
    fn average(&self, c: usize, theta: &[f64], prior: (f64, f64), parts: &[Part]) -> f64 {
        let (mut still, mut moved) = (self.mixed.nothing(), Vec::new());
        for (line, part) in parts.iter().enumerate() {
            if self.mixed.feels(line, c) {
                moved.push(line);
            } else {
                self.mixed.add(&mut still, line, part, theta);
            }
        }
        expected_square(prior, |size| {
            let mut theta = theta.to_vec();
            theta[c] = size * size;
            let mut sum = still.clone();
            for &line in &moved {
                let Some(part) = self.mixed.part(line, &theta) else {
                    return f64::NEG_INFINITY;
                };
                self.mixed.add(&mut sum, line, &part, &theta);
            }
            self.mixed.log_likelihood(sum)
        })
    }

    /// Works out anew what walk `c` changes; `false` where that fails.
    fn update(&self, c: usize, theta: &[f64], parts: &mut [Part]) -> bool {
        let mut touched = parts
            .iter_mut()
            .enumerate()
            .filter(|(line, _)| self.mixed.feels(*line, c));
        touched.all(|(line, part)| {
            let new = self.mixed.part(line, theta);
            new.map(|new| *part = new).is_some()
        })
    }
}

/// The expected square of a size of this log-likelihood, its prior chance as in [`Walks::expected`].
pub fn expected_square((usual, none): (f64, f64), log_likelihood: impl Fn(f64) -> f64) -> f64 {
    let mut points = vec![(0.0, none, log_likelihood(0.0))];
    let mut highest = usual;
    for doubling in 0..=DOUBLINGS.get() {
        let from = if doubling == 0 { 0.0 } else { 0.5 * highest };
        let steps = if doubling == 0 {
            GRID.get()
        } else {
            GRID.get() / 2
        };
        let width = (highest - from) / steps as f64;
        for k in 0..steps {
            let size = from + (k as f64 + 0.5) * width;
            points.push((size, width / usual, log_likelihood(size)));
            if share_of_last(&points) < NOTHING.get() {
                return mean_square(&points);
            }
        }
        if BEYOND.get() * likeliest(&points) <= highest {
            break;
        }
        highest *= 2.0;
    }
    mean_square(&points)
}

/// The likeliest size.
fn likeliest(points: &[(f64, f64, f64)]) -> f64 {
    let best = points.iter().max_by(|a, b| a.2.total_cmp(&b.2));
    best.map_or(0.0, |p| p.0)
}

/// Likelihood of the last size over that of the likeliest.
fn share_of_last(points: &[(f64, f64, f64)]) -> f64 {
    let best = points.iter().map(|p| p.2).fold(f64::NEG_INFINITY, f64::max);
    points.last().map_or(0.0, |last| (last.2 - best).exp())
}

/// The mean of `size²` over `(size, prior weight, log-likelihood)`.
fn mean_square(points: &[(f64, f64, f64)]) -> f64 {
    let best = points.iter().map(|p| p.2).fold(f64::NEG_INFINITY, f64::max);
    let (sum, total) = points.iter().fold((0.0, 0.0), |(sum, total), p| {
        let weight = p.1 * (p.2 - best).exp();
        (sum + weight * p.0 * p.0, total + weight)
    });
    if total > 0.0 { sum / total } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
    use faer::{Mat, Par, Side};
    use nalgebra::DMatrix;
    use rand::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;
    use crate::methods::joint::blocks::covariance::Covariance;
    use crate::methods::joint::blocks::groups::RowGroups;
    use crate::methods::joint::noise::chain::{Chain, Link};
    use crate::methods::joint::noise::likelihood::tests::dense::Dense;
    use crate::methods::joint::noise::stations::Stations;
    use crate::methods::joint::noise::weights::{ComponentKind, Form};

    /// A walk of unit steps from row to row.
    fn walk(groups: &RowGroups, rows: std::ops::Range<usize>) -> Component {
        let one = |value: f64| DMatrix::from_element(1, 1, value);
        let first = rows.start;
        let link = |row: usize| {
            let square = (row - first + 1) as f64;
            let link = Link {
                own: one(square),
                gives: one(1.0),
                takes: one(square),
                keeps: vec![1.0],
            };
            (row, link)
        };
        let stations = Stations::single(groups);
        let count = rows.len();
        let values = Mat::from_fn(count, count, |i, k| (i.min(k) + 1) as f64);
        Component {
            kind: ComponentKind::GyroscopeWalk,
            covariance: Covariance::of_blocks(
                groups.rows(),
                vec![(rows.clone().collect(), values)],
            ),
            form: Form::Passed(Chain::of_links(&stations, 1, rows.map(link))),
        }
    }

    /// Two groups of thirty rows with a walk each, one column across both and one in each.
    fn example() -> (Vec<f64>, Columns, [Component; 2]) {
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(8);
        let r = (0..60).map(|_| StandardNormal.sample(&mut random));
        let jacobian = Mat::from_fn(60, 3, |i, k| match k {
            0 => 1.0 + 0.1 * (i as f64).sin(),
            1 => f64::from(u8::from(i < 30)),
            _ => f64::from(u8::from(i >= 30)) * (i as f64 - 45.0),
        });
        let groups = RowGroups::new((0..60).map(|i| i / 30).collect());
        let jacobian = Columns::cut(&jacobian, &groups);
        let walks = [walk(&groups, 0..30), walk(&groups, 30..60)];
        (r.collect(), jacobian, walks)
    }

    #[test]
    fn the_average_is_that_of_a_finer_grid() {
        let (r, jacobian, [a, b]) = example();
        let walks = Walks::new(&r, &jacobian, &[&a, &b], &[]);
        let usual = [0.3, 0.3];
        let found = walks.expected(&usual, 1.0, &[0.0, 0.0]);
        let whole = Dense::new(&r, &jacobian, &[&a.covariance, &b.covariance]);
        let fine: Vec<(f64, f64, f64)> = (0..=400)
            .map(|k| {
                let size = 0.3 * (f64::from(k) - 0.5).max(0.0) / 400.0;
                let weight = if k == 0 { 1.0 } else { 1.0 / 400.0 };
                let at = [size * size, found[1]];
                (size, weight, whole.log_likelihood(&at).unwrap())
            })
            .collect();
        let exact = mean_square(&fine);
        // Twelve midpoints up to the usual size.
        assert!(
            (found[0] / exact - 1.0).abs() < 0.05,
            "{} {exact}",
            found[0]
        );
    }

    /// Errors of a drift in their standard errors, of biases at twenty-four static intervals with a walk that has `moved` them by
    /// so many standard deviations of their white noise at the last.
    fn drifts(none: f64, draws: u32, moved: f64) -> Vec<f64> {
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(9);
        let rows = 24;
        let groups = RowGroups::whole(rows);
        let component = walk(&groups, 0..rows);
        let walk = Mat::from_fn(rows, rows, |i, k| (i.min(k) + 1) as f64);
        let density = moved / (rows as f64).sqrt();
        let jacobian = Mat::from_fn(rows, 2, |i, k| if k == 0 { 1.0 } else { i as f64 });
        let cut = Columns::cut(&jacobian, &groups);
        let drift = |_| {
            let mut walked = 0.0;
            let r = Mat::from_fn(rows, 1, |_, _| {
                let [step, white] = [(); 2].map(|()| StandardNormal.sample(&mut random));
                let (step, white): (f64, f64) = (step, white);
                walked += density * step;
                walked + white
            });
            let walks = Walks::new(r.col_as_slice(0), &cut, &[&component], &[]);
            let usual = [3.0 / (rows as f64).sqrt()];
            let variance = walks.expected(&usual, none, &[0.0])[0];
            let v = Mat::<f64>::identity(rows, rows) + faer::Scale(variance) * &walk;
            let factor = v.llt(Side::Lower).unwrap();
            let mut whitened = Mat::from_fn(rows, 3, |i, k| match k {
                2 => r[(i, 0)],
                k => jacobian[(i, k)],
            });
            solve_lower_triangular_in_place(factor.L(), whitened.as_mut(), Par::Seq);
            let gram = whitened.transpose() * &whitened;
            let determinant = gram[(0, 0)] * gram[(1, 1)] - gram[(0, 1)].powi(2);
            let slope = (gram[(0, 0)] * gram[(1, 2)] - gram[(0, 1)] * gram[(0, 2)]) / determinant;
            slope / (gram[(0, 0)] / determinant).sqrt()
        };
        (0..draws).map(drift).collect()
    }

    #[test]
    fn errors_are_not_small_where_few_intervals_show_the_walk() {
        let beyond = |z: &[f64], limit: f64| {
            let count = z.iter().filter(|z| z.abs() > limit).count();
            count as f64 / z.len() as f64
        };
        let z = drifts(NO_WALK.get(), 2000, 2.0);
        // Of errors whose own size is known 5 % and none of 2000; with as much chance on no walk as on any 13 % and 21.
        assert!(beyond(&z, 1.96) < 0.1, "{}", beyond(&z, 1.96));
        assert!(beyond(&z, 4.0) < 0.003, "{}", beyond(&z, 4.0));
        // Nor are they without bounds where there is no walk.
        let still = drifts(NO_WALK.get(), 500, 0.0);
        let square: f64 = still.iter().map(|z| z * z).sum();
        assert!((square / 500.0).sqrt() > 0.4, "{square}");
    }
}
