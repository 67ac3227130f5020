//! Predicted and found standard errors of a planned session, and those of placements in random order.
//!
//! ```text
//! cargo run --release -p stillpoint-tests --bin plan-study -- --sessions 300
//! cargo run --release -p stillpoint-tests --bin plan-study -- --after 5,6,8,10
//! cargo run --release -p stillpoint-tests --bin plan-study -- --ties --sessions 3
//! ```
//!
//! With `--after` it cuts the phone's recording after so many placements, follows what the plan asks for next in simulation,
//! and holds the number against the fewest of an exhaustive search.
//!
//! With `--ties` it takes sessions of the power study in which two effects are tied, plans the recording that tells them apart
//! from the findings, makes it in simulation and looks into both recordings: the hidden effect has to be named, 20 to 1 against
//! the other.

use std::process::ExitCode;

use clap::Parser;
use stillpoint_tests::phone;
use stillpoint_tests::plan_next::follow;
use stillpoint_tests::plan_study::{Row, study};
use stillpoint_tests::tie_study::TIES;

/// Gravity where the phone was, m/s².
const GRAVITY: f64 = 9.7951;

/// A planned session simulated many times over, against its prediction
#[derive(Debug, Parser)]
struct Args {
    /// Sessions of either kind
    #[arg(long, default_value_t = 300)]
    sessions: u64,
    /// Seed of the first session; the cut in the prediction was chosen on seeds 0 to 299
    #[arg(long, default_value_t = 1000)]
    seed: u64,
    /// Placements
    #[arg(long, default_value_t = 12)]
    placements: usize,
    /// Placements of the phone's recording after which the plan is asked
    #[arg(long, value_delimiter = ',', value_name = "N,..", conflicts_with_all = ["sessions", "placements", "seed"])]
    after: Vec<usize>,
    /// Follow the plan for tied effects: so many sessions of each of the ten ties
    #[arg(long, conflicts_with_all = ["after", "placements", "seed"])]
    ties: bool,
    /// Of these ties alone, by their place from 1 on
    #[arg(long, value_delimiter = ',', value_name = "N,..", requires = "ties")]
    only: Vec<usize>,
    /// Number of the first session of the power study that is looked into
    #[arg(long, default_value_t = 0, requires = "ties")]
    first: u64,
}

fn main() -> ExitCode {
    let args = Args::parse();
    if !args.after.is_empty() {
        return after(&args.after);
    }
    if args.ties {
        return ties(args.sessions as usize, args.first, &args.only);
    }
    match study(
        args.placements,
        args.seed..args.seed.saturating_add(args.sessions),
    ) {
        Ok(found) => {
            println!(
                "{:16} {:>10} {:>10} {:>7} {:>10} {:>7} {:>5}",
                "parameter", "predicted", "found", "ratio", "random", "share", "n"
            );
            for row in &found.rows {
                print(row);
            }
            println!(
                "cut off either end of a rest: {:.2} s counted on, {:.2} s found",
                found.cut_predicted, found.cut_found
            );
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

/// Fails where a parameter stays open or two placements more than the fewest are asked for.
fn after(counts: &[usize]) -> ExitCode {
    if phone::folder().is_none() {
        return ExitCode::SUCCESS;
    }
    println!(
        "{:>5} {:>7} {:>6} {:>11} {:>12} {:>12}",
        "after", "advised", "fewest", "unobserved", "accel. ppm", "gyro. ppm"
    );
    let mut code = ExitCode::SUCCESS;
    for count in counts {
        let recording = phone::recording("multi_position/rec_1");
        match recording.and_then(|recording| follow(&recording, *count, GRAVITY)) {
            Ok(found) => {
                let [force, rate] = found.largest.map(|e| 1e6 * e);
                println!(
                    "{:>5} {:>7} {:>6} {:>11} {force:>12.0} {rate:>12.0}",
                    found.after,
                    found.advised,
                    found.fewest,
                    found.unobservable.len()
                );
                if !found.is_as_asked() {
                    code = ExitCode::FAILURE;
                }
            }
            Err(error) => {
                eprintln!("after {count}: {error}");
                code = ExitCode::FAILURE;
            }
        }
    }
    code
}

/// Sessions looked into for one that has the tie.
const LOOKED_INTO: u64 = 10;

/// Fails where more than one tie stays in most of its sessions.
fn ties(sessions: usize, first: u64, only: &[usize]) -> ExitCode {
    println!(
        "{:27} {:27} {:>7} {:>7} {:>7} {:>4} {:>4} apart",
        "hidden", "tied to", "session", "before", "after", "n", "min"
    );
    let (mut settled, mut looked_at) = (0, 0);
    let chosen = TIES.iter().enumerate();
    for (_, tie) in chosen.filter(|(k, _)| only.is_empty() || only.contains(&(k + 1))) {
        looked_at += 1;
        let outcomes = match tie.outcomes(first, sessions, LOOKED_INTO * sessions as u64) {
            Ok(outcomes) => outcomes,
            Err(error) => {
                eprintln!("{error}");
                return ExitCode::FAILURE;
            }
        };
        let right = outcomes.iter().filter(|o| o.is_separated(tie)).count();
        settled += usize::from(2 * right > outcomes.len());
        for o in outcomes {
            println!(
                "{:27} {:27} {:7} {:7.1} {:7.1} {:4} {:4.0} {:5.0} {:?} {}",
                tie.hidden,
                tie.other,
                o.index,
                o.before,
                o.after,
                o.placements,
                o.minutes,
                o.planning,
                o.against,
                if o.is_separated(tie) {
                    "yes".into()
                } else {
                    format!("NO {:?} {:?} {:?}", o.found, o.refused, o.shown_by)
                }
            );
        }
    }
    println!("{settled} of {looked_at} ties are told apart");
    if settled + 1 < looked_at {
        return ExitCode::FAILURE;
    }
    ExitCode::SUCCESS
}

fn print(row: &Row) {
    println!(
        "{:16} {:10.3e} {:10.3e} {:7.3} {:10.3e} {:7.3} {:>5}",
        row.name,
        row.predicted,
        row.found,
        row.found / row.predicted,
        row.random,
        row.found / row.random,
        row.sessions
    );
}
