//! The effects that sensors of several kinds have alike: each a [`CommonEffect`](crate::CommonEffect) in a file of its own.

mod asymmetry;
mod cubic;
mod drift;
mod misalignment_temperature;
mod quadratic;
mod relaxation;
mod scale_drift;
mod scale_temperature;
mod step;
mod temperature;
mod temperature_quadratic;
mod temperature_rate;
mod thermal_hysteresis;
mod warmup;

pub use asymmetry::Asymmetry;
pub use cubic::Cubic;
pub use drift::Drift;
pub use misalignment_temperature::MisalignmentTemperature;
pub use quadratic::Quadratic;
pub use relaxation::Relaxation;
pub use scale_drift::ScaleDrift;
pub use scale_temperature::ScaleTemperature;
pub use step::Step;
pub use temperature::Temperature;
pub use temperature_quadratic::TemperatureQuadratic;
pub use temperature_rate::TemperatureRate;
pub use thermal_hysteresis::ThermalHysteresis;
pub use warmup::Warmup;
