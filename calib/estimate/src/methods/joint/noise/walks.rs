//! Expected densities of random walks: the restricted likelihood, group by group of rows.

use std::sync::Arc;

use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::{Mat, Par, Side};

use crate::methods::joint::blocks::arrow::{Arrow, Places, lower_gram};
use crate::methods::joint::blocks::columns::Columns;
use crate::methods::joint::blocks::covariance::{Covariance, independent};

/// Prior chance of no walk at all, over that of any. Every inertial sensor's bias walks, if often too little for a recording to
/// show it: with as much chance on none as on any, one of 120 stated errors of effects that go with time was more than four
/// standard errors off, with this one of 430.
pub const NO_WALK: f64 = 0.2;

/// Sizes tried for an average.
const GRID: usize = 12;

/// Sizes tried reach so far beyond the likeliest.
const BEYOND: f64 = 2.5;

/// Beyond a size with this share of the likeliest one's weight nothing is left to try.
const NOTHING: f64 = 1e-7;

/// How often the sizes tried are doubled at most.
const DOUBLINGS: usize = 12;

/// Rounds over the walks, and the relative change of a variance that ends them.
const ROUNDS: usize = 4;
const SETTLED: f64 = 0.02;

/// Pivots of the normal equations (unit columns) below this are combinations that nothing determines.
const UNDETERMINED: f64 = 1e-11;

/// Residuals and Jacobian under the covariance `I + Σ θ_c C_c`, cut into the groups of rows that share no
/// noise: of `k` rows each, a factorisation costs `Σ k³` instead of `m³`.
#[derive(Clone, Debug)]
pub struct Walks {
    groups: Vec<Group>,
    /// Which columns belong to which recording.
    places: Arc<Places>,
    /// Number of columns of the Jacobian.
    columns: usize,
    /// Number of walks.
    walks: usize,
}

/// Rows that share noise with each other only.
#[derive(Clone, Debug)]
struct Group {
    /// The group of rows in the Jacobian that these are part of.
    recording: usize,
    /// The columns of the Jacobian that are not zero here.
    columns: Vec<usize>,
    /// These columns and the residuals (`k × (c + 1)`).
    bordered: Mat<f64>,
    /// What is always there besides the identity (`k × k`).
    fixed: Option<Mat<f64>>,
    /// `C_c` of every walk here (`k × k`); `None` where its rows do not feel it.
    walks: Vec<Option<Mat<f64>>>,
}

/// `log |V|` of a group and the lower triangle of `[J r]ᵀ V⁻¹ [J r]`.
#[derive(Clone, Debug)]
struct Part {
    log_determinant: f64,
    gram: Mat<f64>,
}

/// What groups add up to.
#[derive(Clone, Debug)]
struct Sum {
    /// `JᵀV⁻¹J`.
    normal: Arrow,
    /// `JᵀV⁻¹r`.
    right: Vec<f64>,
    /// `rᵀV⁻¹r`.
    square: f64,
    /// `log |V|`.
    log_determinant: f64,
}

impl Walks {
    /// Of residuals (`m`) and a Jacobian (`m × n`), both whitened by the white noise, with the covariances of
    /// walks of unit density and a covariance that is `fixed`.
    pub fn new(
        residuals: &[f64],
        jacobian: &Columns,
        walks: &[&Covariance],
        fixed: Option<&Covariance>,
    ) -> Self {
        let all: Vec<&Covariance> = walks.iter().copied().chain(fixed).collect();
        let connected = jacobian.groups().connected_by(all.iter().copied());
        let jacobian = jacobian.clone().regrouped(&connected);
        let scales = jacobian.norms();
        let part = |c: &Covariance, rows: &[usize]| {
            let own = c.part(rows)?;
            (own.norm_max() > 0.0).then_some(own)
        };
        let groups = independent(&all, residuals.len()).into_iter().map(|rows| {
            let recording = rows.first().map_or(0, |&row| connected.of(row));
            let own = &jacobian.parts()[recording];
            let places = rows
                .iter()
                .filter_map(|row| own.rows.binary_search(row).ok());
            let places: Vec<usize> = places.collect();
            let used: Vec<usize> = (0..own.columns.len())
                .filter(|&k| places.iter().any(|&i| own.values[(i, k)] != 0.0))
                .collect();
            let bordered = Mat::from_fn(rows.len(), used.len() + 1, |i, k| match used.get(k) {
                Some(&k) => own.values[(places[i], k)] / scales[own.columns[k]],
                None => residuals[rows[i]],
            });
            Group {
                recording,
                bordered,
                fixed: fixed.and_then(|c| part(c, &rows)),
                walks: walks.iter().map(|c| part(c, &rows)).collect(),
                columns: used.into_iter().map(|k| own.columns[k]).collect(),
            }
        });
        Self {
            groups: groups.collect(),
            places: Arc::new(Places::of(&jacobian)),
            columns: scales.len(),
            walks: walks.len(),
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
        let parts = |theta: &[f64]| -> Option<Vec<Part>> {
            self.groups.iter().map(|g| g.part(theta)).collect()
        };
        let begun = |theta: &[f64]| Some((theta.to_vec(), parts(theta)?));
        let Some((mut theta, mut parts)) = begun(from).or_else(|| begun(&none_at_all)) else {
            return none_at_all;
        };
        // Those beside which another has moved since.
        let mut due = vec![true; self.walks];
        for _ in 0..ROUNDS {
            for c in 0..self.walks {
                if !std::mem::take(&mut due[c]) {
                    continue;
                }
                let before = theta[c];
                theta[c] = self.average(c, &theta, (usual[c], none), &parts);
                if !self.update(c, &theta, &mut parts) {
                    return none_at_all;
                }
                if (theta[c] - before).abs() > SETTLED * theta[c].max(before) {
                    let others = due.iter_mut().enumerate().filter(|(other, _)| *other != c);
                    others.for_each(|(_, due)| *due = true);
                }
            }
        }
        theta
    }

    /// The expected variance of walk `c`.
    fn average(&self, c: usize, theta: &[f64], prior: (f64, f64), parts: &[Part]) -> f64 {
        let (mut still, mut moved) = (self.nothing(), Vec::new());
        for (group, part) in self.groups.iter().zip(parts) {
            match group.walks[c] {
                Some(_) => moved.push(group),
                None => still.add(group, part),
            }
        }
        expected_square(prior, |size| {
            let mut theta = theta.to_vec();
            theta[c] = size * size;
            let mut sum = still.clone();
            for group in &moved {
                let Some(part) = group.part(&theta) else {
                    return f64::NEG_INFINITY;
                };
                sum.add(group, &part);
            }
            sum.log_likelihood()
        })
    }

    /// Works out anew what walk `c` changes; `false` where that fails.
    fn update(&self, c: usize, theta: &[f64], parts: &mut [Part]) -> bool {
        let touched = self.groups.iter().zip(parts);
        touched
            .filter(|(group, _)| group.walks[c].is_some())
            .all(|(group, part)| group.part(theta).map(|new| *part = new).is_some())
    }

    fn nothing(&self) -> Sum {
        Sum {
            normal: Arrow::zeros(&self.places),
            right: vec![0.0; self.columns],
            square: 0.0,
            log_determinant: 0.0,
        }
    }
}

impl Sum {
    fn add(&mut self, group: &Group, part: &Part) {
        let last = group.columns.len();
        self.normal.add(group.recording, &group.columns, &part.gram);
        for (k, &column) in group.columns.iter().enumerate() {
            self.right[column] += part.gram[(last, k)];
        }
        self.square += part.gram[(last, last)];
        self.log_determinant += part.log_determinant;
    }

    /// `−½ (log |V| + log |JᵀV⁻¹J| + rᵀ P r)`, up to a constant.
    fn log_likelihood(&self) -> f64 {
        // A unit prior of no weight: combinations that nothing determines stay what they are.
        let Some(factor) = self.normal.factor(UNDETERMINED) else {
            return f64::NEG_INFINITY;
        };
        let (own, shared) = factor.forward(&self.right);
        let solved = own.iter().map(|own| own.squared_norm_l2()).sum::<f64>();
        let pivots: f64 = factor.pivots().map(|pivot| 2.0 * pivot.ln()).sum();
        let explained = solved + shared.squared_norm_l2();
        -0.5 * (self.log_determinant + pivots + self.square - explained)
    }
}

impl Group {
    fn part(&self, theta: &[f64]) -> Option<Part> {
        let k = self.bordered.nrows();
        let mut v = Mat::<f64>::identity(k, k);
        if let Some(fixed) = &self.fixed {
            v += fixed;
        }
        for (walk, variance) in self.walks.iter().zip(theta) {
            if let Some(c) = walk.as_ref().filter(|_| *variance > 0.0) {
                v += faer::Scale(*variance) * c;
            }
        }
        let factor = v.llt(Side::Lower).ok()?;
        let mut whitened = self.bordered.clone();
        solve_lower_triangular_in_place(factor.L(), whitened.as_mut(), Par::Seq);
        Some(Part {
            log_determinant: (0..k).map(|i| 2.0 * factor.L()[(i, i)].ln()).sum(),
            gram: lower_gram(whitened.as_ref()),
        })
    }
}

/// The expected square of a size of this log-likelihood, its prior chance as in [`Walks::expected`].
pub fn expected_square((usual, none): (f64, f64), log_likelihood: impl Fn(f64) -> f64) -> f64 {
    let mut points = vec![(0.0, none, log_likelihood(0.0))];
    let mut highest = usual;
    for doubling in 0..=DOUBLINGS {
        let from = if doubling == 0 { 0.0 } else { 0.5 * highest };
        let steps = if doubling == 0 { GRID } else { GRID / 2 };
        let width = (highest - from) / steps as f64;
        for k in 0..steps {
            let size = from + (k as f64 + 0.5) * width;
            points.push((size, width / usual, log_likelihood(size)));
            if share_of_last(&points) < NOTHING {
                return mean_square(&points);
            }
        }
        if BEYOND * likeliest(&points) <= highest {
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
    use rand::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;
    use crate::methods::joint::Restricted;
    use crate::methods::joint::blocks::groups::RowGroups;

    /// Two groups of thirty rows with a walk each, one column across both and one in each.
    fn example() -> (Vec<f64>, Columns, [Covariance; 2]) {
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(8);
        let r = (0..60).map(|_| StandardNormal.sample(&mut random));
        let jacobian = Mat::from_fn(60, 3, |i, k| match k {
            0 => 1.0 + 0.1 * (i as f64).sin(),
            1 => f64::from(u8::from(i < 30)),
            _ => f64::from(u8::from(i >= 30)) * (i as f64 - 45.0),
        });
        let walk = |first: usize| {
            let values = Mat::from_fn(30, 30, |i, k| (i.min(k) + 1) as f64);
            Covariance::of_blocks(60, vec![((first..first + 30).collect(), values)])
        };
        let groups = RowGroups::new((0..60).map(|i| i / 30).collect());
        let jacobian = Columns::cut(&jacobian, &groups);
        (r.collect(), jacobian, [walk(0), walk(30)])
    }

    #[test]
    fn the_likelihood_by_groups_differs_from_that_of_the_null_space_by_a_constant() {
        let (r, jacobian, [a, b]) = example();
        let walks = Walks::new(&r, &jacobian, &[&a, &b], None);
        let whole = Restricted::new(&r, &jacobian, &[&a, &b]);
        let parts = |theta: &[f64]| -> Vec<Part> {
            walks
                .groups
                .iter()
                .map(|g| g.part(theta).unwrap())
                .collect()
        };
        let difference = |theta: &[f64]| {
            let mut sum = walks.nothing();
            let parts = parts(theta);
            let all = walks.groups.iter().zip(&parts);
            all.for_each(|(group, part)| sum.add(group, part));
            sum.log_likelihood() - whole.log_likelihood(theta).unwrap()
        };
        let constant = difference(&[0.0, 0.0]);
        for theta in [[0.1, 0.0], [0.0, 0.3], [1.0, 1e-3]] {
            // What holds up undetermined combinations adds 1e-11 to pivots of a hundredth.
            assert!((difference(&theta) - constant).abs() < 1e-7);
        }
    }

    #[test]
    fn the_average_is_that_of_a_finer_grid() {
        let (r, jacobian, [a, b]) = example();
        let walks = Walks::new(&r, &jacobian, &[&a, &b], None);
        let usual = [0.3, 0.3];
        let found = walks.expected(&usual, 1.0, &[0.0, 0.0]);
        let whole = Restricted::new(&r, &jacobian, &[&a, &b]);
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
        let walk = Mat::from_fn(rows, rows, |i, k| (i.min(k) + 1) as f64);
        let density = moved / (rows as f64).sqrt();
        let jacobian = Mat::from_fn(rows, 2, |i, k| if k == 0 { 1.0 } else { i as f64 });
        let covariance = Covariance::of_blocks(rows, vec![((0..rows).collect(), walk.clone())]);
        let cut = Columns::cut(&jacobian, &RowGroups::whole(rows));
        let drift = |_| {
            let mut walked = 0.0;
            let r = Mat::from_fn(rows, 1, |_, _| {
                let [step, white] = [(); 2].map(|()| StandardNormal.sample(&mut random));
                let (step, white): (f64, f64) = (step, white);
                walked += density * step;
                walked + white
            });
            let walks = Walks::new(r.col_as_slice(0), &cut, &[&covariance], None);
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
        let z = drifts(NO_WALK, 2000, 2.0);
        // Of errors whose own size is known 5 % and none of 2000; with as much chance on no walk as on any 13 % and 21.
        assert!(beyond(&z, 1.96) < 0.1, "{}", beyond(&z, 1.96));
        assert!(beyond(&z, 4.0) < 0.003, "{}", beyond(&z, 4.0));
        // Nor are they without bounds where there is no walk.
        let still = drifts(NO_WALK, 500, 0.0);
        let square: f64 = still.iter().map(|z| z * z).sum();
        assert!((square / 500.0).sqrt() > 0.4, "{square}");
    }
}
