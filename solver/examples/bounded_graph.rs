//! Decays of many samples with one rate for all: amplitudes that cannot be negative, a rate within limits.

use stillpoint_solver::{
    Error, Euclidean, Graph, GraphOptions, Products, Residual, Scalar, solve_graph,
};

/// `y = amplitude exp(−rate t) + background`, the background shared like the rate.
struct Sample(Vec<(f64, f64)>);

impl<D: Scalar> Residual<D> for Sample {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        let [rate, background, amplitude] = [x[0], x[1], x[2]];
        let each = self.0.iter();
        out.extend(each.map(|&(t, y)| amplitude * (-rate * t).exp() + background - y));
    }
}

fn main() -> Result<(), Error> {
    let mut graph = Graph::new();
    let shared = graph.add("shared", Euclidean(2), &[1.0, 0.1])?;
    graph.bound(shared, 0, 0.1, 2.0)?; // the rate
    graph.bound(shared, 1, 0.0, f64::INFINITY)?; // the background
    for k in 0..200 {
        let amplitude = graph.add(format!("amplitude {k}"), Euclidean(1), &[1.0])?;
        graph.bound(amplitude, 0, 0.0, f64::INFINITY)?;
        // Every fortieth sample is empty, and reads a little below zero.
        let true_amplitude = if k % 40 == 0 {
            -0.05
        } else {
            1.0 + f64::from(k % 7)
        };
        let reading = |t: f64| (t, true_amplitude * (-0.8 * t).exp());
        let times = (0..6).map(|i| 0.5 * f64::from(i));
        graph.add_factor(&[shared, amplitude], Sample(times.map(reading).collect()));
    }
    let report = solve_graph(&graph, &GraphOptions::default())?;
    println!("{report}"); // the amplitudes of the empty samples are at 0, each with its multiplier
    let rate = report.value(shared)[0];
    let products = Products::new(&graph, &report.values)?; // what bounds hold has no variance
    println!(
        "rate {rate:.4}, standard error {:.1e} per unit of noise",
        products.standard_errors(shared)[0]
    );
    assert!((rate - 0.8).abs() < 0.01 && report.active.len() >= 5);
    Ok(())
}
