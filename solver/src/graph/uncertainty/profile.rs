//! Profile likelihood intervals of a graph's coordinates.

use crate::error::Error;
use crate::graph::options::{GraphOptions, GraphReport};
use crate::graph::problem::{Block, Graph};
use crate::graph::solve::solve_graph;
use crate::graph::uncertainty::Products;
use crate::report::Termination;
use crate::uncertainty::profile::{ProfileInterval, crossing};

/// The values of one coordinate of a block at which the cost, all others refitted, has risen by
/// `½ z² s²` above the minimum, `s² = 2 cost / (m − rank)` (1 without spare residuals); see
/// [`profile_interval`](crate::profile_interval). Of a curved block the values are steps from where the
/// report ended. An interval that meets a bound ends there.
///
/// `report` is the solution of `graph` under `options`; the graph is as before afterwards.
///
/// # Errors
/// A coordinate that is not free, a `z` that is not positive, a refit stopped by the options' limits,
/// and what [`solve_graph`] says of a refit.
pub fn graph_profile(
    graph: &mut Graph<'_>,
    report: &GraphReport,
    options: &GraphOptions,
    block: Block,
    coordinate: usize,
    z: f64,
) -> Result<ProfileInterval, Error> {
    if !(z > 0.0 && z.is_finite()) {
        return Err(Error::ProfileLevel { z });
    }
    let variable = graph.variables.get(block.number());
    let place = variable.and_then(|v| v.free_coordinates().position(|k| k == coordinate));
    let (Some(variable), Some(place)) = (variable, place) else {
        return Err(Error::UnknownParameter {
            name: format!("coordinate {coordinate} of block {}", block.number()),
        });
    };
    let name = variable.coordinate(coordinate);
    let flat = variable.manifold.is_flat();
    let value = if flat {
        report.value(block)[coordinate]
    } else {
        0.0
    };
    let products = Products::new(graph, &report.values)?;
    let spare = report.residuals.saturating_sub(products.rank());
    let sigma = match spare {
        0 => 1.0,
        _ => (2.0 * report.cost / spare as f64).sqrt(),
    };
    let spread = sigma * products.standard_errors(block)[place];
    drop(products);
    let unit = if spread > 0.0 && spread.is_finite() {
        spread
    } else {
        value.abs().max(1.0)
    };
    // Each refit begins beside the minimum.
    let options = &GraphOptions {
        graduated: false,
        ..options.clone()
    };
    let start = graph.values.clone();
    let free = graph.variables[block.number()].free.clone();
    graph.hold_part(block, coordinate);
    let mut deviance = |offset: f64| {
        let cost = refitted(graph, report, options, block, coordinate, offset)?;
        let (cost, stopped) = cost;
        let rise = cost - report.cost;
        let root = match rise > 0.0 {
            true => (2.0 * rise).sqrt() / sigma,
            false => 0.0,
        };
        match stopped {
            Some(termination) if root >= z => Err(Error::Refit { termination }),
            _ => Ok(root),
        }
    };
    let lower = crossing(value, -unit, z, &mut deviance);
    let upper = crossing(value, unit, z, &mut deviance);
    graph.values = start;
    graph.variables[block.number()].free = free;
    Ok(ProfileInterval {
        name,
        value,
        lower: lower?,
        upper: upper?,
    })
}

/// The least cost with the coordinate moved by `offset` and held, and why a refit stopped too early.
fn refitted(
    graph: &mut Graph<'_>,
    report: &GraphReport,
    options: &GraphOptions,
    block: Block,
    coordinate: usize,
    offset: f64,
) -> Result<(f64, Option<Termination>), Error> {
    graph.values.copy_from_slice(&report.values);
    let variable = &graph.variables[block.number()];
    let mut step = vec![0.0; variable.dimension as usize];
    step[coordinate] = offset;
    let own = variable.first..variable.first + variable.numbers as usize;
    variable
        .manifold
        .retract(&report.values[own.clone()], &step, &mut graph.values[own]);
    let range = graph.ranges.get(&(block.0, coordinate as u32));
    if let (Some((lower, upper)), Some(number)) = (range, variable.plain(coordinate))
        && !(lower..=upper).contains(&&graph.values[variable.first + number])
    {
        return Ok((f64::INFINITY, None));
    }
    match solve_graph(graph, options) {
        Ok(refit) => {
            let stopped = matches!(
                refit.termination,
                Termination::Cancelled | Termination::TimeLimit | Termination::IterationLimit
            );
            Ok((refit.cost, stopped.then_some(refit.termination)))
        }
        Err(Error::Empty { free: 0, .. }) => Ok((graph.cost(&graph.values), None)),
        Err(Error::NotFinite { .. } | Error::DerivativeNotFinite { .. }) => {
            Ok((f64::INFINITY, None))
        }
        Err(error) => Err(error),
    }
}
