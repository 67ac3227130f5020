//! A pose graph from a file of g2o, solved: `cargo run --release -p stillpoint-solver --features pose-graphs --example pose_graph
//! -- FILE.g2o [apart|logarithm|quaternion] [file|chordal|better] [repair|moved]`.

use std::time::Instant;

use stillpoint_solver::pose_graph::{EdgeError, Indefinite, PoseGraph};
use stillpoint_solver::{GraphOptions, solve_graph};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let Some(file) = words.first() else {
        return Err("name a file".into());
    };
    let has = |word: &str| words.iter().any(|w| w == word);
    let error = match (has("logarithm"), has("quaternion")) {
        (true, _) => EdgeError::Logarithm,
        (_, true) => EdgeError::Quaternion,
        _ => EdgeError::Apart,
    };
    let indefinite = match (has("repair"), has("moved")) {
        (true, _) => Indefinite::WithoutWrongTerms,
        (_, true) => Indefinite::PlanarTermsMoved,
        _ => Indefinite::Refused,
    };
    let poses = PoseGraph::read(&std::fs::read_to_string(file)?, indefinite)?;
    let graph = poses.graph(error)?;
    println!("{:.9} in the file", graph.cost(graph.values()));
    let begin = Instant::now();
    let start = match (has("file"), has("chordal")) {
        (true, _) => poses,
        (_, true) => poses.chordal_start()?,
        _ => poses.better_start()?,
    };
    let graph = start.graph(error)?;
    let cost = graph.cost(graph.values());
    println!(
        "{cost:.9} at the start, {:.4} s",
        begin.elapsed().as_secs_f64()
    );
    let options = GraphOptions {
        gradient_tolerance: 1e-6,
        last_digits: false,
        rank: false,
        ..GraphOptions::default()
    };
    let report = solve_graph(&graph, &options)?;
    println!(
        "{:.9} after {} steps, {:.4} s: {}",
        report.cost,
        report.iterations.len(),
        begin.elapsed().as_secs_f64(),
        report.termination
    );
    Ok(())
}
