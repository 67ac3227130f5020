//! Losses on factors: graduated, without weight, and the sandwich covariance.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use stillpoint_solver::{
    Block, Euclidean, Graph, GraphOptions, Loss, LossScale, Mask, Options, Parameters, Products,
    Residual, Scalar, Termination, sandwich_covariance, solve, solve_graph,
};

/// `a exp(−b t) + c = y`.
#[derive(Clone)]
struct Point(f64, f64);

impl<D: Scalar> Residual<D> for Point {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        out.push(x[0] * (-x[1] * self.0).exp() + x[2] - self.1);
    }
}

/// All points at once.
struct Points(Vec<Point>);

impl<D: Scalar> Residual<D> for Points {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        for point in &self.0 {
            point.residuals(x, out);
        }
    }
}

fn noise(rng: &mut ChaCha8Rng) -> f64 {
    (0..12).map(|_| rng.random::<f64>()).sum::<f64>() - 6.0
}

const TRUTH: [f64; 3] = [5.0, 1.3, 1.0];

/// 60 points, 18 of them outliers, all to one side: those of `losses.rs`, a factor each.
fn with_outliers(seed: u64) -> Vec<Point> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let point = |i: usize| {
        let t = 0.05 * i as f64;
        let y = TRUTH[0] * (-TRUTH[1] * t).exp() + TRUTH[2] + 0.02 * noise(&mut rng);
        let outlier = match i % 10 < 3 {
            true => 3.0 + 4.0 * rng.random::<f64>(),
            false => 0.0,
        };
        Point(t, y + outlier)
    };
    (0..60).map(point).collect()
}

fn graph(points: &[Point], start: &[f64], loss: Loss) -> (Graph<'static>, Block) {
    let mut graph = Graph::new();
    let curve = graph.add("curve", Euclidean(3), start).unwrap();
    for point in points {
        graph.add_robust_factor(&[curve], point.clone(), loss);
    }
    (graph, curve)
}

fn far_starts() -> Vec<Vec<f64>> {
    stillpoint_solver::spread(&[0.5, 0.2, -20.0], &[20.0, 3.0, 20.0], 40)
}

#[test]
fn graduated_factors_lead_from_most_far_starts_to_the_right_minimum() {
    for loss in [
        Loss::Tukey(LossScale::Given(0.1)),
        Loss::GemanMcClure(LossScale::Given(0.06)),
    ] {
        let right = |(seed, start): (usize, &Vec<f64>)| {
            let (graph, curve) = graph(&with_outliers(seed as u64), start, loss);
            let options = GraphOptions {
                graduated: true,
                ..GraphOptions::default()
            };
            let report = solve_graph(&graph, &options).unwrap();
            let apart = TRUTH.iter().zip(report.value(curve));
            let near = apart.into_iter().all(|(t, x)| (t - x).abs() < 0.15);
            report.termination.converged() && near
        };
        let right = far_starts()
            .iter()
            .enumerate()
            .filter(|s| right(*s))
            .count();
        println!("{loss:?}: {right} of 40");
        assert!(right >= 38, "{loss:?}: {right} of 40");
    }
}

#[test]
fn a_start_where_no_factor_counts_is_graduated_and_not_called_converged_there() {
    let starts = stillpoint_solver::spread(&[50.0, 0.0, 100.0], &[90.0, 3.0, 400.0], 40);
    for (i, start) in starts.iter().enumerate() {
        let loss = Loss::Tukey(LossScale::Given(0.1));
        let (graph, _) = graph(&with_outliers(i as u64), start, loss);
        let report = solve_graph(&graph, &GraphOptions::default()).unwrap();
        let residuals = graph.residuals(&report.values);
        let counted = residuals.iter().filter(|r| r.abs() < 0.1).count();
        assert!(counted >= 3 || !report.termination.converged(), "{report}");
        assert_ne!(report.values, *start);
    }
}

#[test]
fn an_end_at_which_too_few_factors_count_is_no_minimum() {
    // Two clouds of one point each for two numbers: none counts under a loss so narrow.
    let mut graph = Graph::new();
    let x = graph.add("x", Euclidean(3), &[0.0, 0.0, 0.0]).unwrap();
    let narrow = Loss::Tukey(LossScale::Given(1e-3));
    for (t, y) in [(0.0, 1.0), (0.0, 2.0), (0.0, 3.0), (0.0, 4.0)] {
        graph.add_robust_factor(&[x], Point(t, y), narrow);
    }
    let report = solve_graph(&graph, &GraphOptions::default()).unwrap();
    assert_eq!(report.termination, Termination::Weightless);
    assert!(!report.termination.converged());
}

#[test]
fn the_sandwich_of_single_rows_is_the_dense_one() {
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    let points: Vec<Point> = (0..80)
        .map(|k| {
            let t = 0.05 * f64::from(k);
            Point(t, 5.0 * (-0.7 * t).exp() + 1.0 + 0.1 * t * noise(&mut rng))
        })
        .collect();
    let (graph, curve) = graph(&points, &[4.0, 0.5, 0.5], Loss::Quadratic);
    let report = solve_graph(&graph, &GraphOptions::default()).unwrap();
    let products = Products::new(&graph, &report.values).unwrap();
    let ours = products.sandwich(&[curve]).unwrap();
    let problem = Points(points);
    let start = Parameters::unnamed(&report.values);
    let (mask, options) = (Mask::all(3), Options::default());
    let dense = solve(&problem, &start, &mask, &options).unwrap();
    let theirs = sandwich_covariance(&problem, &dense, &mask, &options).unwrap();
    for (a, b) in ours.iter().flatten().zip(theirs.iter().flatten()) {
        assert!((a / b - 1.0).abs() < 1e-8, "{a} {b}");
    }
}

/// `x − y_k` for several readings that share an error.
struct Readings(Vec<f64>);

impl<D: Scalar> Residual<D> for Readings {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        out.extend(self.0.iter().map(|&y| x[0] - y));
    }
}

#[test]
fn the_sandwich_sees_that_readings_of_a_factor_share_their_error() {
    let mut rng = ChaCha8Rng::seed_from_u64(4);
    let mut graph = Graph::new();
    let x = graph.add("x", Euclidean(1), &[0.0]).unwrap();
    for _ in 0..400 {
        let shared = noise(&mut rng);
        let readings = (0..9).map(|_| shared + 0.1 * noise(&mut rng)).collect();
        graph.add_factor(&[x], Readings(readings));
    }
    let report = solve_graph(&graph, &GraphOptions::default()).unwrap();
    let products = Products::new(&graph, &report.values).unwrap();
    // The mean of 400 errors of variance 1; the classical one says a ninth of that.
    let sandwich = products.sandwich(&[x]).unwrap()[0][0];
    assert!((400.0 * sandwich - 1.0).abs() < 0.2, "{sandwich}");
}

#[test]
fn a_loss_whose_scale_squared_is_nothing_is_refused() {
    for scale in [1e-200, 0.0, -1.0, f64::NAN, 1e200] {
        let loss = Loss::Tukey(LossScale::Given(scale));
        let (graph, _) = graph(&with_outliers(1), &[4.0, 0.5, 0.5], loss);
        let error = solve_graph(&graph, &GraphOptions::default()).unwrap_err();
        assert!(error.to_string().contains("scale"), "{scale}: {error}");
    }
}
