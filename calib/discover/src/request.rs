//! Request and session of a search.

use std::borrow::{Borrow, Cow};
use std::sync::Arc;

use ::findings::Kind;
use effects::{catalogue_of, follows_turns, stands_in_the_room};
use estimate::calibrate::{
    Instant, Prepared, corrected_before, leave_out, of_the_detector, own_effects,
};
use estimate::gravity::GravitySource;
use estimate::methods::joint::{BiasNoise, ClockMode, IN_A_SEARCH, JointFit, SourceClock};
use estimate::methods::{Choice, cut, cut_several};
use recording::intervals::Detector;
use recording::watch::{Stage, Watch};
use recording::{Error, Recording};
use sensor::{EffectRef, Nature, Quantity, Role, Sensor};

/// Settings of a search for missing effects.
#[derive(Clone, Debug)]
pub struct Request {
    /// Local gravity, m/s².
    pub gravity: f64,
    /// Source of that value.
    pub gravity_source: GravitySource,
    /// Chance of any false claim about recordings of a device that lacks nothing: half of it for names of effects, a quarter for
    /// faults of the recording that models show, a quarter for saying that something is unexplained.
    pub alpha: f64,
    /// Noise of the biases, where it is known.
    pub noise: Option<BiasNoise>,
    /// Latitude, degrees north: the earth's rotation is then part of the base model.
    pub latitude: Option<f64>,
    /// By which clock the turns are integrated.
    pub clock: ClockMode,
    /// The detector of motion.
    pub detector: Detector,
    /// True if the detector's multiplier is chosen by the residual of the accelerometer's fit.
    pub choose_multiplier: bool,
    /// Static intervals to leave out, each by an instant within it.
    pub left_out: Vec<Instant>,
    /// True if recordings that look like those of different devices are accepted as those of one.
    pub force_device: bool,
    /// True if flicker (1/f) noise of the biases is estimated beside their random walks. It can absorb errors that depend
    /// on the placement, as an effect does.
    pub flicker: bool,
    /// The effects that may be missing.
    pub catalogue: Vec<EffectRef>,
    /// Told of every step.
    pub watch: Watch,
}

impl Request {
    /// The share of the chance of a false claim that an unexplained rest may take.
    pub fn alpha_of_rest(&self) -> f64 {
        0.25 * self.alpha
    }

    /// The evidence that the name of an effect needs: it has paid for the half of [`Request::alpha`] that is not its own.
    pub fn threshold(&self) -> f64 {
        -self.alpha.ln()
    }

    /// The request of one run over these recordings: effects that a user wrote have the steps that its fits need.
    pub(crate) fn granted<R: Borrow<Recording>>(&self, recordings: &[R]) -> Self {
        Self {
            catalogue: own_effects::granted(&self.catalogue, recordings.iter().map(R::borrow)),
            ..self.clone()
        }
    }

    /// The effects that may be missing from the base model.
    pub fn candidates(&self) -> Vec<EffectRef> {
        let is_given = |effect: &EffectRef| {
            self.latitude.is_some() && effect.nature() == Nature::EarthRotation
        };
        let mut all = self.catalogue.clone();
        all.retain(|effect| !is_given(effect) && is_looked_for(effect));
        all
    }

    /// Those of them that may be missing from recordings of which this is said. A device that turns while it should rest moves gravity in its
    /// axes, and its gyroscope reads that rate: biases that go by time alone would be named for it.
    fn candidates_beside(&self, said: &::findings::Findings) -> Vec<EffectRef> {
        let mut all = self.candidates();
        if said.has(Kind::RESTS_TURN) {
            all.retain(|effect| effect.needs() != [Quantity::Time]);
        }
        all
    }

    /// One in a hundred, densities unknown, the whole catalogue.
    pub fn new(gravity: f64) -> Self {
        Self {
            gravity,
            gravity_source: GravitySource::Given,
            alpha: 0.01,
            noise: None,
            flicker: false,
            latitude: None,
            clock: ClockMode::default(),
            detector: Detector::default(),
            choose_multiplier: true,
            left_out: Vec::new(),
            force_device: false,
            catalogue: catalogue_of(Sensor::Accelerometer)
                .chain(catalogue_of(Sensor::Gyroscope))
                .collect(),
            watch: Watch::default(),
        }
    }
}

/// Returns true if an effect is a candidate.
///
/// Effects with a shape of their own (a relaxation after turns, a period) and those fixed in the room are described as a
/// remainder instead: on recordings of a phone they displaced simpler names, or their fits did not converge.
/// `calibrate --effects` has them all.
fn is_looked_for(effect: &EffectRef) -> bool {
    let params = effect.params();
    let is_periodic = params.iter().any(|p| p.role == Role::Shape);
    let is_described = stands_in_the_room(effect) || follows_turns(effect) || is_periodic;
    effect.definition().is_some() || !is_described
}

/// Recordings of one device, cut, with all that stays the same while models change.
#[derive(Clone, Debug)]
pub struct Session<'a> {
    /// The recordings made ready, with their static intervals and turns.
    pub recordings: Vec<(Cow<'a, Recording>, Choice)>,
    /// The parts that a search takes them in, each with the number of its recording: one of each, but of a long one.
    parts: Vec<(usize, Choice)>,
    /// The recordings as they were read.
    pub originals: Vec<&'a Recording>,
    /// The request for them, with the flicker and the latitude that the search has found since.
    pub request: Request,
    /// The effects that may be missing.
    pub candidates: Vec<EffectRef>,
    /// The clocks, once the base models have shown them: models that are compared have noise of the same kind.
    pub clocks: Option<Vec<SourceClock>>,
    /// A fit that others begin at: that of the base models, once it is there.
    pub base: Option<Arc<JointFit>>,
    /// Findings about the recordings: what reading them said, what was done to make them ready, and the static intervals in use
    /// where there are more than the joint problem takes.
    pub remarks: ::findings::Findings,
}

impl<'a> Session<'a> {
    /// The session of one run: effects that a user wrote have the steps that its fits need.
    ///
    /// # Errors
    /// As [`cut`].
    pub(crate) fn of(recordings: &'a [&'a Recording], request: &Request) -> Result<Self, Error> {
        Self::new(recordings, &request.granted(recordings))
    }

    /// Cuts the recordings.
    ///
    /// # Errors
    /// As [`cut`].
    pub fn new<R: Borrow<Recording>>(
        recordings: &'a [R],
        request: &Request,
    ) -> Result<Self, Error> {
        let detector = Detector {
            shaken: true,
            creeping: true,
            ..request.detector
        };
        let choose = request.choose_multiplier;
        let ready = Prepared::of(recordings.iter().map(R::borrow));
        let all = ready.all();
        let choices = cut_several(all.len(), &detector, |k, detector| {
            request.watch.step(Stage::Cutting)?;
            let choice = cut(all[k], detector, choose, request.gravity)?;
            leave_out(choice, all[k], k, &request.left_out)
        })?;
        let mut remarks = ready.remarks.clone();
        for (recording, choice) in all.iter().zip(&choices) {
            remarks.extend(of_the_detector(recording, choice));
            remarks.extend(corrected_before(recording, &choice.segmentation));
        }
        let parts = choices.iter().enumerate().flat_map(|(number, choice)| {
            let parts = choice.in_parts(IN_A_SEARCH).into_iter();
            parts.map(move |part| (number, part))
        });
        Ok(Self {
            candidates: request.candidates_beside(&remarks),
            remarks,
            originals: ready.originals,
            parts: parts.collect(),
            recordings: ready.recordings.into_iter().zip(choices).collect(),
            request: request.clone(),
            clocks: None,
            base: None,
        })
    }

    /// The recordings made ready.
    pub fn ready(&self) -> Vec<&Recording> {
        self.recordings.iter().map(|(r, _)| r.as_ref()).collect()
    }

    /// The parts that a search takes the recordings in, in their order, each with its recording.
    pub fn parts(&self) -> impl Iterator<Item = (&Recording, &Choice)> + Clone {
        let parts = self.parts.iter();
        parts.map(|(number, part)| (self.recordings[*number].0.as_ref(), part))
    }

    /// The recording of each part: those of a fit.
    pub(crate) fn recordings_of_parts(&self) -> Vec<&Recording> {
        self.parts().map(|(own, _)| own).collect()
    }

    /// Returns true if a recording is taken in parts.
    pub(crate) fn is_long(&self) -> bool {
        self.parts.len() > self.recordings.len()
    }

    /// The place of a recording's first part among all parts.
    pub(crate) fn first_part_of(&self, recording: usize) -> Option<usize> {
        self.parts
            .iter()
            .position(|(number, _)| *number == recording)
    }
}
