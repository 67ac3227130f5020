//! Formats of smartphone apps.

pub(crate) mod androsensor;
pub(crate) mod phyphox;
pub(crate) mod physics_toolbox;
pub(crate) mod sensor_logger;
pub(crate) mod sensorlog;
pub(crate) mod sensorstream;
