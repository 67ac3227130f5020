//! The rests and turns of a recording, by the request.

use recording::intervals::{Detector, Segmentation};
use recording::{Error, Recording};
use sensor::Quantity;

use super::request::{Method, Request};
use crate::methods::{self, Choice};

/// The rests and turns of a recording without those that are left out; `k` is its place among those that sections were
/// given for.
pub(super) fn cut(
    recording: &Recording,
    request: &Request,
    k: Option<usize>,
) -> Result<Choice, Error> {
    let mut choice = whole(recording, request, k)?;
    let of_this = request
        .left_out
        .iter()
        .filter(|i| Some(i.recording) == k.map(|k| k + 1));
    let instants: Vec<f64> = of_this.map(|instant| instant.t).collect();
    if !instants.is_empty() {
        choice.segmentation = choice.segmentation.without(recording, &instants)?;
    }
    Ok(choice)
}

/// All rests and turns of a recording.
fn whole(recording: &Recording, request: &Request, k: Option<usize>) -> Result<Choice, Error> {
    let named = |error| match error {
        Error::NotEnough(what) => Error::not_enough(what.in_recording(recording.name.clone())),
        other => other,
    };
    if let Some(spans) = k
        .and_then(|k| request.sections.get(k))
        .filter(|spans| !spans.is_empty())
    {
        let segmentation = Segmentation::from_spans(recording, spans, request.detector.multiplier);
        return Ok(Choice {
            segmentation,
            trials: Vec::new(),
            shortened: None,
        });
    }
    let (choose, gravity) = (request.choose_multiplier, request.gravity);
    let detector = Detector {
        creeping: request.method == Method::Joint,
        shaken: request.detector.shaken || needs_vibration(request),
        ..request.detector
    };
    methods::cut(recording, &detector, choose, gravity).map_err(named)
}

/// Returns true if a requested effect shows only under vibration: static intervals that vibrate are kept then.
fn needs_vibration(request: &Request) -> bool {
    let mut needs = request.effects.iter().flat_map(|effect| effect.needs());
    needs.any(|need| need == Quantity::Vibration)
}
