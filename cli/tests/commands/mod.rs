//! Commands, each in a file of its name.

mod batch;
mod convert;
mod discover;
mod live;
mod plan;
