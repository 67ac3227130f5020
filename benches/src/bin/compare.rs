//! Compares variants of the solver on one's own curves or on published problems.
//!
//! ```text
//! cargo run --release -p stillpoint-benches --bin compare -- FILE.dat …            NIST's format
//! cargo run --release -p stillpoint-benches --bin compare -- FILE.csv --model 'y = b1*exp(-b2*x)' \
//!     --start b1=1,b2=0.1 --start b1=10,b2=1 --picture profile.svg
//! cargo run --release -p stillpoint-benches --bin compare -- FILE.bal FILE.g2o     graphs, by their damping
//! cargo run --release -p stillpoint-benches --bin compare -- --published --summary
//! ```
//! `r` counts residuals evaluated alone, `J` Jacobians, `r″` second derivatives along one direction.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Parser, ValueEnum};
use solver::bundle_adjustment::Bundle;
use solver::pose_graph::{EdgeError, Indefinite, PoseGraph};
use solver::{Comparison, Measure, Options, Table, Variant};
use solver::{Graph, compare_graphs, compare_with, graph_variants};
use stillpoint_benches::curve_file::Curve;
use stillpoint_tests::problems;
use stillpoint_tests::problems::nist::{Model, Regression};

/// Variants of the solver side by side: successes, evaluations, time, cost, digits, reason.
#[derive(Parser)]
struct Arguments {
    /// NIST's .dat files, .bal and .g2o graphs, or tables of numbers with --model.
    files: Vec<PathBuf>,
    /// The model of a table, as 'y = b1*exp(-b2*x)'; names that are no columns are parameters.
    #[arg(long)]
    model: Option<String>,
    /// A start, as b1=1,b2=0.1; may be given several times.
    #[arg(long)]
    start: Vec<String>,
    /// Compare on the unconstrained problems of the published collections.
    #[arg(long)]
    published: bool,
    /// Names of variants, separated by commas; all of them if none are given.
    #[arg(long, value_delimiter = ',')]
    variants: Vec<String>,
    /// How to print.
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
    /// Print one line per variant only.
    #[arg(long)]
    summary: bool,
    /// Write the performance profile (Dolan and Moré) to this file, as SVG.
    #[arg(long)]
    picture: Option<PathBuf>,
    /// What the performance profile counts.
    #[arg(long, value_enum, default_value_t = Counted::Evaluations)]
    measure: Counted,
}

#[derive(Clone, Copy, ValueEnum)]
enum Format {
    Table,
    Csv,
    Json,
}

#[derive(Clone, Copy, ValueEnum)]
enum Counted {
    Evaluations,
    Jacobians,
    Seconds,
}

type Failure = Box<dyn std::error::Error>;

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(2)
        }
    }
}

fn run(arguments: &Arguments) -> Result<(), Failure> {
    let variants = variants(&arguments.variants)?;
    let mut table = Table::default();
    for file in &arguments.files {
        let kind = file.extension().and_then(|e| e.to_str());
        table.append(match (&arguments.model, kind) {
            (Some(model), _) => curve(file, model, &arguments.start, &variants)?,
            (None, Some("bal" | "g2o")) => graph(file)?,
            (None, _) => regression(file, &variants)?,
        });
    }
    if arguments.published {
        table.append(published(&variants));
    }
    if table.runs.is_empty() {
        return Err("nothing to compare: give files, or --published (see --help)".into());
    }
    let measure = match arguments.measure {
        Counted::Evaluations => Measure::Evaluations,
        Counted::Jacobians => Measure::Jacobians,
        Counted::Seconds => Measure::Seconds,
    };
    if let Some(path) = &arguments.picture {
        std::fs::write(path, table.performance_svg(measure))?;
    }
    match arguments.format {
        Format::Table if arguments.summary => print!("{}", table.summary()),
        Format::Table => print!("{table}"),
        Format::Csv => print!("{}", table.to_csv()),
        Format::Json => println!("{}", serde_json::to_string_pretty(&table)?),
    }
    Ok(())
}

/// The variants asked for.
fn variants(names: &[String]) -> Result<Vec<Variant>, Failure> {
    let all = Variant::all();
    if names.is_empty() {
        return Ok(all);
    }
    let find = |name: &String| {
        let known = || all.iter().map(|v| v.name()).collect::<Vec<_>>().join(", ");
        let found = all.iter().copied().find(|v| v.name() == *name);
        found.ok_or_else(|| format!("no variant is called {name}; there are {}", known()).into())
    };
    names.iter().map(find).collect()
}

/// A table of numbers with a model.
fn curve(
    file: &Path,
    model: &str,
    starts: &[String],
    variants: &[Variant],
) -> Result<Table, Failure> {
    let curve = Curve::read(file, model)?;
    if starts.is_empty() {
        return Err(format!(
            "a start is needed: --start {}",
            curve
                .parameters
                .iter()
                .map(|p| format!("{p}=…"))
                .collect::<Vec<_>>()
                .join(",")
        )
        .into());
    }
    let starts = starts
        .iter()
        .map(|start| curve.start(start))
        .collect::<Result<Vec<_>, _>>()?;
    let comparison = Comparison {
        name: stem(file),
        ..Comparison::default()
    };
    Ok(compare_with(&comparison, &curve, &starts, variants))
}

/// A bundle adjustment or a pose graph, by the ways in which the damping of graphs moves.
fn graph(file: &Path) -> Result<Table, Failure> {
    let text = std::fs::read_to_string(file)?;
    let graph = match file.extension().and_then(|e| e.to_str()) {
        Some("bal") => bundle(&text).map_err(|error| error.to_string()),
        _ => poses(&text).map_err(|error| error.to_string()),
    };
    let graph = graph.map_err(|error| format!("{}: {error}", file.display()))?;
    Ok(compare_graphs(&stem(file), &graph, &graph_variants()))
}

/// A bundle adjustment, its gauge fixed.
fn bundle(text: &str) -> Result<Graph<'static>, Failure> {
    Ok(Bundle::read(text)?.graph(false, true)?)
}

/// A pose graph from the start that explains its edges better, that of the file or the chordal one.
fn poses(text: &str) -> Result<Graph<'static>, Failure> {
    let poses = PoseGraph::read(text, Indefinite::Refused)?.better_start()?;
    Ok(poses.graph(EdgeError::Apart)?)
}

/// A file of NIST's.
fn regression(file: &Path, variants: &[Variant]) -> Result<Table, Failure> {
    let name = stem(file);
    let model = Model::ALL.iter().find(|(known, _)| *known == name);
    let Some((_, model)) = model else {
        return Err(format!(
            "{}: not one of NIST's {} problems; give --model and --start",
            file.display(),
            Model::ALL.len()
        )
        .into());
    };
    let folder = file.parent().unwrap_or(Path::new("."));
    let problem = Regression::read(folder, &name, *model)?;
    let comparison = Comparison {
        best: Some(0.5 * problem.data.sum_of_squares),
        solution: Some(problem.data.certified.clone()),
        name,
        ..Comparison::default()
    };
    let starts = [problem.start(1), problem.start(2)];
    Ok(compare_with(&comparison, &problem, &starts, variants))
}

/// The published problems without constraints, and the held-out ones.
fn published(variants: &[Variant]) -> Table {
    let mut table = Table::default();
    let mut cases = problems::unconstrained();
    cases.extend(problems::held_out::all());
    for case in &cases {
        let options = Options {
            constraints: case.constraints(),
            ..Options::default()
        };
        let mut start = case.parameters(1.0);
        if options
            .constraints
            .project(&mut start, &case.mask())
            .is_err()
        {
            continue;
        }
        let least = case.minima.iter().copied().fold(f64::INFINITY, f64::min);
        let comparison = Comparison {
            name: case.name.clone(),
            options,
            best: least.is_finite().then_some(0.5 * least),
            ..Comparison::default()
        };
        table.append(compare_with(
            &comparison,
            &*case.problem,
            &[start],
            variants,
        ));
    }
    table
}

fn stem(file: &Path) -> String {
    file.file_stem()
        .map_or_else(String::new, |stem| stem.to_string_lossy().into_owned())
}
