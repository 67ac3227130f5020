//! Prints how the time of a graph of many small blocks with shared numbers grows with the number of blocks, independent ones and a
//! chain in which consecutive blocks are coupled.
//!
//! ```text
//! cargo run --release -p stillpoint-benches --bin schur-table -- [BLOCKS ...]
//! ```
//! Times are the least of a few runs, of the processor where Linux tells them, which leaves out most
//! of what else the machine does.

use std::time::Instant;

use solver::{Error, Euclidean, Graph, GraphOptions, Residual, Scalar, lit, solve_graph};

/// Two exponentials' amplitudes of a block, the rates shared; coupled: amplitudes of neighbours alike.
struct Decay {
    amplitude: f64,
}

impl<D: Scalar> Residual<D> for Decay {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        for i in 0..6 {
            let t = 0.5 * f64::from(i);
            let model = x[2] * (-x[0] * t).exp() + x[3] * (-x[1] * t).exp();
            let truth = self.amplitude * (-0.4 * t).exp() + 1.5 * (-1.7 * t).exp();
            out.push(model - lit::<D>(truth + 1e-3 * (40.0 * t + self.amplitude).sin()));
        }
    }
}

/// `10⁻³ (own − next)`.
struct Alike;

impl<D: Scalar> Residual<D> for Alike {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        out.extend((0..2).map(|k| (x[k] - x[2 + k]) * 1e-3));
    }
}

/// Blocks solved for one line of the table, all runs together, within two and fifty runs.
const RUNS_OF_BLOCKS: usize = 20_000;

/// Runs shorter than this many seconds are not resolved by the system's count of processor time.
const TICKS: f64 = 0.1;

fn main() -> Result<(), Error> {
    let mut sizes: Vec<usize> = std::env::args()
        .filter_map(|word| word.parse().ok())
        .collect();
    if sizes.is_empty() {
        sizes = vec![10, 100, 1_000, 10_000, 100_000];
    }
    println!("    blocks   chain   parameters   Jacobians   seconds   µs per block and Jacobian");
    for coupled in [false, true] {
        for &blocks in &sizes {
            let graph = build(blocks, coupled)?;
            let timed = || {
                let (before, clock) = (processor_seconds(), Instant::now());
                let report = solve_graph(&graph, &GraphOptions::default())?;
                let spent = processor_seconds()
                    .zip(before)
                    .map(|(now, before)| now - before);
                let wall = clock.elapsed().as_secs_f64();
                let seconds = spent.filter(|_| wall > TICKS).unwrap_or(wall);
                Ok::<_, Error>((seconds, report))
            };
            let (mut seconds, report) = timed()?;
            for _ in 1..(RUNS_OF_BLOCKS / blocks).clamp(2, 50) {
                seconds = seconds.min(timed()?.0);
            }
            let jacobians = report.evaluations.jacobians;
            let each = 1e6 * seconds / (blocks * jacobians) as f64;
            println!(
                "{blocks:10}   {:5}   {:10}   {jacobians:9}   {seconds:7.3}   {each:8.3}   {}",
                if coupled { "yes" } else { "no" },
                2 + 2 * blocks,
                report.termination,
            );
        }
    }
    Ok(())
}

/// Time that this thread has spent on a processor; `None` where the system does not tell.
fn processor_seconds() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    let nanoseconds: f64 = text.split_whitespace().next()?.parse().ok()?;
    Some(1e-9 * nanoseconds)
}

fn build(blocks: usize, coupled: bool) -> Result<Graph<'static>, Error> {
    let mut graph = Graph::new();
    let rates = graph.add("rates", Euclidean(2), &[0.3, 2.0])?;
    let mut before = None;
    for i in 0..blocks {
        let block = graph.add(format!("amplitudes{i}"), Euclidean(2), &[1.0, 1.0])?;
        let amplitude = 2.0 + (0.1 * i as f64).sin();
        graph.add_factor(&[rates, block], Decay { amplitude });
        if let Some(before) = before.filter(|_| coupled) {
            graph.add_factor(&[before, block], Alike);
        }
        before = Some(block);
    }
    Ok(graph)
}
