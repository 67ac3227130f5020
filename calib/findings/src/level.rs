//! Weight of a finding.

use serde::{Deserialize, Serialize};

/// Weight of a finding for the use of a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Level {
    /// Good to know; the result holds as it stands.
    Remark,
    /// The result can be used with care.
    Care,
    /// The result is not to be used as it stands.
    Bad,
    /// There is no result.
    Error,
}

impl Level {
    /// `remark`, `care`, `bad` or `error`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Remark => "remark",
            Self::Care => "care",
            Self::Bad => "bad",
            Self::Error => "error",
        }
    }
}
