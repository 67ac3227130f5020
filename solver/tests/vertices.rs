//! Minima at, near and away from vertices where more constraints meet than there are dimensions.

#![allow(clippy::unwrap_used)]

use faer::Mat;
use faer::linalg::solvers::Solve;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use stillpoint_solver::{
    Constraint, Constraints, Mask, Options, Parameters, Report, Residual, Scalar, lit, solve,
};

/// Dimensions.
const N: usize = 3;

/// Residuals.
const M: usize = 5;

/// `J x − y`.
struct Linear {
    jacobian: [[f64; N]; M],
    y: [f64; M],
}

impl<D: Scalar> Residual<D> for Linear {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        for (row, y) in self.jacobian.iter().zip(&self.y) {
            let value = row
                .iter()
                .zip(x)
                .fold(lit::<D>(0.0), |sum, (&a, &x)| sum + x * a);
            out.push(value - lit::<D>(*y));
        }
    }
}

impl Linear {
    fn cost(&self, x: &[f64]) -> f64 {
        let mut r = Vec::new();
        Residual::<f64>::residuals(self, x, &mut r);
        0.5 * r.iter().map(|r| r * r).sum::<f64>()
    }

    /// `Jᵀ (J x − y)`.
    fn gradient(&self, x: &[f64]) -> [f64; N] {
        let mut r = Vec::new();
        Residual::<f64>::residuals(self, x, &mut r);
        std::array::from_fn(|k| (0..M).map(|i| self.jacobian[i][k] * r[i]).sum())
    }
}

/// A convex problem with constraints `a · x ≥ a · vertex` (or the same from above) through one
/// point.
struct Cone {
    objective: Linear,
    vertex: [f64; N],
    normals: Vec<[f64; N]>,
    /// Held from above, which turns the multiplier's sign.
    above: Vec<bool>,
    /// Well inside.
    inside: [f64; N],
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn vector<const K: usize>(random: &mut ChaCha8Rng) -> [f64; K] {
    std::array::from_fn(|_| random.random_range(-1.0..1.0))
}

/// A normal of its own, or one that depends, exactly or nearly, on those before.
fn normal(random: &mut ChaCha8Rng, before: &[[f64; N]]) -> [f64; N] {
    let (kind, count) = (random.random_range(0..5), before.len());
    if count < 2 || kind < 2 {
        return vector(random);
    }
    let (a, b) = (
        before[random.random_range(0..count)],
        before[random.random_range(0..count)],
    );
    match kind {
        2 => a.map(|a| 3.0 * a),
        3 => a.map(|a| 3.0 * a + 1e-7 * random.random_range(-1.0..1.0)),
        _ => std::array::from_fn(|k| a[k] + 0.5 * b[k]),
    }
}

impl Cone {
    fn new(seed: u64) -> Self {
        let random = &mut ChaCha8Rng::seed_from_u64(seed);
        let axis: [f64; N] = vector(random);
        let mut normals: Vec<[f64; N]> = Vec::new();
        for _ in 0..random.random_range(4..=8) {
            let a = normal(random, &normals);
            let outward = dot(&a, &axis) < 0.0;
            normals.push(if outward { a.map(|a| -a) } else { a });
        }
        let vertex = match seed % 3 {
            0 => [0.0; N],
            1 => vector(random),
            _ => vector::<N>(random).map(|v| 100.0 * v),
        };
        let jacobian: [[f64; N]; M] = std::array::from_fn(|_| vector(random));
        let y = Self::target(random, &jacobian, &vertex, &normals);
        let above = normals.iter().map(|_| random.random_range(0..3) == 0);
        let above = above.collect();
        Self {
            objective: Linear { jacobian, y },
            vertex,
            normals,
            above,
            inside: std::array::from_fn(|k| vertex[k] + 2.0 * axis[k]),
        }
    }

    /// A target with any gradient at the vertex, or one with a gradient in the cone of the normals,
    /// some of which do not pull: then the vertex is the minimum, often on the edge of not being it.
    fn target(
        random: &mut ChaCha8Rng,
        jacobian: &[[f64; N]; M],
        vertex: &[f64; N],
        normals: &[[f64; N]],
    ) -> [f64; M] {
        let noise: [f64; M] = vector(random);
        let gradient: [f64; N] = match random.random_range(0..2) {
            0 => vector(random),
            _ => normals.iter().fold([0.0; N], |sum, a| {
                let weight = random.random_range(-1.0..1.0_f64).max(0.0);
                std::array::from_fn(|k| sum[k] + weight * a[k])
            }),
        };
        // r = noise + J s with Jᵀ r = gradient.
        let normal: Mat<f64> = Mat::from_fn(N, N, |i, k| {
            (0..M).map(|m| jacobian[m][i] * jacobian[m][k]).sum()
        });
        let missing = Mat::from_fn(N, 1, |i, _| {
            gradient[i] - (0..M).map(|m| jacobian[m][i] * noise[m]).sum::<f64>()
        });
        let s = normal.full_piv_lu().solve(&missing);
        std::array::from_fn(|m| {
            let far: [f64; N] = std::array::from_fn(|k| vertex[k] - s[(k, 0)]);
            dot(&jacobian[m], &far) - noise[m]
        })
    }

    fn constraints(&self) -> Constraints {
        let mut constraints = Constraints::new();
        for (a, above) in self.normals.iter().zip(&self.above) {
            let sign = if *above { -1.0 } else { 1.0 };
            let names = ["x0", "x1", "x2"];
            let terms: Vec<(&str, f64)> = (0..N).map(|k| (names[k], sign * a[k])).collect();
            let limit = sign * dot(a, &self.vertex);
            let (lower, upper) = if *above {
                (f64::NEG_INFINITY, limit)
            } else {
                (limit, f64::INFINITY)
            };
            constraints = constraints.linear(&terms, lower, upper);
        }
        constraints
    }

    /// The minimum with the constraints of a set held, if they are independent.
    fn held(&self, set: &[usize]) -> Option<Vec<f64>> {
        let (j, size) = (&self.objective.jacobian, N + set.len());
        let kkt = Mat::from_fn(size, size, |i, k| match (i < N, k < N) {
            (true, true) => (0..M).map(|m| j[m][i] * j[m][k]).sum(),
            (true, false) => self.normals[set[k - N]][i],
            (false, true) => self.normals[set[i - N]][k],
            (false, false) => 0.0,
        });
        let right = |i: usize| match i < N {
            true => (0..M).map(|m| j[m][i] * self.objective.y[m]).sum(),
            false => dot(&self.normals[set[i - N]], &self.vertex),
        };
        let right = Mat::from_fn(size, 1, |i, _| right(i));
        let x = kkt.full_piv_lu().solve(&right);
        let miss = (&kkt * &x - &right).norm_max();
        let solved = miss.is_finite() && miss < 1e-9 * (1.0 + right.norm_max());
        solved.then(|| (0..N).map(|k| x[(k, 0)]).collect())
    }

    fn contains(&self, x: &[f64]) -> bool {
        self.normals.iter().all(|a| {
            let size = dot(&a.map(f64::abs), &self.vertex.map(|v| 1.0 + v.abs()));
            dot(a, x) >= dot(a, &self.vertex) - 1e-12 * size
        })
    }

    /// The least cost, over every set of at most `N` constraints held.
    fn least(&self) -> f64 {
        let sets = 0..1_u32 << self.normals.len();
        let sets = sets.filter(|set| set.count_ones() as usize <= N);
        sets.filter_map(|set| {
            let held = (0..self.normals.len()).filter(|i| set >> i & 1 == 1);
            self.held(&held.collect::<Vec<_>>())
        })
        .chain([self.vertex.to_vec()])
        .filter(|x| self.contains(x))
        .map(|x| self.objective.cost(x.as_slice()))
        .fold(f64::INFINITY, f64::min)
    }

    fn fit(&self, start: &[f64]) -> Report {
        let options = Options {
            constraints: self.constraints(),
            ..Options::default()
        };
        let start = Parameters::unnamed(start);
        solve(&self.objective, &start, &Mask::all(N), &options).unwrap()
    }

    /// `Jᵀ r − Aᵀ μ` of a report, whose multipliers must have the signs of their limits.
    fn left(&self, report: &Report) -> Option<f64> {
        let mut left = self.objective.gradient(report.parameters.values());
        let constraints = self.constraints();
        for active in &report.active {
            let is_it = |row: &&Constraint| {
                row.in_words() == active.constraint
                    && (row.lower == active.value || row.upper == active.value)
            };
            let row = constraints.rows().iter().find(is_it)?;
            let outward = active.multiplier * if row.upper.is_finite() { -1.0 } else { 1.0 };
            if outward < 0.0 {
                return None;
            }
            for (left, (_, c)) in left.iter_mut().zip(&row.terms) {
                *left -= active.multiplier * c;
            }
        }
        Some(left.iter().fold(0.0, |most, v| v.abs().max(most)))
    }

    /// What is wrong with the fit from a start.
    fn complaint(&self, start: &[f64]) -> Option<String> {
        let report = self.fit(start);
        let (cost, least) = (report.cost, self.least());
        let size = 1.0
            + self
                .vertex
                .iter()
                .fold(0.0, |most: f64, v| v.abs().max(most));
        let left = self.left(&report).unwrap_or(f64::INFINITY);
        let good = report.termination.converged()
            && (cost - least).abs() <= 1e-10 * size * (1.0 + least)
            && left <= 1e-9 * size
            && self.contains(report.parameters.values());
        (!good).then(|| {
            format!(
                "{}; cost above {:e}; gradient left {left:e}; {} active; {} steps",
                report.termination,
                cost - least,
                report.active.len(),
                report.iterations.len()
            )
        })
    }
}

fn complaints(seeds: u64) -> Vec<String> {
    let each = (0..seeds).flat_map(|seed| {
        let cone = Cone::new(seed);
        [("inside", cone.inside), ("vertex", cone.vertex)].map(|(name, start)| {
            let complaint = cone.complaint(&start)?;
            Some(format!("seed {seed} from {name}: {complaint}"))
        })
    });
    each.flatten().collect()
}

#[test]
fn the_minimum_is_found_where_more_constraints_meet_than_there_are_dimensions() {
    let complaints = complaints(300);
    assert!(complaints.is_empty(), "{complaints:#?}");
}

#[test]
fn the_nearest_point_is_found_where_more_constraints_meet_than_there_are_dimensions() {
    for seed in 0..600 {
        let mut cone = Cone::new(seed);
        let away: [f64; N] = vector(&mut ChaCha8Rng::seed_from_u64(10_000 + seed));
        let mut z: [f64; N] = cone.vertex;
        let objective = &mut cone.objective;
        (objective.jacobian, objective.y) = ([[0.0; N]; M], [0.0; M]);
        for k in 0..N {
            z[k] += 3.0 * away[k];
            let weight = 1.0 / z[k].abs().max(1.0);
            (objective.jacobian[k][k], objective.y[k]) = (weight, weight * z[k]);
        }
        let mut moved = Parameters::unnamed(&z);
        let projected = cone.constraints().project(&mut moved, &Mask::all(N));
        projected.unwrap();
        let (cost, least) = (cone.objective.cost(moved.values()), cone.least());
        assert!((cost - least).abs() < 1e-10, "{seed}: {cost} {least}");
        assert!(cone.contains(moved.values()), "{seed}");
    }
}
