//! Rotations stored as rotation vectors, near a full turn.

#![allow(clippy::unwrap_used)]

use std::f64::consts::TAU;

use stillpoint_solver::quaternion::{conjugate, exponential, logarithm, multiply};
use stillpoint_solver::{
    Euclidean, Graph, GraphOptions, GraphReport, Manifold, Residual, RotationVector, Scalar, lit,
    solve_graph,
};

/// How the second rotation was measured from the first, in rad.
struct Between([f64; 3]);

impl<D: Scalar> Residual<D> for Between {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        let back = conjugate(&exponential(&self.0.map(lit::<D>)));
        let turned = multiply(&conjugate(&exponential(&x[..3])), &exponential(&x[3..]));
        out.extend(logarithm(&multiply(&back, &turned)));
    }
}

/// A ring of attitudes about z, the last within a hundredth of a full turn, all of them measured from the two before without
/// error. The first is held, off by a fiftieth: all others have to turn by that.
fn ring(manifold: impl Manifold + Copy) -> GraphReport {
    let count = 60;
    let angle = |k: usize| (TAU - 0.01) * k as f64 / (count - 1) as f64;
    let mut graph = Graph::new();
    let blocks: Vec<_> = (0..count)
        .map(|k| {
            let start = [1e-3, 0.0, angle(k)];
            graph.add(format!("c{k}"), manifold, &start).unwrap()
        })
        .collect();
    let first = graph.add("first", manifold, &[0.02, -0.02, 0.0]).unwrap();
    graph.hold(first);
    graph.add_factor(&[first, blocks[0]], Between([0.0; 3]));
    for reach in [1, 2] {
        for (k, &a) in blocks.iter().enumerate().take(count - reach) {
            let turn = Between([0.0, 0.0, angle(k + reach) - angle(k)]);
            graph.add_factor(&[a, blocks[k + reach]], turn);
        }
    }
    solve_graph(&graph, &GraphOptions::default()).unwrap()
}

#[test]
fn a_ring_of_rotation_vectors_turns_as_a_whole_in_a_few_steps() {
    let report = ring(RotationVector);
    assert!(report.cost < 1e-24, "{report}");
    assert!(report.iterations.len() <= 12, "{report}");
    let plain = ring(Euclidean(3));
    let (few, many) = (report.iterations.len(), plain.iterations.len());
    assert!(many >= 3 * few, "{few} and {many} steps");
}
