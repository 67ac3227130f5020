//! Kinds of findings: the physical cause or the consequence of each, by a stable name.

/// Physical cause or consequence that a finding names. The names are stable.
///
/// Each kind is a constant that is declared beside its words, in a file for each subject (`words/tables`).
///
/// # Examples
/// ```
/// use stillpoint_findings::Kind;
///
/// assert_eq!(Kind::SATURATED.name(), "saturated");
/// assert_eq!(Kind::named("saturated"), Kind::SATURATED);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Kind(&'static str);

impl Kind {
    /// The kind of this name.
    pub(crate) const fn of(name: &'static str) -> Self {
        Self(name)
    }

    /// Name in snake case, as documents have it.
    pub const fn name(self) -> &'static str {
        self.0
    }
}
