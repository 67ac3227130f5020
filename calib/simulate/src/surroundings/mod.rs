//! Surroundings of the device: temperature, a table that vibrates, a hand that holds it, and faults of the recording.

mod fault;
mod magnetic_field;
mod temperature;
mod unsteady;
mod vibration;

pub use fault::Fault;
pub use magnetic_field::MagneticField;
pub(crate) use magnetic_field::PlacedField;
pub use temperature::Temperature;
pub use unsteady::Unsteady;
pub use vibration::Vibration;
