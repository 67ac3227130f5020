//! Random graphs that are dense problems too.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use stillpoint_solver::{Block, Euclidean, Factor, Graph, Residual, Scalar, lit};

/// Slightly nonlinear random rows in a few numbers.
#[derive(Clone)]
pub struct Rows {
    pub coefficients: Vec<Vec<f64>>,
    pub targets: Vec<f64>,
}

impl<D: Scalar> Residual<D> for Rows {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        for (row, target) in self.coefficients.iter().zip(&self.targets) {
            let linear = row
                .iter()
                .zip(x)
                .fold(lit::<D>(0.0), |sum, (&c, &x)| sum + x * c);
            out.push(linear + linear.sin() * 0.1 - lit::<D>(*target));
        }
    }
}

/// The same rows with an own Jacobian.
pub struct Own(pub Rows);

impl Factor for Own {
    fn values(&self, x: &[f64], out: &mut Vec<f64>) {
        out.clear();
        Residual::<f64>::residuals(&self.0, x, out);
    }

    fn linearize(&self, x: &[f64], residuals: &mut Vec<f64>, jacobian: &mut Vec<f64>) {
        self.values(x, residuals);
        jacobian.clear();
        for row in &self.0.coefficients {
            let linear: f64 = row.iter().zip(x).map(|(c, x)| c * x).sum();
            jacobian.extend(row.iter().map(|c| c * (1.0 + 0.1 * linear.cos())));
        }
    }
}

/// Blocks of random widths and factors over one to three of them.
pub struct Random {
    pub widths: Vec<usize>,
    pub factors: Vec<(Vec<usize>, Rows)>,
}

impl Random {
    /// One of six kinds.
    pub fn new(rng: &mut ChaCha8Rng, kind: usize) -> Self {
        let shared = 1 + kind % 3;
        let count = rng.random_range(2..30) + if kind.is_multiple_of(2) { 60 } else { 0 };
        let mut widths: Vec<usize> = (0..shared).map(|_| rng.random_range(2..7)).collect();
        widths.extend((0..count).map(|_| rng.random_range(1..4)));
        let mut factors = Vec::new();
        for block in 0..widths.len() {
            let mut lists = vec![vec![block]];
            if block >= shared {
                lists.push(vec![rng.random_range(0..shared), block]);
            }
            if kind % 2 == 1 && block > shared {
                // A chain with far ties: no elimination of single blocks.
                lists.push(vec![block, block - 1]);
                let far = rng.random_range(0..block);
                lists.push(vec![far, block]);
            }
            for list in lists {
                let n: usize = list.iter().map(|&b| widths[b]).sum();
                let rows = rng.random_range(n..n + 2);
                let random = |rng: &mut ChaCha8Rng| rng.random_range(-1.0..1.0);
                let coefficients = (0..rows)
                    .map(|_| (0..n).map(|_| random(rng)).collect())
                    .collect();
                let targets = (0..rows).map(|_| 0.5 * random(rng)).collect();
                factors.push((
                    list,
                    Rows {
                        coefficients,
                        targets,
                    },
                ));
            }
        }
        Self { widths, factors }
    }

    /// As a graph.
    pub fn graph(&self) -> (Graph<'static>, Vec<Block>) {
        let mut graph = Graph::new();
        let blocks: Vec<Block> = self
            .widths
            .iter()
            .enumerate()
            .map(|(k, &w)| {
                graph
                    .add(format!("b{k}"), Euclidean(w), &vec![0.1; w])
                    .unwrap()
            })
            .collect();
        for (k, (list, rows)) in self.factors.iter().enumerate() {
            let list: Vec<Block> = list.iter().map(|&b| blocks[b]).collect();
            if k % 2 == 0 {
                graph.add_factor(&list, rows.clone());
            } else {
                graph.add_factor(&list, Own(rows.clone()));
            }
        }
        (graph, blocks)
    }
}

impl<D: Scalar> Residual<D> for Random {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        let mut first = vec![0];
        for w in &self.widths {
            first.push(first[first.len() - 1] + w);
        }
        for (list, rows) in &self.factors {
            let own: Vec<D> = list
                .iter()
                .flat_map(|&b| x[first[b]..first[b + 1]].to_vec())
                .collect();
            rows.residuals(&own, out);
        }
    }
}
