//! Solves bundle adjustments and pose graphs by the graph of the solver, and makes them up.
//!
//! ```text
//! cargo run --release -p stillpoint-benches --bin graph-table                    a table of small ones
//! … --bin graph-table -- make FOLDER [small]                                    files to compare on
//! … --bin graph-table -- bal FILE auto|analytic fixed|free                      one line
//! … --bin graph-table -- bal FILE auto fixed|free turned                         one line, cameras step by turns
//! … --bin graph-table -- g2o FILE [apart|logarithm|quaternion] [file|chordal] [repair|moved]   one line, of the error and start named
//! … --bin graph-table -- start FILE OUT [file|chordal] [repair|moved]           writes the start, for others to begin at
//! … --bin graph-table -- cost FILE [apart|logarithm|quaternion]                 ½ eᵀΩe of the file's poses
//! … --bin graph-table -- shared NUMBERS BLOCKS                                  one line
//! ```
//! A line: cost at the start and the end (½ ‖r‖²), steps, seconds of the processor from the problem in
//! memory to the solution (setting up included), largest memory in MB. `benches/peers/graphs.py` runs it beside
//! other solvers.

use std::error::Error;
use std::path::Path;
use std::time::Duration;

use rustix::time::{ClockId, clock_gettime};
use solver::bundle_adjustment::Bundle;
use solver::pose_graph::{EdgeError, Indefinite, PoseGraph};
use solver::{Euclidean, Factor, Graph, GraphOptions, GraphReport, RotationVector, solve_graph};
use stillpoint_benches::graphs::cameras::ring;
use stillpoint_benches::graphs::groups::{OWN, SPARE, groups, rows};
use stillpoint_benches::graphs::walks::{Loops, planar, spatial};

type Outcome<T> = Result<T, Box<dyn Error>>;

fn main() -> Outcome<()> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    match words[..] {
        [] => table(),
        ["make", folder] => make(Path::new(folder), false),
        ["make", folder, "small"] => make(Path::new(folder), true),
        ["bal", file, jacobian, gauge] => {
            let bundle = Bundle::read(&std::fs::read_to_string(file)?)?;
            let (analytic, fixed) = (jacobian == "analytic", gauge == "fixed");
            line(|| Ok(bundle.graph(analytic, fixed)?), &options())
        }
        ["bal", file, "auto", gauge, "turned"] => {
            let bundle = Bundle::read(&std::fs::read_to_string(file)?)?;
            let camera = (RotationVector, Euclidean(6));
            let build = || Ok(bundle.graph_on(camera, false, gauge == "fixed")?);
            line(build, &options())
        }
        ["g2o", file, ref words @ ..] => pose_graph(file, words),
        ["start", file, out, ref words @ ..] => start(file, out, words),
        ["cost", file, ref words @ ..] => cost(file, words),
        ["shared", numbers, blocks] => shared(numbers.parse()?, blocks.parse()?),
        _ => Err("see the first lines of graph-table.rs".into()),
    }
}

/// How a pose graph is read, where it starts and what is its error.
struct Asked<'a> {
    error: EdgeError,
    start: &'a str,
    indefinite: Indefinite,
}

impl<'a> Asked<'a> {
    fn new(words: &[&'a str]) -> Outcome<Self> {
        let mut asked = Self {
            error: EdgeError::Apart,
            start: "better",
            indefinite: Indefinite::Refused,
        };
        for word in words {
            match *word {
                "apart" => asked.error = EdgeError::Apart,
                "logarithm" => asked.error = EdgeError::Logarithm,
                "quaternion" => asked.error = EdgeError::Quaternion,
                "repair" => asked.indefinite = Indefinite::WithoutWrongTerms,
                "moved" => asked.indefinite = Indefinite::PlanarTermsMoved,
                "file" | "chordal" => asked.start = word,
                _ => return Err(format!("{word}: see the first lines of graph-table.rs").into()),
            }
        }
        Ok(asked)
    }

    fn read(&self, file: &str) -> Outcome<PoseGraph> {
        let text = std::fs::read_to_string(file)?;
        Ok(PoseGraph::read(&text, self.indefinite)?)
    }

    fn started(&self, poses: &PoseGraph) -> Outcome<PoseGraph> {
        Ok(match self.start {
            "file" => poses.clone(),
            "chordal" => poses.chordal_start()?,
            _ => poses.clone().better_start()?,
        })
    }
}

/// A pose graph: the time includes that of its start.
fn pose_graph(file: &str, words: &[&str]) -> Outcome<()> {
    let asked = Asked::new(words)?;
    let poses = asked.read(file)?;
    let build = || Ok(asked.started(&poses)?.graph(asked.error)?);
    line(build, &options())
}

/// Writes a pose graph with its start, and prints the seconds that the start took.
fn start(file: &str, out: &str, words: &[&str]) -> Outcome<()> {
    let asked = Asked::new(words)?;
    let poses = asked.read(file)?;
    let clock = Clock::start();
    let started = asked.started(&poses)?;
    println!("{:.6}", clock.seconds());
    Ok(std::fs::write(out, started.write())?)
}

/// Prints the cost of a file's poses.
fn cost(file: &str, words: &[&str]) -> Outcome<()> {
    let asked = Asked::new(words)?;
    let graph = asked.read(file)?.graph(asked.error)?;
    println!("{:.12e}", graph.cost(graph.values()));
    Ok(())
}

/// Time of this thread on a processor, which leaves out what else the machine does.
struct Clock(Duration);

impl Clock {
    fn start() -> Self {
        Self(processor_time())
    }

    fn seconds(&self) -> f64 {
        processor_time().saturating_sub(self.0).as_secs_f64()
    }
}

fn processor_time() -> Duration {
    let now = clock_gettime(ClockId::ThreadCPUTime);
    Duration::try_from(now).unwrap_or_default()
}

/// As the peers end: with the step that the linearised problem says to lower the cost by 1e-10 of
/// itself or less, and without a look at the rank.
fn options() -> GraphOptions {
    GraphOptions {
        gradient_tolerance: 1e-5,
        last_digits: false,
        rank: false,
        ..GraphOptions::default()
    }
}

fn line(build: impl Fn() -> Outcome<Graph<'static>>, options: &GraphOptions) -> Outcome<()> {
    let clock = Clock::start();
    let graph = build()?;
    let report = solve_graph(&graph, options)?;
    print(&graph, &report, clock.seconds());
    Ok(())
}

fn print(graph: &Graph<'_>, report: &GraphReport, seconds: f64) {
    let start: f64 = graph.residuals(graph.values()).iter().map(|r| r * r).sum();
    println!(
        "ours {:.12e} {:.12e} {} {seconds:.6} {:.1} {}",
        0.5 * start,
        report.cost,
        report.iterations.len(),
        largest_memory(),
        report.termination,
    );
}

/// Largest memory of this process in MB, where the system tells.
fn largest_memory() -> f64 {
    let text = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = text.lines().find_map(|l| l.strip_prefix("VmHWM:"));
    let kilobytes = line.and_then(|l| l.trim().strip_suffix(" kB")?.parse::<f64>().ok());
    kilobytes.map_or(f64::NAN, |kb| kb / 1024.0)
}

fn make(folder: &Path, small: bool) -> Outcome<()> {
    std::fs::create_dir_all(folder)?;
    let cameras: &[(usize, usize)] = if small {
        &[(20, 300)]
    } else {
        &[(20, 1_500), (50, 5_000), (100, 10_000), (300, 20_000)]
    };
    for &(count, points) in cameras {
        let text = ring(count, points, 20, 7).write();
        std::fs::write(folder.join(format!("ring-{count}.bal")), text)?;
    }
    let poses: &[usize] = if small { &[300] } else { &[300, 3_000, 30_000] };
    for &count in poses {
        for (name, loops) in [("", Loops::Anywhere), ("laps-", Loops::Laps)] {
            let plane = folder.join(format!("{name}plane-{count}.g2o"));
            std::fs::write(plane, planar(count, 7, loops).write())?;
            let space = folder.join(format!("{name}space-{count}.g2o"));
            std::fs::write(space, spatial(count, 7, loops).write())?;
        }
    }
    Ok(())
}

fn table() -> Outcome<()> {
    println!("problem                  start        end    steps  seconds");
    let show = |name: &str, graph: Graph<'static>| -> Outcome<()> {
        let clock = Clock::start();
        let report = solve_graph(&graph, &options())?;
        let seconds = clock.seconds();
        let start: f64 = graph.residuals(graph.values()).iter().map(|r| r * r).sum();
        println!(
            "{name:18} {:10.4e} {:10.4e} {:8} {seconds:8.3}  {}",
            0.5 * start,
            report.cost,
            report.iterations.len(),
            report.termination
        );
        Ok(())
    };
    for (count, points) in [(20, 1_500), (50, 5_000)] {
        let bundle = ring(count, points, 20, 7);
        show(
            &format!("{count} cameras, duals"),
            bundle.graph(false, false)?,
        )?;
        show(&format!("{count} cameras, own"), bundle.graph(true, true)?)?;
    }
    for count in [300, 3_000] {
        show(
            &format!("plane {count}"),
            planar(count, 7, Loops::Anywhere).graph(EdgeError::Apart)?,
        )?;
        show(
            &format!("space {count}"),
            spatial(count, 7, Loops::Anywhere).graph(EdgeError::Apart)?,
        )?;
    }
    for count in [2, 8, 32, 128] {
        shared(count, 2_000)?;
    }
    Ok(())
}

/// Time per Jacobian of a problem with shared numbers, and of that what the evaluation of the rows takes, beside the
/// multiplications that a triangular factorisation of its rows takes by the elimination of the blocks: `rows · s²` each.
fn shared(numbers: usize, blocks: usize) -> Outcome<()> {
    let graph = groups(numbers, blocks, 7)?;
    let mut best = f64::INFINITY;
    let mut jacobians = 0;
    for _ in 0..5 {
        let clock = Clock::start();
        let report = solve_graph(&graph, &options())?;
        jacobians = report.evaluations.jacobians;
        best = best.min(clock.seconds() / jacobians as f64);
    }
    let rows = evaluation_seconds(numbers, blocks);
    let dense = dense_seconds(numbers, blocks);
    let micros = |seconds: f64| 1e6 * seconds / blocks as f64;
    println!(
        "shared {numbers:4} blocks {blocks:6}: {:8.3} µs a block and Jacobian ({jacobians} of them; {:.3} to evaluate the \
         rows), dense QR of the rows {:8.3} µs, ratio {:.2} ({:.2} without evaluations)",
        micros(best),
        micros(rows),
        micros(dense),
        best / dense,
        (best - rows) / dense
    );
    Ok(())
}

/// Seconds of one evaluation of all rows and their Jacobian, without anything done with them.
fn evaluation_seconds(numbers: usize, blocks: usize) -> f64 {
    let factors = rows(numbers, blocks, 7);
    let x = vec![0.1; numbers + OWN];
    let (mut residuals, mut jacobian) = (Vec::new(), Vec::new());
    let mut best = f64::INFINITY;
    for _ in 0..5 {
        let clock = Clock::start();
        for factor in &factors {
            factor.linearize(&x, &mut residuals, &mut jacobian);
            std::hint::black_box(&jacobian);
        }
        best = best.min(clock.seconds());
    }
    best
}

/// Seconds of a dense QR factorisation of the rows that the blocks leave to the shared numbers.
fn dense_seconds(numbers: usize, blocks: usize) -> f64 {
    let rows = blocks * (OWN + SPARE);
    let mut state = 1u64;
    let a = faer::Mat::from_fn(rows, numbers + OWN, |_, _| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 11) as f64 / (1u64 << 53) as f64 - 0.5
    });
    let mut best = f64::INFINITY;
    for _ in 0..3 {
        let clock = Clock::start();
        std::hint::black_box(a.qr());
        best = best.min(clock.seconds());
    }
    best
}
