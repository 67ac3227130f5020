//! A gyroscope that the turns do not calibrate, in words and with what its rests say.

use findings::{Finding, Kind, Remedy};
use recording::Recording;
use recording::intervals::{Segmentation, TurnFault};

use super::bias::at_rest::rest_bias;
use crate::calibration::{NotCalibrated, NotCalibratedReason};

findings::tuning! {
    /// A turn has two numbers; so many parameters has the gyroscope without its bias, and one turn more checks them.
    FEWEST_TURNS: usize = 6;
}

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
    /// Counts the turns by their faults; `all` is the number of turns, with and without a fault.
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

    /// Counts the turns of segmented recordings.
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
            few if few <= FEWEST_TURNS.get() => Some(NotCalibratedReason::TooFewTurns),
            _ if self.saturated > 0 => Some(NotCalibratedReason::NotObservable),
            _ => None,
        }
    }

    /// `none of 24 turns can be used; 23 with samples missing; 1 faster than the gyroscope can read`, and what to do.
    pub fn finding(&self) -> Finding {
        if self.all == 0 {
            return Finding::of(Kind::TURNS_MISSING);
        }
        let found = match self.usable() {
            0 => Finding::of(Kind::TURNS_UNUSABLE),
            few if few <= FEWEST_TURNS.get() => {
                Finding::of(Kind::TURNS_USABLE_FEW).count("least", FEWEST_TURNS.get() + 1)
            }
            _ => Finding::of(Kind::TURNS_USABLE_OPEN),
        };
        let found = found
            .count("count", self.all)
            .count("usable", self.usable());
        let faults = [
            ("gaps", self.gaps),
            ("frozen", self.frozen),
            ("saturated", self.saturated),
            ("empty", self.empty),
        ];
        let faults = faults.into_iter().filter(|(_, count)| *count > 0);
        let found = faults.fold(found, |found, (name, count)| found.count(name, count));
        let most = [
            (
                self.saturated,
                [Remedy::TurnSlower, Remedy::LargerRange].to_vec(),
            ),
            (self.gaps, vec![Remedy::LoseNoSamples]),
            (self.frozen, vec![Remedy::FreezeNoRows]),
            (self.empty, vec![Remedy::BothSensors]),
        ];
        let most = most.into_iter().max_by_key(|(count, _)| *count);
        found.only_remedies(match most {
            Some((count, remedies)) if count > 0 => remedies,
            _ => vec![Remedy::TurnEachAxis],
        })
    }

    /// Builds the mark of a gyroscope that is not calibrated; `refused` is why the usable turns are not enough, `known` the
    /// last recording, whose static intervals give the bias.
    pub fn mark(
        &self,
        reason: NotCalibratedReason,
        refused: &Finding,
        known: Option<(&Recording, &Segmentation)>,
    ) -> NotCalibrated {
        let bias = known.and_then(|(recording, cut)| rest_bias(recording, cut));
        let why = match reason {
            NotCalibratedReason::NoUsableTurn => self.finding(),
            _ => self.finding().because(refused.clone()),
        };
        NotCalibrated::gyroscope(reason, &why, bias)
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
            none.finding().to_string(),
            "none of 3 turns can be used; 1 with samples missing; 2 faster than the gyroscope can read; turn more slowly, or record with a larger range of the sensor"
        );
        let few = TurnCount::of(8, faults.iter());
        assert_eq!(few.reason(), Some(NotCalibratedReason::TooFewTurns));
        assert!(
            few.finding()
                .to_string()
                .starts_with("5 of 8 turns can be used")
        );
        assert_eq!(TurnCount::of(20, faults[..1].iter()).reason(), None);
    }
}
