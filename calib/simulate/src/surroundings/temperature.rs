//! The temperature of the device.

use serde::{Deserialize, Serialize};

/// `T(t) = ambient + drift t + swing sin(2πt/period) + self_heating (1 − exp(−t/tau))`, and the
/// thermometer that reads it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "snake_case")]
pub struct Temperature {
    /// °C.
    pub ambient: f64,
    /// K/s.
    pub drift: f64,
    /// Amplitude of a slow swing, K.
    pub swing: f64,
    /// Its period, s.
    pub period: f64,
    /// Temperature rise by the device's own heat, K.
    pub self_heating: f64,
    /// Time constant of the warming, s.
    pub tau: f64,
    /// Thermometer readings per second.
    pub rate: f64,
    /// Thermometer noise (standard deviation), K.
    pub noise: f64,
}

impl Default for Temperature {
    fn default() -> Self {
        Self {
            ambient: 25.0,
            drift: 0.0,
            swing: 0.0,
            period: 600.0,
            self_heating: 8.0,
            tau: 180.0,
            rate: 1.0,
            noise: 0.02,
        }
    }
}

impl Temperature {
    /// Its derivative at time `t` (s), K/s.
    pub fn rate_at(&self, t: f64) -> f64 {
        let per = std::f64::consts::TAU / self.period;
        let swing = self.swing * per * (per * t).cos();
        self.drift + swing + self.self_heating / self.tau * (-t / self.tau).exp()
    }

    /// True temperature at time `t` (s), °C.
    pub fn at(&self, t: f64) -> f64 {
        let swing = self.swing * (std::f64::consts::TAU * t / self.period).sin();
        self.ambient + self.drift * t + swing - self.self_heating * (-t / self.tau).exp_m1()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn after_one_time_constant_63_percent_of_the_warming_is_done() {
        let temperature = Temperature {
            self_heating: 10.0,
            tau: 100.0,
            ..Temperature::default()
        };
        assert!((temperature.at(100.0) - 25.0 - 6.321_205_588).abs() < 1e-8);
        assert_eq!(temperature.at(0.0), 25.0);
    }
}
