//! Placeholder until the reader is in.

#[derive(Debug, Default, Clone, clap::Args)]
pub struct ReadArgs {}
