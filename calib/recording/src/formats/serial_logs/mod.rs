//! Lines that firmware and scripts print: their numbers behind names, labels, headings and stamps.

pub(crate) mod adafruit;
pub(crate) mod headings;
mod labelled_numbers;
mod listed_names;
mod log_prefix;
pub(crate) mod serial;
