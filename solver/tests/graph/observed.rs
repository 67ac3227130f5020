//! A graph's run as it is watched and stopped.

use std::ops::ControlFlow;

use stillpoint_solver::{
    Euclidean, Graph, GraphOptions, Residual, Scalar, Termination, solve_graph,
    solve_graph_observed,
};

/// Rosenbrock's valley.
struct Valley;

impl<D: Scalar> Residual<D> for Valley {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        out.extend([(x[1] - x[0] * x[0]) * 10.0, -x[0] + 1.0]);
    }
}

fn valley() -> Graph<'static> {
    let mut graph = Graph::new();
    let block = graph.add("x", Euclidean(2), &[-1.2, 1.0]).unwrap();
    graph.add_factor(&[block], Valley);
    graph
}

#[test]
fn every_step_of_the_trace_is_shown_with_the_values_after_it() {
    let graph = valley();
    let options = GraphOptions::default();
    let mut seen = Vec::new();
    let report = solve_graph_observed(&graph, &options, &mut |step, values| {
        seen.push((step.clone(), values.to_vec()));
        ControlFlow::Continue(())
    })
    .unwrap();
    assert_eq!(report, solve_graph(&graph, &options).unwrap());
    let steps: Vec<_> = seen.iter().map(|(step, _)| step.clone()).collect();
    assert_eq!(steps, report.iterations);
    let mut here = graph.values().to_vec();
    for (step, values) in &seen {
        if step.accepted {
            let cost = graph.cost(values);
            assert!((cost - step.cost).abs() <= 1e-12 * cost.max(1e-20));
        } else {
            assert_eq!(*values, here);
        }
        here.clone_from(values);
    }
    assert!(steps.iter().any(|step| !step.accepted));
    assert_eq!(here, report.values);
}

#[test]
fn a_run_is_stopped_before_the_next_step_where_the_observer_asks() {
    let graph = valley();
    let mut count = 0;
    let report = solve_graph_observed(&graph, &GraphOptions::default(), &mut |_, _| {
        count += 1;
        if count == 3 {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    })
    .unwrap();
    assert_eq!((count, report.iterations.len()), (3, 3));
    assert_eq!(report.termination, Termination::Cancelled);
}
