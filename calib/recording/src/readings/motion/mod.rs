//! A device that does not lie still: held in a hand, shaken, swinging, turning slowly.

pub(in crate::readings) mod hand;
pub(in crate::readings) mod swing;
pub(in crate::readings) mod turning;
pub(in crate::readings) mod vibration;
