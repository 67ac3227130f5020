//! Covariates of an error, by name.

use std::fmt;

use serde::{Deserialize, Serialize};
use solver::{Scalar, lit};

use crate::axis::Axis;
use crate::kinematics::{Kinematics, REFERENCE_TEMPERATURE};

/// One number of the true motion or its surroundings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub enum Covariate {
    /// `fx`: specific force, m/s².
    SpecificForce(Axis),
    /// `wx`: angular rate, rad/s.
    AngularRate(Axis),
    /// `alphax`: derivative of the angular rate, rad/s².
    AngularAcceleration(Axis),
    /// `vibrationx`: mean square of the vibration, (m/s²)².
    Vibration(Axis),
    /// `changex`: sign of the last change of specific force, −1, 0 or 1.
    LastChange(Axis),
    /// `t`: time since the start of the recording, s.
    Time,
    /// `T`: temperature, °C.
    Temperature,
    /// `dT`: temperature less [`REFERENCE_TEMPERATURE`], K.
    TemperatureChange,
    /// `rateT`: derivative of the temperature, K/s.
    TemperatureRate,
    /// `warming`: sign of the last change of temperature, −1, 0 or 1.
    Warming,
    /// `turnx`: rotation vector of the last turn that is over, rad.
    LastTurn(Axis),
    /// `sinceturn`: time since the end of the last turn, s.
    SinceTurn,
    /// `abs(fx)`: size of the specific force along an axis, m/s².
    ForceSize(Axis),
    /// `abs(wx)`: size of the angular rate about an axis, rad/s.
    RateSize(Axis),
}

/// Unit of a product of covariates: powers of (m/s², rad/s, rad/s², s, K).
pub(crate) type Dimension = [i32; 6];

impl Covariate {
    /// Those with a name of their own in expressions: all but the sizes, which functions make of the others.
    pub fn all() -> impl Iterator<Item = Self> {
        let triads = [
            Self::SpecificForce,
            Self::AngularRate,
            Self::AngularAcceleration,
            Self::Vibration,
            Self::LastChange,
            Self::LastTurn,
        ];
        let triads = triads.into_iter().flat_map(|kind| Axis::ALL.map(kind));
        triads.chain([
            Self::Time,
            Self::Temperature,
            Self::TemperatureChange,
            Self::TemperatureRate,
            Self::Warming,
            Self::SinceTurn,
        ])
    }

    /// Its name in expressions.
    pub fn name(self) -> String {
        match self {
            Self::SpecificForce(axis) => format!("f{axis}"),
            Self::AngularRate(axis) => format!("w{axis}"),
            Self::AngularAcceleration(axis) => format!("alpha{axis}"),
            Self::Vibration(axis) => format!("vibration{axis}"),
            Self::LastChange(axis) => format!("change{axis}"),
            Self::Time => "t".to_owned(),
            Self::Temperature => "T".to_owned(),
            Self::TemperatureChange => "dT".to_owned(),
            Self::TemperatureRate => "rateT".to_owned(),
            Self::Warming => "warming".to_owned(),
            Self::LastTurn(axis) => format!("turn{axis}"),
            Self::SinceTurn => "sinceturn".to_owned(),
            Self::ForceSize(axis) => format!("abs(f{axis})"),
            Self::RateSize(axis) => format!("abs(w{axis})"),
        }
    }

    /// The same covariate of the next axis, x after z; one without an axis is itself.
    #[must_use]
    pub fn on_next_axis(self) -> Self {
        match self {
            Self::SpecificForce(axis) => Self::SpecificForce(axis.following()),
            Self::AngularRate(axis) => Self::AngularRate(axis.following()),
            Self::AngularAcceleration(axis) => Self::AngularAcceleration(axis.following()),
            Self::Vibration(axis) => Self::Vibration(axis.following()),
            Self::LastChange(axis) => Self::LastChange(axis.following()),
            Self::LastTurn(axis) => Self::LastTurn(axis.following()),
            Self::ForceSize(axis) => Self::ForceSize(axis.following()),
            Self::RateSize(axis) => Self::RateSize(axis.following()),
            other => other,
        }
    }

    /// Its value in `truth`.
    pub fn value<D: Scalar>(self, truth: &Kinematics<D>) -> D {
        match self {
            Self::SpecificForce(axis) => truth.specific_force[axis.index()],
            Self::AngularRate(axis) => truth.angular_rate[axis.index()],
            Self::AngularAcceleration(axis) => lit(truth.angular_acceleration[axis.index()]),
            Self::Vibration(axis) => lit(truth.vibration[axis.index()]),
            Self::LastChange(axis) => lit(truth.last_change[axis.index()]),
            Self::Time => lit(truth.time),
            Self::Temperature => lit(truth.temperature),
            Self::TemperatureChange => lit(truth.temperature - REFERENCE_TEMPERATURE),
            Self::TemperatureRate => lit(truth.temperature_rate),
            Self::Warming => lit(truth.warming),
            Self::LastTurn(axis) => lit(truth.last_turn[axis.index()]),
            Self::SinceTurn => lit(truth.since_turn.middle()),
            Self::ForceSize(axis) => truth.specific_force[axis.index()].abs(),
            Self::RateSize(axis) => truth.angular_rate[axis.index()].abs(),
        }
    }

    /// The same in Rust, for an instant called `truth`.
    pub(crate) fn source(self) -> String {
        match self {
            Self::SpecificForce(axis) => format!("truth.specific_force.{axis}"),
            Self::AngularRate(axis) => format!("truth.angular_rate.{axis}"),
            Self::AngularAcceleration(axis) => format!("truth.angular_acceleration.{axis}"),
            Self::Vibration(axis) => format!("truth.vibration.{axis}"),
            Self::LastChange(axis) => format!("truth.last_change.{axis}"),
            Self::Time => "truth.time".to_owned(),
            Self::Temperature => "truth.temperature".to_owned(),
            Self::TemperatureChange => "(truth.temperature - REFERENCE_TEMPERATURE)".to_owned(),
            Self::TemperatureRate => "truth.temperature_rate".to_owned(),
            Self::Warming => "truth.warming".to_owned(),
            Self::LastTurn(axis) => format!("truth.last_turn.{axis}"),
            Self::SinceTurn => "truth.since_turn.middle()".to_owned(),
            Self::ForceSize(axis) => format!("truth.specific_force.{axis}.abs()"),
            Self::RateSize(axis) => format!("truth.angular_rate.{axis}.abs()"),
        }
    }

    /// Returns the meaning of the covariate and its unit.
    pub(crate) fn meaning(self) -> (&'static str, &'static str) {
        match self {
            Self::SpecificForce(_) => ("specific force", "m/s²"),
            Self::AngularRate(_) => ("angular rate", "rad/s"),
            Self::AngularAcceleration(_) => ("angular acceleration", "rad/s²"),
            Self::Vibration(_) => ("mean square of the vibration", "(m/s²)²"),
            Self::LastChange(_) => ("sign of the last change of specific force", "1"),
            Self::Time => ("time", "s"),
            Self::Temperature => ("temperature", "°C"),
            Self::TemperatureChange => ("temperature less `REFERENCE_TEMPERATURE`", "K"),
            Self::TemperatureRate => ("derivative of the temperature", "K/s"),
            Self::Warming => ("sign of the last change of temperature", "1"),
            Self::LastTurn(_) => ("rotation vector of the last turn", "rad"),
            Self::SinceTurn => ("time since the end of the last turn", "s"),
            Self::ForceSize(_) => ("size of the specific force along an axis", "m/s²"),
            Self::RateSize(_) => ("size of the angular rate about an axis", "rad/s"),
        }
    }

    pub(crate) fn dimension(self) -> Dimension {
        match self {
            Self::SpecificForce(_) | Self::ForceSize(_) => [1, 0, 0, 0, 0, 0],
            Self::AngularRate(_) | Self::RateSize(_) => [0, 1, 0, 0, 0, 0],
            Self::AngularAcceleration(_) => [0, 0, 1, 0, 0, 0],
            Self::Vibration(_) => [2, 0, 0, 0, 0, 0],
            Self::LastChange(_) | Self::Warming | Self::LastTurn(_) => [0; 6],
            Self::Time | Self::SinceTurn => [0, 0, 0, 1, 0, 0],
            Self::Temperature | Self::TemperatureChange => [0, 0, 0, 0, 1, 0],
            Self::TemperatureRate => [0, 0, 0, -1, 1, 0],
        }
    }
}

impl fmt::Display for Covariate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.name())
    }
}

impl From<Covariate> for String {
    fn from(covariate: Covariate) -> Self {
        covariate.name()
    }
}

/// A name that no covariate has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NoSuchCovariate(pub String);

impl fmt::Display for NoSuchCovariate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "no covariate `{}`", self.0)
    }
}

impl std::error::Error for NoSuchCovariate {}

impl TryFrom<String> for Covariate {
    type Error = NoSuchCovariate;

    fn try_from(name: String) -> Result<Self, NoSuchCovariate> {
        let sizes = [Self::ForceSize, Self::RateSize];
        let sizes = sizes.into_iter().flat_map(|kind| Axis::ALL.map(kind));
        let known = Self::all().chain(sizes).find(|c| c.name() == name);
        known.ok_or(NoSuchCovariate(name))
    }
}
