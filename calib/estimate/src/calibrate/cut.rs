//! Static intervals and turns of recordings, by the request.

use findings::{Finding, Findings};
use recording::intervals::{Detector, Segmentation};
use recording::watch::Stage;
use recording::{Error, Recording};
use sensor::Quantity;

use super::checks::{self, none_is_there_twice, none_is_turned};
use super::request::{Instant, Method, Request};
use crate::methods::{self, Choice, cut_several};

/// Recordings with their static intervals and turns.
#[derive(Clone, Debug)]
pub(super) struct Cut<'a> {
    /// The recordings.
    pub recordings: Vec<&'a Recording>,
    /// The settings by which each was cut.
    pub choices: Vec<Choice>,
}

impl<'a> Cut<'a> {
    /// Cuts the recordings of one device, and lists the findings about how they were cut.
    ///
    /// # Errors
    /// A recording that cannot be cut; two that hold the same readings, or whose axes are turned against each other.
    pub fn of(
        recordings: Vec<&'a Recording>,
        request: &Request,
    ) -> Result<(Self, Findings), Error> {
        let choices = cut_several(recordings.len(), &request.detector, |k, detector| {
            request.watch.step(Stage::Cutting)?;
            let request = Request {
                detector: *detector,
                ..request.clone()
            };
            cut(recordings[k], &request, Some(k))
        })?;
        let each = choices.iter().map(|choice| &choice.segmentation);
        let each = recordings.iter().copied().zip(each);
        checks::readings_of_the_device(each.clone())?;
        if !request.force_device {
            of_one_recording_each(each, request.gravity)?;
        }
        let cut = Self {
            recordings,
            choices,
        };
        let found = cut.found().collect();
        Ok((cut, found))
    }

    /// Cuts recordings for the gyroscope alone, for which no sections are given.
    ///
    /// # Errors
    /// A recording that cannot be cut.
    pub fn of_turns(
        recordings: Vec<&'a Recording>,
        request: &Request,
    ) -> Result<(Self, Findings), Error> {
        let choices = recordings.iter().map(|r| {
            request.watch.step(Stage::Cutting)?;
            cut(r, request, None)
        });
        let cut = Self {
            choices: choices.collect::<Result<_, _>>()?,
            recordings,
        };
        let found = cut.found().collect();
        Ok((cut, found))
    }

    /// The recordings with how each was cut.
    pub fn each(&self) -> impl Iterator<Item = (&'a Recording, &Segmentation)> + Clone {
        let recordings = self.recordings.iter().copied();
        recordings.zip(self.choices.iter().map(|choice| &choice.segmentation))
    }

    /// The same with the choices.
    pub fn with_choices(&self) -> impl Iterator<Item = (&'a Recording, &Choice)> {
        self.recordings.iter().copied().zip(&self.choices)
    }

    fn found(&self) -> impl Iterator<Item = Finding> {
        let each = self.recordings.iter().zip(&self.choices);
        each.flat_map(|(recording, choice)| checks::of_the_detector(recording, choice))
    }
}

/// Refuses recordings that hold the same readings, or whose axes are turned against each other's.
///
/// # Errors
/// The two recordings and what they share.
pub fn of_one_recording_each<'a>(
    cut: impl Iterator<Item = (&'a Recording, &'a Segmentation)> + Clone,
    gravity: f64,
) -> Result<(), Error> {
    none_is_there_twice(cut.clone())?;
    checks::no_rows_come_again(cut.clone().map(|(recording, _)| recording))?;
    none_is_turned(cut, gravity)
}

/// The rests and turns of a recording without those that are left out; `k` is its place among those that sections were
/// given for.
fn cut(recording: &Recording, request: &Request, k: Option<usize>) -> Result<Choice, Error> {
    let choice = whole(recording, request, k)?;
    match k {
        Some(k) => leave_out(choice, recording, k, &request.left_out),
        None => Ok(choice),
    }
}

/// The choice without the static intervals of the recording at place `k` that `instants` lie in.
///
/// # Errors
/// An instant in none of them.
pub fn leave_out(
    mut choice: Choice,
    recording: &Recording,
    k: usize,
    instants: &[Instant],
) -> Result<Choice, Error> {
    let own = instants.iter().filter(|i| i.recording == k + 1);
    let own: Vec<f64> = own.map(|instant| instant.t).collect();
    if !own.is_empty() {
        choice.segmentation = choice.segmentation.without(recording, &own)?;
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
        return Ok(Choice::given(segmentation));
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
