//! Many small blocks with shared parameters.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use solver::{Error, Euclidean, Factor, Graph};

/// Numbers of a block of its own.
pub const OWN: usize = 2;

/// Rows of a block beyond its own numbers.
pub const SPARE: usize = 4;

/// Slightly nonlinear rows in the shared numbers and those of one block, with an own Jacobian:
/// `r = A x + 0.1 sin(A x) − b`.
#[derive(Debug)]
pub struct Rows {
    width: usize,
    a: Vec<f64>,
    b: Vec<f64>,
}

impl Rows {
    fn linear<'s>(&'s self, x: &'s [f64]) -> impl Iterator<Item = (&'s [f64], f64, f64)> + 's {
        let rows = self.a.chunks_exact(self.width).zip(&self.b);
        rows.map(move |(row, &b)| {
            let sum: f64 = row.iter().zip(x).map(|(a, x)| a * x).sum();
            (row, sum, b)
        })
    }
}

impl Factor for Rows {
    fn values(&self, x: &[f64], out: &mut Vec<f64>) {
        out.clear();
        out.extend(self.linear(x).map(|(_, s, b)| s + 0.1 * s.sin() - b));
    }

    fn linearize(&self, x: &[f64], residuals: &mut Vec<f64>, jacobian: &mut Vec<f64>) {
        residuals.clear();
        jacobian.clear();
        for (row, s, b) in self.linear(x) {
            residuals.push(s + 0.1 * s.sin() - b);
            let slope = 1.0 + 0.1 * s.cos();
            jacobian.extend(row.iter().map(|a| a * slope));
        }
    }
}

/// `blocks` blocks of [`OWN`] numbers, each read with all `shared` numbers by one factor of
/// `OWN + SPARE` rows.
///
/// # Errors
/// None: the start is finite.
pub fn groups(shared: usize, blocks: usize, seed: u64) -> Result<Graph<'static>, Error> {
    let mut graph = Graph::new();
    let common = graph.add("shared", Euclidean(shared), &vec![0.0; shared])?;
    for (k, rows) in rows(shared, blocks, seed).into_iter().enumerate() {
        let own = graph.add(format!("b{k}"), Euclidean(OWN), &[0.0; OWN])?;
        graph.add_factor(&[common, own], rows);
    }
    Ok(graph)
}

/// The rows of all blocks.
pub fn rows(shared: usize, blocks: usize, seed: u64) -> Vec<Rows> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let width = shared + OWN;
    let scale = 1.0 / (width as f64).sqrt();
    let rows = OWN + SPARE;
    (0..blocks)
        .map(|_| {
            let a = (0..rows * width).map(|_| scale * rng.random_range(-1.0..1.0));
            let a = a.collect();
            let b = (0..rows).map(|_| rng.random_range(-1.0..1.0)).collect();
            Rows { width, a, b }
        })
        .collect()
}
