//! What is wrong with a batch as a whole, in words.

use batch::{Error, Fault};

use crate::exit::{Failure, INPUT, OUTPUT};
use crate::show;

/// A batch's error in words.
pub(super) fn failure(error: Error) -> Failure {
    let code = match &error {
        Error::Output { .. } => OUTPUT,
        Error::TooFew { .. } => crate::exit::NOT_ENOUGH,
        _ => INPUT,
    };
    match &error {
        Error::Parts(faults) => {
            let lines: Vec<String> = faults.iter().map(fault).collect();
            let lines = match lines.is_empty() {
                true => "no part of a batch; name its output folder or its part files".to_owned(),
                false => lines.join("\n  "),
            };
            Failure::new(code, format!("the parts make no whole:\n  {lines}"))
        }
        other => Failure::new(code, other.to_string()),
    }
}

/// What is wrong with a part, and what to do.
fn fault(fault: &Fault) -> String {
    match fault {
        Fault::Unreadable { path, what } => {
            format!(
                "{}: {what}; run its shard again with --resume",
                show::path(path)
            )
        }
        Fault::Foreign {
            path,
            found,
            expected,
        } => {
            format!(
                "{}: of another run ({found}; {expected} expected)",
                show::path(path)
            )
        }
        Fault::Missing { shard } => {
            format!(
                "part {}/{} is missing; run it with --shard {}/{} --resume",
                shard.k, shard.n, shard.k, shard.n
            )
        }
        Fault::Lacks { index } => format!("device {} of the manifest is in no part", index + 1),
        _ => "a part cannot be merged".to_owned(),
    }
}
