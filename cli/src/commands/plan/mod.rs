//! `plan`: which placements and turns to record, and what each buys.

mod known;
mod rivals;
mod sheet;
mod tables;

use std::path::{Path, PathBuf};

use calib::discover::{Aim, Design};
use clap::ValueEnum;
use known::Input;
use nalgebra::Vector3;
use plan::{
    Criterion, Efficiency, ForceMatrix, Noise, Pace, Plan, Protocol, REQUIREMENT, Timing, Words,
    finest,
};
use serde_json::{Value, json};

use crate::commands::shared::inputs::DetectorArgs;
use crate::exit::{Failure, USAGE};
use crate::output::{Output, Replace};
use crate::read_args::ReadArgs;
use crate::show;

/// Placements of a plan from nothing, and most that can be asked for.
const PLACEMENTS: std::ops::RangeInclusive<usize> = 6..=60;

/// Says which placements and turns to record: in words, in pictures, with the standard errors that they buy.
///
/// Without an input it plans a whole session. With a recording or a calibration it plans what to record next. With findings that
/// list effects which the recording cannot tell apart it plans the recording that does, and says which it cannot.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example:
  stillpoint plan --placements 12 --report plan.html
  stillpoint plan phone.csv                what is still missing
  stillpoint plan cal.json --next 4        what four more placements buy
  stillpoint plan findings.json            what tells tied effects apart")]
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
    /// What the placements are best for; both efficiencies are printed
    #[arg(long, value_enum, default_value_t = By::Reading, conflicts_with_all = ["input", "protocol"])]
    criterion: By,
    /// Plan for the accelerometer only: no turns
    #[arg(long)]
    accelerometer_only: bool,
    /// Say what to do for the dependence on temperature; with findings: the device may be warmed
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

/// What placements are best for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum By {
    /// Error of a corrected reading, of what is easy to hold
    Reading,
    /// Volume of the confidence ellipsoid (D-optimality), tilts in steps of 5°
    Volume,
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
    crate::commands::shared::inputs::check_gravity(args.gravity)?;
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
    let start = input.as_ref().map(|input| input.known).unwrap_or_default();
    let rivals = input.as_ref().map(|input| &input.rivals);
    let aim = match rivals.filter(|rivals| !rivals.is_empty()) {
        Some(rivals) => Some(rivals.separate(args, &timing)?),
        None => None,
    };
    let found = match &aim {
        Some(aim) => {
            let Design {
                ups, turns, timing, ..
            } = &aim.design;
            plan::follow(ups, turns, &start, &noise, timing, words)
        }
        None => plan::plan(
            &placements(args, input.as_ref()),
            &start,
            &noise,
            &timing,
            words,
        ),
    };
    let ups: Vec<Vector3<f64>> = found.steps.iter().map(|s| s.up.into()).collect();
    let efficiency = input.is_none().then(|| plan::efficiency(&ups)).flatten();
    let ties = aim.as_ref().map_or(Vec::new(), rivals::rows);
    let mut notes = notes(args, input.as_ref(), aim.as_ref());
    notes.extend(efficiency.as_ref().map(efficiency_words));
    notes.extend(rivals::words(&ties));
    let extra = json!({"ties": ties, "efficiency": efficiency});
    let document = show::json(&document(args, input.as_ref(), &found, extra, &notes))?;
    if let Some(output) = output {
        output.write(document.as_bytes())?;
    }
    if let Some(report) = report {
        report.write(sheet::page(&found, &notes, args.accelerometer_only).as_bytes())?;
    }
    show::print(&if args.json {
        document
    } else {
        tables::text(
            &found,
            input.as_ref(),
            &ties,
            &notes,
            args.accelerometer_only,
        )
    })
}

/// The placements of the session, or those to add.
fn placements(args: &Args, input: Option<&Input>) -> Vec<Vector3<f64>> {
    match input {
        Some(input) => input.next(args.next),
        None => {
            let count = args.placements.unwrap_or(REQUIREMENT.advised);
            match args.criterion {
                By::Reading => args.protocol.protocol().placements(count),
                By::Volume => finest(count, &ForceMatrix::zeros(), Criterion::Volume),
            }
        }
    }
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
fn notes(args: &Args, input: Option<&Input>, aim: Option<&Aim>) -> Vec<String> {
    let rest = aim.map_or(args.rest, |aim| aim.design.timing.rest);
    let mut notes = vec![format!(
        "The requirement: {REQUIREMENT}. Put the device down, let go, wait {rest:.0} s."
    )];
    if let Some(aim) = aim {
        if aim.ties.iter().any(|tie| tie.settles) {
            notes.push(
                "Leave the device switched off for an hour before, and record from the moment it is switched on."
                    .into(),
            );
        }
        notes.push(
            "Record it as one recording of its own and give both to `discover`, the first and this one.".into(),
        );
        if args.temperature {
            notes.push(
                "Temperature: begin cold, warm the device by 15 K in the first half (a hair dryer, the sun) and let it \
                 cool in the second."
                    .into(),
            );
        }
        return notes;
    }
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
    extra: Value,
    notes: &[String],
) -> Value {
    let mut document = json!({
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
    });
    if let (Value::Object(all), Value::Object(extra)) = (&mut document, extra) {
        all.extend(extra);
    }
    document
}

/// What the placements come to beside the best that any could.
fn efficiency_words(efficiency: &Efficiency) -> String {
    format!(
        "Placements: {:.1} % of the best that any so many could come to by the error of a reading, {:.1} % by the volume of the \
         confidence ellipsoid (D-efficiency).",
        100.0 * efficiency.reading,
        100.0 * efficiency.volume
    )
}
