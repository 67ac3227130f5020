//! Covariance, rank, unobservable directions, profiles and robust losses.

#![allow(clippy::unwrap_used)]

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use stillpoint_solver::{
    Constraints, DualNum, Error, Jet, Loss, LossScale, Mask, Options, Parameters, Residual, Scalar,
    from_fn, lit, profile_interval, solve,
};

/// `y = a + b t` at `t = 0 … 9` with the given deviations from `1 + 2 t`.
struct Line([f64; 10]);

impl<D: Scalar> Residual<D> for Line {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        for (i, deviation) in self.0.iter().enumerate() {
            let t = i as f64;
            out.push(x[0] + x[1] * t - lit::<D>(1.0 + 2.0 * t + deviation));
        }
    }
}

const NOISE: [f64; 10] = [0.1, -0.2, 0.05, 0.1, -0.1, 0.2, -0.15, 0.0, 0.1, -0.1];

fn named(values: &[f64], names: &[&str]) -> Parameters {
    let mut parameters = Parameters::new();
    for (name, value) in names.iter().zip(values) {
        parameters.push(*name, "", *value);
    }
    parameters
}

#[test]
fn covariance_of_a_line_is_the_textbook_one() {
    let report = solve(
        &Line(NOISE),
        &named(&[0.0, 0.0], &["a", "b"]),
        &Mask::all(2),
        &Options::default(),
    )
    .unwrap();
    // Σ (t − 4.5)² = 82.5; var b = 1 / 82.5, var a = 1/10 + 4.5² / 82.5, cov = −4.5 / 82.5.
    let c = &report.uncertainty.covariance;
    for (value, wanted) in [
        (c[1][1], 1.0 / 82.5),
        (c[0][0], 0.1 + 20.25 / 82.5),
        (c[0][1], -4.5 / 82.5),
    ] {
        assert!((value - wanted).abs() < 1e-14, "{value} {wanted}");
    }
    let wanted = -4.5 / 28.5f64.sqrt();
    assert!((report.uncertainty.correlation(0, 1) - wanted).abs() < 1e-12);
}

#[test]
fn the_profile_interval_of_a_linear_parameter_is_symmetric_by_standard_errors() {
    let (mask, options) = (Mask::all(2), Options::default());
    let report = solve(
        &Line(NOISE),
        &named(&[0.0, 0.0], &["a", "b"]),
        &mask,
        &options,
    )
    .unwrap();
    let sigma = report.reduced_chi2().unwrap().sqrt();
    for (k, name) in ["a", "b"].into_iter().enumerate() {
        let interval =
            profile_interval(&Line(NOISE), &report, &mask, &options, name, 1.96).unwrap();
        let half = 1.96 * report.uncertainty.standard_error(k, sigma);
        // The search stops at 1e-6 of the interval.
        assert!((interval.upper.unwrap() - interval.value - half).abs() < 3e-6 * half);
        assert!((interval.value - interval.lower.unwrap() - half).abs() < 3e-6 * half);
    }
}

#[test]
fn a_parameter_that_the_data_do_not_bound_above_has_no_upper_end() {
    // Rises to 1 within the first sample: the rate may be arbitrarily large.
    let rise = from_fn(|x: &[Jet], out: &mut Vec<Jet>| {
        for (t, y) in [(1.0, 0.96), (2.0, 1.03), (3.0, 0.98), (4.0, 1.01)] {
            out.push(lit::<Jet>(1.0 - y) - (-x[0] * t).exp());
        }
    });
    let (start, mask, options) = (
        Parameters::unnamed(&[2.0]),
        Mask::all(1),
        Options::default(),
    );
    let report = solve(&rise, &start, &mask, &options).unwrap();
    let interval = profile_interval(&rise, &report, &mask, &options, "x0", 1.96).unwrap();
    assert!(
        interval.lower.is_some() && interval.upper.is_none(),
        "{interval:?}"
    );
}

#[test]
fn directions_that_the_data_cannot_see_are_named() {
    let problem = from_fn(|x: &[Jet], out: &mut Vec<Jet>| {
        for i in 0..6 {
            let t = f64::from(i);
            out.push((x[0] - x[1]) * t + x[2] - lit::<Jet>(t * t));
        }
    });
    let start = named(
        &[0.5, 0.1, 0.0, 4.0],
        &["alpha_xz", "alpha_yx", "bias", "unused"],
    );
    let report = solve(&problem, &start, &Mask::all(4), &Options::default()).unwrap();
    let mut unseen = report.uncertainty.unobservable.clone();
    unseen.sort();
    assert_eq!(
        (report.uncertainty.rank, unseen),
        (
            2,
            vec!["alpha_xz + alpha_yx".to_owned(), "unused".to_owned()]
        )
    );
}

#[test]
fn robust_losses_resist_outliers_and_report_the_weights() {
    let mut noise = NOISE;
    (noise[2], noise[7]) = (30.0, -50.0);
    let losses = [
        Loss::Huber(LossScale::Estimated(1.345)),
        Loss::Cauchy(LossScale::Estimated(2.385)),
        Loss::Tukey(LossScale::Estimated(4.685)),
        Loss::Huber(LossScale::Given(0.2)),
        Loss::Cauchy(LossScale::Given(0.3)),
        Loss::Tukey(LossScale::Given(3.0)),
    ];
    for loss in losses {
        let options = Options {
            loss,
            ..Options::default()
        };
        let report = solve(
            &Line(noise),
            &named(&[0.0, 1.9], &["a", "b"]),
            &Mask::all(2),
            &options,
        )
        .unwrap();
        let x = report.parameters.values();
        assert!(
            report.termination.converged(),
            "{loss:?}: {:?}",
            report.termination
        );
        assert!(
            (x[0] - 1.0).abs() < 0.3 && (x[1] - 2.0).abs() < 0.06,
            "{loss:?}: {x:?}"
        );
        assert!(
            report.weights[7] < 0.02 && report.weights[5] > 0.2,
            "{loss:?}: {:?}",
            report.weights
        );
        // Stationary: Σ w r ∂r/∂x = 0.
        let sum = |f: &dyn Fn(usize) -> f64| -> f64 {
            (0..10)
                .map(|i| report.weights[i] * report.residuals[i] * f(i))
                .sum()
        };
        assert!(
            sum(&|_| 1.0).abs() < 1e-8 && sum(&|i| i as f64).abs() < 1e-7,
            "{loss:?}"
        );
    }
}

#[test]
fn a_robust_loss_with_a_wide_scale_is_least_squares() {
    let start = named(&[0.0, 0.0], &["a", "b"]);
    let plain = solve(&Line(NOISE), &start, &Mask::all(2), &Options::default()).unwrap();
    let options = Options {
        loss: Loss::Huber(LossScale::Given(1e3)),
        ..Options::default()
    };
    let wide = solve(&Line(NOISE), &start, &Mask::all(2), &options).unwrap();
    assert_eq!(plain.parameters, wide.parameters);
    assert!(wide.weights.iter().all(|w| *w == 1.0));
}

/// `x₀ e^(−x₁ t)` against a decay from 2 at 0.7, with a ripple.
fn decay(x: &[Jet], out: &mut Vec<Jet>) {
    for i in 0..8 {
        let t = 0.5 * f64::from(i);
        let y = 2.0 * (-0.7 * t).exp() + 0.1 * (7.0 * t * t + 1.0).sin();
        out.push(x[0] * (-x[1] * t).exp() - lit::<Jet>(y));
    }
}

/// The 95 % interval of `x1`.
fn profile(options: &Options, start: [f64; 2]) -> stillpoint_solver::ProfileInterval {
    let (problem, mask) = (from_fn(decay), Mask::all(2));
    let report = solve(&problem, &Parameters::unnamed(&start), &mask, options).unwrap();
    profile_interval(&problem, &report, &mask, options, "x1", 1.96).unwrap()
}

fn within(constraints: Constraints) -> Options {
    Options {
        constraints,
        ..Options::default()
    }
}

#[test]
fn a_profile_interval_ends_at_a_bound_and_is_there_for_a_parameter_on_its_bound() {
    let free = profile(&Options::default(), [1.0, 1.0]);
    let (below, above) = (free.value - 0.01, free.value + 0.01);
    let cut = profile(
        &within(Constraints::new().bound("x1", below, above)),
        [1.0, free.value],
    );
    // To 1e-6 of an interval half as long as 0.09.
    assert!((cut.lower.unwrap() - below).abs() < 1e-6 && cut.lower.unwrap() >= below);
    assert!((cut.upper.unwrap() - above).abs() < 1e-6 && cut.upper.unwrap() <= above);
    // On its bound the parameter has no variance, and yet the data bound it below.
    let options = within(Constraints::new().bound("x1", f64::NEG_INFINITY, below));
    let held = profile(&options, [1.0, 0.5]);
    assert_eq!(held.value, below);
    assert!((held.upper.unwrap() - below).abs() < 1e-6);
    let cost_at = |x1: f64| {
        let start = Parameters::unnamed(&[1.0, x1]);
        let mask = Mask::all(2).without(1);
        solve(&from_fn(decay), &start, &mask, &Options::default())
            .unwrap()
            .cost
    };
    // One parameter is fitted, the other sits on its bound: seven of eight residuals are to spare.
    let level = cost_at(below) * (1.0 + 1.96f64.powi(2) / 7.0);
    assert!((cost_at(held.lower.unwrap()) / level - 1.0).abs() < 1e-5);
}

#[test]
fn a_profile_interval_respects_a_tie() {
    let options = within(Constraints::new().tie("x0", "x1"));
    let tied = profile(&options, [1.0, 1.0]);
    let one = from_fn(|x: &[Jet], out: &mut Vec<Jet>| decay(&[x[0], x[0]], out));
    let (start, mask) = (Parameters::unnamed(&[1.0]), Mask::all(1));
    let report = solve(&one, &start, &mask, &Options::default()).unwrap();
    let direct = profile_interval(&one, &report, &mask, &Options::default(), "x0", 1.96).unwrap();
    for (a, b) in [(tied.lower, direct.lower), (tied.upper, direct.upper)] {
        assert!((a.unwrap() - b.unwrap()).abs() < 1e-5, "{a:?} {b:?}");
    }
}

#[test]
fn one_of_two_parameters_of_which_only_the_sum_is_seen_has_no_ends() {
    let sum = from_fn(|x: &[Jet], out: &mut Vec<Jet>| {
        out.extend((0..8).map(|i| x[0] + x[1] - lit::<Jet>(f64::from(i))));
    });
    let (mask, options) = (Mask::all(2), Options::default());
    let report = solve(&sum, &Parameters::unnamed(&[1.0, 1.0]), &mask, &options).unwrap();
    let interval = profile_interval(&sum, &report, &mask, &options, "x1", 1.96).unwrap();
    assert_eq!((interval.lower, interval.upper), (None, None));
}

#[test]
fn the_profile_of_a_single_parameter_counts_outliers_as_the_fit_does() {
    let level = from_fn(|x: &[Jet], out: &mut Vec<Jet>| {
        for (i, noise) in NOISE.iter().enumerate() {
            let outlier = if i == 4 { 50.0 } else { 0.0 };
            out.push(x[0] - lit::<Jet>(noise + outlier));
        }
    });
    let mask = Mask::all(1);
    for scale in [LossScale::Given(0.1), LossScale::Estimated(1.345)] {
        let options = Options {
            loss: Loss::Huber(scale),
            ..Options::default()
        };
        let report = solve(&level, &Parameters::unnamed(&[0.0]), &mask, &options).unwrap();
        let interval = profile_interval(&level, &report, &mask, &options, "x0", 1.96).unwrap();
        let half = 1.96 * report.standard_error(0).unwrap();
        let found = 0.5 * (interval.upper.unwrap() - interval.lower.unwrap());
        // Piecewise quadratic near the minimum: alike, not equal.
        assert!((0.5..2.0).contains(&(found / half)), "{found} {half}");
    }
}

#[test]
fn a_profile_that_cannot_be_had_is_an_error() {
    let (problem, mask) = (from_fn(decay), Mask::all(2));
    let start = Parameters::unnamed(&[1.0, 1.0]);
    let report = solve(&problem, &start, &mask, &Options::default()).unwrap();
    for z in [0.0, -1.0, f64::NAN] {
        let error = profile_interval(&problem, &report, &mask, &Options::default(), "x1", z);
        assert!(matches!(error, Err(Error::ProfileLevel { .. })), "{z}");
    }
    let hurried = Options {
        time_limit: Some(std::time::Duration::ZERO),
        ..Options::default()
    };
    let error = profile_interval(&problem, &report, &mask, &hurried, "x1", 1.96);
    assert!(matches!(error, Err(Error::Refit { .. })), "{error:?}");
}

#[test]
fn standard_errors_under_a_robust_loss_are_those_of_many_draws() {
    let mut rng = ChaCha8Rng::seed_from_u64(11);
    // A tenth of the noise is ten times as wide.
    let mut draw = || {
        let gauss = (0..12).map(|_| rng.random_range(-0.5..0.5)).sum::<f64>();
        if rng.random_bool(0.1) {
            10.0 * gauss
        } else {
            gauss
        }
    };
    let options = Options {
        loss: Loss::Huber(LossScale::Estimated(1.345)),
        ..Options::default()
    };
    let (mut values, mut variance) = (Vec::new(), 0.0);
    for _ in 0..400 {
        let y: Vec<f64> = (0..40).map(|_| draw()).collect();
        let line = from_fn(|x: &[Jet], out: &mut Vec<Jet>| {
            let t = |i: usize| i as f64 / 39.0 - 0.5;
            out.extend(
                y.iter()
                    .enumerate()
                    .map(|(i, &y)| x[0] + x[1] * t(i) - lit::<Jet>(y)),
            );
        });
        let start = Parameters::unnamed(&[0.0, 0.0]);
        let report = solve(&line, &start, &Mask::all(2), &options).unwrap();
        values.push(report.parameters.values()[1]);
        variance += report.standard_error(1).unwrap().powi(2) / 400.0;
    }
    let scatter = values.iter().map(|v| v * v).sum::<f64>() / 400.0;
    // The scatter of 400 draws is known to 4 %; the reduced chi² gave 1.6.
    let ratio = (variance / scatter).sqrt();
    assert!((0.85..1.15).contains(&ratio), "{ratio}");
}
