//! A thermometer beside the sensors: joined from a file of its own, and its counts to °C.

pub(crate) mod counts;
pub(crate) mod thermometer;
