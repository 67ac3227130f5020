//! The catalogue of bad inputs: each numbered case is a test of the binary under its number.
//!
//! Every file is made here. A case runs the program in a folder of its own and looks at the exit status, at what is said and
//! at what is left in the folder. Cases 133 and 141 are of `batch` and stand with its tests, `cli/tests/commands/batch.rs`.

mod bench;
mod calibrations;
mod containers;
mod corruption;
#[cfg(unix)]
mod cpu;
mod device;
mod encodings;
mod files;
mod logs;
mod motion;
#[cfg(unix)]
mod outputs;
mod plausible;
mod reading;
mod time;
mod values;
