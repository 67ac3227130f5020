//! Power and false alarms of discovery on simulated sessions.
//!
//! ```text
//! cargo run --release -p stillpoint-tests --bin power-study -- --row clean --row outside --out power.jsonl
//! ```
//!
//! Row `conditions` hides nothing under the conditions of the coverage study. Sessions are numbered; one that is in
//! the file already is not made again. The result does not depend on
//! the number of threads.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::{File, OpenOptions};
use std::io::{BufRead, BufReader, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Mutex;

use calib::simulate::Simulation;
use clap::{Parser, ValueEnum};
use indicatif::{ProgressBar, ProgressStyle};
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use serde::{Deserialize, Serialize};
use stillpoint_tests::power::{Record, Row, Summary, run, spec_of, summarise};

/// Hidden effects, and whether they are found
#[derive(Debug, Parser)]
struct Args {
    /// Rows of the table; all without
    #[arg(long, value_enum)]
    row: Vec<Row>,
    /// Sessions per row; as many as the table asks for without
    #[arg(long)]
    sessions: Option<u64>,
    /// Number of the first session
    #[arg(long, default_value_t = 0)]
    first: u64,
    /// Where the records go, a line of JSON each
    #[arg(long, default_value = "power.jsonl")]
    out: PathBuf,
    /// Print the sessions that went wrong
    #[arg(long)]
    wrong: bool,
    /// Write the recordings of the sessions into folders `DIR/<row>-<number>` and look into none
    #[arg(long, value_name = "DIR")]
    save: Option<PathBuf>,
}

#[derive(Serialize, Deserialize)]
struct Line {
    row: Row,
    #[serde(flatten)]
    record: Record,
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
    let rows = if args.row.is_empty() {
        Row::value_variants().to_vec()
    } else {
        args.row.clone()
    };
    for row in rows {
        if let Some(dir) = &args.save {
            let count = args.sessions.unwrap_or(row.sessions());
            save(row, args.first..args.first + count, dir)?;
            continue;
        }
        let done: BTreeSet<u64> = read(&args.out)?
            .into_iter()
            .filter(|l| l.row == row)
            .map(|l| l.record.index)
            .collect();
        let count = args.sessions.unwrap_or(row.sessions());
        let wanted = args.first..args.first + count;
        let missing: Vec<u64> = wanted.clone().filter(|k| !done.contains(k)).collect();
        make(row, missing, &args.out)?;
        let lines: Vec<Line> = read(&args.out)?
            .into_iter()
            .filter(|l| l.row == row && wanted.contains(&l.record.index))
            .collect();
        print(row, &lines, args.wrong);
    }
    Ok(())
}

/// Recordings and truth, to be looked into with the program itself.
fn save(row: Row, sessions: Range<u64>, dir: &Path) -> Result<(), Box<dyn std::error::Error>> {
    for index in sessions {
        let folder = dir.join(format!("{}-{index}", name_of(row)));
        Simulation::new(&spec_of(row, index)?)?.write(&folder, false)?;
    }
    Ok(())
}

fn read(path: &Path) -> Result<Vec<Line>, Box<dyn std::error::Error>> {
    if !path.exists() {
        return Ok(Vec::new());
    }
    BufReader::new(File::open(path)?)
        .lines()
        .map(|line| Ok(serde_json::from_str(&line?)?))
        .collect()
}

fn make(row: Row, missing: Vec<u64>, out: &Path) -> Result<(), Box<dyn std::error::Error>> {
    let file = Mutex::new(OpenOptions::new().create(true).append(true).open(out)?);
    let style = ProgressStyle::with_template("{prefix} [{bar:30}] {pos}/{len} {elapsed}<{eta}")?;
    let bar = ProgressBar::new(missing.len() as u64).with_style(style);
    bar.set_prefix(name_of(row));
    let written: Result<(), String> = missing.into_par_iter().try_for_each(|index| {
        let record = run(row, index).map_err(|e| format!("session {index}: {e}"))?;
        let line = serde_json::to_string(&Line { row, record }).map_err(|e| e.to_string())?;
        let mut file = file.lock().map_err(|e| e.to_string())?;
        writeln!(file, "{line}").map_err(|e| e.to_string())?;
        bar.inc(1);
        Ok(())
    });
    bar.finish_and_clear();
    Ok(written?)
}

fn name_of(row: Row) -> String {
    row.to_possible_value()
        .map_or_else(String::new, |v| v.get_name().to_owned())
}

fn print(row: Row, lines: &[Line], wrong: bool) {
    let mut kinds: BTreeMap<&str, Vec<&Record>> = BTreeMap::new();
    for line in lines {
        kinds
            .entry(&line.record.kind)
            .or_default()
            .push(&line.record);
    }
    println!(
        "{:38} {:>5} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6}",
        name_of(row),
        "n",
        "exact",
        "ties",
        "wrong",
        "name",
        "unexpl",
        "descr",
        "alone",
        "fault",
        "formul",
        "claim",
        "cover",
        "gap10%",
        "s"
    );
    for (kind, records) in &kinds {
        print_line(kind, &summarise(records.iter().copied()));
    }
    print_line("all", &summarise(lines.iter().map(|l| &l.record)));
    if wrong {
        for line in lines
            .iter()
            .filter(|l| !l.record.is_exact() || l.record.unexplained.is_some())
        {
            let r = &line.record;
            println!(
                "  {} {}: named {:?} ties {:?} faults {:?} unexplained {:?} proposed {:?} {}",
                r.index,
                r.kind,
                r.named,
                r.ties,
                r.integrity,
                r.unexplained,
                r.proposed,
                r.refused.as_deref().unwrap_or("")
            );
        }
    }
}

fn print_line(name: &str, s: &Summary) {
    let percent = |v: f64| format!("{:.1}", 100.0 * v);
    println!(
        "  {:36} {:>5} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6.2}{}",
        name,
        s.sessions,
        percent(s.exact),
        percent(s.with_ties),
        percent(s.wrong),
        percent(s.any_name),
        percent(s.unexplained),
        percent(s.described),
        percent(s.name_alone),
        percent(s.integrity),
        percent(s.formula),
        percent(s.any_claim),
        percent(s.coverage),
        percent(s.gap_within_tenth),
        s.seconds,
        if s.refused > 0 {
            format!("  {} refused", s.refused)
        } else {
            String::new()
        }
    );
}
