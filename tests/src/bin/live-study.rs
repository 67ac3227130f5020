//! Guided sessions with simulated people: how many placements until there is a calibration.
//!
//! ```text
//! cargo run -p stillpoint-tests --bin live-study -- --sessions 200
//! ```
//! People hold the phone in the hand, choose wrong faces, turn too fast, give up early; the phone pauses and is out of
//! reach. The status is 1 unless every session ends with a calibration of both sensors in at most 1.2 times the planned
//! placements.

use std::process::ExitCode;

use clap::Parser;
use rayon::prelude::*;
use stillpoint_tests::live::{KINDS, Sitting, kind, sit};

#[derive(Debug, Parser)]
struct Args {
    /// Sessions
    #[arg(long, default_value_t = 200)]
    sessions: u64,
    /// The first seed
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Placements planned
    #[arg(long, default_value_t = 12)]
    placements: usize,
    /// A line for every session
    #[arg(long)]
    each: bool,
}

fn main() -> ExitCode {
    let args = Args::parse();
    let seeds = args.seed..args.seed + args.sessions;
    let sittings: Vec<(u64, Result<Sitting, String>)> = seeds
        .into_par_iter()
        .map(|seed| (seed, sit(seed, args.placements).map_err(|e| e.to_string())))
        .collect();
    for (seed, sitting) in &sittings {
        match sitting {
            Err(error) => println!("seed {seed}: {error}"),
            Ok(s) if args.each || !s.is_good() => {
                let reason = s.calibration.as_ref().err().map_or("", |e| e.as_str());
                println!(
                    "seed {seed} ({}): {} made, {} counted of {} in {:.0} s; pauses, drops, hands, speed {:?} {reason}",
                    KINDS[kind(*seed)],
                    s.made,
                    s.counted,
                    s.planned,
                    s.seconds,
                    s.incidents
                );
            }
            Ok(_) => {}
        }
    }
    let held: Vec<&Sitting> = sittings
        .iter()
        .filter_map(|(_, s)| s.as_ref().ok())
        .collect();
    let good = held.iter().filter(|s| s.is_good()).count();
    let most = held.iter().map(|s| s.made).max().unwrap_or(0);
    let normalised: Vec<f64> = held
        .iter()
        .flat_map(|s| s.normalised.iter().copied())
        .collect();
    let within = normalised.iter().filter(|z| z.abs() < 1.96).count();
    let exported = held.iter().filter(|s| s.fallback.is_none()).count();
    let sum = |k: usize| held.iter().map(|s| s.incidents[k]).sum::<usize>();
    println!(
        "{good} of {} sessions end with a calibration in at most 1.2 times {} placements; the most were {most}",
        args.sessions, args.placements
    );
    for (k, name) in KINDS.iter().enumerate() {
        let of = sittings.iter().filter(|(seed, _)| kind(*seed) == k);
        let all: Vec<_> = of.filter_map(|(_, s)| s.as_ref().ok()).collect();
        let good = all.iter().filter(|s| s.is_good()).count();
        let most = all.iter().map(|s| s.made).max().unwrap_or(0);
        println!("  {name}: {good} of {}; the most were {most}", all.len());
    }
    println!(
        "pauses {}, lost connections {}, in the hand {}, too fast {}",
        sum(0),
        sum(1),
        sum(2),
        sum(3)
    );
    println!(
        "{exported} by the phone's own file; {:.1} % of {} parameters within 1.96 standard errors",
        100.0 * within as f64 / normalised.len().max(1) as f64,
        normalised.len()
    );
    if good as u64 == args.sessions {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    }
}
