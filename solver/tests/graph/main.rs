//! Graphs of blocks and factors.

#![allow(clippy::unwrap_used)]

mod bounds;
mod losses;
mod minima;
mod observed;
mod random_graphs;
mod report;
