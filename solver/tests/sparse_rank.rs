//! Rank and null space of graphs too large for one dense factorisation, beside dense singular
//! values.

#![allow(clippy::unwrap_used)]

use faer::Mat;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use stillpoint_solver::{Block, Euclidean, Factor, Graph, GraphOptions, Products, solve_graph};

/// Linear rows `A x − b` over a few blocks.
#[derive(Clone)]
struct Rows {
    a: Vec<Vec<f64>>,
    b: Vec<f64>,
}

impl Factor for Rows {
    fn values(&self, x: &[f64], out: &mut Vec<f64>) {
        let line = |(a, b): (&Vec<f64>, &f64)| a.iter().zip(x).map(|(a, x)| a * x).sum::<f64>() - b;
        out.clear();
        out.extend(self.a.iter().zip(&self.b).map(line));
    }

    fn linearize(&self, x: &[f64], residuals: &mut Vec<f64>, jacobian: &mut Vec<f64>) {
        self.values(x, residuals);
        jacobian.clear();
        self.a.iter().for_each(|row| jacobian.extend(row));
    }
}

/// A graph, and its Jacobian as a whole.
struct Pair {
    graph: Graph<'static>,
    blocks: Vec<Block>,
    width: usize,
    dense: Vec<Vec<f64>>,
}

impl Pair {
    fn new(blocks: usize, width: usize) -> Self {
        let mut graph = Graph::new();
        let blocks = (0..blocks)
            .map(|k| graph.add(format!("b{k}"), Euclidean(width), &vec![0.1; width]))
            .collect::<Result<_, _>>()
            .unwrap();
        Self {
            graph,
            blocks,
            width,
            dense: Vec::new(),
        }
    }

    fn add(&mut self, over: &[usize], a: Vec<Vec<f64>>) {
        for row in &a {
            let mut line = vec![0.0; self.width * self.blocks.len()];
            for (k, &block) in over.iter().enumerate() {
                line[block * self.width..(block + 1) * self.width]
                    .copy_from_slice(&row[k * self.width..(k + 1) * self.width]);
            }
            self.dense.push(line);
        }
        let b = vec![0.5; a.len()];
        let over: Vec<Block> = over.iter().map(|&k| self.blocks[k]).collect();
        self.graph.add_factor(&over, Rows { a, b });
    }

    /// The rank by singular values of the Jacobian with columns of unit length.
    fn rank(&self) -> usize {
        let n = self.width * self.blocks.len();
        let length = |c: usize| {
            self.dense
                .iter()
                .map(|row| row[c] * row[c])
                .sum::<f64>()
                .sqrt()
        };
        let lengths: Vec<f64> = (0..n).map(length).collect();
        let matrix = Mat::from_fn(self.dense.len(), n, |r, c| {
            self.dense[r][c] / if lengths[c] > 0.0 { lengths[c] } else { 1.0 }
        });
        let singular = matrix.singular_values().unwrap();
        singular
            .iter()
            .filter(|&&s| s > 1e-10 * singular[0])
            .count()
    }

    /// Rank and null space of the graph, after a check that it takes more than a dense matrix.
    fn check(&self, trial: u64) -> usize {
        let report = solve_graph(&self.graph, &GraphOptions::default()).unwrap();
        let method = report.method;
        assert!(!method.dense || method.eliminated > 0, "{method:?}");
        let products = Products::new(&self.graph, &report.values).unwrap();
        let n = self.width * self.blocks.len();
        let rank = self.rank();
        assert_eq!(products.rank(), rank, "{trial}");
        assert_eq!(products.null_space().len(), n - rank, "{trial}");
        rank
    }
}

#[test]
fn components_that_float_are_as_many_and_as_named_as_the_dense_jacobian_says() {
    for trial in 0..16 {
        let mut rng = ChaCha8Rng::seed_from_u64(trial);
        let parts = rng.random_range(1..5);
        let mut pair = Pair::new(130, 2);
        for k in parts..130 {
            let mut partners = vec![k - parts];
            if k > 20 && rng.random_range(0..4) == 0 {
                partners.push(k - parts * rng.random_range(2..5));
            }
            for other in partners {
                let scale = rng.random_range(0.5..2.0);
                pair.add(
                    &[other, k],
                    vec![vec![-scale, 0.0, scale, 0.0], vec![0.0, -1.0, 0.0, 1.0]],
                );
            }
        }
        // One part is held in one coordinate.
        pair.add(&[0], vec![vec![1.0, 0.0]]);
        let rank = pair.check(trial);
        assert_eq!(rank, 2 * 130 - 2 * parts + 1, "{trial}");
        let products = Products::new(&pair.graph, pair.graph.values()).unwrap();
        for vector in products.null_space() {
            let mut x = vec![0.0; 2 * 130];
            for &(block, coordinate, value) in &vector.components {
                x[2 * block.number() + coordinate] = value;
            }
            let size = x.iter().map(|v| v.abs()).fold(0.0, f64::max);
            for row in &pair.dense {
                let seen: f64 = row.iter().zip(&x).map(|(a, x)| a * x).sum();
                assert!(seen.abs() < 1e-7 * size, "{trial}: {seen} {}", vector.words);
            }
        }
    }
}

#[test]
fn small_blocks_that_are_eliminated_lose_the_rank_of_the_dense_jacobian() {
    let mut short = 0;
    for trial in 0..16 {
        let mut rng = ChaCha8Rng::seed_from_u64(100 + trial);
        let mut pair = Pair::new(90, 3);
        let hubs = 12;
        for k in hubs..90 {
            // Of a few the rows are too few or repeat.
            let poor = rng.random_range(0..10) == 0;
            for _ in 0..if poor { 1 } else { 3 } {
                let hub = rng.random_range(0..hubs);
                let row =
                    |rng: &mut ChaCha8Rng| (0..6).map(|_| rng.random_range(-1.0..1.0)).collect();
                let first: Vec<f64> = row(&mut rng);
                let second = if poor { first.clone() } else { row(&mut rng) };
                pair.add(&[hub, k], vec![first, second]);
            }
        }
        let rank = pair.check(trial);
        short += usize::from(rank < 3 * 90);
    }
    assert!(short >= 8, "{short}");
}
