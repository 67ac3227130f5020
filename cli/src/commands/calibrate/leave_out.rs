//! `--leave-out`: static intervals by an instant within them.

use std::str::FromStr;

use calib::calibrate::Instant;

use crate::exit::Failure;

/// Argument of `--leave-out`: an instant within a static interval.
#[derive(Clone, Copy, Debug)]
pub struct LeftOut(Instant);

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

/// The instants to leave out; each has to be of one of `recordings`.
pub fn instants(given: &[LeftOut], recordings: usize) -> Result<Vec<Instant>, Failure> {
    let instants: Vec<Instant> = given.iter().map(|one| one.0).collect();
    match instants.iter().find(|i| i.recording > recordings) {
        Some(i) => Err(Failure::usage(format!(
            "--leave-out {}:{}: there is no recording {}, only {recordings}",
            i.recording, i.t, i.recording
        ))),
        None => Ok(instants),
    }
}
