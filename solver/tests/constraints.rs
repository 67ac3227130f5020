//! Masks, bounds and linear constraints as properties.

#![allow(clippy::unwrap_used)]

use proptest::prelude::*;
use stillpoint_solver::{
    Constraints, Mask, Options, Parameters, Report, Residual, Scalar, lit, solve,
};

const N: usize = 4;

/// A mildly nonlinear regression with random design: seven rows, four parameters.
#[derive(Clone, Debug)]
struct Random {
    design: Vec<[f64; N]>,
    y: Vec<f64>,
}

impl<D: Scalar> Residual<D> for Random {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        for (a, y) in self.design.iter().zip(&self.y) {
            let linear = a
                .iter()
                .zip(x)
                .fold(lit::<D>(0.0), |sum, (&a, &x)| sum + x * a);
            out.push(linear + linear.sin() * 0.2 - lit::<D>(*y));
        }
    }
}

/// [`Random`] with one parameter written in as a number.
struct Deleted<'a> {
    whole: &'a Random,
    index: usize,
    value: f64,
}

impl<D: Scalar> Residual<D> for Deleted<'_> {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        let mut all = x.to_vec();
        all.insert(self.index, lit(self.value));
        self.whole.residuals(&all, out);
    }
}

fn problems() -> impl Strategy<Value = Random> {
    let row = prop::array::uniform4(-1.0..1.0f64);
    let rows = (
        prop::collection::vec(row, 7),
        prop::collection::vec(-2.0..2.0f64, 7),
    );
    rows.prop_map(|(mut design, y)| {
        // Keeps the design well conditioned.
        for (k, row) in design.iter_mut().take(N).enumerate() {
            row[k] += 2.5;
        }
        Random { design, y }
    })
}

fn fit(problem: &Random, constraints: Constraints) -> Report {
    let options = Options {
        constraints,
        ..Options::default()
    };
    solve(
        problem,
        &Parameters::unnamed(&[0.0; N]),
        &Mask::all(N),
        &options,
    )
    .unwrap()
}

/// `Jᵀ r` at the solution.
fn gradient(problem: &Random, report: &Report) -> Vec<f64> {
    let mut r = Vec::new();
    let all: Vec<usize> = (0..N).collect();
    let j =
        stillpoint_solver::Problem::linearize(problem, report.parameters.values(), &all, &mut r);
    (0..N)
        .map(|k| (0..r.len()).map(|i| j[(i, k)] * r[i]).sum())
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 100, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn fixing_a_parameter_equals_deleting_it(problem in problems(), index in 0..N, value in -1.0..1.0f64) {
        let mut start = Parameters::unnamed(&[0.0; N]);
        start.values_mut()[index] = value;
        let fixed = solve(&problem, &start, &Mask::all(N).without(index), &Options::default()).unwrap();
        let deleted = Deleted { whole: &problem, index, value };
        let without = Parameters::unnamed(&[0.0; N - 1]);
        let shorter = solve(&deleted, &without, &Mask::all(N - 1), &Options::default()).unwrap();
        let mut rest = fixed.parameters.values().to_vec();
        prop_assert_eq!(rest.remove(index), value);
        // The same numbers pass through the same operations.
        prop_assert_eq!(rest.as_slice(), shorter.parameters.values());
        prop_assert_eq!(fixed.uncertainty.covariance, shorter.uncertainty.covariance);
    }

    #[test]
    fn inactive_bounds_change_nothing(problem in problems()) {
        let start = Parameters::unnamed(&[0.0; N]);
        let wide = Constraints::new().bounds(&start, &[-1e3; N], &[1e3; N]).order("x0", "x1");
        let (free, bounded) = (fit(&problem, Constraints::new()), fit(&problem, wide));
        prop_assume!(bounded.active.is_empty());
        for (a, b) in free.parameters.values().iter().zip(bounded.parameters.values()) {
            // Ways differ, and every way ends within an offset of 1e-11.
            prop_assert!((a - b).abs() <= 1e-9 * (1.0 + a.abs()));
        }
    }

    #[test]
    fn active_bounds_satisfy_the_kkt_conditions(problem in problems(), width in 0.01..0.5f64) {
        let start = Parameters::unnamed(&[0.0; N]);
        let constraints = Constraints::new()
            .bounds(&start, &[-width; N], &[width; N])
            .linear(&[("x0", 1.0), ("x1", -1.0), ("x3", 0.5)], -width, width);
        let report = fit(&problem, constraints.clone());
        prop_assert!(report.termination.converged(), "{:?}", report.termination);
        prop_assert!(report.infeasibility <= 1e-9);
        // Stationarity: the gradient is the active constraints' multipliers times their normals.
        let mut left = gradient(&problem, &report);
        for active in &report.active {
            let row = constraints.rows().iter().find(|row| row.in_words() == active.constraint).unwrap();
            let at_lower = active.value == row.lower;
            let outward = if at_lower { active.multiplier } else { -active.multiplier };
            prop_assert!(outward >= 0.0);
            for (name, c) in &row.terms {
                left[report.parameters.index(name).unwrap()] -= active.multiplier * c;
            }
        }
        for value in left {
            prop_assert!(value.abs() <= 1e-9, "{value:e}");
        }
        // Bounds hold exactly, and no step off the active ones is known to the covariance.
        for (k, x) in report.parameters.values().iter().enumerate() {
            prop_assert!(x.abs() <= width);
            if x.abs() == width && report.active.iter().any(|a| a.constraint == format!("x{k}")) {
                prop_assert!(report.uncertainty.covariance[k][k].abs() < 1e-20);
            }
        }
    }

    #[test]
    fn tied_parameters_are_equal_and_optimal(problem in problems()) {
        let report = fit(&problem, Constraints::new().tie("x0", "x2"));
        let x = report.parameters.values();
        prop_assert!((x[0] - x[2]).abs() <= 1e-12 * (1.0 + x[0].abs()));
        let g = gradient(&problem, &report);
        for value in [g[0] + g[2], g[1], g[3]] {
            prop_assert!(value.abs() <= 1e-9, "{value:e}");
        }
    }
}

/// `(x₀ − a, 2 (x₁ − b), x₀ x₁ / 10)`.
struct Bowl(f64, f64);

impl<D: Scalar> Residual<D> for Bowl {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        out.push(x[0] - lit::<D>(self.0));
        out.push((x[1] - lit::<D>(self.1)) * 2.0);
        out.push(x[0] * x[1] * 0.1);
    }
}

fn bowl(a: f64, b: f64, start: [f64; 2], constraints: Constraints) -> Report {
    let options = Options {
        constraints,
        ..Options::default()
    };
    let start = Parameters::unnamed(&start);
    solve(&Bowl(a, b), &start, &Mask::all(2), &options).unwrap()
}

#[test]
fn bounds_of_zero_are_reached_from_anywhere_without_a_step_refused() {
    for i in 0..200 {
        let start = 1e-3 * 1.07f64.powi(i);
        let positive =
            Constraints::new()
                .bound("x0", 0.0, f64::INFINITY)
                .bound("x1", 0.0, f64::INFINITY);
        let report = bowl(-3.0, -1.0, [start, 0.9 * start], positive);
        assert_eq!(report.parameters.values(), [0.0, 0.0], "{start}");
        assert!(report.termination.converged());
        // The product bends the way only where it is large.
        if start < 3.0 {
            assert!(
                report.iterations.len() <= 3,
                "{start}: {}",
                report.iterations.len()
            );
        }
    }
}

#[test]
fn bounds_a_rounding_apart_hold_the_parameter() {
    let narrow = Constraints::new().bound("x0", 1.0, 1.0 + 1e-15);
    let report = bowl(3.0, -1.0, [1.0, 0.5], narrow);
    let held = bowl(
        3.0,
        -1.0,
        [1.0, 0.5],
        Constraints::new().bound("x0", 1.0, 1.0),
    );
    assert!(report.termination.converged(), "{}", report.termination);
    assert!((report.parameters.values()[1] - held.parameters.values()[1]).abs() < 1e-12);
    assert!((report.active[0].multiplier - held.active[0].multiplier).abs() < 1e-12);
}

#[test]
fn constraints_that_meet_at_zero_are_seen_to_be_active() {
    // Towards the origin from inside: what is left of the steps is rounding, of which the
    // constraints' own size says nothing there.
    for i in 0..60 {
        let turn = 0.1 * f64::from(i);
        let cone = Constraints::new()
            .linear(&[("x0", 3.0), ("x1", -1.0)], 0.0, f64::INFINITY)
            .linear(&[("x0", -1.0), ("x1", 2.0)], 0.0, f64::INFINITY)
            .linear(&[("x0", 1.0), ("x1", 1.0)], 0.0, f64::INFINITY);
        let report = bowl(
            -2.0 - turn,
            -1.0 - 0.3 * turn,
            [1.0, 1.1 + 0.01 * turn],
            cone,
        );
        assert!(
            report.termination.converged(),
            "{i}: {}",
            report.termination
        );
        assert!(report.parameters.values().iter().all(|x| x.abs() < 1e-14));
        assert!(report.active.len() >= 2 && report.active.iter().all(|a| a.multiplier >= 0.0));
    }
}
