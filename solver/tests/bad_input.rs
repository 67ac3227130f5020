//! Bad input is a typed error or a termination, never a panic, and the best point is returned.

#![allow(clippy::unwrap_used)]

use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use stillpoint_solver::{
    Constraints, DualNum, Error, Jet, Loss, LossScale, Mask, Options, Parameters, Problem,
    Residual, Scalar, Termination, Variant, check_derivatives, from_fn, from_fn_numeric, lit,
    solve, solve_observed,
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
        assert_eq!(
            report.termination,
            Termination::NotFinite {
                row: 0,
                parameter: None
            },
            "{variant:?}"
        );
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
        (
            Constraints::new().bound("x0", f64::INFINITY, f64::INFINITY),
            "nothing lies between inf and inf",
        ),
        (
            Constraints::new().bounds(&Parameters::unnamed(&[1.0]), &[f64::NAN], &[f64::INFINITY]),
            "nothing lies between NaN and inf",
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
    for value in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-200] {
        for scale in [LossScale::Given(value), LossScale::Estimated(value)] {
            if scale == LossScale::Estimated(1e-200) {
                // As a factor it only makes the scale the least there is.
                continue;
            }
            let options = Options {
                loss: Loss::Huber(scale),
                ..Options::default()
            };
            let outcome = fit(&Valley, &[0.0, 1.0], &options);
            assert!(matches!(outcome, Err(Error::LossScale { .. })), "{scale:?}");
        }
    }
}

#[test]
fn minimum_norm_steps_know_no_constraints() {
    let constraints = Constraints::new().bound("x0", 0.0, 1.0);
    let options = Options {
        constraints,
        variant: Variant::GaussNewtonMinimumNorm,
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

#[test]
fn options_and_constraints_survive_json_with_their_infinities() {
    let options = Options {
        variant: Variant::Dogleg,
        constraints: Constraints::new().bound("a", 0.5, f64::INFINITY).bound(
            "b",
            f64::NEG_INFINITY,
            1.0,
        ),
        loss: Loss::Huber(LossScale::Given(2.0)),
        time_limit: Some(Duration::from_millis(1500)),
        ..Options::default()
    };
    let text = serde_json::to_string(&options).unwrap();
    let again: Options = serde_json::from_str(&text).unwrap();
    assert_eq!(again.constraints, options.constraints);
    assert_eq!(
        (again.variant, again.loss, again.time_limit),
        (options.variant, options.loss, options.time_limit)
    );
    let partial: Options = serde_json::from_str(r#"{"max_iterations": 7}"#).unwrap();
    assert_eq!(
        (partial.max_iterations, partial.gradient_tolerance),
        (7, Options::default().gradient_tolerance)
    );
}

#[test]
fn parameters_without_a_name_each_are_not_read() {
    let text = r#"{"names": ["a"], "units": ["", ""], "values": [1.0, 2.0]}"#;
    let error = serde_json::from_str::<Parameters>(text).unwrap_err();
    assert!(
        error.to_string().contains("1 names and 2 units for 2"),
        "{error}"
    );
    assert!(!Mask::all(2).is_free(2));
}

#[test]
fn a_jacobian_of_the_wrong_shape_is_an_error() {
    struct Shaped(usize, usize);
    impl Problem for Shaped {
        fn values(&self, x: &[f64], out: &mut Vec<f64>) {
            *out = vec![x[0] - 1.0, x[1], 3.0];
        }
        fn linearize(&self, x: &[f64], _: &[usize], out: &mut Vec<f64>) -> faer::Mat<f64> {
            self.values(x, out);
            faer::Mat::identity(self.0, self.1)
        }
        fn second_derivative(&self, _: &[f64], _: &[f64], _: &mut Vec<f64>) -> bool {
            false
        }
    }
    assert!(fit(&Shaped(3, 2), &[3.0, 3.0], &Options::default()).is_ok());
    for (m, n) in [(2, 2), (4, 2), (3, 1), (3, 3), (0, 0)] {
        let problem = Shaped(m, n);
        let outcome = fit(&problem, &[3.0, 3.0], &Options::default());
        assert!(
            matches!(outcome, Err(Error::DerivativeNotFinite { .. })),
            "{m} {n}"
        );
        let start = Parameters::unnamed(&[3.0, 3.0]);
        assert_eq!(check_derivatives(&problem, &start, 1e-6).len(), 6);
    }
}

#[test]
fn a_step_to_where_residuals_go_missing_is_not_a_better_one() {
    // Below 1/2 the larger residual is left out, as by a filter of rows that cannot be computed.
    let problem = from_fn(|x: &[Jet], out: &mut Vec<Jet>| {
        out.push(x[0]);
        if x[0].re > 0.5 {
            out.push(lit::<Jet>(3.0) - x[0] * 0.1);
        }
    });
    let report = fit(&problem, &[2.0], &Options::default()).unwrap();
    assert!(report.residuals.len() == 2 && report.parameters.values()[0] > 0.5);
    assert!(!report.termination.converged());
}

#[test]
fn a_limit_is_said_to_be_the_reason_however_large_the_parameters() {
    // Four seconds off in seconds since 1970: a relative step of 2e-9.
    let problem = from_fn(|x: &[Jet], out: &mut Vec<Jet>| {
        out.push(x[0] - lit::<Jet>(1.7e9));
        out.push(lit::<Jet>(0.5));
    });
    let options = Options {
        max_iterations: 0,
        ..Options::default()
    };
    let report = fit(&problem, &[1.7e9 + 4.0], &options).unwrap();
    assert_eq!(report.termination, Termination::IterationLimit);
}

#[test]
fn a_callback_that_stops_is_not_called_again_under_a_loss_of_unknown_scale() {
    let problem = from_fn(|x: &[Jet], out: &mut Vec<Jet>| {
        out.extend((0..9).map(|i| x[0] - lit::<Jet>(f64::from(i % 4))));
    });
    let options = Options {
        loss: Loss::Huber(LossScale::Estimated(1.345)),
        ..Options::default()
    };
    let mut calls = 0;
    let mut stop = |_: &stillpoint_solver::Iteration, _: &[f64]| {
        calls += 1;
        ControlFlow::Break(())
    };
    let start = Parameters::unnamed(&[1.0]);
    let report = solve_observed(&problem, &start, &Mask::all(1), &options, &mut stop).unwrap();
    assert_eq!((report.termination, calls), (Termination::Cancelled, 1));
}

#[test]
fn differences_are_taken_in_the_size_of_the_parameter_and_on_the_side_that_is_finite() {
    // A rate of 1e-8, and a logarithm next to its zero.
    let rate = from_fn_numeric(|x: &[f64], out: &mut Vec<f64>| {
        out.extend((0..5).map(|i| {
            let t = f64::from(i);
            (1e8 * x[0] * t).exp() - (2.0 * t).exp()
        }));
    });
    let report = fit(&rate, &[1e-8], &Options::default()).unwrap();
    assert!((report.parameters.values()[0] / 2e-8 - 1.0).abs() < 1e-9);
    let log = from_fn_numeric(|x: &[f64], out: &mut Vec<f64>| {
        out.push((x[0] + 1e-300).ln() / 690.0 + 1.0);
        out.push(if x[1] < 0.0 {
            f64::NAN
        } else {
            x[1] + x[1] * x[1] - 2.0
        });
    });
    let report = fit(&log, &[1e-6, 0.0], &Options::default()).unwrap();
    assert!((report.parameters.values()[1] - 1.0).abs() < 1e-9);
    // A parameter that happens to be near zero is of ordinary size nevertheless.
    let line = from_fn_numeric(|x: &[f64], out: &mut Vec<f64>| {
        out.extend((0..5).map(|i| (x[0] + 0.3 * f64::from(i)).sin() - 0.5));
    });
    let mismatches = check_derivatives(&line, &Parameters::unnamed(&[1e-13]), 1e-8);
    assert!(mismatches.is_empty());
    let mut residuals = Vec::new();
    let slope = line.linearize(&[1e-13], &[0], &mut residuals);
    for i in 0..5 {
        assert!((slope[(i, 0)] - (0.3 * i as f64).cos()).abs() < 1e-9);
    }
}

#[test]
fn columns_without_a_name_are_called_by_their_number() {
    let names = |names: &[&str]| names.iter().map(|n| n.to_string()).collect();
    let jacobian = faer::Mat::from_fn(3, 2, |i, k| (i * (1 - k)) as f64);
    let few = stillpoint_solver::uncertainty(&jacobian, names(&["a"]));
    assert_eq!(
        (few.names, few.unobservable),
        (names(&["a", "x1"]), names(&["x1"]))
    );
    let many = stillpoint_solver::uncertainty(&jacobian, names(&["a", "b", "c"]));
    assert_eq!(many.names, names(&["a", "b"]));
}
