//! `batch merge`: parts to one result.

use std::path::PathBuf;

use batch::{merge, part_files, to_csv};

use super::failure::failure;
use super::{page, tables};
use crate::commands::shared::inputs::as_paths;
use crate::exit::Failure;
use crate::output::{Output, Replace};
use crate::show;

/// Joins the parts of a batch: refuses with a list where one is missing, half-written or of another run.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example:
  stillpoint batch merge out -o all --jsonl --csv --report   all.jsonl, all.csv, all.html")]
pub struct Args {
    /// Output folders of `batch`, or part files
    #[arg(value_name = "PARTS", required = true)]
    parts: Vec<PathBuf>,
    /// Write results under this name, with .jsonl, .csv and .html added
    #[arg(short, value_name = "OUT")]
    output: PathBuf,
    /// Write JSON lines, a device each [default, where nothing else is asked for]
    #[arg(long)]
    jsonl: bool,
    /// Write a table, a row per device
    #[arg(long)]
    csv: bool,
    /// Write a report: yield, reasons, distributions, control charts, outliers, drift
    #[arg(long)]
    report: bool,
    #[command(flatten)]
    replace: Replace,
    /// Print yield and reasons as JSON instead of a table
    #[arg(long)]
    json: bool,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<(), Failure> {
    let parts = part_files(&args.parts).map_err(failure)?;
    let claim = |wanted: bool, ending: &str| {
        let mut name = args.output.clone().into_os_string();
        if args.output.extension().is_none_or(|e| e != ending) {
            name.push(format!(".{ending}"));
        }
        wanted
            .then(|| Output::claim(name.as_ref(), args.replace, &as_paths(&parts)))
            .transpose()
    };
    let jsonl = claim(args.jsonl || !(args.csv || args.report), "jsonl")?;
    let csv = claim(args.csv, "csv")?;
    let report = claim(args.report, "html")?;
    args.replace.end_if_all_exist()?;
    let merged = merge(&args.parts).map_err(failure)?;
    let records = &merged.records;
    if let Some(output) = jsonl {
        let lines = records
            .iter()
            .map(|r| serde_json::to_string(r).unwrap_or_default() + "\n");
        output.write(lines.collect::<String>().as_bytes())?;
    }
    if let Some(output) = csv {
        output.write(to_csv(records).as_bytes())?;
    }
    if let Some(output) = report {
        output.write(page::page(records)?.html()?.as_bytes())?;
    }
    show::print(&match args.json {
        true => show::json(&tables::document(records))?,
        false => tables::of_all(records),
    })
}
