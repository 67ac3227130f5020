//! The words of a kind, and who reads them.

use crate::kind::Kind;
use crate::level::Level;
use crate::remedy::Remedy;

/// Who reads the words: options have other names on the command line, in Rust and in Python.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Front {
    /// Nobody in particular: options in plain English.
    #[default]
    Plain,
    /// The command line: flags.
    CommandLine,
    /// The library in Rust: fields of requests.
    Rust,
    /// Python: keyword arguments.
    Python,
}

/// The words of a kind.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// The kind.
    pub kind: Kind,
    /// Usual level.
    pub level: Level,
    /// Usual error of a corrected orientation, °, where no consequence is known ([`crate::Finding::severity`]).
    pub severity: f64,
    /// The reason in a few words, as a verdict says it.
    pub reason: &'static str,
    /// Template of the message, in sentences.
    ///
    /// `{name}` stands for a number or a word, `{sensor}` and `{at}` for the place. Text between `[` and `]` is left
    /// out if a name in it is not given.
    pub text: &'static str,
    /// Template of the advice, an imperative, where no [`Remedy`] gives it. The form is that of `text`.
    pub advice: &'static str,
    /// Usual ways out.
    pub remedies: fn() -> Vec<Remedy>,
}

impl Entry {
    /// The words of a doubt: it ends a run only where it is beyond doubt.
    pub(super) const fn doubt(
        kind: Kind,
        text: &'static str,
        advice: &'static str,
        remedies: fn() -> Vec<Remedy>,
    ) -> Self {
        Self {
            level: Level::Care,
            severity: 0.1,
            ..Self::error(kind, text, advice, remedies)
        }
    }

    /// The words of an error: it ends a run, so no verdict gives a reason for it.
    pub(super) const fn error(
        kind: Kind,
        text: &'static str,
        advice: &'static str,
        remedies: fn() -> Vec<Remedy>,
    ) -> Self {
        Self {
            kind,
            level: Level::Error,
            severity: 90.0,
            reason: "",
            text,
            advice,
            remedies,
        }
    }
}
