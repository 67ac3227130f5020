//! Prints, for each variant and NIST problem: digits, evaluations and reason; and per variant how
//! many of the 54 runs reach 4, 6, 8, 9 and 10 digits.
//!
//! ```text
//! cargo run --release -p stillpoint-benches --bin solver-table -- DIR [--json] [--summary]
//! ```
//! `DIR` holds NIST's `.dat` files. Start 3 is the certified values and is not counted.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use comfy_table::{Table, presets::UTF8_FULL_CONDENSED};
use solver::Variant;
use stillpoint_benches::nist_study::{LEVELS, VariantRuns, run};
use stillpoint_tests::problems::nist::{Regression, default_folder};

/// Every variant of the solver on NIST's nonlinear regression problems.
#[derive(Parser)]
struct Arguments {
    /// Folder with the .dat files.
    folder: Option<PathBuf>,
    /// Print JSON.
    #[arg(long)]
    json: bool,
    /// Print the counts per variant only.
    #[arg(long)]
    summary: bool,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let folder = arguments.folder.unwrap_or_else(default_folder);
    let problems = match Regression::all(&folder) {
        Ok(problems) => problems,
        Err(error) => {
            eprintln!("{error}");
            return ExitCode::from(3);
        }
    };
    let all: Vec<VariantRuns> = Variant::all()
        .into_iter()
        .map(|v| run(&problems, v))
        .collect();
    if arguments.json {
        match serde_json::to_string_pretty(&all) {
            Ok(text) => println!("{text}"),
            Err(error) => {
                eprintln!("{error}");
                return ExitCode::from(1);
            }
        }
        return ExitCode::SUCCESS;
    }
    if !arguments.summary {
        all.iter().for_each(print_runs);
    }
    print_counts(&all);
    ExitCode::SUCCESS
}

fn print_runs(runs: &VariantRuns) {
    let mut table = Table::new();
    table.load_style(UTF8_FULL_CONDENSED);
    table.set_header(["problem", "start", "LRE", "steps", "r", "J", "r″", "reason"]);
    for run in &runs.runs {
        table.add_row([
            run.problem.clone(),
            run.start.to_string(),
            format!("{:.1}", run.lre),
            run.steps.to_string(),
            run.residuals.to_string(),
            run.jacobians.to_string(),
            run.second_derivatives.to_string(),
            run.reason.clone(),
        ]);
    }
    println!("{}\n{table}\n", runs.variant);
}

fn print_counts(all: &[VariantRuns]) {
    let mut table = Table::new();
    table.load_style(UTF8_FULL_CONDENSED);
    let levels = LEVELS.map(|level| format!("≥ {level}"));
    table.set_header(
        ["variant".to_owned()]
            .into_iter()
            .chain(levels)
            .chain(["J", "r", "r″"].map(String::from)),
    );
    for runs in all {
        let counts = runs.counts().map(|count| count.to_string());
        let row = [runs.variant.clone()].into_iter().chain(counts);
        let [residuals, second] = runs.other_evaluations();
        let evaluations = [runs.jacobians(), residuals, second].map(|count| count.to_string());
        table.add_row(row.chain(evaluations));
    }
    println!(
        "runs of 54 by digits in the worst parameter; the default is {}",
        Variant::default().name()
    );
    println!("{table}");
}
