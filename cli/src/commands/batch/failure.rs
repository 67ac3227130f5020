//! Failures of a batch as a whole, in words.

use batch::Error;
use findings::Front;

use crate::exit::{Failure, INPUT, OUTPUT};

/// A batch's error in words.
pub(super) fn failure(error: Error) -> Failure {
    let code = match &error {
        Error::Output { .. } => OUTPUT,
        Error::TooFew { .. } => crate::exit::NOT_ENOUGH,
        _ => INPUT,
    };
    let failure = Failure::of(code, error.finding());
    match &error {
        Error::Parts(faults) if !faults.is_empty() => {
            let lines = faults.iter().map(|found| found.text(Front::CommandLine));
            let lines: Vec<String> = lines.collect();
            let message = format!("the parts make no whole:\n  {}", lines.join("\n  "));
            Failure { message, ..failure }
        }
        _ => failure,
    }
}
