//! Quiet stretches that are no static intervals.

use std::fmt;
use std::mem::discriminant;

use super::spans::Span;

/// Stretches that are named one by one; more are counted.
const NAMED: usize = 4;

/// A quiet stretch that is not used.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rejected {
    /// When.
    pub span: Span,
    /// Why it is no static interval.
    pub reason: Reason,
}

/// Why a quiet stretch is no static interval.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Reason {
    /// The device turned at this rate, rad/s, which no bias explains; in most cases about the vertical.
    Turning(f64),
    /// The accelerometer is cut off at the end of its range on this axis, 0 to 2.
    Clipped(usize),
    /// The device tilted steadily, from begin to end by this angle, rad.
    Tilting(f64),
    /// The device lay still on something that vibrates.
    Vibrating,
    /// A sensor has no samples in it.
    Empty,
}

impl Rejected {
    /// A stretch in which a sensor has no samples.
    pub(super) fn without_samples(span: Span) -> Self {
        let reason = Reason::Empty;
        Self { span, reason }
    }

    /// What a user should know of them: those of one reason in one sentence.
    pub fn in_words(all: &[Self]) -> Vec<String> {
        let mut kinds: Vec<Vec<&Self>> = Vec::new();
        for one in all {
            let alike =
                |kind: &&mut Vec<&Self>| discriminant(&kind[0].reason) == discriminant(&one.reason);
            match kinds.iter_mut().find(alike) {
                Some(kind) => kind.push(one),
                None => kinds.push(vec![one]),
            }
        }
        let words = |kind: &Vec<&Self>| match kind.as_slice() {
            [one] => one.to_string(),
            all => several(all),
        };
        kinds.iter().map(words).collect()
    }
}

/// Some stretches of one reason in a sentence.
fn several(all: &[&Rejected]) -> String {
    let mut named: Vec<String> = all.iter().take(NAMED).map(|one| one.place()).collect();
    if all.len() > NAMED {
        named.push(format!("{} more", all.len() - NAMED));
    }
    let (what, to_do) = all[0].what_and_to_do();
    format!(
        "{} quiet stretches are no static intervals ({}): {what}; {to_do}",
        all.len(),
        named.join(", ")
    )
}

impl Rejected {
    /// When, and what was measured there.
    fn place(&self) -> String {
        let Span { from, to } = self.span;
        let measured = match self.reason {
            Reason::Turning(rate) => format!(" at {:.2} °/s", rate.to_degrees().abs()),
            Reason::Tilting(angle) => format!(" by {:.2}°", angle.to_degrees()),
            Reason::Clipped(_) | Reason::Vibrating | Reason::Empty => String::new(),
        };
        format!("{from:.2} to {to:.2} s{measured}")
    }

    /// What happened in such stretches, and what to do.
    fn what_and_to_do(&self) -> (String, &'static str) {
        match self.reason {
            Reason::Turning(_) => (
                "the device turned at a constant rate, which no bias explains".into(),
                "lay the device down where nothing turns",
            ),
            Reason::Clipped(axis) => (
                format!(
                    "accelerometer {} is cut off at the end of its range",
                    ["x", "y", "z"].get(axis).copied().unwrap_or_default()
                ),
                "set a larger range",
            ),
            Reason::Tilting(_) => (
                "the device tilts steadily".into(),
                "lay it down on something firm",
            ),
            Reason::Vibrating => (
                "the device lay still and vibrated".into(),
                "lay it down where nothing runs",
            ),
            Reason::Empty => (
                "a sensor has no samples there".into(),
                "give stretches in which all sensors were recorded",
            ),
        }
    }
}

impl fmt::Display for Rejected {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Span { from, to } = self.span;
        write!(
            f,
            "the quiet stretch from {from:.2} to {to:.2} s is no static interval: "
        )?;
        match self.reason {
            Reason::Turning(rate) => write!(
                f,
                "the device turned there at a constant {:.2} °/s, which no bias explains; lay the device down where \
                 nothing turns",
                rate.to_degrees().abs()
            ),
            Reason::Tilting(angle) => write!(
                f,
                "the device tilts steadily, by a slope of {:.3} °/s and {:.2}° in all; lay it down on something \
                 firm",
                angle.to_degrees() / self.span.length(),
                angle.to_degrees()
            ),
            Reason::Clipped(_) | Reason::Vibrating | Reason::Empty => {
                let (what, to_do) = self.what_and_to_do();
                write!(f, "{what}; {to_do}")
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(from: f64, reason: Reason) -> Rejected {
        let span = Span {
            from,
            to: from + 2.0,
        };
        Rejected { span, reason }
    }

    #[test]
    fn stretches_of_one_reason_are_one_sentence() {
        let turning = (0..6).map(|k| at(f64::from(k), Reason::Turning(0.5)));
        let all: Vec<Rejected> = turning.chain([at(9.0, Reason::Vibrating)]).collect();
        let words = Rejected::in_words(&all);
        let [turned, vibrated] = words.as_slice() else {
            panic!("two reasons");
        };
        assert!(turned.starts_with(
            "6 quiet stretches are no static intervals (0.00 to 2.00 s at 28.65 °/s, 1.00"
        ));
        assert!(turned.contains("2 more"), "{turned}");
        assert!(
            vibrated.starts_with("the quiet stretch from 9.00 to 11.00 s is no static interval")
        );
        assert!(vibrated.contains("vibrated"), "{vibrated}");
    }
}
