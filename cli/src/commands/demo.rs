//! `demo`: a simulated session, calibrated, beside its truth.

use std::fmt::Write as _;
use std::path::PathBuf;

use calib::calibrate::{Outcome, Request, calibrate};
use calib::calibration::effect_named;
use calib::simulate::{Session, Spec};

use super::inputs::spinner;
use crate::exit::{BUG, Failure};
use crate::output::Output;
use crate::show;

/// The demonstration is the same for everybody.
const SEED: u64 = 20_240_229;

/// The effect that the simulated device has beyond its base models.
const HIDDEN_EFFECT: &str = "gyro_g_sensitivity";

/// Simulates a hand-held session, calibrates it and shows truth beside estimate.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example:
  stillpoint demo --out demo/   leaves recording.csv and cal.json to play with")]
pub struct Args {
    /// Write the recording and its calibration into this folder
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Replace existing files
    #[arg(long)]
    force: bool,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<(), Failure> {
    let claims = match &args.out {
        Some(dir) => {
            std::fs::create_dir_all(dir).map_err(|e| {
                Failure::new(crate::exit::OUTPUT, format!("{}: {e}", dir.display()))
            })?;
            let claim = |name: &str| Output::claim(&dir.join(name), args.force, &[]);
            Some((claim("recording.csv")?, claim("cal.json")?))
        }
        None => None,
    };
    let progress = spinner("simulating");
    let mut session = Spec::hand_held(SEED)
        .with_effect(HIDDEN_EFFECT, 1.0)
        .run()?;
    progress.set_message("calibrating");
    let request = Request {
        gravity: session.truth.spec.gravity,
        effects: effect_named(HIDDEN_EFFECT).into_iter().collect(),
        ..Request::default()
    };
    let recordings = [session.recording.clone()];
    let outcome = calibrate(&recordings, &[], &request)?;
    progress.finish_and_clear();
    if let Some((recording, cal)) = claims {
        recording.write(calib::recording::to_csv(&mut session.recording).as_bytes())?;
        let json = serde_json::to_string_pretty(&outcome.calibration)
            .map_err(|e| Failure::new(BUG, e.to_string()))?;
        cal.write(format!("{json}\n").as_bytes())?;
    }
    show::print(&text(&session, &outcome))?;
    Ok(())
}

fn text(session: &Session, outcome: &Outcome) -> String {
    let mut table = show::table(&["parameter", "truth", "estimate", "std error", "error / std"]);
    let mut within = 0;
    let mut count = 0;
    let fits = [
        outcome.accelerometer.as_ref().map(|fit| &fit.fitted),
        outcome.gyroscope.as_ref().map(|fit| &fit.fitted),
    ];
    for fitted in fits.into_iter().flatten() {
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
    }
    let samples = session
        .recording
        .accelerometer
        .as_ref()
        .map_or(0, |s| s.len());
    let rests = outcome
        .choices
        .first()
        .map_or(0, |c| c.segmentation.statics.len());
    let mut text = String::new();
    let _ = writeln!(
        text,
        "A simulated device, held by hand in {rests} placements: {samples} samples of both sensors, \
         consumer grade,\nwith {HIDDEN_EFFECT} on top. What `calibrate --effects {HIDDEN_EFFECT}` makes \
         of it:\n\n{table}\n{within} of {count} estimates lie within 1.96 standard errors of the truth."
    );
    if let (Some(accelerometer), Some(gyroscope)) = (&outcome.accelerometer, &outcome.gyroscope) {
        let _ = writeln!(
            text,
            "Gravity's modulus holds to {:.2} mm/s² rms; its direction is foretold through a turn to \
             {:.4}° rms\n(raw: {:.2}°).",
            1e3 * accelerometer.first.rms(),
            gyroscope.rms().to_degrees(),
            gyroscope.rms_before().to_degrees()
        );
    }
    text
}
