//! The arguments of `plan`.

use std::path::PathBuf;

use clap::ValueEnum;
use plan::{Noise, Pace, Protocol, Timing, Words};

use crate::commands::shared::inputs::DetectorArgs;
use crate::exit::Failure;
use crate::output::Replace;
use crate::read_args::ReadArgs;

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
    pub(super) input: Option<PathBuf>,
    /// Placements of the session
    #[arg(long, value_name = "N", conflicts_with_all = ["next", "input"])]
    pub(super) placements: Option<usize>,
    /// Placements to add to the input [default: as many as are missing, at least 3]
    #[arg(long, value_name = "K", requires = "input")]
    pub(super) next: Option<usize>,
    /// Placements by name
    #[arg(long, value_enum, default_value_t = Named::Optimal, conflicts_with = "input")]
    pub(super) protocol: Named,
    /// Take the placements that are best for this, in the order that tells most; without it the faces come first
    #[arg(long, value_enum, conflicts_with_all = ["input", "protocol"])]
    pub(super) criterion: Option<By>,
    /// Plan for the accelerometer only: no turns
    #[arg(long)]
    pub(super) accelerometer_only: bool,
    /// Say what to do for the dependence on temperature; with findings: the device may be warmed
    #[arg(long)]
    pub(super) temperature: bool,
    /// Call the sides by the sensor's axes, not by those of a phone
    #[arg(long)]
    pub(super) axes: bool,
    /// Each rest, s
    #[arg(long, value_name = "S", default_value_t = 6.0)]
    pub(super) rest: f64,
    /// Mean speed of the turns, °/s; their peak is about twice that
    #[arg(long, value_name = "DEG/S", default_value_t = 90.0)]
    pub(super) speed: f64,
    /// Noise of a placement beyond white noise, mm/s²: what your calibrations leave [default: that of the calibration, else 0]
    #[arg(long, value_name = "MM/S²")]
    pub(super) misfit: Option<f64>,
    /// Local gravity, m/s² [default: that of the calibration, else 9.80665]
    #[arg(long, value_name = "M/S²")]
    pub(super) gravity: Option<f64>,
    /// Write the plan as JSON
    #[arg(short, value_name = "FILE")]
    pub(super) output: Option<PathBuf>,
    /// Write a page with a picture of every placement (HTML, to print)
    #[arg(long, value_name = "FILE")]
    pub(super) report: Option<PathBuf>,
    #[command(flatten)]
    pub(super) replace: Replace,
    /// Print the plan as JSON instead of tables
    #[arg(long)]
    pub(super) json: bool,
    #[command(flatten)]
    pub(super) detector: DetectorArgs,
    #[command(flatten)]
    pub(super) read: ReadArgs,
}

/// Placements by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Named {
    /// The best for their number
    Optimal,
    /// Six faces, twelve edges, eight corners
    FacesEdgesCorners,
    /// imu_tk's 36 to 50
    #[value(name = "imu_tk")]
    ImuTk,
}

/// Optimality criterion of the placements.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum By {
    /// Error of a corrected reading, of what is easy to hold
    Reading,
    /// Volume of the confidence ellipsoid (D-optimality), tilts in steps of 5°
    Volume,
}

impl Named {
    pub(super) fn protocol(self) -> Protocol {
        match self {
            Self::Optimal => Protocol::Optimal,
            Self::FacesEdgesCorners => Protocol::FacesEdgesCorners,
            Self::ImuTk => Protocol::ImuTk,
        }
    }
}

impl Args {
    pub(super) fn check(&self) -> Result<(), Failure> {
        let refuse = |what: String| Err(Failure::usage(what));
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
            ("--misfit", self.misfit.unwrap_or(0.0), 0.0..=1000.0),
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

    /// The noise, with `misfit` (mm/s²) of a placement where none is given.
    pub(super) fn noise(&self, gravity: f64, misfit: Option<f64>) -> Noise {
        let rate = Noise::default().rate;
        Noise {
            // Turns that tell nothing leave the accelerometer alone.
            rate: if self.accelerometer_only { 1e3 } else { rate },
            placement: 1e-3 * self.misfit.or(misfit).unwrap_or(0.0),
            gravity,
            ..Noise::default()
        }
    }

    pub(super) fn timing(&self) -> Timing {
        Timing {
            rest: self.rest,
            pace: Pace {
                rate: self.speed.to_radians(),
                ..Pace::default()
            },
            ..Timing::default()
        }
    }

    /// Returns true if the plan is a complete session for a person, with the default protocol and criterion.
    pub(super) fn is_for_a_hand(&self) -> bool {
        self.protocol == Named::Optimal && self.criterion.is_none()
    }

    pub(super) fn words(&self) -> Words {
        if self.axes { Words::Axes } else { Words::Phone }
    }
}
