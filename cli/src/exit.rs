//! Exit statuses and the messages that go with them.

use calib::Error;
use findings::{Finding, Front};
use serde_json::{Value, json};

use crate::quoted::{path as shown_path, shortened};

/// Done, but a quality gate failed.
pub const GATE: u8 = 1;
/// The call is wrong.
pub const USAGE: u8 = 2;
/// An input is unreadable or invalid.
pub const INPUT: u8 = 3;
/// Not enough information.
pub const NOT_ENOUGH: u8 = 4;
/// Did not converge.
pub const NOT_CONVERGED: u8 = 5;
/// An output could not be written.
pub const OUTPUT: u8 = 6;
/// A bug of ours.
pub const BUG: u8 = 7;
/// Interrupted.
pub const INTERRUPTED: u8 = 130;

/// Why the program ends early or with a status other than 0.
#[derive(Debug)]
pub struct Failure {
    /// Exit status.
    pub code: u8,
    /// The kind of failure, for programs.
    pub kind: &'static str,
    /// Message on standard error.
    pub message: String,
    /// The file that the message is about, where that is known.
    pub file: Option<String>,
    /// Advice, where there is any; the message ends with it.
    pub advice: Option<String>,
    /// The finding that ended the run, where a library had it.
    pub finding: Option<Box<Finding>>,
}

impl Failure {
    /// With a status and a message.
    pub fn new(code: u8, message: impl Into<String>) -> Self {
        let kind = match code {
            0 => "nothing_to_do",
            GATE => "gate",
            USAGE => "usage",
            INPUT => "input",
            NOT_ENOUGH => "not_enough_information",
            NOT_CONVERGED => "not_converged",
            OUTPUT => "output",
            INTERRUPTED => "interrupted",
            _ => "bug",
        };
        Self {
            code,
            kind,
            message: message.into(),
            file: None,
            advice: None,
            finding: None,
        }
    }

    /// The same about a file, with which the message begins.
    pub fn in_file(mut self, name: impl Into<String>) -> Self {
        let name = name.into();
        self.message = format!("{name}: {}", self.message);
        self.file = Some(name);
        self
    }

    /// The same with what to do about it, with which the message ends.
    pub fn advise(mut self, advice: impl Into<String>) -> Self {
        let advice = advice.into();
        self.message = format!("{}; {advice}", self.message);
        self.advice = Some(advice);
        self
    }

    /// The call is wrong.
    pub fn usage(message: impl Into<String>) -> Self {
        Self::new(USAGE, message)
    }

    /// Builds the failure of a finding.
    pub fn of(code: u8, finding: Finding) -> Self {
        let message = finding.text(Front::CommandLine);
        Self {
            file: finding.place.file.clone(),
            advice: finding.advice(Front::CommandLine),
            finding: Some(Box::new(finding)),
            ..Self::new(code, message)
        }
    }

    /// An output is there already.
    pub fn exists(message: impl Into<String>) -> Self {
        Self {
            kind: "output_exists",
            ..Self::new(OUTPUT, message)
        }
    }

    /// Nothing is left to do: status 0.
    pub fn nothing_to_do(message: impl Into<String>) -> Self {
        Self::new(0, message)
    }

    /// After a panic, whose own message is on standard error already.
    pub fn bug() -> Self {
        Self::new(
            BUG,
            "this is a bug of ours: please report the message above and the command",
        )
    }

    /// The document that `--json` prints: kind, status, message, place and next step.
    pub fn document(&self) -> Value {
        let message = shortened(&self.message);
        if self.code == 0 {
            return json!({"nothing_to_do": message});
        }
        let found = self.finding.as_deref();
        json!({"error": {
            "kind": self.kind,
            "exit": self.code,
            "message": message,
            "file": self.file,
            "line": found.and_then(|f| f.place.line),
            "column": found.and_then(|f| f.place.column),
            "next": self.advice.as_deref().unwrap_or(self.usual_step()),
            "finding": found,
        }})
    }

    /// General advice on the exit status.
    fn usual_step(&self) -> &'static str {
        match self.code {
            USAGE => "see stillpoint COMMAND --help",
            INPUT => "correct the input at the place named, or export it again",
            NOT_ENOUGH => "record more, as the message says",
            NOT_CONVERGED => "look at the static intervals with stillpoint segment",
            OUTPUT => "choose another output",
            INTERRUPTED => "run the command again",
            GATE => "do not use the result",
            _ => "report the command and its message",
        }
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        let code = match error {
            Error::Usage(_) | Error::Parts { .. } => USAGE,
            Error::NotEnough(_) => NOT_ENOUGH,
            Error::Output { .. } => OUTPUT,
            Error::NotConverged(_) | Error::Solver(_) => NOT_CONVERGED,
            Error::Cancelled => INTERRUPTED,
            _ => INPUT,
        };
        Self::of(code, error.finding())
    }
}

impl From<::output::Error> for Failure {
    fn from(error: ::output::Error) -> Self {
        use ::output::Reason as R;
        let found = error.reason.finding().in_file(shown_path(&error.path));
        match error.reason {
            R::Exists | R::Appeared => Self {
                kind: "output_exists",
                ..Self::of(OUTPUT, found)
            },
            R::Input(_) | R::Twice => Self::of(USAGE, found),
            _ => Self::of(OUTPUT, found),
        }
    }
}

impl From<live::Error> for Failure {
    fn from(error: live::Error) -> Self {
        use live::Error as E;
        let code = match error {
            E::NoSource(_) => USAGE,
            E::File { .. } => OUTPUT,
            E::Unreadable(error) => return error.into(),
            _ => INPUT,
        };
        Self::of(code, error.finding())
    }
}

impl From<exchange::Error> for Failure {
    fn from(error: exchange::Error) -> Self {
        use exchange::Error as E;
        let code = match error {
            E::Settings(_) => USAGE,
            E::Lacks { .. } => NOT_ENOUGH,
            E::LeftHanded { .. } | E::Flipped { .. } => GATE,
            _ => INPUT,
        };
        Self::of(code, error.finding())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_document_has_every_entry() {
        let failure = Failure::new(INPUT, "5 cells, 7 expected").in_file("no.csv");
        let failure = failure.advise("split it here");
        assert_eq!(
            failure.message,
            "no.csv: 5 cells, 7 expected; split it here"
        );
        let error = &failure.document()["error"];
        assert_eq!(error["kind"], "input");
        assert_eq!(error["exit"], 3);
        assert_eq!(error["file"], "no.csv");
        assert_eq!(error["next"], "split it here");
        let error = &Failure::new(NOT_ENOUGH, "all static").document()["error"];
        assert!(error["file"].is_null() && error["line"].is_null());
    }
}
