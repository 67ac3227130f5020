//! One recording in the layouts that apps, loggers and robots write: what the readers and the README's table are
//! tested on. Headers, units, signs and orders of axes are those of the programs; digits are as few as theirs.

mod databases;
mod layout;
mod phones;
mod robots;
mod serial;
mod trackers;

pub use layout::{Layout, Samples, session};

/// Every layout.
pub fn layouts(samples: &Samples) -> Vec<Layout> {
    let mut all = phones::layouts(samples);
    all.extend(serial::layouts(samples));
    all.extend(trackers::layouts(samples));
    all.extend(robots::layouts(samples));
    all.extend(databases::layouts(samples));
    all
}
