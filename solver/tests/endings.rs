//! What the solver says of the point where it stops.
#![allow(clippy::unwrap_used)]

use solver::{
    Constraints, Damping, DualNum, Jet, Mask, Options, Parameters, Problem, Report, Residual,
    Scalar, Termination, Variant, from_fn, lit, solve,
};
use stillpoint_solver as solver;

fn fit(problem: &dyn Problem, start: &[f64], options: &Options) -> Report {
    let mask = Mask::all(start.len());
    solve(problem, &Parameters::unnamed(start), &mask, options).unwrap()
}

/// `(x² − 1)² + y²`: a saddle at the origin, minima at ±1.
struct TwoWells;

impl<D: Scalar> Residual<D> for TwoWells {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        out.push(x[0] * x[0] - lit::<D>(1.0));
        out.push(x[1]);
    }
}

/// Powell's singular function: the Jacobian has rank two at the root.
struct Singular;

impl<D: Scalar> Residual<D> for Singular {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        out.push(x[0] + x[1] * 10.0);
        out.push((x[2] - x[3]) * 5f64.sqrt());
        out.push((x[1] - x[2] * 2.0).powi(2));
        out.push((x[0] - x[3]).powi(2) * 10f64.sqrt());
    }
}

/// A cubic root beside noise: rank is short at the minimum and the residual is not zero.
struct FlatBeside;

impl<D: Scalar> Residual<D> for FlatBeside {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        out.push(x[0].powi(3));
        out.push(x[1] - lit::<D>(1.0));
        out.push(x[1] + 1.0);
    }
}

#[test]
fn a_saddle_is_left_where_second_derivatives_are_at_hand() {
    for start in [[0.0, 0.0], [0.0, 3.0]] {
        let report = fit(&TwoWells, &start, &Options::default());
        assert!(report.cost < 1e-20, "{report}");
        assert!((report.parameters.values()[0].abs() - 1.0).abs() < 1e-12);
        assert!(report.termination.converged(), "{report}");
    }
}

#[test]
fn a_zero_residual_is_called_zero() {
    for start in [[3.0, -1.0, 0.0, 1.0], [1.0, 1.0, 1.0, 1.0]] {
        let report = fit(&Singular, &start, &Options::default());
        assert!(report.termination.converged(), "{report}");
        assert!(report.cost < 1e-30, "{report}");
        assert!(report.evaluations.jacobians < 100, "{report}");
    }
}

#[test]
fn a_flat_minimum_of_short_rank_is_not_called_stalled() {
    let report = fit(&FlatBeside, &[1.0, 5.0], &Options::default());
    assert!((report.cost - 1.0).abs() < 1e-12, "{report}");
    assert!(report.termination.converged(), "{report}");
}

#[test]
fn a_wrong_derivative_is_still_called_stalled() {
    /// Its Jacobian points the other way.
    struct Wrong;
    impl Problem for Wrong {
        fn values(&self, x: &[f64], out: &mut Vec<f64>) {
            out.clear();
            out.extend([x[0] - 3.0, 1.0]);
        }
        fn linearize(&self, x: &[f64], _: &[usize], r: &mut Vec<f64>) -> solver::Mat<f64> {
            self.values(x, r);
            solver::Mat::from_fn(2, 1, |i, _| if i == 0 { -1.0 } else { 0.0 })
        }
    }
    let report = fit(&Wrong, &[1.0], &Options::default());
    assert_eq!(report.termination, Termination::Stalled, "{report}");
}

#[test]
fn second_derivatives_are_budgeted() {
    let options = Options {
        max_second_derivatives: 5,
        ..Options::default()
    };
    let report = fit(&Singular, &[3.0, -1.0, 0.0, 1.0], &options);
    assert!(report.evaluations.second_derivatives <= 5, "{report}");
    assert!(report.termination.converged(), "{report}");
}

#[test]
fn without_second_derivatives_the_automatic_variant_is_nielsens() {
    let valley = from_fn(|x: &[Jet], out: &mut Vec<Jet>| {
        out.extend([(x[1] - x[0] * x[0]) * 10.0, lit::<Jet>(1.0) - x[0]]);
    });
    let automatic = fit(&valley, &[-1.2, 1.0], &Options::default());
    let variant = Variant::LevenbergMarquardt {
        damping: Damping::Nielsen,
        geodesic: false,
    };
    let nielsen = fit(
        &valley,
        &[-1.2, 1.0],
        &Options {
            variant,
            ..Options::default()
        },
    );
    assert_eq!(automatic.evaluations.second_derivatives, 0);
    let (a, b) = (automatic.jacobian_evaluations, nielsen.jacobian_evaluations);
    // The first trial is judged by the rule that the automatic variant begins with.
    assert!(a.abs_diff(b) <= 3, "{a} {b}");
}

#[test]
fn first_damping_and_first_radius_are_heeded() {
    for (variant, options) in [
        (
            Variant::Automatic,
            Options {
                first_damping: 7.0,
                ..Options::default()
            },
        ),
        (
            Variant::Dogleg,
            Options {
                first_radius: 0.01,
                ..Options::default()
            },
        ),
    ] {
        let report = fit(
            &Singular,
            &[3.0, -1.0, 0.0, 1.0],
            &Options { variant, ..options },
        );
        let first = report.iterations[0].lambda;
        // ‖D x‖ at the start: columns (1 … ) give 0.01 · ‖D x‖ for the radius.
        let expected = if variant == Variant::Dogleg {
            0.0..5.0
        } else {
            7.0..7.1
        };
        assert!(expected.contains(&first), "{first}");
    }
}

#[test]
fn dogleg_follows_the_steepest_descent_where_the_newton_step_is_too_long() {
    // Rosenbrock's valley: from its usual start the Gauss–Newton step is 4.8 long.
    let valley = from_fn(|x: &[Jet], out: &mut Vec<Jet>| {
        out.extend([(x[1] - x[0].powi(2)) * 10.0, x[0] - 1.0]);
    });
    let options = Options {
        variant: Variant::Dogleg,
        first_radius: 0.01,
        ..Options::default()
    };
    let report = fit(&valley, &[-1.2, 1.0], &options);
    assert!(report.termination.converged(), "{report}");
    assert!(report.cost < 1e-20, "{report}");
}

#[test]
fn dogleg_and_gauss_newton_keep_to_constraints() {
    // min (x − 2)² + (y − 2)² with x + y ≤ 1, x ≥ 0.6: at (0.6, 0.4).
    let target = from_fn(|x: &[Jet], out: &mut Vec<Jet>| {
        out.extend([x[0] - 2.0, (x[1] - 2.0) * 3.0, (x[1] - x[0]).exp() * 0.1]);
    });
    let constraints = Constraints::new()
        .linear(&[("x0", 1.0), ("x1", 1.0)], f64::NEG_INFINITY, 1.0)
        .bound("x0", 0.2, f64::INFINITY);
    let solved = |variant: Variant| {
        let options = Options {
            constraints: constraints.clone(),
            variant,
            first_radius: 0.1,
            ..Options::default()
        };
        fit(&target, &[0.3, 0.2], &options)
    };
    let expected = solved(Variant::Automatic);
    for variant in [Variant::Dogleg, Variant::GaussNewton] {
        let report = solved(variant);
        assert!(report.termination.converged(), "{report}");
        assert!(report.infeasibility < 1e-12, "{report}");
        assert!(
            (report.cost - expected.cost).abs() < 1e-10 * expected.cost,
            "{report}"
        );
    }
}

#[test]
fn a_report_reads_as_text() {
    let report = fit(&Singular, &[3.0, -1.0, 0.0, 1.0], &Options::default());
    let text = report.to_string();
    assert!(text.starts_with("converged"), "{text}");
    assert!(text.contains("r″") && text.contains("x3"), "{text}");
}
