//! Many small problems of one shape in one call.

use pulp::{Arch, Simd, WithSimd};

use crate::error::Error;
use crate::options::Options;
use crate::parameters::{Mask, Parameters};
use crate::report::Termination;
use crate::residual::{Problem, Residual};
use crate::scalar::Wide;
use crate::solve::solve;

/// Derivatives that one evaluation carries.
const LANES: usize = 4;

/// The damping up to the first step that fails, and from then on.
const NEXT_TO_NONE: f64 = 1e-8;
const FIRST: f64 = 1e-3;
/// A damping beyond this means that no step leads lower.
const MOST: f64 = 1e12;

/// A pivot below this share of its column's square: the normal equations have lost what the columns differ in.
const COLLINEAR: f64 = 1e-11;

/// A step shorter than this, relative to the parameters, changes nothing.
const SHORT: f64 = 1e-14;

/// Options of [`solve_batch`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BatchOptions {
    /// Most steps tried in one problem before [`solve`](crate::solve()) takes it over.
    pub max_iterations: usize,
    /// Relative offset `‖P r‖ / ‖r‖` at which a point counts as a minimum, `P` the projection on the columns of `J`.
    pub gradient_tolerance: f64,
    /// Threads; the result is the same to the last bit. 1 starts none.
    pub threads: usize,
}

impl Default for BatchOptions {
    fn default() -> Self {
        Self {
            max_iterations: 60,
            gradient_tolerance: 1e-9,
            threads: 1,
        }
    }
}

/// Result of [`solve_batch`]: for `N` problems with `n` parameters each.
#[derive(Clone, Debug, PartialEq)]
pub struct Batch {
    /// Parameters at the minima, `n` of every problem one after the other (`N n`).
    pub values: Vec<f64>,
    /// Their standard errors `σ √((JᵀJ)⁻¹)ₖₖ`, `σ² = ‖r‖² / (m − n)`; NaN without a spare residual or where a parameter is not
    /// determined (`N n`).
    pub standard_errors: Vec<f64>,
    /// `½ ‖r‖²` there (`N`).
    pub costs: Vec<f64>,
    /// Why each ended (`N`).
    pub terminations: Vec<Termination>,
    /// Parameters of a problem.
    pub parameters: usize,
}

impl Batch {
    /// The parameters of a problem.
    pub fn of(&self, problem: usize) -> &[f64] {
        &self.values[problem * self.parameters..(problem + 1) * self.parameters]
    }
}

/// Minimises `½ ‖rᵢ(x)‖²` of every problem from its own start (`N n` values), without memory of its own per problem.
///
/// Each takes damped steps by the normal equations in memory that all share, with the machine's vectors (mark `residuals` as
/// `#[inline(always)]`). What is not at a minimum then, or has nearly collinear columns, is solved by [`solve`](crate::solve()).
///
/// # Errors
/// Starts of another length than problems times parameters; a residual or derivative that is not finite at a start.
///
/// # Examples
/// ```
/// use stillpoint_solver::{BatchOptions, Residual, Scalar, solve_batch};
///
/// /// `y = a exp(−b t)` at `t = 0, 1, 2, 3`.
/// struct Decay([f64; 4]);
///
/// impl<D: Scalar> Residual<D> for Decay {
///     #[inline(always)]
///     fn residuals(&self, x: &[D], out: &mut Vec<D>) {
///         out.extend((0..4).map(|k| x[0] * (-x[1] * k as f64).exp() - self.0[k]));
///     }
/// }
///
/// let problems = [Decay([2.0, 1.2, 0.75, 0.44]), Decay([3.0, 1.1, 0.4, 0.15])];
/// let batch = solve_batch(&problems, 2, &[1.0, 1.0, 1.0, 1.0], &BatchOptions::default())?;
/// assert!((batch.of(0)[1] - 0.5).abs() < 0.02 && (batch.of(1)[1] - 1.0).abs() < 0.02);
/// # Ok::<(), stillpoint_solver::Error>(())
/// ```
pub fn solve_batch<P>(
    problems: &[P],
    parameters: usize,
    starts: &[f64],
    options: &BatchOptions,
) -> Result<Batch, Error>
where
    P: Problem + Residual<Wide<LANES>> + Sync,
{
    let count = problems.len();
    if parameters == 0 || starts.len() != count * parameters {
        return Err(Error::MaskLength {
            mask: starts.len(),
            parameters: count * parameters,
        });
    }
    let mut batch = Batch {
        values: starts.to_vec(),
        standard_errors: vec![f64::NAN; starts.len()],
        costs: vec![0.0; count],
        terminations: vec![Termination::IterationLimit; count],
        parameters,
    };
    let each = count
        .div_ceil(options.threads.clamp(1, count.max(1)))
        .max(1);
    let parts = problems
        .chunks(each)
        .zip(batch.values.chunks_mut(each * parameters))
        .zip(batch.standard_errors.chunks_mut(each * parameters))
        .zip(batch.costs.chunks_mut(each))
        .zip(batch.terminations.chunks_mut(each))
        .map(
            |((((problems, values), errors), costs), terminations)| Part {
                problems,
                values,
                errors,
                costs,
                terminations,
                parameters,
                options,
            },
        );
    let parts: Vec<Part<'_, P>> = parts.collect();
    if let [_] | [] = parts.as_slice() {
        parts
            .into_iter()
            .try_for_each(|part| Arch::new().dispatch(part))?;
        return Ok(batch);
    }
    std::thread::scope(|scope| {
        let running: Vec<_> = parts
            .into_iter()
            .map(|part| scope.spawn(|| Arch::new().dispatch(part)))
            .collect();
        running
            .into_iter()
            .try_for_each(|thread| match thread.join() {
                Ok(ended) => ended,
                Err(panic) => std::panic::resume_unwind(panic),
            })
    })?;
    Ok(batch)
}

/// Problems that one thread solves, and where their results go.
struct Part<'a, P> {
    problems: &'a [P],
    values: &'a mut [f64],
    errors: &'a mut [f64],
    costs: &'a mut [f64],
    terminations: &'a mut [Termination],
    parameters: usize,
    options: &'a BatchOptions,
}

impl<P: Problem + Residual<Wide<LANES>>> WithSimd for Part<'_, P> {
    type Output = Result<(), Error>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Result<(), Error> {
        let n = self.parameters;
        let mut work = Work::new(n);
        for (k, problem) in self.problems.iter().enumerate() {
            let own = k * n..(k + 1) * n;
            let start = &mut self.values[own.clone()];
            let ended = work.minimise(problem, start, self.options);
            let ended = match ended.filter(|ended| ended.converged()) {
                Some(ended) => {
                    start.copy_from_slice(&work.here.x);
                    ended
                }
                None => work.by_the_general_solver(problem, start)?,
            };
            self.terminations[k] = ended;
            self.costs[k] = work.here.cost;
            work.standard_errors(&mut self.errors[own]);
        }
        Ok(())
    }
}

/// A point with the normal equations there.
#[derive(Clone, Debug, Default)]
struct Point {
    x: Vec<f64>,
    /// `JᵀJ`, row after row, each filled up to whole groups of lanes.
    normal: Vec<f64>,
    /// `Jᵀr`.
    gradient: Vec<f64>,
    cost: f64,
    rows: usize,
}

/// Memory that all problems of a thread share.
struct Work {
    n: usize,
    /// Length of a row of the normal equations: `n` in whole groups of lanes.
    stride: usize,
    here: Point,
    there: Point,
    /// Largest squared column norms so far.
    scale: Vec<f64>,
    factor: Vec<f64>,
    step: Vec<f64>,
    at: Vec<Wide<LANES>>,
    out: Vec<Wide<LANES>>,
    /// `J`, row after row, each filled up.
    jacobian: Vec<f64>,
}

impl Work {
    fn new(n: usize) -> Self {
        let stride = n.div_ceil(LANES) * LANES;
        let point = Point {
            x: vec![0.0; n],
            normal: vec![0.0; n * stride],
            gradient: vec![0.0; stride],
            ..Point::default()
        };
        Self {
            n,
            stride,
            here: point.clone(),
            there: point,
            scale: vec![0.0; n],
            factor: vec![0.0; n * n],
            step: vec![0.0; n],
            at: Vec::new(),
            out: Vec::new(),
            jacobian: Vec::new(),
        }
    }

    /// Damped steps from `start`; `None` where the general solver has to look.
    #[inline(always)]
    fn minimise<P: Residual<Wide<LANES>>>(
        &mut self,
        problem: &P,
        start: &[f64],
        options: &BatchOptions,
    ) -> Option<Termination> {
        self.there.x.copy_from_slice(start);
        if !self.linearize(problem) {
            return None;
        }
        self.scale.fill(0.0);
        self.take();
        let (mut lambda, mut rise, mut has_failed) = (NEXT_TO_NONE, 2.0, false);
        for _ in 0..options.max_iterations {
            if self.here.cost == 0.0 {
                return Some(Termination::Zero);
            }
            if !self.solve_damped(lambda) {
                lambda = next_after_failure(lambda, &mut rise, &mut has_failed)?;
                continue;
            }
            // gᵀ(H + λD²)⁻¹g, of the next to undamped step ‖P r‖².
            let decrement = -dot(&self.here.gradient[..self.n], &self.step);
            if lambda <= NEXT_TO_NONE
                && decrement <= options.gradient_tolerance.powi(2) * 2.0 * self.here.cost
            {
                return Some(Termination::Gradient);
            }
            if self.is_short() {
                return Some(Termination::Step);
            }
            for k in 0..self.n {
                self.there.x[k] = self.here.x[k] + self.step[k];
            }
            let weighted: f64 = (self.step.iter().zip(&self.scale))
                .map(|(p, d)| d * p * p)
                .sum();
            let predicted = 0.5 * (decrement + lambda * weighted);
            let before = self.here.cost;
            if self.linearize(problem) && self.there.cost < before {
                let ratio = (before - self.there.cost) / predicted;
                self.take();
                let fall = (1.0 - (2.0 * ratio - 1.0).powi(3)).clamp(1.0 / 9.0, 2.0);
                lambda = match has_failed {
                    true if lambda * fall < NEXT_TO_NONE => NEXT_TO_NONE,
                    true => lambda * fall,
                    false => NEXT_TO_NONE,
                };
                rise = 2.0;
            } else if lambda <= NEXT_TO_NONE && decrement <= f64::EPSILON * before {
                return Some(Termination::Cost);
            } else {
                lambda = next_after_failure(lambda, &mut rise, &mut has_failed)?;
            }
        }
        None
    }

    /// Takes the point tried for the one at hand.
    #[inline(always)]
    fn take(&mut self) {
        std::mem::swap(&mut self.here, &mut self.there);
        for k in 0..self.n {
            self.scale[k] = self.scale[k].max(self.here.normal[k * self.stride + k]);
        }
    }

    /// Residuals and normal equations at the point tried; whether all is finite.
    #[inline(always)]
    fn linearize<P: Residual<Wide<LANES>>>(&mut self, problem: &P) -> bool {
        let (n, stride) = (self.n, self.stride);
        for first in (0..n).step_by(LANES) {
            self.at.clear();
            self.at
                .extend(self.there.x.iter().map(|&x| Wide::constant(x)));
            for lane in 0..LANES.min(n - first) {
                self.at[first + lane].slopes[lane] = 1.0;
            }
            self.out.clear();
            problem.residuals(&self.at, &mut self.out);
            if stride > LANES {
                self.jacobian.resize(self.out.len() * stride, 0.0);
                for (row, value) in self.jacobian.chunks_exact_mut(stride).zip(&self.out) {
                    row[first..first + LANES].copy_from_slice(&value.slopes);
                }
            }
        }
        let there = &mut self.there;
        there.normal.fill(0.0);
        there.gradient.fill(0.0);
        there.rows = self.out.len();
        let mut square = 0.0;
        for (k, value) in self.out.iter().enumerate() {
            square += value.re * value.re;
            let row = match stride > LANES {
                true => &self.jacobian[k * stride..(k + 1) * stride],
                false => &value.slopes,
            };
            for (g, j) in there.gradient.iter_mut().zip(row) {
                *g += j * value.re;
            }
            for (normal, j) in there.normal.chunks_exact_mut(stride).zip(row) {
                for (h, other) in normal.iter_mut().zip(row) {
                    *h += j * other;
                }
            }
        }
        there.cost = 0.5 * square;
        square.is_finite()
            && there
                .gradient
                .iter()
                .chain(&there.normal)
                .all(|v| v.is_finite())
    }

    /// `(H + λ D²) p = −g`; whether that is positive definite.
    #[inline(always)]
    fn solve_damped(&mut self, lambda: f64) -> bool {
        if !self.factorise(lambda) {
            return false;
        }
        let n = self.n;
        let l = &self.factor;
        for i in 0..n {
            let sum: f64 = (0..i).map(|k| l[i * n + k] * self.step[k]).sum();
            self.step[i] = (-self.here.gradient[i] - sum) / l[i * n + i];
        }
        for i in (0..n).rev() {
            let sum: f64 = (i + 1..n).map(|k| l[k * n + i] * self.step[k]).sum();
            self.step[i] = (self.step[i] - sum) / l[i * n + i];
        }
        true
    }

    /// The Cholesky factor of `H + λ D²`.
    #[inline(always)]
    fn factorise(&mut self, lambda: f64) -> bool {
        let (n, stride) = (self.n, self.stride);
        let l = &mut self.factor;
        for i in 0..n {
            for k in 0..=i {
                let mut sum = self.here.normal[i * stride + k];
                if i == k {
                    sum += lambda * self.scale[i];
                }
                let floor = COLLINEAR * sum;
                for j in 0..k {
                    sum -= l[i * n + j] * l[k * n + j];
                }
                l[i * n + k] = match i == k {
                    true if sum > floor => sum.sqrt(),
                    true => return false,
                    false => sum / l[k * n + k],
                };
            }
        }
        true
    }

    /// True where the step changes no parameter.
    #[inline(always)]
    fn is_short(&self) -> bool {
        let of = |v: &[f64]| -> f64 { v.iter().zip(&self.scale).map(|(v, d)| d * v * v).sum() };
        of(&self.step) <= SHORT * SHORT * of(&self.here.x)
    }

    /// Standard errors at the point at hand, NaN where there are none.
    #[inline(always)]
    fn standard_errors(&mut self, errors: &mut [f64]) {
        let n = self.n;
        errors.fill(f64::NAN);
        let spare = self.here.rows.saturating_sub(n);
        if spare == 0 || !self.factorise(0.0) {
            return;
        }
        let variance = 2.0 * self.here.cost / spare as f64;
        for (k, error) in errors.iter_mut().enumerate() {
            // The column of L⁻¹ that belongs to parameter k.
            let mut square = 0.0;
            for i in k..n {
                let unit = f64::from(u8::from(i == k));
                let sum: f64 = (k..i).map(|j| self.factor[i * n + j] * self.step[j]).sum();
                self.step[i] = (unit - sum) / self.factor[i * n + i];
                square += self.step[i] * self.step[i];
            }
            *error = (variance * square).sqrt();
        }
    }

    /// Solves what the steps here did not, and linearises there.
    #[cold]
    fn by_the_general_solver<P: Problem + Residual<Wide<LANES>>>(
        &mut self,
        problem: &P,
        x: &mut [f64],
    ) -> Result<Termination, Error> {
        let start = Parameters::unnamed(x);
        let report = solve(problem, &start, &Mask::all(self.n), &Options::default())?;
        x.copy_from_slice(report.parameters.values());
        self.there.x.copy_from_slice(x);
        if self.linearize(problem) {
            self.take();
        }
        self.here.cost = report.cost;
        Ok(report.termination)
    }
}

/// The damping after a step that failed; `None` where none is left to try.
#[inline(always)]
fn next_after_failure(lambda: f64, rise: &mut f64, has_failed: &mut bool) -> Option<f64> {
    if !std::mem::replace(has_failed, true) {
        return Some(FIRST);
    }
    let next = lambda.max(FIRST * FIRST) * *rise;
    *rise *= 2.0;
    (next < MOST).then_some(next)
}

#[inline(always)]
fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::Scalar;

    /// `y = a exp(−b t) + c` at twenty instants.
    struct Decay(Vec<f64>);

    fn instants() -> impl Iterator<Item = f64> {
        (0..20).map(|k| 0.2 * f64::from(k))
    }

    impl<D: Scalar> Residual<D> for Decay {
        #[inline(always)]
        fn residuals(&self, x: &[D], out: &mut Vec<D>) {
            let all = instants().zip(&self.0);
            out.extend(all.map(|(t, y)| x[0] * (-x[1] * t).exp() + x[2] - *y));
        }
    }

    /// Problems with errors from a small generator, and bad starts.
    fn decays(count: usize) -> (Vec<Decay>, Vec<f64>) {
        let mut state = 1u64;
        let mut noise = move || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            (state >> 11) as f64 / (1u64 << 53) as f64 - 0.5
        };
        let mut starts = Vec::new();
        let problems = (0..count).map(|_| {
            let (a, b, c) = (2.0 + noise(), 0.8 + noise(), noise());
            starts.extend([0.5, 3.0 * (0.6 + noise()), 0.0]);
            Decay(
                instants()
                    .map(|t| a * (-b * t).exp() + c + 0.02 * noise())
                    .collect(),
            )
        });
        (problems.collect(), starts)
    }

    #[test]
    fn every_problem_ends_where_the_general_solver_does_with_its_errors() {
        let (problems, starts) = decays(200);
        let batch = solve_batch(&problems, 3, &starts, &BatchOptions::default()).unwrap();
        for (k, problem) in problems.iter().enumerate() {
            let start = Parameters::unnamed(&starts[3 * k..3 * k + 3]);
            let report = solve(problem, &start, &Mask::all(3), &Options::default()).unwrap();
            assert!(batch.terminations[k].converged(), "{k}");
            assert!((batch.costs[k] / report.cost - 1.0).abs() < 1e-9, "{k}");
            for i in 0..3 {
                let error = report.standard_error(i).unwrap();
                let own = batch.standard_errors[3 * k + i];
                assert!((batch.of(k)[i] - report.parameters.values()[i]).abs() < 1e-6 * error);
                assert!((own / error - 1.0).abs() < 1e-5, "{k} {i}: {own} {error}");
            }
        }
    }

    #[test]
    fn the_number_of_threads_changes_no_bit() {
        let (problems, starts) = decays(101);
        let of = |threads: usize| {
            let options = BatchOptions {
                threads,
                ..BatchOptions::default()
            };
            solve_batch(&problems, 3, &starts, &options).unwrap()
        };
        assert_eq!(of(1), of(4));
    }

    /// More parameters than lanes, linear: one step is the solution.
    struct Powers([f64; 9]);

    impl<D: Scalar> Residual<D> for Powers {
        fn residuals(&self, x: &[D], out: &mut Vec<D>) {
            for (k, y) in self.0.iter().enumerate() {
                let t = k as f64 / 4.0 - 1.0;
                let mut sum = D::from(-*y);
                for (power, x) in x.iter().enumerate() {
                    sum += *x * t.powi(power as i32);
                }
                out.push(sum);
            }
        }
    }

    #[test]
    fn more_parameters_than_lanes_and_collinear_columns_are_solved_too() {
        let t = |k: usize| k as f64 / 4.0 - 1.0;
        let powers = Powers(std::array::from_fn(|k| 1.0 + 2.0 * t(k) - t(k).powi(5)));
        let batch = solve_batch(&[powers], 6, &[0.5; 6], &BatchOptions::default()).unwrap();
        for (found, due) in batch.of(0).iter().zip([1.0, 2.0, 0.0, 0.0, 0.0, -1.0]) {
            assert!((found - due).abs() < 1e-9, "{:?}", batch.of(0));
        }
        struct Same;
        impl<D: Scalar> Residual<D> for Same {
            fn residuals(&self, x: &[D], out: &mut Vec<D>) {
                out.extend([x[0] + x[1] - 2.0, x[0] + x[1] - 4.0, x[0] + x[1] - 3.0]);
            }
        }
        let batch = solve_batch(&[Same], 2, &[0.0, 0.0], &BatchOptions::default()).unwrap();
        assert!((batch.costs[0] - 1.0).abs() < 1e-12);
        assert!(batch.standard_errors.iter().all(|error| error.is_nan()));
    }

    #[test]
    fn bad_starts_are_refused() {
        let (problems, mut starts) = decays(2);
        let options = BatchOptions::default();
        assert!(solve_batch(&problems, 3, &starts[1..], &options).is_err());
        starts[0] = f64::NAN;
        assert!(matches!(
            solve_batch(&problems, 3, &starts, &options),
            Err(Error::NotFinite { .. })
        ));
    }
}
