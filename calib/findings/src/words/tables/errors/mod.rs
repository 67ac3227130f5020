//! Words of errors: findings that end a run.

pub(super) mod files;
pub(super) mod recordings;
pub(super) mod requests;
pub(super) mod search;
