//! A graph of three points in the plane from distances between them: named blocks, factors over two.

use stillpoint_solver::{Euclidean, Graph, GraphOptions, Residual, Scalar, solve_graph};

struct Distance(f64);

impl<D: Scalar> Residual<D> for Distance {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        let (dx, dy) = (x[2] - x[0], x[3] - x[1]);
        out.push((dx * dx + dy * dy).sqrt() - self.0);
    }
}

fn main() -> Result<(), stillpoint_solver::Error> {
    let mut graph = Graph::new();
    let a = graph.add("a", Euclidean(2), &[0.0, 0.0])?;
    let b = graph.add("b", Euclidean(2), &[4.1, 0.0])?;
    let c = graph.add("c", Euclidean(2), &[0.2, 2.0])?;
    graph.hold(a);
    graph.hold_part(b, 1);
    for (ends, distance) in [([a, b], 4.0), ([a, c], 3.0), ([b, c], 5.0)] {
        graph.add_factor(&ends, Distance(distance));
    }
    let report = solve_graph(&graph, &GraphOptions::default())?;
    println!("c = {:?}, {}", report.value(c), report.termination);
    assert!((report.value(c)[1] - 3.0).abs() < 1e-12);
    Ok(())
}
