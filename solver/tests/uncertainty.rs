//! Covariance, rank, unobservable directions, profiles and robust losses.

#![allow(clippy::unwrap_used)]

use stillpoint_solver::{
    DualNum, Jet, Loss, LossScale, Mask, Options, Parameters, Residual, Scalar, from_fn, lit,
    profile_interval, solve,
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
