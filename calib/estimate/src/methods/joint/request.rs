//! Request for a joint fit, and disturbances known in advance.

use recording::Recording;
use recording::intervals::Segmentation;
use recording::watch::Watch;
use sensor::Model;

use super::clock::{ClockMode, SourceClock};
use super::faults::{FaultRef, Reason};
use super::fit::JointFit;
use crate::methods::joint::noise::bias::BiasNoise;

/// Request for a joint fit.
#[derive(Clone, Debug)]
pub struct JointRequest<'a> {
    /// The recordings with their rests and turns.
    pub recordings: Vec<(&'a Recording, &'a Segmentation)>,
    /// The accelerometer: base model and effects.
    pub accelerometer: Model,
    /// The gyroscope: base model and effects.
    pub gyroscope: Model,
    /// Local gravity, m/s².
    pub gravity: f64,
    /// Noise of the biases of accelerometer and gyroscope, where it is known; estimated where not.
    pub bias_noise: Option<BiasNoise>,
    /// True if the biases may have flicker noise beside their walks: the levels of both are then the likeliest.
    /// Otherwise walks alone are estimated, as averages over their possible levels with a sixth of the prior chance on
    /// no walk.
    pub flicker: bool,
    /// True if disturbed static intervals and turns are searched for and get parameters of their own, and if intervals
    /// and turns may scatter beyond all noise. Otherwise the noise is white noise and walks, with a scatter of the
    /// turns only where they miss grossly.
    pub disturbances: bool,
    /// True if static intervals and turns may scatter, without that search too, where the model misses by far more than the noise: a walk would
    /// take what differs from one to the next.
    pub scatter: bool,
    /// Disturbances known in advance, by their place in the data: each has parameters of its own, with or without a
    /// search.
    pub known: Vec<Known>,
    /// Parameters held at a value, by name.
    pub held: Vec<(String, f64)>,
    /// Parameters that begin at a value of their own, by name.
    pub starts: Vec<(String, f64)>,
    /// True if the inputs of effects are computed at the samples of turns even where no effect of the models needs
    /// them: time, temperature, specific force, angular acceleration.
    pub covariates: bool,
    /// Clock by which the turns are integrated.
    pub clock: ClockMode,
    /// The clocks of the recordings where a fit before has decided them, and with them whether something is missing between
    /// samples: how much that is, is then fitted. Without, the data decide.
    pub clocks: Option<Vec<SourceClock>>,
    /// True if this is one of many models that are compared: its minimum is then found to a thousandth of a standard
    /// error, and not to what double precision allows.
    pub compared: bool,
    /// A fit of the same recordings and intervals with other effects that looked for no disturbances: the recordings need not be
    /// cut again, and the walks begin at its.
    pub before: Option<&'a JointFit>,
    /// True if the parameters begin at the minimum of that fit too.
    pub from_its_minimum: bool,
    /// True if the readings contain a rotation of the earth that is not given: its direction is then estimated as far
    /// as the data determine it, and uncertain as far as they do not.
    pub earth: bool,
    /// Told of every step.
    pub watch: Watch,
}

impl<'a> JointRequest<'a> {
    /// Base models, walks estimated, disturbances looked for.
    pub fn new(recordings: Vec<(&'a Recording, &'a Segmentation)>, gravity: f64) -> Self {
        Self {
            recordings,
            accelerometer: accelerometer::model(),
            gyroscope: gyroscope::model(),
            gravity,
            bias_noise: None,
            flicker: false,
            disturbances: true,
            scatter: false,
            known: Vec::new(),
            held: Vec::new(),
            starts: Vec::new(),
            covariates: false,
            clock: ClockMode::default(),
            clocks: None,
            compared: false,
            before: None,
            from_its_minimum: false,
            earth: false,
            watch: Watch::default(),
        }
    }
}

impl<'a> JointRequest<'a> {
    /// The fit at whose minimum this one begins.
    pub(crate) fn minimum_before(&self) -> Option<&'a JointFit> {
        self.before.filter(|_| self.from_its_minimum)
    }
}

/// Something that is known to be disturbed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Known {
    /// The fault.
    pub fault: FaultRef,
    /// The rest, the chunk or the turn, by its place in [`super::Data`].
    pub place: usize,
    /// Why it has parameters of its own.
    pub reason: Reason,
}

impl Known {
    /// Something that was disturbed.
    pub fn disturbed(fault: FaultRef, place: usize) -> Self {
        Self {
            fault,
            place,
            reason: Reason::Disturbed,
        }
    }

    /// Returns true if both are the same fault at the same place, whatever the reason.
    pub fn is_at(&self, other: &Self) -> bool {
        self.fault == other.fault && self.place == other.place
    }
}
