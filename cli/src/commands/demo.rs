//! `demo`: a simulated session with a hidden effect, calibrated, the effect discovered, beside the truth.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use calib::calibrate::{Method, Outcome, Request as CalibrationRequest, calibrate};
use calib::discover::{Discovery, Request};
use calib::effects::force_sensitivity;
use calib::recording::averages::root_mean_square;
use calib::simulate::{Session, Spec};

use super::discover::{json, look, page, plots, verdict};
use crate::commands::shared::inputs::spinner;
use crate::exit::Failure;
use crate::output::{Filled, Folder, Output, Replace};
use crate::show;

/// The demonstration is the same for everybody.
const SEED: u64 = 20_240_229;

/// Name of the effect that the simulated device has beyond its base models. Nothing but the simulation is told.
fn hidden_effect() -> &'static str {
    force_sensitivity().name()
}

/// Simulates a hand-held session of a device with a hidden effect, calibrates it, discovers the effect and
/// shows truth beside estimate.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example:
  stillpoint demo --out demo/   leaves recording.csv, cal.json, findings.json and report.html")]
pub struct Args {
    /// Write the recording, its calibration, the findings and the report into this folder
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    replace: Replace,
}

/// The files of the demonstration.
struct Files {
    recording: Output,
    calibration: Output,
    findings: Output,
    report: Output,
    /// After the files, so that it is empty when it goes.
    _folder: Folder,
}

impl Files {
    fn claim(dir: &Path, replace: Replace) -> Result<Self, Failure> {
        let folder = Folder::make(dir)?;
        let claim = |name: &str| Output::claim_in(dir, name, replace, &[]);
        Ok(Self {
            recording: claim("recording.csv")?,
            calibration: claim("cal.json")?,
            findings: claim("findings.json")?,
            report: claim("report.html")?,
            _folder: folder,
        })
    }

    fn write(
        self,
        session: &mut Session,
        discovery: &Discovery,
        request: &Request,
    ) -> Result<(), Failure> {
        let calibration = show::json(&discovery.findings.calibration)?;
        let plots = plots(discovery);
        let recordings = [session.recording.clone()];
        let page = page(discovery, &recordings, request, &plots)?.html()?;
        let csv = calib::recording::to_csv(&mut session.recording);
        let findings = json(&discovery.findings)?;
        let mut filled = Vec::new();
        for (output, contents) in [
            (self.recording, csv),
            (self.calibration, calibration),
            (self.findings, findings),
            (self.report, page),
        ] {
            filled.push(output.fill(|out| out.write_all(contents.as_bytes()))?);
        }
        filled.into_iter().try_for_each(Filled::publish)
    }
}

/// Runs the command.
pub fn run(args: &Args) -> Result<(), Failure> {
    let dir = args.out.as_deref();
    let files = dir.map(|dir| Files::claim(dir, args.replace)).transpose()?;
    args.replace.end_if_all_exist()?;
    let progress = spinner("simulating");
    let mut session = Spec::hand_held(SEED)
        .with_effect(hidden_effect(), 1.0)
        .run()?;
    let gravity = session.truth.spec.gravity;
    let recordings = [session.recording.clone()];
    progress.set_message("calibrating");
    let request = CalibrationRequest {
        method: Method::Joint,
        gravity,
        ..CalibrationRequest::default()
    };
    let outcome = calibrate(&recordings, &[], &request)?;
    progress.finish_and_clear();
    let request = Request::new(gravity);
    let discovery = look(&recordings, None, &request)?;
    if let Some(files) = files {
        files.write(&mut session, &discovery, &request)?;
    }
    let mut text = simulated(&session, &outcome);
    text.push_str(&discovered(&discovery));
    text.push_str(&compared(&session, &discovery));
    if let Some(dir) = dir {
        let report = dir.join("report.html");
        let _ = writeln!(text, "The report is in {}.", show::path(&report));
    }
    show::print(&show::wrapped(&text))
}

/// What was simulated, and what the base models make of it.
fn simulated(session: &Session, outcome: &Outcome) -> String {
    let accelerometer = session.recording.accelerometer.as_ref();
    let samples = accelerometer.map_or(0, |s| s.len());
    let choice = outcome.choices.first();
    let rests = choice.map_or(0, |c| c.segmentation.statics.len());
    let mut text = format!(
        "A simulated device, held by hand in {rests} placements: {samples} samples of both sensors, consumer grade.\n\
         It has an effect that the analysis is not told of.\n\n"
    );
    if let Some(fit) = &outcome.joint {
        let _ = writeln!(
            text,
            "calibrate: gravity's norm holds to {:.2} mm/s² rms; its direction is predicted through a turn\n\
             to {:.4}° rms (raw: {:.2}°).",
            1e3 * root_mean_square(&fit.norms),
            root_mean_square(&fit.chords).to_degrees(),
            root_mean_square(&fit.chords_before).to_degrees()
        );
    }
    text
}

fn discovered(discovery: &Discovery) -> String {
    let effects = &discovery.findings.effects;
    let mut text = format!("discover: {}\n", verdict(&discovery.findings));
    for effect in effects {
        let _ = writeln!(
            text,
            "Likelihood ratio {:.0} with {:.0} degrees of freedom.",
            effect.statistic, effect.dof
        );
    }
    text
}

/// Truth beside the estimates of the model with everything that was named.
fn compared(session: &Session, discovery: &Discovery) -> String {
    let mut table = show::table(&["parameter", "truth", "estimate", "std error", "error / std"]);
    let (mut within, mut count) = (0, 0);
    let fitted = discovery.search.last.fit.all_fitted();
    for name in &fitted.free {
        let (Some(truth), Some(estimate), Some(std)) = (
            session.truth.get(name),
            fitted.parameters.get(name),
            fitted.standard_error(name),
        ) else {
            continue;
        };
        let ratio = (estimate - truth) / std;
        count += 1;
        within += usize::from(ratio.abs() < 1.96);
        table.add_row([
            name.clone(),
            show::value(truth, Some(std)),
            show::value(estimate, Some(std)),
            show::error(Some(std)),
            format!("{ratio:+.2}"),
        ]);
    }
    format!(
        "\nHidden was {}. Truth beside the estimates of the model with what was named:\n\n{table}\n\
         {within} of {count} estimates lie within 1.96 standard errors of the truth.\n",
        hidden_effect()
    )
}
