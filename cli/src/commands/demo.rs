//! `demo`: a simulated session with a hidden effect, calibrated, the effect discovered, beside the truth.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use calib::calibrate::{
    Method, Outcome, Request as CalibrationRequest, STANDARD_GRAVITY, calibrate,
};
use calib::discover::{Discovery, Request};
use calib::effects::force_sensitivity;
use calib::simulate::{Session, Spec};

use super::calibrate::session as session_of;
use super::discover::{gaps, look, page_after, plots, verdict};
use crate::commands::shared::first_screen::{Screen, Step};
use crate::commands::shared::inputs::spinner;
use crate::exit::Failure;
use crate::output::{Folder, Output, Replace};
use crate::pages::residual::Residual;
use crate::report::{Report, ReportTable};
use crate::show;
use crate::show::command_line;

/// The demonstration is the same for everybody.
const SEED: u64 = 20_240_229;

/// Name of the effect that the simulated device has beyond its base models. Nothing but the simulation is told.
fn hidden_effect() -> String {
    force_sensitivity().name().to_owned()
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
        let rows = estimates(session, discovery);
        let page = page_after(discovery, &recordings, request, &plots, |report| {
            compared_on_page(report, &rows)
        })?;
        let page = page.html()?;
        let csv = calib::recording::to_csv(&mut session.recording);
        let findings = show::json(&discovery.findings)?;
        Output::write_all([
            (self.recording, csv),
            (self.calibration, calibration),
            (self.findings, findings),
            (self.report, page),
        ])
    }
}

/// Runs the command.
pub fn run(args: &Args) -> Result<(), Failure> {
    let dir = args.out.as_deref();
    let files = dir.map(|dir| Files::claim(dir, args.replace)).transpose()?;
    args.replace.end_if_all_exist()?;
    let progress = spinner("simulating");
    let mut session = Spec::hand_held(SEED)
        .with_effect(&hidden_effect(), 1.0)
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
    let residual = Residual::measured(&session_of(&recordings, &outcome)?).in_words();
    screen(dir, &session, &outcome, &discovery, &residual).show(|| {
        let mut text = simulated(&session, &outcome, &residual);
        text.push_str(&discovered(&discovery));
        text.push_str(&compared(&session, &discovery));
        text
    })
}

/// The first screen: that it is simulated, whether the hidden effect is named, and its truth beside the estimate.
fn screen(
    dir: Option<&Path>,
    session: &Session,
    outcome: &Outcome,
    discovery: &Discovery,
    residual: &str,
) -> Screen {
    let findings = &discovery.findings;
    let found = findings
        .effects
        .iter()
        .find(|effect| effect.name == hidden_effect());
    let verdict = match found {
        Some(effect) => format!(
            "The hidden effect is found: {}. All data here are simulated.",
            effect.name
        ),
        None => "The hidden effect is not found. All data here are simulated.".into(),
    };
    let samples = session
        .recording
        .accelerometer
        .as_ref()
        .map_or(0, |s| s.len());
    let rests = outcome
        .choices
        .first()
        .map_or(0, |c| c.segmentation.statics.len());
    let mut figures = vec![[
        "simulated".to_owned(),
        format!("{rests} placements by hand, {samples} samples, one hidden effect"),
    ]];
    figures.push(["base models".into(), residual.to_owned()]);
    if let Some(effect) = found {
        let [before, after] = gaps(effect.gap_before, effect.gap_after);
        let [left, then] = gaps(effect.held_out_gap_before, effect.held_out_gap_after);
        figures.push([
            "gap with the effect".into(),
            format!("{before} → {after}, on intervals left out {left} → {then}"),
        ]);
    }
    let rows = estimates(session, discovery);
    let within = rows.iter().filter(|row| row.ratio().abs() < WITHIN).count();
    figures.push([
        "estimates".into(),
        format!(
            "{within} of {} within {WITHIN} standard errors of the truth",
            rows.len()
        ),
    ]);
    let (next, written) = match dir {
        Some(dir) => {
            let file = |name: &str| command_line(&dir.join(name));
            let recording = file("recording.csv");
            (
                vec![
                    Step::new(
                        "calibrate it yourself",
                        format!("stillpoint calibrate {recording} -o cal.json"),
                    ),
                    Step::new(
                        "find the effect",
                        format!("stillpoint discover {recording} -o findings.json"),
                    ),
                ],
                format!(
                    "The report is in {}; beside it are recording, calibration and findings.",
                    show::path(&dir.join("report.html"))
                ),
            )
        }
        None => (
            vec![Step::new("get the report", "stillpoint demo --out demo")],
            String::new(),
        ),
    };
    Screen {
        verdict: vec![verdict],
        figures,
        tables: vec![hidden(&rows)],
        next,
        written,
        ..Screen::default()
    }
}

/// An estimate lies within so many standard errors of the truth in nineteen cases of twenty.
const WITHIN: f64 = 1.96;

/// A parameter with its truth and its estimate.
struct Estimate {
    name: String,
    truth: f64,
    value: f64,
    std: f64,
}

impl Estimate {
    fn ratio(&self) -> f64 {
        (self.value - self.truth) / self.std
    }

    /// The row of a table under [`HEADER`].
    fn cells(&self) -> [String; 5] {
        let std = Some(self.std);
        [
            self.name.clone(),
            show::value(self.truth, std),
            show::value(self.value, std),
            show::error(std),
            format!("{:+.2}", self.ratio()),
        ]
    }
}

const HEADER: [&str; 5] = ["parameter", "truth", "estimate", "std error", "error / std"];

/// Everything that the model with what was named estimates.
fn estimates(session: &Session, discovery: &Discovery) -> Vec<Estimate> {
    let fitted = discovery.search.last.fit.all_fitted();
    let estimate = |name: &String| {
        Some(Estimate {
            name: name.clone(),
            truth: session.truth.get(name)?,
            value: fitted.parameters.get(name)?,
            std: fitted.standard_error(name)?,
        })
    };
    fitted.free.iter().filter_map(estimate).collect()
}

/// Truth beside estimate of the hidden effect, in the units that people use.
fn hidden(rows: &[Estimate]) -> String {
    // 1 (rad/s)/(m/s²) in °/h per g.
    let factor = 3600.0 * 1f64.to_degrees() * STANDARD_GRAVITY;
    let own = rows
        .iter()
        .filter(|row| row.name.starts_with(&hidden_effect()));
    let mut lines = vec![format!(
        "  {:<24}  {:>8}  {:>16}",
        "°/h per g", "truth", "estimate"
    )];
    lines.extend(own.map(|row| {
        let value = show::with_error(factor * row.value, Some(factor * row.std));
        format!(
            "  {:<24}  {:>8.1}  {value:>16}",
            row.name,
            factor * row.truth
        )
    }));
    lines.join("\n")
}

/// Describes the simulated session and the residual of the base models on it.
fn simulated(session: &Session, outcome: &Outcome, residual: &str) -> String {
    let accelerometer = session.recording.accelerometer.as_ref();
    let samples = accelerometer.map_or(0, |s| s.len());
    let choice = outcome.choices.first();
    let rests = choice.map_or(0, |c| c.segmentation.statics.len());
    let mut text = format!(
        "A simulated device, held by hand in {rests} placements: {samples} samples of both sensors, consumer grade.\n\
         It has an effect that the analysis is not told of.\n\n"
    );
    let _ = writeln!(text, "calibrate: gravity is met {residual}.");
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
    let rows = estimates(session, discovery);
    let table = show::table_of(&HEADER, rows.iter().map(Estimate::cells));
    let within = rows.iter().filter(|row| row.ratio().abs() < WITHIN).count();
    let count = rows.len();
    format!(
        "\nHidden was {}. Truth beside the estimates of the model with what was named:\n\n{table}\n\
         {within} of {count} estimates lie within {WITHIN} standard errors of the truth.\n",
        hidden_effect()
    )
}

/// The same on the page, and that nothing on it was measured.
fn compared_on_page(report: Report, rows: &[Estimate]) -> Report {
    let table = ReportTable::of(HEADER, rows.iter().map(Estimate::cells));
    let within = rows.iter().filter(|row| row.ratio().abs() < WITHIN).count();
    report
        .section("Simulated: truth beside estimate")
        .text(format!(
            "All data on this page are simulated, so that the truth is known. The hidden effect is {}; the analysis was not told of it.",
            hidden_effect()
        ))
        .table(table)
        .text(format!("{within} of {} estimates lie within {WITHIN} standard errors of the truth.", rows.len()))
}
