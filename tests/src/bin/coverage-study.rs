//! Coverage, consistency, silent lies and false alarms under each condition, both methods.
//!
//! ```text
//! cargo run -p stillpoint-tests --bin coverage-study -- --sessions 150 --out study.jsonl
//! cargo run -p stillpoint-tests --bin coverage-study -- --row stamps-1.5 --sessions 20
//! ```
//!
//! Sessions have the seeds `0..N`; the result does not depend on the number of threads. With `--out`, what is
//! in the file is not run again, so that a study can be interrupted, and one of another commit needs another
//! file.

use std::path::PathBuf;
use std::process::ExitCode;
use std::time::{Duration, Instant};

use clap::Parser;
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use stillpoint_tests::conditions::{
    CONDITIONS, Condition, HEADING, Record, Stored, condition, read, row, run,
};

/// Simulated sessions under each condition, calibrated by both methods, against their truth
#[derive(Debug, Parser)]
struct Args {
    /// Sessions per row
    #[arg(long, default_value_t = 150)]
    sessions: u64,
    /// Rows of the table; all without
    #[arg(long)]
    row: Vec<String>,
    /// JSON lines to read and to go on writing
    #[arg(long, value_name = "FILE.jsonl")]
    out: Option<PathBuf>,
    /// Threads; as many as there are cores without
    #[arg(long, default_value_t = 0)]
    jobs: usize,
    /// Begin no more sessions after so many seconds
    #[arg(long, value_name = "SECONDS")]
    seconds: Option<u64>,
    /// Names of the rows, and nothing else
    #[arg(long)]
    list: bool,
    /// Print the words of each session too
    #[arg(long)]
    words: bool,
}

fn main() -> ExitCode {
    match study(&Args::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn study(args: &Args) -> Result<(), Box<dyn std::error::Error>> {
    if args.list {
        for c in CONDITIONS.iter().copied().flatten() {
            println!("{:20} {}", c.name, c.about);
        }
        return Ok(());
    }
    rayon::ThreadPoolBuilder::new()
        .num_threads(args.jobs)
        .build_global()?;
    let rows = rows(&args.row)?;
    let end = args
        .seconds
        .map(|s| Instant::now() + Duration::from_secs(s));
    let mut stored = args.out.as_deref().map(Stored::open).transpose()?;
    println!("{HEADING}");
    for condition in rows {
        let mut records = Vec::new();
        let has = |seed: &u64| {
            stored
                .as_ref()
                .is_some_and(|s| s.has(condition.name, *seed))
        };
        let missing: Vec<u64> = (0..args.sessions).filter(|seed| !has(seed)).collect();
        // Some at a time, so that an interruption costs little.
        for seeds in missing.chunks(16) {
            if end.is_some_and(|end| Instant::now() > end) {
                break;
            }
            let new: Vec<Record> = seeds
                .into_par_iter()
                .map(|&seed| run(condition, seed))
                .collect::<Result<_, _>>()
                .map_err(|e| format!("{}: {e}", condition.name))?;
            if let Some(stored) = &mut stored {
                new.iter().try_for_each(|record| stored.add(record))?;
            }
            records.extend(new);
        }
        if let Some(path) = &args.out {
            records = read(path)?;
        }
        records.retain(|r| r.row == condition.name && r.seed < args.sessions);
        if records.is_empty() {
            continue;
        }
        println!("{}", row(condition, &records));
        if args.words {
            print_words(&records);
        }
    }
    Ok(())
}

fn rows(names: &[String]) -> Result<Vec<&'static Condition>, String> {
    if names.is_empty() {
        return Ok(CONDITIONS.iter().copied().flatten().collect());
    }
    let of = |name: &String| {
        condition(name).ok_or(format!("there is no row `{name}`: --list has their names"))
    };
    names.iter().map(of).collect()
}

fn print_words(records: &[Record]) {
    for record in records {
        for (method, outcome) in [("joint", &record.joint), ("stepwise", &record.stepwise)] {
            for words in &outcome.words {
                println!("  {} {method}: {words}", record.seed);
            }
        }
    }
}
