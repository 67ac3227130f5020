//! Options of graphs side by side.

use super::table::{ComparedRun, Table};
use crate::clock::timed;
use crate::graph::{Graph, GraphOptions, solve_graph};
use crate::search::Damping;

/// Solves a graph from its start with every set of options, each with a name.
///
/// ```
/// use stillpoint_solver::{Euclidean, Graph, Residual, Scalar, compare_graphs, graph_variants};
///
/// struct Valley;
///
/// impl<D: Scalar> Residual<D> for Valley {
///     fn residuals(&self, x: &[D], out: &mut Vec<D>) {
///         out.extend([(x[1] - x[0] * x[0]) * 10.0, -x[0] + 1.0]);
///     }
/// }
///
/// let mut graph = Graph::new();
/// let x = graph.add("x", Euclidean(2), &[-1.2, 1.0])?;
/// graph.add_factor(&[x], Valley);
/// let table = compare_graphs("valley", &graph, &graph_variants());
/// assert_eq!(table.successes("graph-nielsen"), 1);
/// # Ok::<(), stillpoint_solver::Error>(())
/// ```
pub fn compare_graphs(name: &str, graph: &Graph<'_>, variants: &[(String, GraphOptions)]) -> Table {
    let first_cost = graph.cost(graph.values());
    let mut runs: Vec<ComparedRun> = Vec::with_capacity(variants.len());
    for (variant, options) in variants {
        let (outcome, seconds) = timed(|| solve_graph(graph, options));
        let mut run = ComparedRun {
            problem: name.to_owned(),
            start: 1,
            variant: variant.clone(),
            success: false,
            converged: false,
            residuals: 0,
            jacobians: 0,
            second_derivatives: 0,
            seconds,
            cost: f64::INFINITY,
            first_cost,
            digits: f64::NAN,
            reason: String::new(),
        };
        match outcome {
            Err(error) => run.reason = error.to_string(),
            Ok(report) => {
                run.converged = report.termination.converged();
                run.residuals = report.evaluations.residuals;
                run.jacobians = report.evaluations.jacobians;
                run.cost = report.cost;
                run.reason = report.termination.to_string();
            }
        }
        runs.push(run);
    }
    let least = runs
        .iter()
        .map(|run| run.cost)
        .fold(f64::INFINITY, f64::min);
    runs.iter_mut().for_each(|run| run.judge(least));
    Table { runs }
}

/// The ways in which the damping of a graph moves, with their names and all else as in the default.
pub fn graph_variants() -> Vec<(String, GraphOptions)> {
    let all = [
        ("graph-nielsen", Damping::Nielsen),
        ("graph-marquardt", Damping::Marquardt),
        ("graph-delayed", Damping::DelayedGratification),
    ];
    let options = |damping| GraphOptions {
        damping,
        ..GraphOptions::default()
    };
    let named = all.into_iter();
    named
        .map(|(name, damping)| (name.to_owned(), options(damping)))
        .collect()
}
