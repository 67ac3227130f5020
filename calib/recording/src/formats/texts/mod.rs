//! Texts of comma-separated and other cells that no single program writes.

pub(crate) mod axis_rows;
pub(crate) mod brackets;
pub(crate) mod documents;
pub(crate) mod fields;
mod gathered;
pub(crate) mod labview;
pub(crate) mod long;
pub(crate) mod per_axis;
pub(crate) mod places;
mod stamps;
pub(crate) mod tagged;
mod text_format;
pub(crate) mod two_headers;
pub(crate) mod wide;

pub(crate) use stamps::{
    clock_columns, clock_text, date_and_time, split_stamp, start_and_rate, unpadded,
};
pub(crate) use text_format::TextFormat;
