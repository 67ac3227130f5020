//! Texts of comma-separated and other cells that no single program writes.

pub(crate) mod brackets;
pub(crate) mod clock_text;
pub(crate) mod date_and_time;
pub(crate) mod labview;
pub(crate) mod long;
pub(crate) mod per_axis;
pub(crate) mod places;
pub(crate) mod split_stamp;
pub(crate) mod start_and_rate;
pub(crate) mod tagged;
mod text_format;
pub(crate) mod unpadded;
pub(crate) mod wide;

pub(crate) use text_format::TextFormat;
