//! `calibrate --method six-position`: each axis once up and once down.

use std::fmt::Write as _;

use calib::Recording;
use calib::intervals::Detector;
use calib::methods::six_position::{Face, GyroscopePart, SixPosition, placements};

use crate::exit::{BUG, Failure};
use crate::output::Output;
use crate::show;

/// What the options of `calibrate` say to this method.
#[derive(Debug)]
pub struct Call<'a> {
    /// Six recordings, or one with all placements.
    pub recordings: &'a [Recording],
    /// The detector of motion.
    pub detector: Detector,
    /// Local gravity, m/s².
    pub gravity: f64,
    /// Correct by `I − M` instead of the inverse, as the authors do.
    pub first_order: bool,
    /// Print JSON.
    pub json: bool,
    /// Where the calibration goes.
    pub output: Option<Output>,
}

/// Runs the method.
pub fn run(call: Call<'_>) -> Result<(), Failure> {
    let six = placements(call.recordings, &call.detector, call.gravity)?;
    let labels = six
        .placements()
        .each_ref()
        .map(|placement| placement.label.clone());
    let solution = SixPosition::solve(&six, call.gravity);
    let calibration = solution.calibration(call.first_order)?;
    calibration
        .warnings
        .iter()
        .for_each(|warning| show::warn(warning));
    let json =
        serde_json::to_string_pretty(&calibration).map_err(|e| Failure::new(BUG, e.to_string()))?;
    if let Some(output) = call.output {
        output.write(format!("{json}\n").as_bytes())?;
    }
    show::print(&if call.json {
        json
    } else {
        text(&solution, &labels)
    });
    Ok(())
}

fn text(solution: &SixPosition, labels: &[String; 6]) -> String {
    let mut text = String::new();
    let mut table = show::table(&["face", "mean x, m/s²", "mean y", "mean z"]);
    table.set_header(["face", "mean x, m/s²", "mean y", "mean z", "from"]);
    for (k, face) in Face::ALL.iter().enumerate() {
        let mean = |axis: usize| format!("{:.6}", solution.means[(axis, k)]);
        table.add_row([
            face.name().into(),
            mean(0),
            mean(1),
            mean(2),
            show::printable(&labels[k]),
        ]);
    }
    let _ = writeln!(text, "{table}\n");
    let mut table = show::table(&["raw = (I + M) f + b", "M x", "M y", "M z", "b, m/s²"]);
    for (i, axis) in ["x", "y", "z"].iter().enumerate() {
        let m = |j: usize| format!("{:+.7}", solution.m[(i, j)]);
        table.add_row([
            (*axis).into(),
            m(0),
            m(1),
            m(2),
            format!("{:+.6}", solution.bias[i]),
        ]);
    }
    let _ = writeln!(text, "{table}");
    let _ = writeln!(
        text,
        "residual {:.1} mm/s² rms; the placements are tilted by about {:.2}° rms\n",
        1e3 * solution.residual_rms,
        solution.tilt().to_degrees()
    );
    if let Some(gyroscope) = &solution.gyroscope {
        let _ = writeln!(text, "{}", gyroscope_text(gyroscope));
    }
    text
}

fn gyroscope_text(part: &GyroscopePart) -> String {
    let mut table = show::table(&[
        "gyroscope, as published",
        "bias, rad/s",
        "std error",
        "S",
        "std error",
    ]);
    for (k, axis) in ["x", "y", "z"].iter().enumerate() {
        table.add_row([
            (*axis).into(),
            format!("{:+.7}", part.bias[k]),
            show::error(Some(part.bias_std[k])),
            format!("{:+.4}", part.scale_error[k]),
            show::error(Some(part.scale_error_std[k])),
        ]);
    }
    let verdict = if part.is_meaningful() {
        "the earth's rate stands out: S can be used"
    } else {
        "S means nothing here: the bias wanders by more than the earth's rate between placements; only \
         the bias goes into the calibration"
    };
    format!("{table}\n{verdict}")
}
