//! Signals at random times and limits on file sizes, over all commands with outputs.
//!
//! ```text
//! cargo build --release && cargo run --release -p stillpoint-tests --bin faults -- [--trials 20] [--seed 1]
//! ```
//! Twenty trials a command are 200 signals (KILL, TERM, HUP, INT) and 200 limits. Needs `sh` and `kill`.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use stillpoint_tests::faults::Faults;

/// Kills, interrupts and limits the program while it writes, and looks at what is left.
#[derive(Parser)]
struct Arguments {
    /// Trials of each kind for each command.
    #[arg(long, default_value_t = 20)]
    trials: usize,
    /// Commands, the quick ones first.
    #[arg(long, default_value_t = 10)]
    commands: usize,
    /// Seed of the times.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// The program.
    #[arg(long, default_value = "target/release/stillpoint")]
    program: PathBuf,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let tried = arguments.program.canonicalize().map_err(|e| e.to_string());
    let tried = tried.and_then(|program| {
        let folder = tempfile::tempdir().map_err(|e| e.to_string())?;
        let mut faults = Faults::new(&program, folder.path(), arguments.seed)?;
        faults.run(arguments.commands, arguments.trials)
    });
    match tried {
        Ok(tried) => {
            println!(
                "{} signals, {} of them ended a run; {} limits on file sizes: no file half written, nothing left, every next run \
                 clean",
                tried.signals, tried.ended, tried.limited
            );
            ExitCode::SUCCESS
        }
        Err(what) => {
            eprintln!("{what}");
            ExitCode::FAILURE
        }
    }
}
