//! `cargo run --release -p stillpoint-tests --features vary --bin tuning-study -- --page FILE`: how much depends on each tuning constant.
//!
//! A constant is varied in a process of its own, for in a process it has one value. All of them take half an hour on two cores; what is
//! measured is on the page as it comes.

use std::collections::HashMap;
use std::io::{Seek, SeekFrom};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Mutex;
use std::time::{Duration, Instant};

use clap::Parser;
use findings::tuning::{reached, vary};
use indicatif::ProgressBar;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use stillpoint_tests::tuning::{
    Constant, Job, Outcome, constants, measured_on, moved, outcomes, page, simulate, words,
};

/// A run that takes longer has no end.
const PATIENCE: Duration = Duration::from_secs(180);

/// Half and twice the value.
const FACTORS: [f64; 2] = [0.5, 2.0];

#[derive(Parser)]
struct Args {
    /// The page that is written.
    #[arg(long, required_unless_present = "vary")]
    page: Option<PathBuf>,

    /// Varies the constants whose path contains this; without, those of which the page says nothing yet.
    #[arg(long)]
    only: Option<String>,

    /// Runs the sessions once, with one constant times a factor, and prints what they gave.
    #[arg(long, hide = true, num_args = 3, value_names = ["PATH", "FACTOR", "JOBS"])]
    vary: Option<Vec<String>>,
}

/// What a run gave.
#[derive(Serialize, Deserialize)]
struct Run {
    outcomes: Vec<Outcome>,
    reached: Vec<String>,
}

type Failure = Box<dyn std::error::Error + Send + Sync>;

fn main() -> Result<(), Failure> {
    let args = Args::parse();
    if let Some([path, factor, jobs]) = args.vary.as_deref() {
        vary(path, factor.parse()?);
        return print_run(Path::new(jobs));
    }
    let page = Page::open(args.page.unwrap_or_default())?;
    let folder = tempfile::tempdir()?;
    let jobs = folder.path().join("jobs.json");
    std::fs::write(&jobs, serde_json::to_vec(&simulate(folder.path())?)?)?;
    let usual = run("", 1.0, &jobs)?;
    let is_asked = |path: &&String| args.only.as_ref().is_none_or(|part| path.contains(part));
    let is_open = |path: &&String| args.only.is_some() || !page.has(path);
    let varied = usual.reached.iter().filter(is_asked).filter(is_open);
    let varied: Vec<&String> = varied.collect();
    let bar = ProgressBar::new(varied.len() as u64);
    varied.into_par_iter().try_for_each(|path| {
        let both = FACTORS.map(|factor| match run(path, factor, &jobs) {
            Ok(run) => words(moved(&usual.outcomes, &run.outcomes)),
            Err(_) => "fails".to_owned(),
        });
        bar.inc(1);
        page.add(path, both)
    })
}

/// The page with what is measured so far.
struct Page {
    file: PathBuf,
    constants: Vec<Constant>,
    measured: Mutex<HashMap<String, [String; 2]>>,
}

impl Page {
    /// Begins with what is on the page.
    fn open(file: PathBuf) -> Result<Self, Failure> {
        let constants = constants(&Path::new(env!("CARGO_MANIFEST_DIR")).join(".."))?;
        let old = std::fs::read_to_string(&file).unwrap_or_default();
        Ok(Self {
            measured: Mutex::new(measured_on(&old, &constants)),
            file,
            constants,
        })
    }

    /// True where it has been measured.
    fn has(&self, path: &str) -> bool {
        let measured = self.measured.lock();
        measured.is_ok_and(|all| all.contains_key(path))
    }

    /// Writes the page with one more.
    fn add(&self, path: &str, moved: [String; 2]) -> Result<(), Failure> {
        let mut measured = self.measured.lock().map_err(|_| "another thread failed")?;
        measured.insert(path.to_owned(), moved);
        let text = page(&self.constants, &measured);
        Ok(std::fs::write(&self.file, text)?)
    }
}

/// Runs the sessions in this process and prints what they gave.
fn print_run(jobs: &Path) -> Result<(), Failure> {
    let jobs: Vec<Job> = serde_json::from_slice(&std::fs::read(jobs)?)?;
    let outcomes = outcomes(&jobs);
    let reached = reached().into_iter().map(|(path, _)| path.into()).collect();
    println!("{}", serde_json::to_string(&Run { outcomes, reached })?);
    Ok(())
}

/// Runs the sessions in a process of their own, on one core.
fn run(path: &str, factor: f64, jobs: &Path) -> Result<Run, Failure> {
    let mut said = tempfile::tempfile()?;
    let mut child = Command::new(std::env::current_exe()?)
        .args(["--vary", path, &factor.to_string()])
        .arg(jobs)
        .env("RAYON_NUM_THREADS", "1")
        .stdout(said.try_clone()?)
        .stderr(Stdio::null())
        .spawn()?;
    let start = Instant::now();
    let status = loop {
        match child.try_wait()? {
            Some(status) => break status,
            None if start.elapsed() > PATIENCE => {
                child.kill()?;
                break child.wait()?;
            }
            None => std::thread::sleep(Duration::from_millis(50)),
        }
    };
    if !status.success() {
        return Err(format!("{path} times {factor}: {status}").into());
    }
    said.seek(SeekFrom::Start(0))?;
    Ok(serde_json::from_reader(said)?)
}
