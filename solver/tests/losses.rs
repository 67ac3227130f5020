//! Robust losses: all of them, by rows, graduated, and what the covariance says.
#![allow(clippy::unwrap_used)]

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use solver::{
    Loss, LossFunction, LossScale, Mask, Options, Parameters, Report, Residual, RowLoss, Scalar,
    lit, multi_start, sandwich_covariance, solve, spread,
};
use stillpoint_solver as solver;

/// `y = a exp(−b t) + c` with outliers.
struct Decay(Vec<(f64, f64)>);

impl<D: Scalar> Residual<D> for Decay {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        for &(t, y) in &self.0 {
            out.push(x[0] * (-x[1] * t).exp() + x[2] - lit::<D>(y));
        }
    }
}

const TRUTH: [f64; 3] = [5.0, 1.3, 1.0];

/// Standard normal by the sum of twelve uniforms.
fn noise(rng: &mut ChaCha8Rng) -> f64 {
    (0..12).map(|_| rng.random::<f64>()).sum::<f64>() - 6.0
}

/// 60 points, 18 of them outliers, all to one side: the harder case.
fn with_outliers(seed: u64) -> Decay {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let point = |i: usize| {
        let t = 0.05 * i as f64;
        let y = TRUTH[0] * (-TRUTH[1] * t).exp() + TRUTH[2] + 0.02 * noise(&mut rng);
        let outlier = if i % 10 < 3 {
            3.0 + 4.0 * rng.random::<f64>()
        } else {
            0.0
        };
        (t, y + outlier)
    };
    Decay((0..60).map(point).collect())
}

fn fit(problem: &Decay, start: &[f64], options: &Options) -> Report {
    let mask = Mask::all(start.len());
    solve(problem, &Parameters::unnamed(start), &mask, options).unwrap()
}

fn is_right(report: &Report) -> bool {
    let apart = report.parameters.values().iter().zip(TRUTH);
    // Five standard errors at noise 0.02 are below 0.15 for all three.
    apart.into_iter().all(|(x, truth)| (x - truth).abs() < 0.15)
}

#[test]
fn forty_far_starts_with_thirty_percent_outliers_lead_to_the_right_minimum() {
    let starts = spread(&[0.5, 0.2, -20.0], &[20.0, 3.0, 20.0], 40);
    for loss in [
        Loss::Tukey(LossScale::Given(0.1)),
        Loss::GemanMcClure(LossScale::Given(0.06)),
    ] {
        let options = Options {
            loss,
            graduated: true,
            ..Options::default()
        };
        let right = (starts.iter().enumerate())
            .filter(|(i, start)| is_right(&fit(&with_outliers(*i as u64), start, &options)))
            .count();
        println!("{loss:?}: {right} of 40");
        assert!(right >= 38, "{loss:?}: {right} of 40");
    }
}

#[test]
fn a_start_where_no_residual_counts_is_graduated_and_not_called_converged_there() {
    let options = Options {
        loss: Loss::Tukey(LossScale::Given(0.1)),
        ..Options::default()
    };
    for (i, start) in spread(&[50.0, 0.0, 100.0], &[90.0, 3.0, 400.0], 40)
        .iter()
        .enumerate()
    {
        let report = fit(&with_outliers(i as u64), start, &options);
        let counted = report.weights.iter().filter(|w| **w > 0.0).count();
        assert!(counted >= 3 || !report.termination.converged(), "{report}");
    }
}

/// `ρ = 2 (√s − ln(1 + √s))`: Fair's.
#[derive(Debug)]
struct Fair;

impl LossFunction for Fair {
    fn at(&self, s: f64) -> [f64; 3] {
        let root = s.sqrt().max(1e-150);
        let below = 1.0 + root;
        [
            2.0 * (root - root.ln_1p()),
            1.0 / below,
            -0.5 / (root * below * below),
        ]
    }
}

#[test]
fn every_loss_finds_what_the_good_points_say() {
    let scale = LossScale::Given(0.05);
    for loss in [
        Loss::SoftL1(scale),
        Loss::Arctan(scale),
        Loss::GemanMcClure(scale),
        Loss::own(&Fair, scale),
    ] {
        let report = fit(
            &with_outliers(3),
            &[4.0, 1.0, 0.5],
            &Options {
                loss,
                ..Options::default()
            },
        );
        assert!(report.termination.converged(), "{loss:?} {report}");
        // Losses that grow let outliers of one sign pull a little.
        assert!(
            (report.parameters.values()[1] - TRUTH[1]).abs() < 0.5,
            "{loss:?} {report}"
        );
    }
}

#[test]
fn rows_have_losses_of_their_own() {
    // Outliers in the first thirty rows only; the loss of those rows is robust, the rest counts in full.
    let mut data = with_outliers(5);
    for (i, point) in data.0.iter_mut().enumerate().skip(30) {
        let t = point.0;
        point.1 = TRUTH[0] * (-TRUTH[1] * t).exp()
            + TRUTH[2]
            + 0.01 * if i % 2 == 0 { 1.0 } else { -1.0 };
    }
    let options = Options {
        row_losses: vec![RowLoss {
            rows: 0..30,
            loss: Loss::Tukey(LossScale::Estimated(4.685)),
        }],
        graduated: true,
        ..Options::default()
    };
    let report = fit(&data, &[1.0, 1.0, 0.0], &options);
    assert!(is_right(&report), "{report}");
    assert!(report.weights[30..].iter().all(|w| *w == 1.0));
    assert_eq!(report.loss_scale, None);
    assert!(
        report.row_loss_scales[0].is_some_and(|s| s < 0.5),
        "{:?}",
        report.row_loss_scales
    );
}

/// A line through points whose noise grows with t.
struct Line(Vec<(f64, f64)>);

impl<D: Scalar> Residual<D> for Line {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        out.extend(self.0.iter().map(|&(t, y)| x[0] + x[1] * t - lit::<D>(y)));
    }
}

#[test]
fn the_sandwich_covers_noise_that_grows_where_the_classical_covariance_does_not() {
    let (mut classical, mut robust, runs) = (0, 0, 400);
    for seed in 0..runs {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let point = |i: i32| {
            let t = f64::from(i) / 100.0;
            (t, 1.0 + 2.0 * t + t.powi(2) * noise(&mut rng))
        };
        let line = Line((0..200).map(point).collect());
        let (mask, options) = (Mask::all(2), Options::default());
        let report = solve(&line, &Parameters::unnamed(&[0.0, 0.0]), &mask, &options).unwrap();
        let sandwich = sandwich_covariance(&line, &report, &mask, &options).unwrap();
        let apart = (report.parameters.values()[0] - 1.0).abs();
        classical += usize::from(apart < 1.96 * report.standard_error(0).unwrap());
        robust += usize::from(apart < 1.96 * sandwich[0][0].sqrt());
    }
    // 95 % of 400 is 380 ± 4.4; the intercept, where the noise is small, is known far better than the
    // classical covariance says: it covers nearly always.
    assert!((366..=394).contains(&robust), "{robust}");
    assert!(classical >= 398, "{classical}");
}

#[test]
fn many_starts_lead_to_the_minima_there_are() {
    /// Himmelblau's function: four minima of cost zero.
    struct Himmelblau;
    impl<D: Scalar> Residual<D> for Himmelblau {
        fn residuals(&self, x: &[D], out: &mut Vec<D>) {
            out.push(x[0] * x[0] + x[1] - lit::<D>(11.0));
            out.push(x[0] + x[1] * x[1] - lit::<D>(7.0));
        }
    }
    let starts: Vec<Parameters> = spread(&[-5.0, -5.0], &[5.0, 5.0], 40)
        .iter()
        .map(|x| Parameters::unnamed(x))
        .collect();
    let found = multi_start(&Himmelblau, &starts, &Mask::all(2), &Options::default());
    let zeros = found
        .minima
        .iter()
        .filter(|m| m.report.cost < 1e-20)
        .count();
    assert_eq!(zeros, 4);
    let known = found.minima.iter().map(|m| m.starts.len()).sum::<usize>();
    assert_eq!(known + found.unfinished.len() + found.failed.len(), 40);
}
