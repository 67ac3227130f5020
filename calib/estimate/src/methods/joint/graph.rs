//! The joint problem as a graph: a block of parameters for every recording, one that all share, a factor for every
//! recording.

use faer::Mat;
use recording::Error;
use solver::{Block, Euclidean, Factor, Graph, GraphOptions, Termination, solve_graph};

use super::approach::Weighted;
use crate::methods::Ending;
use crate::methods::joint::blocks::columns::Part;

/// End of a run of the solver.
#[derive(Clone, Debug)]
pub(crate) struct Ended {
    /// All parameters there.
    pub x: Vec<f64>,
    /// Why.
    pub ending: Ending,
    /// Number of linearisations of the rows.
    pub linearisations: usize,
}

impl Ended {
    /// Builds the end of a run whose steps near the minimum have become negligible.
    pub fn settled(x: Vec<f64>, steps: usize) -> Self {
        Self {
            x,
            ending: Ending {
                termination: Termination::Gradient,
                steps,
            },
            linearisations: 0,
        }
    }
}

/// Goes from `x` to the minimum over the `free` parameters, to what double precision allows, in no more than `most_steps`.
///
/// # Errors
/// What the solver refuses.
pub(crate) fn solve_rows(
    weighted: &Weighted<'_>,
    x: &[f64],
    free: &[usize],
    most_steps: usize,
) -> Result<Ended, Error> {
    let groups = weighted.whitening.groups();
    let columns = weighted.rows.columns_of(groups);
    let places = Places::of(&columns, x.len(), free);
    let mut graph = Graph::new();
    let values = |columns: &[usize]| columns.iter().map(|&k| x[k]).collect::<Vec<f64>>();
    let add = |graph: &mut Graph<'_>, name: String, columns: &[usize]| {
        let start = values(columns);
        (!columns.is_empty())
            .then(|| graph.add(name, Euclidean(columns.len()), &start))
            .transpose()
    };
    let shared = add(&mut graph, "shared".into(), &places.shared)?;
    let mut blocks: Vec<(Block, &[usize])> = Vec::new();
    blocks.extend(shared.map(|block| (block, places.shared.as_slice())));
    let parts = groups.iter().zip(&columns).zip(&places.own);
    for (k, ((rows, columns), own)) in parts.enumerate() {
        let block = add(&mut graph, format!("recording {}", k + 1), own)?;
        let touched: Vec<Block> = shared.into_iter().chain(block).collect();
        let read = [&places.shared[..], own].concat();
        blocks.extend(block.map(|block| (block, own.as_slice())));
        if !rows.is_empty() && !touched.is_empty() {
            graph.add_factor(&touched, Recording::new(weighted, x, (rows, columns), read));
        }
    }
    let options = GraphOptions {
        max_iterations: most_steps,
        rank: false,
        ..GraphOptions::default()
    };
    let report = solve_graph(&graph, &options)?;
    let mut x = x.to_vec();
    for (block, columns) in blocks {
        let values = columns.iter().zip(report.value(block));
        values.for_each(|(&k, value)| x[k] = *value);
    }
    Ok(Ended {
        x,
        ending: Ending {
            termination: report.termination,
            steps: report.iterations.len(),
        },
        linearisations: report.evaluations.jacobians,
    })
}

/// Free parameters that one group of rows has alone, and those that several have.
struct Places {
    own: Vec<Vec<usize>>,
    shared: Vec<usize>,
}

impl Places {
    /// Sorts the free ones of `count` parameters by the groups of rows; `columns` are the parameters of every group.
    fn of(columns: &[Vec<usize>], count: usize, free: &[usize]) -> Self {
        let mut is_free = vec![false; count];
        free.iter().for_each(|&k| is_free[k] = true);
        let mut own = columns.to_vec();
        let mut groups_of = vec![0; count];
        for columns in &mut own {
            columns.retain(|&k| is_free[k]);
            columns.iter().for_each(|&k| groups_of[k] += 1);
        }
        for columns in &mut own {
            columns.retain(|&k| groups_of[k] == 1);
        }
        let shared = (0..count).filter(|&k| groups_of[k] > 1).collect();
        Self { own, shared }
    }
}

/// The rows of a group.
struct Recording<'a> {
    weighted: &'a Weighted<'a>,
    /// All parameters; those that are not read are held.
    held: &'a [f64],
    rows: &'a [usize],
    /// The parameters that are read, in the order of the blocks.
    read: Vec<usize>,
    /// Their places among the columns of the rows.
    places: Vec<Option<usize>>,
    /// The columns of the rows.
    columns: &'a [usize],
}

impl<'a> Recording<'a> {
    fn new(
        weighted: &'a Weighted<'a>,
        held: &'a [f64],
        (rows, columns): (&'a [usize], &'a [usize]),
        read: Vec<usize>,
    ) -> Self {
        let place = |k: &usize| columns.binary_search(k).ok();
        Self {
            places: read.iter().map(place).collect(),
            weighted,
            held,
            rows,
            read,
            columns,
        }
    }

    fn all(&self, x: &[f64]) -> Vec<f64> {
        let mut all = self.held.to_vec();
        self.read
            .iter()
            .zip(x)
            .for_each(|(&k, value)| all[k] = *value);
        all
    }

    fn whitened(&self, r: &[f64]) -> Vec<f64> {
        let mut column = Mat::from_fn(r.len(), 1, |i, _| r[i]);
        let whitening = self.weighted.whitening;
        whitening.apply_group(self.rows, column.as_mut());
        column.col(0).iter().copied().collect()
    }
}

impl Factor for Recording<'_> {
    fn values(&self, x: &[f64], out: &mut Vec<f64>) {
        let residuals = self.weighted.rows.residuals_of(&self.all(x), self.rows);
        *out = self.whitened(&residuals);
    }

    fn linearize(&self, x: &[f64], residuals: &mut Vec<f64>, jacobian: &mut Vec<f64>) {
        let mut part = Part::zeros(self.rows, self.columns);
        let r = self.weighted.rows.linearize_part(&self.all(x), &mut part);
        *residuals = self.whitened(&r);
        let whitening = self.weighted.whitening;
        whitening.apply_group(self.rows, part.values.as_mut());
        jacobian.clear();
        for i in 0..self.rows.len() {
            let entry = |place: &Option<usize>| place.map_or(0.0, |k| part.values[(i, k)]);
            jacobian.extend(self.places.iter().map(entry));
        }
    }
}
