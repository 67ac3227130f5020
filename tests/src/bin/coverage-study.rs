//! Coverage, consistency and efficiency of the joint method, the stepwise method beside it.
//!
//! ```text
//! cargo run --release -p stillpoint-tests --bin coverage-study -- --sessions 500 --row consumer --row tactical
//! ```
//!
//! Sessions have the seeds `0..N`; the result does not depend on the number of threads.

use std::process::ExitCode;

use clap::{Parser, ValueEnum};
use indicatif::ProgressBar;
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use stillpoint_tests::coverage::{Row, SessionResult, Summary, Tally, run, summarise};

/// Simulated sessions calibrated both ways, against their truth
#[derive(Debug, Parser)]
struct Args {
    /// Sessions per row
    #[arg(long, default_value_t = 500)]
    sessions: u64,
    /// First seed
    #[arg(long, default_value_t = 0)]
    first_seed: u64,
    /// Rows of the table; all without
    #[arg(long, value_enum)]
    row: Vec<Row>,
    /// Print one JSON line per session and one per row
    #[arg(long)]
    json: bool,
}

fn main() -> ExitCode {
    let args = Args::parse();
    let rows = if args.row.is_empty() {
        Row::value_variants().to_vec()
    } else {
        args.row.clone()
    };
    for row in rows {
        match sessions(&args, row) {
            Ok(results) => print(row, &results, args.json),
            Err(error) => {
                eprintln!("{error}");
                return ExitCode::FAILURE;
            }
        }
    }
    ExitCode::SUCCESS
}

fn sessions(args: &Args, row: Row) -> Result<Vec<SessionResult>, calib::Error> {
    let bar = ProgressBar::new(args.sessions);
    let results = (args.first_seed..args.first_seed + args.sessions)
        .into_par_iter()
        .map(|seed| run(row, seed))
        .inspect(|_| bar.inc(1))
        .collect();
    bar.finish_and_clear();
    results
}

fn print(row: Row, results: &[SessionResult], json: bool) {
    let summary = summarise(results);
    if json {
        for result in results {
            println!("{}", serde_json::json!({ "row": row, "session": result }));
        }
        println!("{}", serde_json::json!({ "row": row, "summary": summary }));
        return;
    }
    let name = row
        .to_possible_value()
        .map_or_else(String::new, |v| v.get_name().to_owned());
    println!(
        "{name}: {} sessions, {:.3} s per joint fit",
        summary.sessions, summary.seconds
    );
    print_tally("joint", summary.joint.as_ref());
    print_tally("stepwise", summary.stepwise.as_ref());
    print_names(&summary);
    for result in results.iter().filter(|r| !r.words.is_empty()).take(10) {
        println!("  seed {}: {}", result.seed, result.words.join("\n    "));
    }
}

fn print_tally(name: &str, tally: Option<&Tally>) {
    let Some(t) = tally else { return };
    println!(
        "  {name:8} coverage {:.1} % (each {:.1} to {:.1} %)  NEES/dof {:.3}  rms/CRB {:.3}  largest {:.1e} {:.1e}",
        100.0 * t.coverage,
        100.0 * t.coverage_each[0],
        100.0 * t.coverage_each[1],
        t.nees,
        t.efficiency,
        t.largest[0],
        t.largest[1],
    );
}

fn print_names(summary: &Summary) {
    let [slip, touch, gap] = summary.named.map(|share| 100.0 * share);
    println!(
        "  named: slips {slip:.1} %, touches {touch:.1} %, gaps {gap:.1} %; false alarms in {} sessions; \
         {} refused or warned",
        summary.false_alarms, summary.warned
    );
}
