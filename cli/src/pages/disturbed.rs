//! Static intervals that something disturbed: which, and what to do.

use super::session::Session;

/// Static intervals that something disturbed, by the warnings.
pub struct Disturbed {
    /// What they are called, with begin and end.
    names: Vec<String>,
    /// Instants within them, as the option takes them.
    instants: Vec<String>,
    /// The calibration uses some of them.
    used: bool,
    /// Share of all static intervals.
    share: f64,
}

/// With a larger share of them a new recording is better.
const LARGEST_SHARE: f64 = 0.25;

impl Disturbed {
    /// `None` where no warning with a word of `causes` names a static interval.
    pub fn in_session(session: &Session<'_>, warnings: &[String], causes: &[&str]) -> Option<Self> {
        let speaks = |w: &&String| causes.iter().any(|word| session.body(w).contains(word));
        let warnings: Vec<&String> = warnings.iter().filter(speaks).collect();
        let mut found = Self {
            names: Vec::new(),
            instants: Vec::new(),
            used: false,
            share: 0.0,
        };
        for (k, part) in session.parts.iter().enumerate() {
            let rests = session.rests.iter().filter(|rest| rest.part == k);
            for (number, rest) in (1..).zip(rests) {
                let begin = format!("{}: static interval {number} (", part.recording.name);
                let Some(warning) = warnings.iter().find(|w| w.starts_with(&begin)) else {
                    continue;
                };
                let (from, to) = rest.span;
                let of = match session.parts.len() {
                    1 => String::new(),
                    _ => format!("{}:", k + 1),
                };
                found
                    .names
                    .push(format!("{number} ({from:.1} to {to:.1} s)"));
                found.instants.push(format!("{of}{:.1}", 0.5 * (from + to)));
                found.used |= !warning.contains("not used");
            }
        }
        found.share = found.names.len() as f64 / session.rests.len().max(1) as f64;
        Some(found).filter(|found| !found.names.is_empty())
    }

    /// What to do; `again` where a new recording is better.
    pub fn advice(&self, again: &str) -> String {
        let one = self.names.len() == 1;
        let (plural, s, instants, them, are) = if one {
            ("", "s", "an instant", "it", "is")
        } else {
            ("s", "", "instants", "them", "are")
        };
        let names = self.names.join(", ");
        if self.share > LARGEST_SHARE {
            return format!("{again} (Static interval{plural} {names}.)");
        }
        if self.used {
            format!(
                "Leave out static interval{plural} {names}, which spoil{s} this calibration: add --leave-out {} ({instants} \
                 within {them}, s) to the command that made this page, and take the calibration that this gives. A new \
                 recording is not needed.",
                self.instants.join(",")
            )
        } else {
            format!(
                "Nothing has to be mended: static interval{plural} {names} {are} not in this calibration. In the next \
                 recording let nothing touch or shake the device while it is still."
            )
        }
    }
}
