//! The residuals of a fit, raw and calibrated: one definition for the terminal, the page and the documents.

use calib::limits::Residuals;
use calib::recording::averages::root_mean_square;

use super::session::{Moved, Rest, Session};
use crate::report::Figure;
use crate::show;

/// Root mean squares before and after the calibration.
///
/// They are those of `evaluate`, but for what the fit found disturbed. Readings in counts or g have no raw one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Residual {
    /// Norm of specific force less gravity at static intervals, mm/s².
    pub at_rest: [Option<f64>; 2],
    /// Angle by which gravity is missed after a turn, °.
    pub after_turn: [Option<f64>; 2],
    /// Static intervals and turns.
    pub count: [usize; 2],
}

impl Residual {
    /// Computes the residual of recordings, each interval and turn as much as the others.
    pub fn measured(session: &Session<'_>) -> Self {
        let rms = |values: Vec<f64>| (!values.is_empty()).then(|| root_mean_square(&values));
        let sound = |rest: &&Rest| !rest.is_disturbed;
        let rests: Vec<&Rest> = session.rests.iter().filter(sound).collect();
        let sound = |turn: &&Moved| !turn.is_disturbed;
        let turns: Vec<&Moved> = session.turns.iter().filter(sound).collect();
        Self {
            at_rest: [
                rms(rests.iter().filter_map(|r| r.raw).collect()),
                rms(rests.iter().filter_map(|r| r.left).collect()),
            ],
            after_turn: [
                rms(turns.iter().filter_map(|t| t.raw).collect()),
                rms(turns.iter().filter_map(|t| t.left).collect()),
            ],
            count: [
                rests.len(),
                turns.iter().filter(|t| t.raw.or(t.left).is_some()).count(),
            ],
        }
    }

    /// The same for limits.
    pub fn for_limits(&self) -> Residuals {
        Residuals {
            at_rest: self.at_rest[1].map(|left| 1e-3 * left),
            after_turn: self.after_turn[1],
        }
    }

    /// `raw 243 → 0.354 mm/s² at rest, 3.11 → 0.0141° after a turn`; empty where there is none.
    pub fn in_words(&self) -> String {
        let parts = [
            show::arrow(self.at_rest, " mm/s² at rest"),
            show::arrow(self.after_turn, "° after a turn"),
        ];
        let mut parts: Vec<String> = parts.into_iter().flatten().collect();
        if let Some(first) = parts.iter_mut().find(|part| part.contains('→')) {
            first.insert_str(0, "raw ");
        }
        parts.join(", ")
    }

    /// The figure at the head of a page.
    pub fn figure(&self) -> Figure {
        let [rests, turns] = self.count;
        let turns = show::counted(turns, "turn");
        let through = show::arrow(self.after_turn, "°");
        let (value, note) = match show::arrow(self.at_rest, " mm/s²") {
            Some(value) => {
                let through = through.map(|text| format!("; direction through {turns} {text}"));
                let note = format!(
                    "norm of {}{}",
                    show::counted(rests, "static interval"),
                    through.unwrap_or_default()
                );
                (value, note)
            }
            None => (
                through.unwrap_or("none".into()),
                format!("direction through {turns}"),
            ),
        };
        Figure::new("Residual, raw → calibrated", value, note)
    }
}
