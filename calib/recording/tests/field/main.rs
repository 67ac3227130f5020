//! Files of programs met in the field: what they hold is read as it was meant, or what is missing is said with the option
//! that helps.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

mod apps;
mod boards;
mod columns;
mod formats;
mod languages;
mod layouts;
mod lines;
mod loggers;
mod session;
mod stamps;
