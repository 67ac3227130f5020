//! Columns that are not understood: which they are, and the `--columns` line that answers.

pub(crate) mod likely;
pub(crate) mod said_rate;
pub(crate) mod suggest;
pub(crate) mod unclear;
