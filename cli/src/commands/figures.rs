//! The figures of reports as pictures, for programs that show them elsewhere than in a page.

use calib::Recording;
use calib::calibrate::Outcome;
use calib::discover::Discovery;

use super::{calibrate, discover};
use crate::exit::Failure;
use crate::report::{Plot, Theme};

/// A figure of a report.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Figure {
    /// Its title.
    pub title: String,
    /// The picture, SVG for a light page.
    pub svg: String,
}

/// The figures in the report of `calibrate`.
///
/// # Errors
/// What cannot be measured or drawn, in words.
pub fn of_calibration(recordings: &[&Recording], outcome: &Outcome) -> Result<Vec<Figure>, String> {
    calibrate::parts(recordings.iter().copied(), outcome)
        .and_then(|parts| drawn(&calibrate::report::plots(&parts)))
        .map_err(|failure| failure.message)
}

/// The figures in the report of `discover`.
///
/// # Errors
/// What cannot be drawn, in words.
pub fn of_discovery(discovery: &Discovery) -> Result<Vec<Figure>, String> {
    drawn(&discover::plots(discovery)).map_err(|failure| failure.message)
}

fn drawn(plots: &[Plot]) -> Result<Vec<Figure>, Failure> {
    let figure = |plot: &Plot| {
        Ok(Figure {
            title: plot.title.clone(),
            svg: plot.svg(Theme::Light)?,
        })
    };
    plots.iter().map(figure).collect()
}
