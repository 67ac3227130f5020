//! The words of a kind, and who reads them.

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

/// Advice on the use of a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum UseOfResult {
    /// Nothing.
    Open,
    /// It may be used under a condition.
    Conditional,
    /// It must not be used.
    Forbidden,
}

/// The words of a kind.
#[derive(Clone, Debug)]
pub(crate) struct Entry {
    /// Usual level.
    pub level: Level,
    /// Usual error of a corrected orientation, °, where no consequence is known ([`crate::Finding::severity`]).
    pub severity: f64,
    /// The reason in a few words, as a verdict says it; an error ends a run, so no verdict gives a reason for it.
    pub reason: &'static str,
    /// Template of the message, in sentences.
    ///
    /// `{name}` stands for a number or a word, `{sensor}` and `{at}` for the place. Text between `[` and `]` is left
    /// out if a name in it is not given.
    pub text: &'static str,
    /// Template of the advice, an imperative, where no [`Remedy`] gives it. The form is that of `text`.
    pub advice: &'static str,
    /// Advice on the use of the result.
    pub use_of_result: UseOfResult,
    /// Usual ways out.
    pub remedies: Vec<Remedy>,
}

/// An entry of a level without words yet.
fn silent(level: Level, severity: f64) -> Entry {
    Entry {
        level,
        severity,
        reason: "",
        text: "",
        advice: "",
        use_of_result: UseOfResult::Open,
        remedies: Vec::new(),
    }
}

/// An entry that requires no action, without words yet.
pub(super) fn remark(severity: f64) -> Entry {
    silent(Level::Remark, severity)
}

/// An entry that asks for care, without words yet.
pub(super) fn care(severity: f64) -> Entry {
    silent(Level::Care, severity)
}

/// An entry that forbids the use of a result, without words yet.
pub(super) fn bad(severity: f64) -> Entry {
    silent(Level::Bad, severity)
}

/// The words of an error.
pub(super) fn error(text: &'static str, advice: &'static str) -> Entry {
    error_with(text, advice, Vec::new())
}

/// The words of an error whose ways out are the advice.
pub(super) fn error_by(text: &'static str, remedies: Vec<Remedy>) -> Entry {
    error_with(text, "", remedies)
}

/// The words of an error with advice and ways out.
pub(super) fn error_with(text: &'static str, advice: &'static str, remedies: Vec<Remedy>) -> Entry {
    Entry {
        text,
        advice,
        remedies,
        ..silent(Level::Error, 90.0)
    }
}

/// The words of a doubt: it ends a run only where it is beyond doubt.
pub(super) fn doubt(text: &'static str, advice: &'static str, remedies: Vec<Remedy>) -> Entry {
    Entry {
        text,
        advice,
        remedies,
        ..care(0.1)
    }
}
