//! A gyroscope that the turns do not calibrate, in words and with what its rests say.

use recording::Recording;
use recording::intervals::{Segmentation, TurnFault};

use super::rest_bias::rest_bias;
use crate::calibration::{NotCalibrated, NotCalibratedReason};

/// A turn has two numbers; so many parameters has the gyroscope without its bias, and one turn more checks them.
const FEWEST_TURNS: usize = 6;

/// Turns that were found, and why those that are not used are not.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct TurnCount {
    all: usize,
    gaps: usize,
    frozen: usize,
    saturated: usize,
    empty: usize,
}

impl TurnCount {
    /// Of all turns, with the fault of each that has one.
    pub fn of<'a>(all: usize, faults: impl Iterator<Item = &'a TurnFault>) -> Self {
        let mut count = Self {
            all,
            ..Self::default()
        };
        for fault in faults {
            match fault {
                TurnFault::Gap(_) => count.gaps += 1,
                TurnFault::Frozen(_) => count.frozen += 1,
                TurnFault::Saturated { .. } => count.saturated += 1,
                TurnFault::Empty => count.empty += 1,
            }
        }
        count
    }

    /// Of recordings that are cut.
    pub fn of_cut<'a>(cut: impl Iterator<Item = &'a Segmentation> + Clone) -> Self {
        let turns = cut.flat_map(|segmentation| &segmentation.turns);
        Self::of(
            turns.clone().count(),
            turns.filter_map(|turn| turn.fault.as_ref()),
        )
    }

    /// Turns that can be integrated.
    fn usable(&self) -> usize {
        self.all
            .saturating_sub(self.gaps + self.frozen + self.saturated + self.empty)
    }

    /// Why the gyroscope is not calibrated, if its turns are why.
    pub fn reason(&self) -> Option<NotCalibratedReason> {
        match self.usable() {
            0 => Some(NotCalibratedReason::NoUsableTurn),
            1..=FEWEST_TURNS => Some(NotCalibratedReason::TooFewTurns),
            _ if self.saturated > 0 => Some(NotCalibratedReason::NotObservable),
            _ => None,
        }
    }

    /// `none of 24 turns can be used (23 have a gap, 1 is saturated)` and what to do.
    pub fn in_words(&self) -> String {
        if self.all == 0 {
            return "there is no turn between two static intervals: turn the device about each axis, still before and \
                    after each turn"
                .into();
        }
        let one = |count: usize, single: &str, many: &str| match count {
            0 => None,
            1 => Some(format!("1 {single}")),
            count => Some(format!("{count} {many}")),
        };
        let faults = [
            one(self.gaps, "has a gap", "have gaps"),
            one(self.frozen, "has frozen readings", "have frozen readings"),
            one(self.saturated, "is saturated", "are saturated"),
            one(self.empty, "has no samples", "have no samples"),
        ];
        let faults: Vec<String> = faults.into_iter().flatten().collect();
        let found = match self.usable() {
            0 => format!("none of {} turns can be used", self.all),
            usable @ 1..=FEWEST_TURNS => format!(
                "{usable} of {} turns can be used, and {} or more are needed",
                self.all,
                FEWEST_TURNS + 1
            ),
            usable => format!(
                "{usable} of {} turns can be used, and they leave a parameter open",
                self.all
            ),
        };
        let why = match faults.is_empty() {
            true => String::new(),
            false => format!(" ({})", faults.join(", ")),
        };
        let most = [
            (self.saturated, "turn more slowly or set a larger range"),
            (self.gaps, "record without losing samples"),
            (self.frozen, "record without frozen rows"),
            (self.empty, "record both sensors at the same time"),
        ];
        let advice = most.into_iter().max_by_key(|(count, _)| *count);
        let advice = match advice {
            Some((count, advice)) if count > 0 => advice,
            _ => "turn the device about each axis both ways, still before and after each turn",
        };
        format!("{found}{why}: {advice}")
    }

    /// What stands in the place of the gyroscope; `refused` is why the turns that can be used are not enough, `known` the
    /// last recording, whose rests say what its bias is.
    pub fn mark(
        &self,
        reason: NotCalibratedReason,
        refused: &str,
        known: Option<(&Recording, &Segmentation)>,
    ) -> NotCalibrated {
        let bias = known.and_then(|(recording, cut)| rest_bias(recording, cut));
        let text = match reason {
            NotCalibratedReason::NoUsableTurn => self.in_words(),
            _ => format!("{}; {refused}", self.in_words()),
        };
        NotCalibrated::gyroscope(reason, text, bias)
    }
}

#[cfg(test)]
mod tests {
    use recording::intervals::Span;

    use super::*;

    #[test]
    fn the_words_count_the_faults_and_advise_on_the_most_frequent() {
        let span = Span { from: 1.0, to: 2.0 };
        let faults = [
            TurnFault::Gap(span),
            TurnFault::Saturated { samples: 4 },
            TurnFault::Saturated { samples: 9 },
        ];
        let none = TurnCount::of(3, faults.iter());
        assert_eq!(none.reason(), Some(NotCalibratedReason::NoUsableTurn));
        assert_eq!(
            none.in_words(),
            "none of 3 turns can be used (1 has a gap, 2 are saturated): turn more slowly or set a larger range"
        );
        let few = TurnCount::of(8, faults.iter());
        assert_eq!(few.reason(), Some(NotCalibratedReason::TooFewTurns));
        assert!(few.in_words().starts_with("5 of 8 turns can be used"));
        assert_eq!(TurnCount::of(20, faults[..1].iter()).reason(), None);
    }
}
