//! The figures of reports as pictures, for programs that show them elsewhere than in a page.

use calib::Recording;
use calib::calibrate::Outcome;
use calib::discover::Discovery;

use crate::commands::{calibrate, discover};
use crate::pages::calibration;
use crate::report::Picture;

/// A figure of a report.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Figure {
    /// Its title.
    pub title: String,
    /// The picture, SVG for light and dark pages.
    pub svg: String,
}

/// The figures in the report of `calibrate`.
///
/// # Errors
/// What cannot be measured or drawn, in words.
pub fn of_calibration(recordings: &[&Recording], outcome: &Outcome) -> Result<Vec<Figure>, String> {
    let session = calibrate::session(recordings.iter().copied(), outcome);
    let session = session.map_err(|failure| failure.message)?;
    let units = calibrate::tables::units(outcome);
    let all = calibration::pictures(&outcome.calibration, &session, units);
    Ok(all.iter().map(|(_, picture)| drawn(picture)).collect())
}

/// The figures in the report of `discover`.
pub fn of_discovery(discovery: &Discovery) -> Vec<Figure> {
    let plots = discover::plots(discovery);
    plots.iter().map(|(_, picture)| drawn(picture)).collect()
}

fn drawn(picture: &Picture) -> Figure {
    Figure {
        title: picture.title().to_owned(),
        svg: picture.svg(),
    }
}
