//! Bounds in graphs against the dense solver's.

use crate::random_graphs::{Own, Random, Rows};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use stillpoint_solver::{
    Constraints, Direction, Error, Euclidean, Graph, GraphOptions, Loss, LossScale, Mask, Options,
    Parameters, Products, Report, Residual, Scalar, graph_profile, profile_interval, solve,
    solve_graph,
};

/// A random graph whose numbers have random bounds, two thirds of them.
struct Bounded {
    random: Random,
    lower: Vec<f64>,
    upper: Vec<f64>,
}

impl Bounded {
    fn new(rng: &mut ChaCha8Rng, random: Random) -> Self {
        let n: usize = random.widths.iter().sum();
        let (mut lower, mut upper) = (vec![f64::NEG_INFINITY; n], vec![f64::INFINITY; n]);
        for k in 0..n {
            match rng.random_range(0..9) {
                0..2 => lower[k] = rng.random_range(-0.1..0.1),
                2..4 => upper[k] = rng.random_range(0.1..0.3),
                4..6 => {
                    lower[k] = rng.random_range(-0.3..0.1);
                    upper[k] = lower[k] + rng.random_range(0.001..0.4);
                }
                _ => {}
            }
        }
        Self {
            random,
            lower,
            upper,
        }
    }

    fn graph(&self) -> (Graph<'static>, Vec<stillpoint_solver::Block>) {
        let (mut graph, blocks) = self.random.graph();
        let mut k = 0;
        for (&block, &width) in blocks.iter().zip(&self.random.widths) {
            for coordinate in 0..width {
                let (lower, upper) = (self.lower[k], self.upper[k]);
                graph.bound(block, coordinate, lower, upper).unwrap();
                k += 1;
            }
        }
        graph.move_within_bounds();
        (graph, blocks)
    }

    fn constraints(&self, parameters: &Parameters) -> Constraints {
        Constraints::new().bounds(parameters, &self.lower, &self.upper)
    }

    fn dense(&self, start: &[f64]) -> Report {
        let start = Parameters::unnamed(start);
        let options = Options {
            constraints: self.constraints(&start),
            ..Options::default()
        };
        solve(&self.random, &start, &Mask::all(start.len()), &options).unwrap()
    }
}

#[test]
fn two_hundred_bounded_graphs_have_minimum_multipliers_and_covariance_of_the_dense_problem() {
    let mut rng = ChaCha8Rng::seed_from_u64(31);
    let (mut eliminated, mut dense_ones, mut held) = (0, 0, 0);
    for trial in 0..200 {
        let random = Random::new(&mut rng, trial);
        let bounded = Bounded::new(&mut rng, random);
        let (graph, blocks) = bounded.graph();
        let report = solve_graph(&graph, &GraphOptions::default()).unwrap();
        assert!(report.termination.converged(), "{trial}: {report}");
        // From the end found, so that both are at the same of several minima.
        let dense = bounded.dense(&report.values);
        for (a, b) in report.values.iter().zip(dense.parameters.values()) {
            assert!((a - b).abs() < 1e-10 * (1.0 + b.abs()), "{trial}: {a} {b}");
        }
        // Multipliers that are zero to rounding may be counted by one and not by the other.
        let strong = |a: &stillpoint_solver::ActiveConstraint| a.multiplier.abs() > 1e-9;
        let ours: Vec<_> = report.active.iter().filter(|a| strong(a)).collect();
        let theirs = dense.active.iter().filter(|a| strong(a));
        assert_eq!(ours.len(), theirs.clone().count(), "{trial}");
        let mut first = vec![0];
        for width in &bounded.random.widths {
            first.push(first[first.len() - 1] + width);
        }
        for theirs in theirs {
            let number: usize = theirs.constraint[1..].parse().unwrap();
            let block = first.iter().rposition(|&f| f <= number).unwrap();
            let name = match bounded.random.widths[block] {
                1 => format!("b{block}"),
                _ => format!("b{block}.{}", number - first[block]),
            };
            let own = ours.iter().find(|a| a.constraint == name).unwrap();
            assert!((own.multiplier - theirs.multiplier).abs() < 1e-8, "{trial}");
            assert_eq!(own.value, report.values[number]);
        }
        held += ours.len();
        eliminated += usize::from(report.method.eliminated > 0);
        dense_ones += usize::from(report.method.eliminated == 0);
        if report.active.len() != dense.active.len() {
            continue;
        }
        assert_eq!(report.rank, Some(dense.rank), "{trial}");
        let products = Products::new(&graph, &report.values).unwrap();
        assert_eq!(products.rank(), dense.rank, "{trial}");
        let covariance = products.covariance(&blocks);
        let wanted = &dense.uncertainty.covariance;
        let most = (0..covariance.len())
            .map(|k| wanted[k][k])
            .fold(0.0, f64::max);
        for (i, row) in covariance.iter().enumerate() {
            for (j, entry) in row.iter().enumerate() {
                let off = (entry - wanted[i][j]).abs();
                assert!(off < 1e-10 * most, "{trial}: {i} {j} {off}");
            }
        }
    }
    assert!(
        eliminated > 40 && dense_ones > 50 && held > 1_000,
        "{eliminated} {dense_ones} {held}"
    );
}

/// A walk of blocks with ties to near ones: what fills in is little, and none is eliminated.
fn chain(rng: &mut ChaCha8Rng, count: usize) -> Random {
    let mut factors = Vec::new();
    for block in 0..count {
        let mut lists = vec![vec![block]];
        if block > 0 {
            lists.push(vec![block - 1, block]);
        }
        if block > 6 {
            lists.push(vec![block - rng.random_range(2..6), block]);
        }
        for list in lists {
            let n = 2 * list.len();
            let mut numbers =
                |n: usize| -> Vec<f64> { (0..n).map(|_| rng.random_range(-1.0..1.0)).collect() };
            let coefficients = (0..n).map(|_| numbers(n)).collect();
            let targets = numbers(n);
            factors.push((
                list,
                Rows {
                    coefficients,
                    targets,
                },
            ));
        }
    }
    Random {
        widths: vec![2; count],
        factors,
    }
}

#[test]
fn a_bounded_chain_solved_sparsely_has_the_minimum_of_the_dense_problem() {
    let mut rng = ChaCha8Rng::seed_from_u64(32);
    for _ in 0..3 {
        let random = chain(&mut rng, 120);
        let bounded = Bounded::new(&mut rng, random);
        let (graph, _) = bounded.graph();
        let report = solve_graph(&graph, &GraphOptions::default()).unwrap();
        assert!(!report.method.dense && report.method.eliminated == 0);
        assert!(report.active.len() > 20 && report.termination.converged());
        let dense = bounded.dense(&report.values);
        for (a, b) in report.values.iter().zip(dense.parameters.values()) {
            assert!((a - b).abs() < 1e-10 * (1.0 + b.abs()), "{a} {b}");
        }
        let threads = GraphOptions {
            threads: 3,
            ..GraphOptions::default()
        };
        assert_eq!(solve_graph(&graph, &threads).unwrap(), report);
    }
}

#[test]
fn the_walk_to_a_bounded_minimum_takes_hardly_more_steps_than_the_dense_one() {
    let mut rng = ChaCha8Rng::seed_from_u64(33);
    let (mut ours, mut theirs) = (0, 0);
    for trial in 0..60 {
        let random = Random::new(&mut rng, trial);
        let bounded = Bounded::new(&mut rng, random);
        let (graph, _) = bounded.graph();
        let report = solve_graph(&graph, &GraphOptions::default()).unwrap();
        ours += report.evaluations.jacobians;
        theirs += bounded.dense(graph.values()).evaluations.jacobians;
    }
    assert!(ours < 2 * theirs, "{ours} {theirs}");
}

#[test]
fn log_determinant_and_solutions_leave_out_what_a_bound_holds() {
    let mut rng = ChaCha8Rng::seed_from_u64(34);
    for trial in 0..40 {
        let random = Random::new(&mut rng, trial);
        let bounded = Bounded::new(&mut rng, random);
        let (mut graph, blocks) = bounded.graph();
        let report = solve_graph(&graph, &GraphOptions::default()).unwrap();
        let products = Products::new(&graph, &report.values).unwrap();
        let determinant = products.log_determinant();
        let n = products.unknowns();
        let mut right = vec![(0..n).map(|k| (k as f64).sin()).collect::<Vec<f64>>()];
        let on_all = right[0].clone();
        products.solve(&mut right).unwrap();
        drop(products);
        // The same numbers held by hand.
        graph.start_at(&report.values);
        let names: Vec<&str> = report.active.iter().map(|a| &a.constraint[..]).collect();
        graph.free_where(|name| !names.contains(&name));
        let by_hand = Products::new(&graph, &report.values).unwrap();
        let off = (determinant - by_hand.log_determinant()).abs();
        assert!(off < 1e-9 * determinant.abs().max(1.0), "{trial}: {off}");
        let mut free = Vec::new();
        for (&block, &width) in blocks.iter().zip(&bounded.random.widths) {
            let name = graph.name(block);
            free.extend((0..width).map(|k| match width {
                1 => !names.contains(&name),
                _ => !names.contains(&&format!("{name}.{k}")[..]),
            }));
        }
        let kept = |x: &[f64]| -> Vec<f64> {
            let kept = x.iter().zip(&free).filter(|(_, free)| **free);
            kept.map(|(x, _)| *x).collect()
        };
        let mut own = vec![kept(&on_all)];
        by_hand.solve(&mut own).unwrap();
        let most = own[0].iter().fold(0.0f64, |most, v| most.max(v.abs()));
        for (a, b) in kept(&right[0]).iter().zip(&own[0]) {
            assert!((a - b).abs() < 1e-9 * most, "{trial}: {a} {b}");
        }
    }
}

/// `x = target`.
struct Near(f64);

impl<D: Scalar> Residual<D> for Near {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        out.push(x[0] - self.0);
    }
}

#[test]
fn a_start_outside_is_refused_until_it_is_moved_within() {
    let mut graph = Graph::new();
    let x = graph.add("x", Euclidean(1), &[3.0]).unwrap();
    graph.add_factor(&[x], Near(5.0));
    graph.bound_block(x, -1.0, 2.0).unwrap();
    let refused = solve_graph(&graph, &GraphOptions::default());
    assert!(matches!(refused, Err(Error::StartInfeasible { constraint, .. }) if constraint == "x"));
    graph.move_within_bounds();
    let report = solve_graph(&graph, &GraphOptions::default()).unwrap();
    assert_eq!(report.value(x), [2.0]);
    assert_eq!(report.active[0].multiplier, -3.0);
    assert_eq!((report.rank, report.undetermined()), (Some(0), Vec::new()));
    assert!(
        report.to_string().contains("x = 2 (multiplier -3.00e0)"),
        "{report}"
    );
    // Without bounds again.
    graph.bound(x, 0, f64::NEG_INFINITY, f64::INFINITY).unwrap();
    let report = solve_graph(&graph, &GraphOptions::default()).unwrap();
    assert!((report.value(x)[0] - 5.0).abs() < 1e-12 && report.active.is_empty());
}

#[test]
fn bounds_that_mean_nothing_are_refused() {
    let mut graph = Graph::new();
    let x = graph.add("x", Euclidean(2), &[0.0, 0.0]).unwrap();
    let q = graph.add("q", Direction, &[0.0, 0.0, 1.0]).unwrap();
    assert!(matches!(
        graph.bound(x, 0, 1.0, 0.0),
        Err(Error::EmptyRange { .. })
    ));
    assert!(matches!(
        graph.bound(x, 0, f64::NAN, 0.0),
        Err(Error::EmptyRange { .. })
    ));
    let missing = graph.bound(x, 2, 0.0, 1.0).unwrap_err();
    assert_eq!(missing.to_string(), "no parameter is called x.2");
    assert!(matches!(
        graph.bound(q, 0, 0.0, 1.0),
        Err(Error::Unsupported { .. })
    ));
}

#[test]
fn an_equality_is_held_and_a_number_held_by_hand_needs_no_bound() {
    let rows = Rows {
        coefficients: vec![vec![1.0, 0.5], vec![-0.3, 1.0], vec![0.2, 0.1]],
        targets: vec![1.0, 2.0, 3.0],
    };
    let mut graph = Graph::new();
    let x = graph.add("x", Euclidean(2), &[0.7, 0.0]).unwrap();
    graph.add_factor(&[x], rows.clone());
    graph.bound(x, 0, 0.7, 0.7).unwrap();
    let tied = solve_graph(&graph, &GraphOptions::default()).unwrap();
    assert_eq!(tied.active.len(), 1);
    graph.bound(x, 0, 0.0, 0.1).unwrap();
    graph.hold_part(x, 0);
    let held = solve_graph(&graph, &GraphOptions::default()).unwrap();
    assert!(held.active.is_empty() && held.value(x)[0] == 0.7);
    assert!((held.value(x)[1] - tied.value(x)[1]).abs() < 1e-12);
}

#[test]
fn outliers_do_not_press_a_bounded_number_against_its_bound() {
    let mut graph = Graph::new();
    let x = graph.add("x", Euclidean(1), &[0.2]).unwrap();
    for k in 0..9 {
        let outlier = if k < 2 { 50.0 } else { 0.0 };
        graph.add_factor(&[x], Near(0.5 + 0.01 * f64::from(k) + outlier));
    }
    graph.bound(x, 0, 0.0, 1.0).unwrap();
    let plain = solve_graph(&graph, &GraphOptions::default()).unwrap();
    assert_eq!(plain.value(x), [1.0]);
    graph.set_loss(x, Loss::Cauchy(LossScale::Given(0.05)));
    let robust = solve_graph(&graph, &GraphOptions::default()).unwrap();
    assert!(robust.active.is_empty() && (robust.value(x)[0] - 0.55).abs() < 0.02);
}

#[test]
fn a_profile_interval_ends_at_a_bound() {
    let rows = Rows {
        coefficients: (0..8)
            .map(|k| vec![1.0, 0.3 * f64::from(k) - 1.0])
            .collect(),
        targets: (0..8)
            .map(|k| 0.5 + 0.2 * f64::from(k) + 0.1 * f64::from(k % 3))
            .collect(),
    };
    let mut graph = Graph::new();
    let x = graph.add("x", Euclidean(2), &[0.5, 0.4]).unwrap();
    graph.add_factor(&[x], Own(rows.clone()));
    let options = GraphOptions::default();
    let free = solve_graph(&graph, &options).unwrap();
    let upper = free.value(x)[1] + 0.01;
    graph.bound(x, 1, 0.0, upper).unwrap();
    let report = solve_graph(&graph, &options).unwrap();
    let interval = graph_profile(&mut graph, &report, &options, x, 1, 2.0).unwrap();
    assert!((interval.upper.unwrap() - upper).abs() < 1e-6);
    // As the dense solver says.
    let start = Parameters::unnamed(&report.values);
    let options = Options {
        constraints: Constraints::new().bound("x1", 0.0, upper),
        ..Options::default()
    };
    let dense = solve(&rows, &start, &Mask::all(2), &options).unwrap();
    let theirs = profile_interval(&rows, &dense, &Mask::all(2), &options, "x1", 2.0).unwrap();
    let off = interval.lower.unwrap() - theirs.lower.unwrap();
    assert!(off.abs() < 1e-6, "{off}");
}
