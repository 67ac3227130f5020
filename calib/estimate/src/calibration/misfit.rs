//! Residuals of a calibration on its own recordings, before any error is inflated.

use findings::{Finding, Kind, names};
use sensor::Sensor;
use serde::{Deserialize, Serialize};

use crate::methods::chance;
use crate::methods::joint::{Channel, ChannelMisfit, Pattern, Shown};

findings::tuning! {
    /// A misfit above this many times the noise is worth a warning where chance does not explain it and walks of the
    /// biases are counted as noise.
    pub WITH_WALKS: f64 = std::f64::consts::SQRT_2;

    /// The same where walks are not told from a misfit.
    pub WITHOUT_WALKS: f64 = 3.0;

    /// By chance in fewer cases than this.
    UNLIKELY: f64 = 1e-4;
}

/// Probabilities are stated down to this.
const LEAST_CHANCE: f64 = 1e-300;

/// One kind of comparison between a calibration and its recordings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Remainder {
    /// `static_norm` (norm of specific force at static intervals), `static_rate` (rate there), `direction` (gravity carried
    /// through turns).
    pub channel: Channel,
    /// Root mean square of what is left, in `unit`.
    pub rms: f64,
    /// Root mean square predicted from the measured noise, random walks of the biases included, in `unit`.
    pub noise: f64,
    /// `m/s^2`, `rad/s` or `rad`.
    pub unit: String,
    /// `χ²` per degree of freedom against that noise: 1 where nothing is missing.
    pub reduced_chi2: f64,
    /// Degrees of freedom.
    pub degrees_of_freedom: f64,
    /// Probability of so much by noise alone.
    pub p_value: f64,
    /// The likeliest dependence on the orientation, where there is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pattern: Option<Pattern>,
    /// Probability that noise and walks alone show it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pattern_p_value: Option<f64>,
}

impl Remainder {
    /// Builds it from the `rms` of a kind of rows and its reduced chi-square with `dof` degrees of freedom.
    pub fn new(channel: Channel, rms: f64, reduced_chi2: f64, dof: f64) -> Self {
        Self {
            channel,
            rms,
            noise: if reduced_chi2 > 0.0 {
                rms / reduced_chi2.sqrt()
            } else {
                rms
            },
            unit: unit(channel).into(),
            reduced_chi2,
            degrees_of_freedom: dof,
            p_value: chance::of_chi2(reduced_chi2 * dof, dof),
            pattern: None,
            pattern_p_value: None,
        }
    }

    /// The same with what it depends on.
    pub fn depending(self, shown: Option<Shown>) -> Self {
        Self {
            pattern: shown.map(|shown| shown.pattern),
            pattern_p_value: shown.map(|shown| shown.p_value),
            ..self
        }
    }

    /// Builds it from a channel of the joint fit.
    pub fn of(misfit: &ChannelMisfit) -> Self {
        let (rms, reduced_chi2) = (misfit.rms, misfit.chi2 / misfit.dof);
        Self {
            p_value: misfit.p_value,
            ..Self::new(misfit.channel, rms, reduced_chi2, misfit.dof).depending(misfit.pattern)
        }
    }

    /// A finding where more than `limit` times the noise is left and chance does not explain it.
    pub fn finding(&self, limit: f64) -> Option<Finding> {
        let ratio = self.reduced_chi2.sqrt();
        let much = ratio > limit && self.p_value < UNLIKELY.get();
        if !much && self.pattern.is_none() {
            return None;
        }
        let unit = unit(self.channel);
        let left = (self.rms.powi(2) - self.noise.powi(2)).max(0.0).sqrt();
        let of = match self.channel {
            Channel::Direction => "turn",
            Channel::Force | Channel::Rate => "corrected_reading",
        };
        let found = Finding::of(Kind::MISFIT)
            .of_sensor(match self.channel {
                Channel::Force => Sensor::Accelerometer,
                Channel::Rate | Channel::Direction => Sensor::Gyroscope,
            })
            .detail("channel", self.what())
            .number("rms", self.rms, unit)
            .number("noise", self.noise, unit)
            .number("ratio", ratio, "1")
            .number("dof", self.degrees_of_freedom, "count")
            .detail("p", chance(self.p_value))
            .affects(of, left, unit);
        Some(match self.pattern {
            None => found,
            Some(pattern) => {
                let p = chance(self.pattern_p_value.unwrap_or(0.0));
                found
                    .detail("pattern", like(pattern))
                    .detail("pattern_p", p)
            }
        })
    }

    /// `length of the accelerometer's reading at rest`.
    pub fn what(&self) -> &'static str {
        match self.channel {
            Channel::Force => names::NORM_AT_REST,
            Channel::Rate => names::RATE_AT_REST,
            Channel::Direction => names::DIRECTION,
        }
    }

    /// A size in units for people.
    pub fn in_words(&self, size: f64) -> String {
        match self.channel {
            Channel::Force => format!("{:.2} mm/s²", 1e3 * size),
            Channel::Rate => format!("{:.1} °/h", size.to_degrees() * 3600.0),
            Channel::Direction => format!("{:.4}°", size.to_degrees()),
        }
    }
}

/// Returns the name of the error that shows such a dependence on the orientation.
fn like(pattern: Pattern) -> &'static str {
    match pattern {
        Pattern::Quadratic => names::QUADRATIC,
        Pattern::Asymmetry => names::ASYMMETRY,
        Pattern::Cubic => names::CUBIC,
        Pattern::History => names::HISTORY,
        Pattern::Force => names::FORCE,
    }
}

/// `= 2e-17`, or `< 1e-300` where no number is that small.
fn chance(p: f64) -> String {
    if p < LEAST_CHANCE {
        format!("< {LEAST_CHANCE:.0e}")
    } else {
        format!("= {p:.0e}")
    }
}

fn unit(channel: Channel) -> &'static str {
    match channel {
        Channel::Force => "m/s^2",
        Channel::Rate => "rad/s",
        Channel::Direction => "rad",
    }
}
