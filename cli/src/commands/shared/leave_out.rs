//! `--leave-out`: static intervals by an instant within them.

use std::fmt;
use std::str::FromStr;

use calib::calibrate::Instant;

use crate::exit::Failure;

/// Argument of `--leave-out`: an instant within a static interval.
#[derive(Clone, Copy, Debug)]
pub struct LeftOut(Instant);

impl fmt::Display for LeftOut {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            Instant { recording: 1, t } => write!(out, "{t}"),
            Instant { recording, t } => write!(out, "{recording}:{t}"),
        }
    }
}

impl FromStr for LeftOut {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (recording, t) = text.split_once(':').unwrap_or(("1", text));
        let recording = recording.trim().parse().ok().filter(|k| *k > 0);
        let t = t.trim().parse().ok().filter(|t: &f64| t.is_finite());
        let instant = recording
            .zip(t)
            .map(|(recording, t)| Instant { recording, t });
        let expected = "a stamp in s expected, as in 61.5, or 2:61.5 of the second recording";
        instant.map(Self).ok_or_else(|| expected.to_owned())
    }
}

/// Static intervals that are left out.
#[derive(Clone, Debug, clap::Args)]
pub struct LeaveOutArgs {
    /// Static intervals to leave out, each by an instant within it, s; of the second recording as 2:61.5
    #[arg(
        long,
        value_name = "T,T",
        value_delimiter = ',',
        allow_hyphen_values = true
    )]
    leave_out: Vec<LeftOut>,
}

impl LeaveOutArgs {
    /// True if none is.
    pub fn is_empty(&self) -> bool {
        self.leave_out.is_empty()
    }

    /// The same for a command line, with a space before it; empty where none is.
    pub fn command_line(&self) -> String {
        let all: Vec<String> = self.leave_out.iter().map(LeftOut::to_string).collect();
        match all.is_empty() {
            true => String::new(),
            false => format!(" --leave-out {}", all.join(",")),
        }
    }

    /// The instants to leave out; each has to be of one of `recordings`.
    pub fn instants(&self, recordings: usize) -> Result<Vec<Instant>, Failure> {
        let instants: Vec<Instant> = self.leave_out.iter().map(|one| one.0).collect();
        match instants.iter().find(|i| i.recording > recordings) {
            Some(i) => Err(Failure::usage(format!(
                "--leave-out {}:{}: there is no recording {}, only {recordings}",
                i.recording, i.t, i.recording
            ))),
            None => Ok(instants),
        }
    }
}
