//! Bad input is a typed error or a termination, never a panic, and the best point is returned.

#![allow(clippy::unwrap_used)]

use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use stillpoint_solver::{
    Constraints, DualNum, Error, Jet, Loss, LossScale, Mask, Options, Parameters, Problem,
    Residual, Scalar, Termination, Variant, from_fn, from_fn_numeric, lit, solve, solve_observed,
};

struct Valley;

impl<D: Scalar> Residual<D> for Valley {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        out.push((x[1] - x[0] * x[0]) * 10.0);
        out.push(lit::<D>(1.0) - x[0]);
    }
}

fn fit(
    problem: &dyn Problem,
    start: &[f64],
    options: &Options,
) -> Result<stillpoint_solver::Report, Error> {
    solve(
        problem,
        &Parameters::unnamed(start),
        &Mask::all(start.len()),
        options,
    )
}

#[test]
fn a_start_that_is_not_finite_names_the_row() {
    for bad in [f64::NAN, f64::INFINITY] {
        let error = fit(&Valley, &[1.0, bad], &Options::default()).unwrap_err();
        assert!(matches!(error, Error::NotFinite { row: 0, .. }), "{error}");
    }
}

#[test]
fn a_derivative_that_is_not_finite_names_row_and_parameter() {
    let problem = from_fn(|x: &[Jet], out: &mut Vec<Jet>| {
        out.push(x[1]);
        out.push(x[1].sqrt() + x[0]);
    });
    let error = fit(&problem, &[1.0, 0.0], &Options::default()).unwrap_err();
    assert_eq!(
        error,
        Error::DerivativeNotFinite {
            row: 1,
            parameter: "x1".into()
        }
    );
}

#[test]
fn not_a_number_on_the_way_backs_off() {
    // The full Gauss-Newton step from 3 leads to -1.2, where the logarithm is not defined.
    let problem = from_fn(|x: &[Jet], out: &mut Vec<Jet>| out.push(x[0].ln() + 0.3));
    let report = fit(&problem, &[3.0], &Options::default()).unwrap();
    assert!((report.parameters.values()[0] - (-0.3f64).exp()).abs() < 1e-12);
}

#[test]
fn a_problem_that_is_finite_only_at_the_start_says_so() {
    for variant in Variant::all() {
        let problem = from_fn_numeric(|x: &[f64], out: &mut Vec<f64>| {
            out.push(if (x[0] - 1.0).abs() < 1e-4 {
                x[0]
            } else {
                f64::NAN
            });
        });
        let options = Options {
            variant,
            ..Options::default()
        };
        let report = fit(&problem, &[1.0], &options).unwrap();
        assert!(report.parameters.values()[0].is_finite() && report.cost <= 0.5);
    }
}

#[test]
fn a_zero_column_is_left_alone_and_named() {
    let problem = from_fn(|x: &[Jet], out: &mut Vec<Jet>| {
        out.push(x[0] - lit::<Jet>(2.0));
        out.push(x[0] * x[0] - lit::<Jet>(4.0));
    });
    let report = fit(&problem, &[1.0, 7.0], &Options::default()).unwrap();
    assert_eq!(report.parameters.values()[1], 7.0);
    assert_eq!(
        (
            report.uncertainty.rank,
            report.uncertainty.unobservable.clone()
        ),
        (1, vec!["x1".to_owned()])
    );
    assert!(report.termination.converged());
}

#[test]
fn fewer_residuals_than_parameters_give_a_solution_and_the_rank() {
    for variant in Variant::all() {
        let problem = from_fn(|x: &[Jet], out: &mut Vec<Jet>| {
            out.push(x[0] + x[1] * 2.0 + x[2] - lit::<Jet>(6.0))
        });
        let options = Options {
            variant,
            ..Options::default()
        };
        let report = fit(&problem, &[1.0, 0.0, 0.0], &options).unwrap();
        assert!(report.cost < 1e-25, "{variant:?}: {:e}", report.cost);
        assert_eq!(
            (
                report.uncertainty.rank,
                report.uncertainty.unobservable.len()
            ),
            (1, 2)
        );
        assert_eq!(report.reduced_chi2(), None);
    }
}

#[test]
fn a_constant_residual_is_at_its_minimum() {
    for variant in Variant::all() {
        let problem = from_fn(|_: &[Jet], out: &mut Vec<Jet>| out.push(lit::<Jet>(3.0)));
        let options = Options {
            variant,
            ..Options::default()
        };
        let report = fit(&problem, &[1.0], &options).unwrap();
        assert_eq!(
            (report.termination, report.uncertainty.rank),
            (Termination::Gradient, 0)
        );
    }
}

#[test]
fn an_empty_problem_is_an_error() {
    let nothing = from_fn(|_: &[Jet], _: &mut Vec<Jet>| {});
    assert_eq!(
        fit(&nothing, &[1.0], &Options::default()).unwrap_err(),
        Error::Empty {
            residuals: 0,
            free: 1
        }
    );
    let error = solve(
        &Valley,
        &Parameters::unnamed(&[1.0, 1.0]),
        &Parameters::unnamed(&[1.0, 1.0]).free_where(|_| false),
        &Options::default(),
    );
    assert_eq!(
        error.unwrap_err(),
        Error::Empty {
            residuals: 2,
            free: 0
        }
    );
    let error = solve(
        &Valley,
        &Parameters::unnamed(&[1.0, 1.0]),
        &Mask::all(3),
        &Options::default(),
    );
    assert_eq!(
        error.unwrap_err(),
        Error::MaskLength {
            mask: 3,
            parameters: 2
        }
    );
}

#[test]
fn bounds_that_exclude_the_start_are_named_and_projection_helps() {
    let options = Options {
        constraints: Constraints::new().bound("x0", 2.0, 3.0),
        ..Options::default()
    };
    let error = fit(&Valley, &[1.0, 1.0], &options).unwrap_err();
    assert_eq!(
        error,
        Error::StartInfeasible {
            constraint: "x0".into(),
            value: 1.0,
            lower: 2.0,
            upper: 3.0
        }
    );
    let mut start = Parameters::unnamed(&[1.0, 1.0]);
    options
        .constraints
        .project(&mut start, &Mask::all(2))
        .unwrap();
    assert_eq!(start.values(), [2.0, 1.0]);
}

#[test]
fn constraints_that_make_no_sense_are_errors() {
    for (constraints, wanted) in [
        (
            Constraints::new().bound("y", 0.0, 1.0),
            "no parameter is called y",
        ),
        (
            Constraints::new().bound("x0", 1.0, 0.0),
            "nothing lies between 1 and 0",
        ),
        (
            Constraints::new().bound("x0", f64::NAN, 0.0),
            "nothing lies between NaN and 0",
        ),
    ] {
        let options = Options {
            constraints,
            ..Options::default()
        };
        let error = fit(&Valley, &[1.0, 1.0], &options).unwrap_err().to_string();
        assert!(error.contains(wanted), "{error}");
    }
    let mut start = Parameters::unnamed(&[0.0]);
    let apart = Constraints::new()
        .bound("x0", 0.0, 1.0)
        .bound("x0", 2.0, 3.0);
    assert!(apart.project(&mut start, &Mask::all(1)).is_err());
}

#[test]
fn a_callback_that_stops_leaves_the_best_point() {
    let start = Parameters::unnamed(&[-1.2, 1.0]);
    let mut seen = 0;
    let mut stop_after_five = |_: &stillpoint_solver::Iteration, _: &[f64]| {
        seen += 1;
        if seen == 5 {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    };
    let report = solve_observed(
        &Valley,
        &start,
        &Mask::all(2),
        &Options::default(),
        &mut stop_after_five,
    )
    .unwrap();
    assert_eq!(
        (report.termination, report.iterations.len()),
        (Termination::Cancelled, 5)
    );
    assert!(report.cost < 12.1, "{}", report.cost);
}

#[test]
fn limits_stop_the_run_and_say_so() {
    let run = |options: Options| fit(&Valley, &[-1.2, 1.0], &options).unwrap().termination;
    assert_eq!(
        run(Options {
            max_iterations: 3,
            ..Options::default()
        }),
        Termination::IterationLimit
    );
    assert_eq!(
        run(Options {
            time_limit: Some(Duration::ZERO),
            ..Options::default()
        }),
        Termination::TimeLimit
    );
    let flag = Some(Arc::new(AtomicBool::new(true)));
    assert_eq!(
        run(Options {
            cancel: flag,
            ..Options::default()
        }),
        Termination::Cancelled
    );
}

#[test]
fn a_wrong_derivative_stalls_and_says_so() {
    struct Wrong;
    impl Problem for Wrong {
        fn values(&self, x: &[f64], out: &mut Vec<f64>) {
            *out = vec![x[0] - 1.0, 2.0];
        }
        fn linearize(&self, x: &[f64], _: &[usize], out: &mut Vec<f64>) -> faer::Mat<f64> {
            self.values(x, out);
            faer::Mat::from_fn(2, 1, |i, _| if i == 0 { -1.0 } else { 0.0 })
        }
        fn second_derivative(&self, _: &[f64], _: &[f64], _: &mut Vec<f64>) -> bool {
            false
        }
    }
    let report = fit(&Wrong, &[3.0], &Options::default()).unwrap();
    assert!(!report.termination.converged());
    assert!(
        report
            .termination
            .to_string()
            .contains("check the derivatives"),
        "{}",
        report.termination
    );
}

#[test]
fn scales_of_losses_have_to_be_positive() {
    for value in [0.0, -1.0, f64::NAN] {
        let options = Options {
            loss: Loss::Huber(LossScale::Given(value)),
            ..Options::default()
        };
        assert!(matches!(
            fit(&Valley, &[0.0, 1.0], &options),
            Err(Error::LossScale { .. })
        ));
    }
}

#[test]
fn constraints_ask_for_levenberg_marquardt() {
    let constraints = Constraints::new().bound("x0", 0.0, 1.0);
    let options = Options {
        constraints,
        variant: Variant::Dogleg,
        ..Options::default()
    };
    assert!(matches!(
        fit(&Valley, &[0.5, 1.0], &options),
        Err(Error::Unsupported { .. })
    ));
}

#[test]
fn the_report_survives_json() {
    let report = fit(&Valley, &[-1.2, 1.0], &Options::default()).unwrap();
    let text = serde_json::to_string(&report).unwrap();
    let again: stillpoint_solver::Report = serde_json::from_str(&text).unwrap();
    assert_eq!(again.parameters, report.parameters);
    assert_eq!(again.iterations.len(), report.iterations.len());
}
