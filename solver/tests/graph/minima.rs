//! Graphs against dense solutions and closed forms.

use crate::random_graphs::{Random, Rows};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use stillpoint_solver::quaternion::{exponential, logarithm, multiply, rotate};
use stillpoint_solver::{
    Block, Direction, Euclidean, Graph, GraphOptions, Manifold, Mask, Options, Parameters,
    Residual, Rotation, Scalar, lit, solve, solve_graph,
};

#[test]
fn two_hundred_random_graphs_have_the_minimum_of_the_dense_problem() {
    let mut rng = ChaCha8Rng::seed_from_u64(11);
    let mut methods = [0; 3];
    for trial in 0..200 {
        let random = Random::new(&mut rng, trial);
        let (graph, _) = random.graph();
        let report = solve_graph(&graph, &GraphOptions::default()).unwrap();
        assert!(
            report.termination.converged(),
            "{trial}: {}",
            report.termination
        );
        let n: usize = random.widths.iter().sum();
        let free: Vec<usize> = (0..n).collect();
        let at_end = Parameters::unnamed(&report.values);
        let options = Options {
            max_iterations: 50,
            ..Options::default()
        };
        // From the end found, so that both are at the same of several minima.
        let dense = solve(&random, &at_end, &Mask::all(n), &options).unwrap();
        assert!(dense.uncertainty.rank == free.len(), "{trial}");
        for (a, b) in report.values.iter().zip(dense.parameters.values()) {
            assert!((a - b).abs() < 1e-10 * (1.0 + b.abs()), "{trial}: {a} {b}");
        }
        let kind = match (report.method.eliminated > 0, report.method.dense) {
            (true, _) => 0,
            (false, true) => 1,
            (false, false) => 2,
        };
        methods[kind] += 1;
    }
    assert!(methods[0] > 20 && methods[1] > 20, "{methods:?}");
}

#[test]
fn wide_blocks_of_unequal_width_under_many_rows_have_the_minimum_of_the_dense_problem() {
    let mut rng = ChaCha8Rng::seed_from_u64(12);
    let widths = vec![20, 77, 30];
    let lists = [vec![0, 1], vec![0, 2], vec![0]];
    let factors = lists.map(|list| {
        let n: usize = list.iter().map(|&b| widths[b]).sum();
        let mut number = |_| rng.random_range(-1.0..1.0);
        let coefficients = (0..300)
            .map(|_| (0..n).map(&mut number).collect())
            .collect();
        let targets = (0..300).map(&mut number).collect();
        let rows = Rows {
            coefficients,
            targets,
        };
        (list, rows)
    });
    let random = Random {
        widths,
        factors: factors.into(),
    };
    let report = solve_graph(&random.graph().0, &GraphOptions::default()).unwrap();
    let start = Parameters::unnamed(&report.values);
    let dense = solve(&random, &start, &Mask::all(127), &Options::default()).unwrap();
    for (a, b) in report.values.iter().zip(dense.parameters.values()) {
        assert!((a - b).abs() < 1e-10, "{a} {b}");
    }
}

#[test]
fn a_graph_without_last_digits_ends_as_near_whatever_the_first_damping() {
    let mut rng = ChaCha8Rng::seed_from_u64(12);
    for trial in 0..60 {
        let (mut graph, _) = Random::new(&mut rng, trial).graph();
        for first_damping in [1e-4, 1e-2, 1.0, 1e3] {
            let options = GraphOptions {
                gradient_tolerance: 1e-5,
                last_digits: false,
                rank: false,
                first_damping,
                ..GraphOptions::default()
            };
            let report = solve_graph(&graph, &options).unwrap();
            assert!(report.termination.converged() && report.relative_offset <= 1e-5);
            let start = graph.values().to_vec();
            graph.start_at(&report.values);
            let least = solve_graph(&graph, &GraphOptions::default()).unwrap();
            graph.start_at(&start);
            // An offset of 1e-5 leaves 1e-10 of the cost; nearly all of it goes with the step taken.
            let left = report.cost / least.cost - 1.0;
            assert!(left < 1e-10, "{trial}, {first_damping}: {left}");
        }
    }
}

/// `log(q⁻¹ measured)`.
struct Measured([f64; 4]);

impl<D: Scalar> Residual<D> for Measured {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        let q = self.0.map(lit::<D>);
        let inverse = [x[0], -x[1], -x[2], -x[3]];
        out.extend(logarithm(&multiply(&inverse, &q)));
    }
}

#[test]
fn cameras_and_points_of_every_width_return_to_what_made_the_residuals() {
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    let shared = [9, 9, 8, 3, 6, 6, 7, 7, 2, 2];
    let own = (0..120).map(|k| 2 + k % 2);
    let mut graph = Graph::new();
    let mut truth = Vec::new();
    for (k, width) in shared.into_iter().chain(own).enumerate() {
        let values: Vec<f64> = (0..width).map(|_| rng.random_range(-1.0..1.0)).collect();
        let start: Vec<f64> = values.iter().map(|v| v + 0.01).collect();
        let block = graph.add(format!("b{k}"), Euclidean(width), &start);
        truth.push((block.unwrap(), values));
    }
    for (own, own_values) in &truth[shared.len()..] {
        for (block, values) in &truth[..shared.len()] {
            let x = [&values[..], own_values].concat();
            let coefficients: Vec<Vec<f64>> = (0..2)
                .map(|_| x.iter().map(|_| rng.random_range(-1.0..1.0)).collect())
                .collect();
            let mut rows = Rows {
                coefficients,
                targets: vec![0.0; 2],
            };
            let mut targets = Vec::new();
            Residual::<f64>::residuals(&rows, &x, &mut targets);
            rows.targets = targets;
            graph.add_factor(&[*block, *own], rows);
        }
    }
    let report = solve_graph(&graph, &GraphOptions::default()).unwrap();
    assert_eq!(report.method.eliminated, 120);
    let threads = GraphOptions {
        threads: 3,
        ..GraphOptions::default()
    };
    let values = solve_graph(&graph, &threads).unwrap().values;
    assert_eq!(values, report.values);
    // Newton's steps: a product that is wrong would make many of them.
    assert!(report.iterations.len() <= 8, "{}", report.iterations.len());
    for (block, values) in &truth {
        for (found, known) in report.value(*block).iter().zip(values) {
            assert!((found - known).abs() < 1e-10, "{found} {known}");
        }
    }
}

#[test]
fn two_rotations_average_to_the_one_half_way() {
    let (a, b) = ([0.3, -0.8, 0.5], [0.9, 0.1, -0.4]);
    let (p, q) = (exponential::<f64>(&a), exponential::<f64>(&b));
    let mut graph = Graph::new();
    let mean = graph.add("mean", Rotation, &[1.0, 0.0, 0.0, 0.0]).unwrap();
    graph.add_factor(&[mean], Measured(p));
    graph.add_factor(&[mean], Measured(q));
    let report = solve_graph(&graph, &GraphOptions::default()).unwrap();
    // p exp(½ log(p⁻¹ q)).
    let inverse = [p[0], -p[1], -p[2], -p[3]];
    let half = logarithm(&multiply(&inverse, &q)).map(|v| 0.5 * v);
    let wanted = multiply(&p, &exponential(&half));
    let found = report.value(mean);
    let sign = (0..4).map(|k| found[k] * wanted[k]).sum::<f64>().signum();
    for k in 0..4 {
        assert!((found[k] - sign * wanted[k]).abs() < 1e-12, "{found:?}");
    }
}

/// The vector turned back, less what was measured: chordal, with a closed form.
struct Turned {
    before: [f64; 3],
    after: [f64; 3],
}

impl<D: Scalar> Residual<D> for Turned {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        let turned = rotate(x, &self.before.map(lit::<D>));
        out.extend((0..3).map(|k| turned[k] - lit::<D>(self.after[k])));
    }
}

#[test]
fn a_rotation_between_two_sets_of_vectors_is_davenports() {
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    let mut random = || [(); 3].map(|()| rng.random_range(-1.0..1.0));
    let truth = exponential::<f64>(&[0.7, -1.1, 0.4]);
    let pairs: Vec<([f64; 3], [f64; 3])> = (0..12)
        .map(|_| {
            let (before, noise) = (random(), random());
            let mut after = rotate(&truth, &before);
            (0..3).for_each(|k| after[k] += 0.1 * noise[k]);
            (before, after)
        })
        .collect();
    let mut graph = Graph::new();
    let q = graph.add("q", Rotation, &[1.0, 0.0, 0.0, 0.0]).unwrap();
    for &(before, after) in &pairs {
        graph.add_factor(&[q], Turned { before, after });
    }
    let report = solve_graph(&graph, &GraphOptions::default()).unwrap();
    // Davenport's matrix K, whose largest eigenvector is q: by power iteration on K + 20.
    let mut k = [[0.0; 4]; 4];
    for (b, a) in &pairs {
        let s = |i: usize, j: usize| a[i] * b[j] + a[j] * b[i];
        let dot: f64 = (0..3).map(|i| a[i] * b[i]).sum();
        let z = [
            b[1] * a[2] - b[2] * a[1],
            b[2] * a[0] - b[0] * a[2],
            b[0] * a[1] - b[1] * a[0],
        ];
        k[0][0] += dot;
        for i in 0..3 {
            k[0][i + 1] += z[i];
            k[i + 1][0] += z[i];
            for j in 0..3 {
                k[i + 1][j + 1] += s(i, j) - if i == j { dot } else { 0.0 };
            }
        }
    }
    let mut v = [1.0, 0.1, 0.1, 0.1];
    for _ in 0..4000 {
        let mut next = v.map(|x| 20.0 * x);
        for i in 0..4 {
            next[i] += (0..4).map(|j| k[i][j] * v[j]).sum::<f64>();
        }
        let length = next.iter().map(|x| x * x).sum::<f64>().sqrt();
        v = next.map(|x| x / length);
    }
    let found = report.value(q);
    let sign = (0..4).map(|i| found[i] * v[i]).sum::<f64>().signum();
    for i in 0..4 {
        assert!((found[i] - sign * v[i]).abs() < 1e-12, "{found:?} {v:?}");
    }
}

/// `u − measured`.
struct Seen([f64; 3]);

impl<D: Scalar> Residual<D> for Seen {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        out.extend((0..3).map(|k| x[k] - lit::<D>(self.0[k])));
    }
}

#[test]
fn a_direction_fitted_to_vectors_is_their_sum_at_unit_length() {
    let seen = [[0.9, 0.3, -0.1], [-0.2, 0.8, 0.4], [0.1, -0.3, 1.2]];
    for start in [[1.0, 0.0, 0.0], [-0.6, 0.0, 0.8], [0.0, -1.0, 0.0]] {
        let mut graph = Graph::new();
        let u = graph.add("u", Direction, &start).unwrap();
        seen.iter().for_each(|&s| graph.add_factor(&[u], Seen(s)));
        let report = solve_graph(&graph, &GraphOptions::default()).unwrap();
        let sum: [f64; 3] = std::array::from_fn(|k| seen.iter().map(|s| s[k]).sum());
        let length = sum.iter().map(|v| v * v).sum::<f64>().sqrt();
        for (found, sum) in report.value(u).iter().zip(sum) {
            assert!((found - sum / length).abs() < 1e-13);
        }
    }
}

/// A user's own manifold: a point on the circle through it about the origin, stored as two numbers.
#[derive(Debug)]
struct Circle;

impl Manifold for Circle {
    fn numbers(&self) -> usize {
        2
    }

    fn dimension(&self) -> usize {
        1
    }

    fn retract<D: Scalar>(&self, x: &[D], step: &[D], out: &mut [D]) {
        let (sine, cosine) = step[0].sin_cos();
        out[0] = x[0] * cosine - x[1] * sine;
        out[1] = x[0] * sine + x[1] * cosine;
    }

    fn local<D: Scalar>(&self, x: &[D], y: &[D], out: &mut [D]) {
        let cross = x[0] * y[1] - x[1] * y[0];
        let dot = x[0] * y[0] + x[1] * y[1];
        // atan2 by the half angle: (√(c² + d²) − d) / c loses digits near zero.
        let radius = (cross * cross + dot * dot).sqrt();
        out[0] = (cross / (radius + dot)).atan() * 2.0;
    }
}

/// The distance from a point, less what was measured.
struct From2([f64; 2]);

impl<D: Scalar> Residual<D> for From2 {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        out.extend((0..2).map(|k| x[k] - lit::<D>(self.0[k])));
    }
}

#[test]
fn the_nearest_point_of_a_circle_is_found_on_a_users_own_manifold() {
    let circle = Circle;
    for step in [0.0, 1e-8, 0.4, -2.0] {
        let worst = stillpoint_solver::check_manifold(&circle, &[0.0, 2.0], &[step]);
        assert!(worst < 2e-9, "{step}: {worst:e}");
    }
    let mut graph = Graph::new();
    let p = graph.add("p", Circle, &[2.0, 0.0]).unwrap();
    graph.add_factor(&[p], From2([-3.0, 4.0]));
    let report = solve_graph(&graph, &GraphOptions::default()).unwrap();
    assert!((report.value(p)[0] + 1.2).abs() < 1e-12, "{report:?}");
    assert!((report.value(p)[1] - 1.6).abs() < 1e-12);
}

#[test]
fn a_manifold_that_breaks_its_rules_is_found_out() {
    #[derive(Debug)]
    struct Broken;
    impl Manifold for Broken {
        fn numbers(&self) -> usize {
            1
        }
        fn dimension(&self) -> usize {
            1
        }
        fn retract<D: Scalar>(&self, x: &[D], step: &[D], out: &mut [D]) {
            out[0] = x[0] + step[0] * 2.0;
        }
        fn local<D: Scalar>(&self, x: &[D], y: &[D], out: &mut [D]) {
            out[0] = y[0] - x[0];
        }
    }
    assert!(stillpoint_solver::check_manifold(&Broken, &[1.0], &[0.5]) > 0.1);
}

#[test]
fn held_blocks_and_coordinates_stay_and_threads_change_no_bit() {
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    let random = Random::new(&mut rng, 0);
    let (mut graph, blocks) = random.graph();
    graph.hold(blocks[3]);
    graph.hold_part(blocks[0], 1);
    let one = solve_graph(&graph, &GraphOptions::default()).unwrap();
    assert!(one.value(blocks[3]).iter().all(|&v| v == 0.1));
    assert_eq!(one.value(blocks[0])[1], 0.1);
    assert_ne!(one.value(blocks[0])[0], 0.1);
    let threads = GraphOptions {
        threads: 3,
        ..GraphOptions::default()
    };
    let three = solve_graph(&graph, &threads).unwrap();
    assert_eq!(one.values, three.values);
    assert_eq!(one.cost.to_bits(), three.cost.to_bits());
}

#[test]
fn a_start_that_is_not_finite_names_the_coordinate() {
    struct Root;
    impl<D: Scalar> Residual<D> for Root {
        fn residuals(&self, x: &[D], out: &mut Vec<D>) {
            out.push(x[0] + x[2].sqrt() + x[1]);
        }
    }
    let mut graph = Graph::new();
    let a = graph.add("a", Euclidean(1), &[1.0]).unwrap();
    let b = graph.add("b", Euclidean(2), &[1.0, 0.0]).unwrap();
    graph.add_factor(&[a, b], Root);
    let error = solve_graph(&graph, &GraphOptions::default()).unwrap_err();
    assert!(error.to_string().contains("b.1"), "{error}");
    assert!(graph.add("c", Euclidean(2), &[1.0]).is_err());
    graph.add_factor(&[a, a], Root);
    let error = solve_graph(&graph, &GraphOptions::default()).unwrap_err();
    assert!(error.to_string().contains("twice"), "{error}");
}

/// `(JᵀJ)⁺` among some columns, from the dense uncertainty.
fn dense_of(graph: &Graph<'_>, random: &Random, held: &[usize]) -> stillpoint_solver::Uncertainty {
    use stillpoint_solver::{Problem, uncertainty};
    let n: usize = random.widths.iter().sum();
    let free: Vec<usize> = (0..n).filter(|k| !held.contains(k)).collect();
    let jacobian = Problem::linearize(random, graph.values(), &free, &mut Vec::new());
    uncertainty(&jacobian, free.iter().map(|k| format!("x{k}")).collect())
}

#[test]
fn products_of_two_hundred_random_graphs_are_those_of_the_dense_jacobian() {
    let mut rng = ChaCha8Rng::seed_from_u64(21);
    let mut short = 0;
    for trial in 0..200 {
        let mut random = Random::new(&mut rng, trial);
        if trial % 4 == 3 {
            // Two blocks that only their sum tells, one that nobody reads: the rank is short.
            let (a, b) = (random.widths.len(), random.widths.len() + 1);
            random.widths.extend([2, 2, 1]);
            let coefficients = vec![vec![1.0, 0.0, 1.0, 0.0], vec![0.3, 0.7, 0.3, 0.7]];
            let targets = vec![0.1, 0.2];
            random.factors.push((
                vec![a, b],
                Rows {
                    coefficients,
                    targets,
                },
            ));
        }
        let (mut graph, blocks) = random.graph();
        let mut held = Vec::new();
        if trial % 3 == 0 {
            graph.hold_part(blocks[0], 1);
            held.push(1);
        }
        let wanted = dense_of(&graph, &random, &held);
        let products = stillpoint_solver::Products::new(&graph, graph.values()).unwrap();
        assert_eq!(products.rank(), wanted.rank, "{trial}");
        assert_eq!(
            products.null_space().len(),
            wanted.names.len() - wanted.rank
        );
        short += usize::from(wanted.rank < wanted.names.len());
        // All blocks in their order: the whole, to compare with.
        let covariance = products.covariance(&blocks);
        let largest = (0..covariance.len())
            .map(|k| wanted.covariance[k][k])
            .fold(0.0, f64::max);
        for (row, wanted) in covariance.iter().zip(&wanted.covariance) {
            for (a, b) in row.iter().zip(wanted) {
                assert!((a - b).abs() < 1e-10 * largest, "{trial}: {a} {b}");
            }
        }
        let some = products.covariance(&blocks[2..4]);
        let at = random.widths[..2].iter().sum::<usize>() - held.len();
        assert!((some[0][0] - covariance[at][at]).abs() < 1e-12 * largest);
        check_determinant(&products, &graph, &random, &held, trial);
    }
    assert!(short >= 50, "{short}");
}

fn check_determinant(
    products: &stillpoint_solver::Products<'_>,
    graph: &Graph<'_>,
    random: &Random,
    held: &[usize],
    trial: usize,
) {
    use stillpoint_solver::Problem;
    let n: usize = random.widths.iter().sum();
    let free: Vec<usize> = (0..n).filter(|k| !held.contains(k)).collect();
    let jacobian = Problem::linearize(random, graph.values(), &free, &mut Vec::new());
    let singular = jacobian.singular_values().unwrap();
    let wanted: f64 = singular[..products.rank()]
        .iter()
        .map(|s| 2.0 * s.ln())
        .sum();
    let found = products.log_determinant();
    assert!(
        (found - wanted).abs() < 1e-10 * (1.0 + wanted.abs()),
        "{trial}: {found} {wanted}"
    );
    // A solution: H x = b for b in the range, seen through the covariance.
    let mut right = vec![vec![0.0; free.len()]];
    right[0][0] = 1.0;
    products.solve(&mut right).unwrap();
    let first = products.covariance(&[graph.block("b0").unwrap()]);
    assert!((right[0][0] - first[0][0]).abs() <= 1e-12 * first[0][0].abs());
}

#[test]
fn a_chain_that_floats_and_a_scale_nobody_sees_are_named() {
    struct Difference(f64);
    impl<D: Scalar> Residual<D> for Difference {
        fn residuals(&self, x: &[D], out: &mut Vec<D>) {
            out.push(x[1] - x[0] - lit::<D>(self.0));
        }
    }
    let mut graph = Graph::new();
    let blocks: Vec<Block> = (0..400)
        .map(|k| graph.add(format!("h{k}"), Euclidean(1), &[0.0]).unwrap())
        .collect();
    for k in 1..400 {
        graph.add_factor(&[blocks[k - 1], blocks[k]], Difference(0.01 * k as f64));
        if k % 7 == 0 {
            graph.add_factor(&[blocks[k / 2], blocks[k]], Difference(1.0));
        }
    }
    let report = solve_graph(&graph, &GraphOptions::default()).unwrap();
    assert!(report.termination.converged(), "{}", report.termination);
    assert!(!report.method.dense, "{:?}", report.method);
    let products = stillpoint_solver::Products::new(&graph, &report.values).unwrap();
    assert_eq!(products.rank(), 399);
    let null = products.null_space();
    assert!(
        null[0].words.starts_with("h0 + h1 + h2"),
        "{}",
        null[0].words
    );
    assert!(null[0].words.ends_with("and 388 more"), "{}", null[0].words);
    // Held by a coordinate the variance of the far end is that of the resistances between.
    graph.hold(blocks[0]);
    let products = stillpoint_solver::Products::new(&graph, &report.values).unwrap();
    assert_eq!(products.rank(), 399);
    assert!((products.standard_errors(blocks[1])[0] - 1.0).abs() < 1e-3);
}

/// `y − a − b t`, one residual.
struct Line {
    t: f64,
    y: f64,
}

impl<D: Scalar> Residual<D> for Line {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        out.push(-x[0] - x[1] * self.t + lit::<D>(self.y));
    }
}

/// All of them.
struct Lines(Vec<Line>);

impl<D: Scalar> Residual<D> for Lines {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        self.0.iter().for_each(|line| line.residuals(x, out));
    }
}

fn lines() -> Vec<Line> {
    (0..30)
        .map(|k| {
            let t = 0.1 * f64::from(k);
            let wild = if k % 5 == 2 { 4.0 } else { 0.0 };
            let y = 1.0 + 2.0 * t + 0.05 * (7.0 * t * t).sin() + wild;
            Line { t, y }
        })
        .collect()
}

#[test]
fn a_robust_factor_of_one_residual_costs_as_in_the_dense_solver() {
    use stillpoint_solver::{Loss, LossScale};
    let scale = LossScale::Given(0.1);
    for loss in [Loss::Huber(scale), Loss::Cauchy(scale), Loss::Tukey(scale)] {
        let (mut own, mut of_block) = (Graph::new(), Graph::new());
        for (graph, each) in [(&mut own, true), (&mut of_block, false)] {
            let x = graph.add("x", Euclidean(2), &[1.1, 1.9]).unwrap();
            for line in lines() {
                if each {
                    graph.add_robust_factor(&[x], line, loss);
                } else {
                    graph.add_factor(&[x], line);
                }
            }
            if !each {
                graph.set_loss(x, loss);
            }
        }
        let options = Options {
            loss,
            ..Options::default()
        };
        let start = Parameters::unnamed(&[1.1, 1.9]);
        let dense = solve(&Lines(lines()), &start, &Mask::all(2), &options).unwrap();
        for graph in [own, of_block] {
            let report = solve_graph(&graph, &GraphOptions::default()).unwrap();
            assert!(report.termination.converged(), "{loss:?}");
            assert!((report.cost / dense.cost - 1.0).abs() < 1e-12, "{loss:?}");
            for (a, b) in report.values.iter().zip(dense.parameters.values()) {
                assert!((a - b).abs() < 1e-8, "{loss:?}: {a} {b}");
            }
        }
    }
}

#[test]
fn an_outlying_turn_of_three_residuals_counts_as_a_whole() {
    use stillpoint_solver::{Loss, LossScale};
    let mut graph = Graph::new();
    let mean = graph.add("mean", Rotation, &[1.0, 0.0, 0.0, 0.0]).unwrap();
    let loss = Loss::Tukey(LossScale::Given(0.3));
    for k in 0..10 {
        let wild = if k % 4 == 3 { 1.5 } else { 0.0 };
        let turn = [0.01 * (f64::from(k)).sin(), wild, -wild];
        graph.add_robust_factor(&[mean], Measured(exponential(&turn)), loss);
    }
    let report = solve_graph(&graph, &GraphOptions::default()).unwrap();
    assert!(report.termination.converged(), "{}", report.termination);
    let off = logarithm(report.value(mean));
    assert!(off.iter().all(|v| v.abs() < 0.01), "{off:?}");
}

#[test]
fn the_profile_of_a_line_is_its_standard_error() {
    use stillpoint_solver::{Products, graph_profile};
    let mut graph = Graph::new();
    let x = graph.add("x", Euclidean(2), &[0.0, 0.0]).unwrap();
    lines().into_iter().for_each(|l| graph.add_factor(&[x], l));
    let options = GraphOptions::default();
    let report = solve_graph(&graph, &options).unwrap();
    let sigma = (2.0 * report.cost / 28.0).sqrt();
    let error = sigma
        * Products::new(&graph, &report.values)
            .unwrap()
            .standard_errors(x)[1];
    let interval = graph_profile(&mut graph, &report, &options, x, 1, 2.0).unwrap();
    assert_eq!(interval.name, "x.1");
    let slope = report.value(x)[1];
    assert!((interval.upper.unwrap() - slope - 2.0 * error).abs() < 1e-5 * error);
    assert!((slope - interval.lower.unwrap() - 2.0 * error).abs() < 1e-5 * error);
    assert_eq!(graph.value(x), [0.0, 0.0]);
    assert!(graph_profile(&mut graph, &report, &options, x, 7, 2.0).is_err());
}
