//! What to fit, and what may be wrong with the data.

use recording::Recording;
use recording::intervals::Segmentation;
use sensor::Model;

use super::clock::{ClockMode, DecidedClock};
use super::disturbance::{Disturbance, Reason};
use super::fit::JointFit;
use crate::methods::joint::noise::bias::BiasNoise;

/// What to fit.
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
    /// Whether the biases may flicker as well as walk: both are then at their likeliest. Without, walks alone are
    /// estimated, as averages over what they may be with a sixth of the prior chance on none.
    pub flicker: bool,
    /// Whether rests and turns that something disturbed are looked for and get parameters of their own, and
    /// whether rests and turns may scatter beyond all noise. Without, the noise is white noise and walks, and
    /// every row is believed.
    pub disturbances: bool,
    /// What is known to be disturbed, by its place in the data: parameters of their own whatever is looked for.
    pub known: Vec<Known>,
    /// Parameters held at a value, by name.
    pub held: Vec<(String, f64)>,
    /// Parameters that begin at a value of their own, by name.
    pub starts: Vec<(String, f64)>,
    /// Whether what effects ask for is worked out at the samples of turns even where no effect of the
    /// models asks for it: time, temperature, specific force, angular acceleration.
    pub covariates: bool,
    /// Which clock the turns are integrated by.
    pub clock: ClockMode,
    /// The clocks of the recordings where a fit before has decided them, and with them whether something is missing between
    /// samples: how much that is, is then fitted. Without, the data decide.
    pub clocks: Option<Vec<DecidedClock>>,
    /// Whether this is one of many models that are compared: its minimum is then found to a thousandth of a standard error, and not
    /// to what double precision allows.
    pub compared: bool,
    /// A fit of the same recordings and intervals with other effects that looked for no disturbances: the recordings need not be
    /// cut again, and the walks begin at its.
    pub before: Option<&'a JointFit>,
    /// Whether the parameters begin at its minimum too.
    pub from_its_minimum: bool,
    /// Whether the readings contain a rotation of the earth that nobody says: its direction is then estimated as far as
    /// the data show it, and uncertain as far as they do not.
    pub earth: bool,
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
    /// What happened.
    pub kind: Disturbance,
    /// The rest, the chunk or the turn, by its place in [`super::Data`].
    pub place: usize,
    /// Why it has parameters of its own.
    pub reason: Reason,
}

impl Known {
    /// Something that was disturbed.
    pub fn disturbed(kind: Disturbance, place: usize) -> Self {
        Self {
            kind,
            place,
            reason: Reason::Disturbed,
        }
    }

    /// Whether both are the same thing at the same place, for whatever reason.
    pub fn is_at(&self, other: &Self) -> bool {
        (self.kind, self.place) == (other.kind, other.place)
    }
}
