//! Source of the samples for `allan`: a whole recording, or its static part.

use ::findings::{Finding, Kind};
use calib::Recording;
use calib::intervals::Span;
use calib::noise::{RecordingCurves, Stillness, curves_of_long_csv};
use sensor::Sensor;

use super::args::Args;
use crate::commands::shared::inputs::{read, spinner};
use crate::exit::{Failure, NOT_ENOUGH};
use crate::show;

/// Motions named in a message.
const LISTED: usize = 4;

/// Status 4 with the times of the motions.
pub fn moved(stillness: &Stillness, longest: Option<Span>) -> Failure {
    let length = longest.map_or("never rested".into(), |rest| {
        format!(
            "its longest rest is {:.0} s long (t = {:.2} to {:.2} s)",
            rest.length(),
            rest.from,
            rest.to
        )
    });
    Failure::new(
        NOT_ENOUGH,
        format!(
            "the device moved ({}) and {length}: an Allan deviation needs a recording at rest",
            listed(&stillness.motions)
        ),
    )
    .advise("leave the device alone for an hour, or name a stretch with --rest T0,T1")
}

/// The first few spans, and how many more.
pub fn listed(motions: &[Span]) -> String {
    let shown: Vec<String> = motions
        .iter()
        .take(LISTED)
        .map(|span| format!("{:.1} to {:.1} s", span.from.max(0.0), span.to))
        .collect();
    let more = motions.len().saturating_sub(LISTED);
    let more = if more > 0 {
        format!(" and {more} more times")
    } else {
        String::new()
    };
    format!("t = {}{more}", shown.join(", "))
}

/// The unit of a gyroscope whose header names none, and whose readings do not tell it.
fn assumed() -> Finding {
    Finding::of(Kind::UNIT_ASSUMED).of_sensor(Sensor::Gyroscope)
}

/// The recording as a stream where the file allows it, else in memory.
#[derive(Debug)]
pub struct Source<'a> {
    args: &'a Args,
    recording: Option<Recording>,
    /// The unit of the gyroscope, where it is assumed.
    pub assumed: Option<Finding>,
}

impl<'a> Source<'a> {
    /// Nothing is read yet.
    pub fn new(args: &'a Args) -> Self {
        Self {
            args,
            recording: None,
            assumed: None,
        }
    }

    /// The curves of the recording, or of the stretch `within` of it.
    ///
    /// # Errors
    /// What the reader of recordings refuses.
    pub fn curves(&mut self, within: Option<Span>) -> Result<RecordingCurves, Failure> {
        if let Some(recording) = &self.recording {
            return Ok(RecordingCurves::of(recording, within));
        }
        let args = self.args;
        if args.read.are_default() {
            let spinner = spinner("reading");
            let streamed = curves_of_long_csv(&args.recording, within);
            spinner.finish_and_clear();
            if let Some(curves) = streamed {
                // Its header names no unit.
                self.assumed = Some(assumed());
                return Ok(curves);
            }
        }
        let recording = read(&args.recording, &args.read)?;
        self.assumed = recording.unit_assumed().map(|_| assumed());
        show::warn_each(&recording.warnings);
        let curves = RecordingCurves::of(&recording, within);
        self.recording = Some(recording);
        Ok(curves)
    }
}
