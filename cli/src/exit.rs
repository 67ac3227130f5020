//! Exit statuses and the messages that go with them.

use calib::Error;

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

/// Why the program ends with a status other than 0.
#[derive(Debug)]
pub struct Failure {
    /// Exit status.
    pub code: u8,
    /// What is said on standard error.
    pub message: String,
}

impl Failure {
    /// With a status and a message.
    pub fn new(code: u8, message: impl Into<String>) -> Self {
        Self {
            code,
            message: message.into(),
        }
    }

    /// After a panic, whose own message is on standard error already.
    pub fn bug() -> Self {
        Self::new(
            BUG,
            "this is a bug of ours: please report the message above and the command",
        )
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        let code = match error {
            Error::Usage(_) => USAGE,
            Error::NotEnough(_) => NOT_ENOUGH,
            Error::Output { .. } => OUTPUT,
            Error::NotConverged(_) | Error::Solver(_) => NOT_CONVERGED,
            _ => INPUT,
        };
        Self::new(code, error.to_string())
    }
}
