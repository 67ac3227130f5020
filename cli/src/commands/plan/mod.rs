//! `plan`: which placements and turns to record, and what each buys.

mod known;
mod sheet;
mod tables;

use std::path::{Path, PathBuf};

use clap::ValueEnum;
use plan::{Noise, Pace, Plan, Protocol, REQUIREMENT, Timing, Words};
use serde_json::json;

use super::inputs::DetectorArgs;
use crate::exit::{Failure, USAGE};
use crate::output::{Output, Replace};
use crate::read_args::ReadArgs;
use crate::show;
use known::Input;

/// Placements of a plan from nothing, and most that can be asked for.
const PLACEMENTS: std::ops::RangeInclusive<usize> = 6..=60;

/// Says which placements and turns to record: in words, in pictures, with the standard errors that they buy.
///
/// Without an input it plans a whole session. With a recording, a calibration or findings it plans what to record next.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example:
  stillpoint plan --placements 12 --report plan.html
  stillpoint plan phone.csv                what is still missing
  stillpoint plan cal.json --next 4        what four more placements buy")]
pub struct Args {
    /// Recording, calibration or findings to go on from
    #[arg(value_name = "CAL|RECORDING|FINDINGS")]
    input: Option<PathBuf>,
    /// Placements of the session
    #[arg(long, value_name = "N", conflicts_with_all = ["next", "input"])]
    placements: Option<usize>,
    /// Placements to add to the input [default: as many as are missing, at least 3]
    #[arg(long, value_name = "K", requires = "input")]
    next: Option<usize>,
    /// Placements by name
    #[arg(long, value_enum, default_value_t = Named::Optimal, conflicts_with = "input")]
    protocol: Named,
    /// Plan for the accelerometer only: no turns
    #[arg(long)]
    accelerometer_only: bool,
    /// Say what to do for the dependence on temperature
    #[arg(long)]
    temperature: bool,
    /// Call the sides by the sensor's axes, not by those of a phone
    #[arg(long)]
    axes: bool,
    /// Each rest, s
    #[arg(long, value_name = "S", default_value_t = 6.0)]
    rest: f64,
    /// Mean speed of the turns, °/s; their peak is about twice that
    #[arg(long, value_name = "DEG/S", default_value_t = 90.0)]
    speed: f64,
    /// Noise of a placement beyond white noise, mm/s²: what your calibrations leave
    #[arg(long, value_name = "MM/S²", default_value_t = 0.0)]
    misfit: f64,
    /// Local gravity, m/s²
    #[arg(long, value_name = "M/S²", default_value_t = calib::calibrate::STANDARD_GRAVITY)]
    gravity: f64,
    /// Write the plan as JSON
    #[arg(short, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Write a page with a picture of every placement (HTML, to print)
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    #[command(flatten)]
    replace: Replace,
    /// Print the plan as JSON instead of tables
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    detector: DetectorArgs,
    #[command(flatten)]
    read: ReadArgs,
}

/// Placements by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Named {
    /// The best for their number
    Optimal,
    /// Six faces, twelve edges, eight corners
    FacesEdgesCorners,
    /// imu_tk's 36 to 50
    #[value(name = "imu_tk")]
    ImuTk,
}

impl Named {
    fn protocol(self) -> Protocol {
        match self {
            Self::Optimal => Protocol::Optimal,
            Self::FacesEdgesCorners => Protocol::FacesEdgesCorners,
            Self::ImuTk => Protocol::ImuTk,
        }
    }
}

/// Runs the command.
pub fn run(args: &Args) -> Result<(), Failure> {
    super::inputs::check_gravity(args.gravity)?;
    args.check()?;
    let inputs: Vec<&Path> = args.input.iter().map(PathBuf::as_path).collect();
    let claim = |path: &Option<PathBuf>| {
        let claimed = path
            .as_ref()
            .map(|p| Output::claim(p, args.replace, &inputs));
        claimed.transpose()
    };
    let (output, report) = (claim(&args.output)?, claim(&args.report)?);
    args.replace.end_if_all_exist()?;
    let (noise, timing, words) = (args.noise(), args.timing(), args.words());
    let input = match &args.input {
        Some(path) => Some(known::read(path, args, &noise, &timing)?),
        None => None,
    };
    let ups = match &input {
        Some(input) => input.next(args.next),
        None => args
            .protocol
            .protocol()
            .placements(args.placements.unwrap_or(REQUIREMENT.advised)),
    };
    let start = input.as_ref().map(|input| input.known).unwrap_or_default();
    let found = plan::plan(&ups, &start, &noise, &timing, words);
    let notes = notes(args, input.as_ref());
    let document = show::json(&document(args, input.as_ref(), &found, &notes))?;
    if let Some(output) = output {
        output.write(document.as_bytes())?;
    }
    if let Some(report) = report {
        report.write(sheet::page(&found, &notes, args.accelerometer_only).as_bytes())?;
    }
    show::print(&if args.json {
        document
    } else {
        tables::text(&found, input.as_ref(), &notes, args.accelerometer_only)
    })
}

impl Args {
    fn check(&self) -> Result<(), Failure> {
        let refuse = |what: String| Err(Failure::new(USAGE, what));
        if let Some(count) = self.placements.filter(|n| !PLACEMENTS.contains(n)) {
            return refuse(format!(
                "--placements {count}: {} to {} expected",
                PLACEMENTS.start(),
                PLACEMENTS.end()
            ));
        }
        if self.next.is_some_and(|k| k == 0 || k > *PLACEMENTS.end()) {
            return refuse(format!("--next: 1 to {} expected", PLACEMENTS.end()));
        }
        let positive = [
            ("--rest", self.rest, 1.0..=3600.0),
            ("--speed", self.speed, 1.0..=2000.0),
            ("--misfit", self.misfit, 0.0..=1000.0),
        ];
        for (name, value, range) in positive {
            if !range.contains(&value) {
                return refuse(format!(
                    "{name} {value}: {} to {} expected",
                    range.start(),
                    range.end()
                ));
            }
        }
        Ok(())
    }

    fn noise(&self) -> Noise {
        let rate = Noise::default().rate;
        Noise {
            // Turns that tell nothing leave the accelerometer alone.
            rate: if self.accelerometer_only { 1e3 } else { rate },
            placement: 1e-3 * self.misfit,
            gravity: self.gravity,
            ..Noise::default()
        }
    }

    fn timing(&self) -> Timing {
        Timing {
            rest: self.rest,
            pace: Pace {
                rate: self.speed.to_radians(),
                ..Pace::default()
            },
            ..Timing::default()
        }
    }

    fn words(&self) -> Words {
        if self.axes { Words::Axes } else { Words::Phone }
    }
}

/// What else to do.
fn notes(args: &Args, input: Option<&Input>) -> Vec<String> {
    let mut notes = vec![format!(
        "The requirement: {REQUIREMENT}. Put the device down, let go, wait {:.0} s.",
        args.rest
    )];
    if args.temperature {
        notes.push(
            "Temperature: go through the placements twice, once after an hour in the cold (a refrigerator, in a bag) and \
             once warm (in the sun or beside a heater), letting it warm up slowly in between while it records; at least \
             15 K apart, each placement at both ends."
                .into(),
        );
    }
    notes.extend(
        input
            .into_iter()
            .flat_map(|input| input.ties.iter().cloned()),
    );
    notes
}

fn document(
    args: &Args,
    input: Option<&Input>,
    found: &Plan,
    notes: &[String],
) -> serde_json::Value {
    json!({
        "schema": "stillpoint.plan/1",
        "created_by": concat!("stillpoint ", env!("CARGO_PKG_VERSION")),
        "requirement": REQUIREMENT,
        "parameters": plan::parameter_names(),
        "noise": args.noise(),
        "timing": args.timing(),
        "input": input.map(|input| &input.name),
        "coverage": input.and_then(|input| input.coverage.as_ref()),
        "accelerometer_only": args.accelerometer_only,
        "plan": found,
        "notes": notes,
    })
}
