//! The residuals of a fit, raw and calibrated: one definition for the terminal, the page and the documents.

use calib::calibrate::Outcome;
use calib::recording::averages::root_mean_square;

use super::session::Session;
use crate::report::Figure;
use crate::show;

/// Root mean squares before and after the calibration.
///
/// The calibrated ones are `residual_rms` of the calibration's sensors, the raw ones have the same weights; readings in counts or g have
/// no raw one.
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
    /// Computes the residual of a fit whose readings have these units.
    pub fn of(outcome: &Outcome, units: [&str; 2]) -> Self {
        let calibration = &outcome.calibration;
        let mut own = Self::default();
        if let Some(triad) = &calibration.accelerometer {
            let gravity = calibration.gravity;
            let rests = outcome.choices.iter().flat_map(|c| &c.segmentation.statics);
            let norms = rests.filter_map(|rest| Some(rest.accelerometer?.mean.norm() - gravity));
            let norms: Vec<f64> = norms.collect();
            own.count[0] = triad.static_intervals.unwrap_or(norms.len());
            let raw = match &outcome.joint {
                Some(fit) => fit.norm_rms_before(),
                None => root_mean_square(&norms),
            };
            let raw = (units[0] == "m/s²").then_some(1e3 * raw);
            own.at_rest = [raw, Some(1e3 * triad.residual_rms)];
        }
        let turns = match (&outcome.joint, &outcome.gyroscope) {
            (Some(fit), _) if !fit.chords.is_empty() => {
                Some((fit.direction_rms_before(), fit.chords.len()))
            }
            (None, Some(fit)) => Some((fit.rms_before(), fit.chords.len())),
            _ => None,
        };
        if let (Some(triad), Some((raw, count))) = (&calibration.gyroscope, turns) {
            let raw = (units[1] == "rad/s").then(|| raw.to_degrees());
            own.after_turn = [raw, Some(triad.residual_rms)];
            own.count[1] = count;
        }
        own
    }

    /// Computes the residual of recordings without a fit, from plain means over the static intervals and turns.
    pub fn measured(session: &Session<'_>) -> Self {
        let rms = |values: Vec<f64>| (!values.is_empty()).then(|| root_mean_square(&values));
        let (rests, turns) = (&session.rests, &session.turns);
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
