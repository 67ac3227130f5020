//! Lines that firmware and scripts print: their numbers behind names, labels, headings and stamps.

pub(crate) mod adafruit;
pub(crate) mod axis_lines;
pub(crate) mod headings;
mod labelled_numbers;
mod listed_names;
mod log_prefix;
mod one_number;
pub(crate) mod serial;
pub(crate) mod tagged_rows;
mod words;
