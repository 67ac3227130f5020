//! A graph of rotations: five attitudes from turns measured between them, averaged.
//!
//! A rotation block stores a unit quaternion, the real part first, and steps by rotation vectors. The
//! first attitude is held: turns alone leave all of them free to turn together.

use stillpoint_solver::quaternion::{conjugate, exponential, logarithm, multiply};
use stillpoint_solver::{
    Block, Error, Graph, GraphOptions, Products, Residual, Rotation, Scalar, lit, solve_graph,
};

/// The turn from one attitude to another as measured: `r = log(m⁻¹ a⁻¹ b)`, rad.
struct Turn([f64; 4]);

impl<D: Scalar> Residual<D> for Turn {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        let measured = self.0.map(lit::<D>);
        let turn = multiply(&conjugate(&x[..4]), &x[4..]);
        out.extend(logarithm(&multiply(&conjugate(&measured), &turn)));
    }
}

fn main() -> Result<(), Error> {
    let truth = |k: usize| exponential(&[0.3 * k as f64, -0.1 * k as f64, 0.2]);
    let mut graph = Graph::new();
    let attitudes = (0..5)
        .map(|k| graph.add(format!("attitude{k}"), Rotation, &truth(0)))
        .collect::<Result<Vec<Block>, Error>>()?;
    graph.hold(attitudes[0]);
    for (i, &from) in attitudes.iter().enumerate() {
        for (k, &to) in attitudes.iter().enumerate().skip(i + 1) {
            let noise = [1e-3 * (3 * i + k) as f64 - 6e-3, 0.0, 1e-3];
            let turn = multiply(&conjugate(&truth(i)), &truth(k));
            graph.add_factor(&[from, to], Turn(multiply(&turn, &exponential(&noise))));
        }
    }
    let report = solve_graph(&graph, &GraphOptions::default())?;
    print!("{report}");
    let errors = Products::new(&graph, &report.values)?.standard_errors(attitudes[4]);
    println!("attitude4 {:.4?}", report.value(attitudes[4]));
    println!("per rad of noise: ± {errors:.3?} rad");
    assert!(report.termination.converged() && report.rank == Some(12));
    let off = report.value(attitudes[4]).iter().zip(truth(4));
    assert!(off.map(|(q, t)| (q - t).abs()).fold(0.0, f64::max) < 0.01);
    Ok(())
}
