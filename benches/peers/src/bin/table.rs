//! Prints the time per iteration of each problem beside the crate levenberg-marquardt: the
//! least of rounds in which the solvers take turns, which leaves out what else the machine does.
//!
//! ```text
//! STILLPOINT_DATA=FOLDER cargo run --release --bin table -- [ROUNDS [START]]
//! ```
//! `FOLDER/nist` holds NIST's `.dat` files.

use std::time::Instant;

use peers::{Named, Solver, all};

/// Rounds if none are asked for.
const ROUNDS: usize = 101;

/// Seconds of one timing, at least; shorter fits are repeated within it.
const LEAST: f64 = 2e-4;

/// One problem, per solver.
struct Row {
    name: String,
    jacobians: [usize; 3],
    /// Microseconds per iteration.
    micros: [f64; 3],
}

fn main() {
    let asked = std::env::args().nth(1).and_then(|word| word.parse().ok());
    let rounds = asked.unwrap_or(ROUNDS).max(1);
    let start = std::env::args().nth(2).and_then(|word| word.parse().ok());
    let start = start.unwrap_or(2);
    println!(
        "microseconds per iteration, least of {rounds} rounds, NIST from start {start}; ratios to levenberg-marquardt"
    );
    println!("{:13} {:>14} {:>31} {:>15}", "", "Jacobians", "µs", "ratio");
    println!(
        "{:13} {:>4} {:>4} {:>4}  {:>9} {:>9} {:>9}  {:>7} {:>7}",
        "problem", "ours", "w/o", "peer", "ours", "w/o", "peer", "ours", "w/o"
    );
    let rows: Vec<Row> = all(start)
        .iter()
        .map(|problem| measured(problem, rounds))
        .collect();
    rows.iter().for_each(print);
    let nist: Vec<&Row> = rows.iter().skip(1).collect();
    if nist.is_empty() {
        return;
    }
    let total = |s: usize| {
        nist.iter()
            .map(|r| r.jacobians[s] as f64 * r.micros[s])
            .sum::<f64>()
    };
    let count = |s: usize| nist.iter().map(|r| r.jacobians[s]).sum::<usize>();
    let mean = [0, 1, 2].map(|s| total(s) / count(s) as f64);
    print(&Row {
        name: "NIST, sum".into(),
        jacobians: [0, 1, 2].map(count),
        micros: mean,
    });
    let middle = |s: usize| median(nist.iter().map(|r| r.micros[s] / r.micros[2]).collect());
    println!(
        "NIST, median ratio {:>41} {:7.2} {:7.2}",
        "",
        middle(0),
        middle(1)
    );
    println!(
        "NIST, whole fits: {:.2} of the peer's time",
        total(0) / total(2)
    );
}

fn print(row: &Row) {
    let ([a, b, c], [x, y, z]) = (row.jacobians, row.micros);
    let (p, q) = (x / z, y / z);
    println!(
        "{:13} {a:4} {b:4} {c:4}  {x:9.2} {y:9.2} {z:9.2}  {p:7.2} {q:7.2}",
        row.name
    );
}

fn measured(problem: &Named, rounds: usize) -> Row {
    let fit = |solver: Solver| solver.fit(&*problem.problem, &problem.start);
    let jacobians = Solver::ALL.map(fit);
    let repeats = Solver::ALL.map(|solver| {
        let seconds = seconds(1, || fit(solver));
        (LEAST / seconds).ceil().clamp(1.0, 1e4) as usize
    });
    let mut micros = [f64::INFINITY; 3];
    for _ in 0..rounds {
        for (s, solver) in Solver::ALL.into_iter().enumerate() {
            let per_fit = seconds(repeats[s], || fit(solver));
            micros[s] = micros[s].min(1e6 * per_fit / jacobians[s] as f64);
        }
    }
    Row {
        name: problem.name.clone(),
        jacobians,
        micros,
    }
}

/// Seconds per call.
fn seconds(repeats: usize, fit: impl Fn() -> usize) -> f64 {
    let clock = Instant::now();
    for _ in 0..repeats {
        std::hint::black_box(fit());
    }
    clock.elapsed().as_secs_f64() / repeats as f64
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}
