//! Quiet stretches that are no static intervals.

use std::fmt;
use std::mem::discriminant;

use findings::{Finding, Kind};

use super::spans::Span;

findings::tuning! {
    /// Stretches that are named one by one; more are counted.
    NAMED: usize = 4;
}

/// A quiet stretch that is not used.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rejected {
    /// Begin and end by the stamps, s.
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

    /// Builds one finding for each reason of rejection.
    pub fn findings(all: &[Self]) -> Vec<Finding> {
        let mut kinds: Vec<Vec<&Self>> = Vec::new();
        for one in all {
            let alike =
                |kind: &&mut Vec<&Self>| discriminant(&kind[0].reason) == discriminant(&one.reason);
            match kinds.iter_mut().find(alike) {
                Some(kind) => kind.push(one),
                None => kinds.push(vec![one]),
            }
        }
        let finding = |kind: &Vec<&Self>| match kind.as_slice() {
            [one] => one.finding(),
            all => several(all),
        };
        kinds.iter().map(finding).collect()
    }

    /// Builds the finding about this interval.
    pub fn finding(&self) -> Finding {
        let Span { from, to } = self.span;
        let found = self.of_reason().between(from, to);
        match self.reason {
            Reason::Turning(rate) => found.number("rate", rate.abs(), "rad/s"),
            Reason::Tilting(angle) => found
                .number("slope", angle / self.span.length(), "rad/s")
                .number("angle", angle, "rad"),
            Reason::Clipped(_) | Reason::Vibrating | Reason::Empty => found,
        }
    }

    /// A finding of stretches with this reason.
    fn of_reason(&self) -> Finding {
        match self.reason {
            Reason::Turning(_) => Finding::of(Kind::STRETCH_TURNS),
            Reason::Tilting(_) => Finding::of(Kind::STRETCH_TILTS),
            Reason::Vibrating => Finding::of(Kind::STRETCH_VIBRATES),
            Reason::Empty => Finding::of(Kind::STRETCH_EMPTY),
            Reason::Clipped(axis) => {
                let axis = ["x", "y", "z"].get(axis).copied().unwrap_or_default();
                Finding::of(Kind::STRETCH_CLIPPED).detail("axis", axis)
            }
        }
    }

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
}

/// Some stretches of one reason in a finding.
fn several(all: &[&Rejected]) -> Finding {
    let mut named: Vec<String> = all
        .iter()
        .take(NAMED.get())
        .map(|one| one.place())
        .collect();
    if all.len() > NAMED.get() {
        named.push(format!("{} more", all.len() - NAMED.get()));
    }
    all[0]
        .of_reason()
        .count("count", all.len())
        .detail("listed", named.join(", "))
}

impl fmt::Display for Rejected {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.finding().fmt(f)
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
    fn stretches_of_one_reason_are_one_finding() {
        let turning = (0..6).map(|k| at(f64::from(k), Reason::Turning(0.5)));
        let all: Vec<Rejected> = turning.chain([at(9.0, Reason::Vibrating)]).collect();
        let found = Rejected::findings(&all);
        let [turned, vibrated] = found.as_slice() else {
            panic!("two reasons");
        };
        assert_eq!(turned.value("count"), Some(6.0));
        let [turned, vibrated] = [turned, vibrated].map(ToString::to_string);
        assert!(turned.starts_with(
            "6 quiet stretches are no static intervals (0.00 to 2.00 s at 28.65 °/s, 1.00"
        ));
        assert!(turned.contains("2 more"), "{turned}");
        assert!(
            vibrated.starts_with("the quiet stretch at t = 9.00 to 11.00 s is no static interval")
        );
        assert!(vibrated.contains("shook the device"), "{vibrated}");
    }
}
