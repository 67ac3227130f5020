//! Texts whose stamps are in several cells, without an end, or none at all.

pub(crate) mod clock_columns;
pub(crate) mod clock_text;
pub(crate) mod date_and_time;
pub(crate) mod split_stamp;
pub(crate) mod start_and_rate;
pub(crate) mod unpadded;
