//! What surrounds the device: temperature, a table that vibrates, a hand that holds it, and what goes wrong.

mod fault;
mod temperature;
mod unsteady;
mod vibration;

pub use fault::Fault;
pub use temperature::Temperature;
pub use unsteady::Unsteady;
pub use vibration::Vibration;
