//! What a report of a graph says of what the factors leave open, and what is refused.

use stillpoint_solver::{
    Error, Euclidean, Graph, GraphOptions, Loss, LossFunction, LossScale, Mask, Options,
    Parameters, Residual, Rotation, Scalar, Termination, from_fn, lit, solve, solve_graph,
};

/// `b − a − d` of plain blocks of two numbers.
struct Difference([f64; 2]);

impl<D: Scalar> Residual<D> for Difference {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        out.extend((0..2).map(|k| x[2 + k] - x[k] - lit::<D>(self.0[k])));
    }
}

fn chain(links: usize) -> Graph<'static> {
    let mut graph = Graph::new();
    let blocks: Vec<_> = (0..=links)
        .map(|k| {
            graph
                .add(format!("p{k}"), Euclidean(2), &[k as f64, 0.3])
                .unwrap()
        })
        .collect();
    for ends in blocks.windows(2) {
        graph.add_factor(ends, Difference([1.5, -0.5]));
    }
    graph
}

#[test]
fn a_graph_that_floats_says_which_blocks_in_words_and_in_fields() {
    let mut graph = chain(2);
    let report = solve_graph(&graph, &GraphOptions::default()).unwrap();
    assert!(report.termination.converged());
    assert_eq!((report.rank, report.null_space.len()), (Some(4), 2));
    assert_eq!(report.undetermined().len(), 3);
    let text = report.to_string();
    assert!(text.contains("rank 4"), "{text}");
    for line in [
        "no factor determines p0.0 + p1.0 + p2.0",
        "no factor determines p0.1 + p1.1 + p2.1",
        "hold a block",
    ] {
        assert!(text.contains(line), "{line} is missing in\n{text}");
    }
    let first = graph.block("p0").unwrap();
    graph.hold(first);
    let report = solve_graph(&graph, &GraphOptions::default()).unwrap();
    assert_eq!((report.rank, report.null_space.len()), (Some(4), 0));
    assert!(report.undetermined().is_empty());
    assert!(!report.to_string().contains("no factor determines"));
}

#[test]
fn a_graph_that_fits_exactly_says_that_its_residuals_are_zero() {
    let mut graph = chain(3);
    let first = graph.block("p0").unwrap();
    graph.hold(first);
    let report = solve_graph(&graph, &GraphOptions::default()).unwrap();
    assert_eq!(report.termination, Termination::Zero, "{report}");
    assert!(!report.to_string().contains("relative offset"), "{report}");
}

#[test]
fn more_free_directions_than_are_followed_leave_the_rank_open() {
    let mut graph = Graph::new();
    for k in 0..40 {
        graph
            .add(format!("alone{k}"), Euclidean(1), &[0.0])
            .unwrap();
    }
    let pair = ["a", "b"].map(|name| graph.add(name, Euclidean(2), &[0.0, 0.0]).unwrap());
    graph.add_factor(&pair, Difference([1.0, 1.0]));
    let report = solve_graph(&graph, &GraphOptions::default()).unwrap();
    assert_eq!((report.rank, report.null_space.len()), (None, 32));
    assert!(report.to_string().contains("rank not known"));
    let options = GraphOptions {
        rank: false,
        ..GraphOptions::default()
    };
    let report = solve_graph(&graph, &options).unwrap();
    assert_eq!((report.rank, report.null_space.len()), (None, 0));
}

#[test]
fn two_blocks_of_one_name_are_refused_by_name() {
    let mut graph = Graph::new();
    graph.add("pose", Rotation, &[1.0, 0.0, 0.0, 0.0]).unwrap();
    let error = graph.add("pose", Euclidean(1), &[0.0]).unwrap_err();
    assert_eq!(
        error,
        Error::RepeatedName {
            block: "pose".into()
        }
    );
    assert!(error.to_string().contains("two blocks are called pose"));
    assert_eq!(graph.blocks(), 1);
}

/// `ρ = slope · s + offset`.
#[derive(Debug)]
struct Linear {
    slope: f64,
    offset: f64,
}

impl LossFunction for Linear {
    fn at(&self, s: f64) -> [f64; 3] {
        [self.slope * s + self.offset, self.slope, 0.0]
    }
}

#[test]
fn a_loss_that_is_not_the_square_near_zero_is_refused_with_what_was_found() {
    static TWICE: Linear = Linear {
        slope: 2.0,
        offset: 0.0,
    };
    static RAISED: Linear = Linear {
        slope: 1.0,
        offset: 0.5,
    };
    let scale = LossScale::Given(1.0);
    for (loss, value, slope) in [
        (Loss::own(&TWICE, scale), 0.0, 2.0),
        (Loss::own(&RAISED, scale), 0.5, 1.0),
    ] {
        let expected = Error::LossShape { value, slope };
        let line = from_fn(|x: &[_], out: &mut Vec<_>| out.extend([x[0] - 1.0, x[0] - 2.0]));
        let options = Options {
            loss,
            ..Options::default()
        };
        let found = solve(&line, &Parameters::unnamed(&[0.0]), &Mask::all(1), &options);
        assert_eq!(found.unwrap_err(), expected);
        let mut graph = chain(1);
        let first = graph.block("p0").unwrap();
        graph.set_loss(first, loss);
        let found = solve_graph(&graph, &GraphOptions::default());
        assert_eq!(found.unwrap_err(), expected);
    }
    let text = Error::LossShape {
        value: 0.0,
        slope: 2.0,
    };
    assert!(text.to_string().contains("ρ′(0) = 2"), "{text}");
}

/// Counts a residual up to `s = 1`, and less than nothing beyond.
#[derive(Debug)]
struct Falling;

impl LossFunction for Falling {
    fn at(&self, s: f64) -> [f64; 3] {
        [s - 0.5 * s * s, 1.0 - s, -1.0]
    }
}

#[test]
fn a_loss_that_falls_is_refused_with_the_place() {
    let loss = Loss::own(&Falling, LossScale::Given(1.0));
    let line = from_fn(|x: &[_], out: &mut Vec<_>| out.extend([x[0] - 1.0, x[0] - 2.0]));
    let options = Options {
        loss,
        ..Options::default()
    };
    let found = solve(&line, &Parameters::unnamed(&[0.0]), &Mask::all(1), &options).unwrap_err();
    assert!(
        matches!(found, Error::LossSlope { s, slope } if s > 1.0 && slope < 0.0),
        "{found}"
    );
    let mut graph = chain(1);
    let first = graph.block("p0").unwrap();
    graph.set_loss(first, loss);
    assert_eq!(
        solve_graph(&graph, &GraphOptions::default()).unwrap_err(),
        found
    );
}

/// An offset common to all groups on top of each group's own, and a slope.
struct Shifted(f64);

impl<D: Scalar> Residual<D> for Shifted {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        out.extend((0..4).map(|i| x[0] * f64::from(i) + x[1] + x[2] - self.0));
    }
}

#[test]
fn a_shared_number_that_acts_like_those_of_the_blocks_is_named() {
    let mut graph = Graph::new();
    let slope = graph.add("slope", Euclidean(1), &[0.3]).unwrap();
    let shift = graph.add("shift", Euclidean(1), &[0.0]).unwrap();
    for k in 0..200 {
        let own = graph.add(format!("own{k}"), Euclidean(1), &[0.0]).unwrap();
        graph.add_factor(&[slope, shift, own], Shifted(f64::from(k)));
    }
    let report = solve_graph(&graph, &GraphOptions::default()).unwrap();
    assert!(report.termination.converged() && report.method.eliminated == 200);
    assert_eq!((report.rank, report.null_space.len()), (Some(201), 1));
    assert!(!report.undetermined().contains(&slope) && report.undetermined().contains(&shift));
}
