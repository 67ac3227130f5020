//! Prints how the default does on published collections that it was not tuned on.
//!
//! ```text
//! cargo run --release -p stillpoint-benches --bin problem-table -- [--json]
//! ```
//! `benches/peers/scipy_table.py` runs scipy on the same problems and prints both side by side.

use std::process::ExitCode;

use clap::Parser;
use comfy_table::{Table, presets::UTF8_FULL_CONDENSED};
use stillpoint_benches::problem_study::{Outcome, run};

/// The default variant on published problems.
#[derive(Parser)]
struct Arguments {
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

fn main() -> ExitCode {
    let outcomes = run();
    if Arguments::parse().json {
        match serde_json::to_string(&outcomes) {
            Ok(text) => println!("{text}"),
            Err(error) => {
                eprintln!("{error}");
                return ExitCode::from(1);
            }
        }
        return ExitCode::SUCCESS;
    }
    print(&outcomes);
    ExitCode::SUCCESS
}

fn print(outcomes: &[Outcome]) {
    let mut table = Table::new();
    table.load_style(UTF8_FULL_CONDENSED);
    table.set_header([
        "group",
        "problem",
        "Σ r²",
        "optimality",
        "r",
        "J",
        "r″",
        "solved",
        "reason",
    ]);
    for o in outcomes {
        table.add_row([
            o.group.clone(),
            o.problem.clone(),
            format!("{:.9e}", o.sum_of_squares),
            format!("{:.1e}", o.optimality),
            o.residuals.to_string(),
            o.jacobians.to_string(),
            o.second_derivatives.to_string(),
            if o.solved { "yes" } else { "NO" }.to_owned(),
            o.reason.clone(),
        ]);
    }
    println!("{table}");
    for group in ["unconstrained", "bounded", "linear"] {
        let of = || outcomes.iter().filter(|o| o.group == group);
        println!(
            "{group}: {} of {} solved, r {}, J {}, r″ {}",
            of().filter(|o| o.solved).count(),
            of().count(),
            of().map(|o| o.residuals).sum::<usize>(),
            of().map(|o| o.jacobians).sum::<usize>(),
            of().map(|o| o.second_derivatives).sum::<usize>(),
        );
    }
}
