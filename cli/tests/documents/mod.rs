//! The manual and the files that the program writes for others.

mod apps_and_loggers;
mod blocks;
mod book;
mod experiment;
mod export;
mod manual;
