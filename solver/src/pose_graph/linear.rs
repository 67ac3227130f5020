//! Linear least squares over vectors at the poses: rows `weight · (x_b − M x_a − c)`.

use crate::error::Error;
use crate::graph::{Block, Euclidean, Factor, Graph, GraphOptions, solve_graph};

/// `weight · (x_b − M x_a − c)`, `N` rows over the vectors of two poses.
pub(super) struct Row<const N: usize> {
    pub ends: (u32, u32),
    pub weight: f64,
    /// `M`, row after row.
    pub matrix: [[f64; N]; N],
    /// `c`.
    pub constant: [f64; N],
}

impl<const N: usize> Row<N> {
    fn residual(&self, x: &[f64]) -> [f64; N] {
        std::array::from_fn(|i| {
            let turned: f64 = self.matrix[i].iter().zip(x).map(|(m, x)| m * x).sum();
            self.weight * (x[N + i] - turned - self.constant[i])
        })
    }
}

impl<const N: usize> Factor for Row<N> {
    fn values(&self, x: &[f64], out: &mut Vec<f64>) {
        out.clear();
        out.extend_from_slice(&self.residual(x));
    }

    fn linearize(&self, x: &[f64], residuals: &mut Vec<f64>, jacobian: &mut Vec<f64>) {
        self.values(x, residuals);
        jacobian.clear();
        for (i, row) in self.matrix.iter().enumerate() {
            jacobian.extend(row.iter().map(|m| -self.weight * m));
            jacobian.extend((0..N).map(|k| if i == k { self.weight } else { 0.0 }));
        }
    }
}

/// The vectors that minimise the sum of squares, those of the `held` poses as they are in `start`.
///
/// # Errors
/// A start that is not finite.
pub(super) fn solved<const N: usize>(
    start: &[[f64; N]],
    held: &[u32],
    rows: Vec<Row<N>>,
) -> Result<Vec<[f64; N]>, Error> {
    let mut graph = Graph::new();
    let blocks: Vec<Block> = start
        .iter()
        .enumerate()
        .map(|(k, x)| graph.add(format!("{k}"), Euclidean(N), x))
        .collect::<Result<_, _>>()?;
    for &k in held {
        graph.hold(blocks[k as usize]);
    }
    for row in rows {
        let (a, b) = row.ends;
        graph.add_factor(&[blocks[a as usize], blocks[b as usize]], row);
    }
    if held.len() == start.len() {
        return Ok(start.to_vec());
    }
    // One step of Gauss and Newton is the solution; the second only shows that it is.
    let options = GraphOptions {
        max_iterations: 2,
        gradient_tolerance: 1e-4,
        last_digits: false,
        rank: false,
        ..GraphOptions::default()
    };
    let report = solve_graph(&graph, &options)?;
    let (all, _) = report.values.as_chunks::<N>();
    Ok(all.to_vec())
}
