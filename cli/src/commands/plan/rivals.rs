//! Effects that findings could not tell apart, and the recording that can.

use calib::discover::{Aim, Conditions, Request, Rivalry, SETTLED, Separated, ShownBy, separate};
use calib::methods::joint::BiasNoise;
use plan::Timing;
use serde::Serialize;
use serde_json::Value;

use super::args::Args;
use crate::commands::shared::inputs::spinner;
use crate::exit::{Failure, INPUT};
use crate::steps;

/// From here on a tie is told apart in 95 of 100 recordings, if not 20 to 1.
const LIKELY: f64 = 10.8;

/// Tied effects of findings, and the noise of the sensors.
#[derive(Debug, Default)]
pub struct Rivals {
    ties: Vec<Rivalry>,
    walks: [f64; 2],
    white: [f64; 2],
}

/// Confidence with which a tie is resolved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ToldApart {
    /// 20 to 1 in 95 of 100 recordings.
    Yes,
    /// The right one named in 95 of 100.
    Likely,
    /// Not by this.
    No,
}

impl ToldApart {
    fn of(separation: f64) -> Self {
        match separation {
            s if s >= SETTLED => Self::Yes,
            s if s >= LIKELY => Self::Likely,
            _ => Self::No,
        }
    }

    /// In a table.
    pub fn words(self) -> &'static str {
        match self {
            Self::Yes => "yes",
            Self::Likely => "likely",
            Self::No => "no",
        }
    }
}

/// A tie and what the plan does about it.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// The named effect.
    pub named: String,
    /// Name of the effect that it is tied to.
    pub tied_to: String,
    /// `λ (1 − ρ²)` by what was recorded.
    pub before: f64,
    /// With the planned recording.
    pub after: f64,
    /// Confidence with which the plan resolves the tie.
    pub told_apart: ToldApart,
    /// Alternative that would resolve the tie, if the plan does not.
    pub instead: Option<&'static str>,
}

impl Rivals {
    /// Those of a document; none of one that is no findings, or older than they are.
    pub fn of(document: &Value) -> Self {
        let pair = |key: &str| {
            let pair = document.get(key).cloned();
            pair.and_then(|v| serde_json::from_value(v).ok())
                .unwrap_or_default()
        };
        let effects = document.get("effects").and_then(Value::as_array);
        let of_effect = |effect: &Value| {
            let rivals = effect.get("rivals")?.clone();
            serde_json::from_value::<Vec<Rivalry>>(rivals).ok()
        };
        Self {
            ties: effects
                .into_iter()
                .flatten()
                .filter_map(of_effect)
                .flatten()
                .collect(),
            walks: pair("walks"),
            white: pair("white"),
        }
    }

    /// Returns true if there are no tied effects.
    pub fn is_empty(&self) -> bool {
        self.ties.is_empty()
    }

    /// The recording that tells them apart.
    pub fn separate(&self, args: &Args, gravity: f64, timing: &Timing) -> Result<Aim, Failure> {
        let catalogue = Request::new(gravity).catalogue;
        let known =
            |tie: &&Rivalry| tie.named.is_known(&catalogue) && tie.other.is_known(&catalogue);
        let ties: Vec<Rivalry> = self.ties.iter().filter(known).cloned().collect();
        if ties.is_empty() {
            return Err(Failure::new(
                INPUT,
                "the tied effects are of an effect file: only effects of the catalogue can be planned for",
            ));
        }
        if self.white.iter().any(|w| !w.is_finite() || *w <= 0.0) {
            return Err(
                Failure::new(INPUT, "the findings do not say how noisy the sensors are")
                    .advise("run `discover` again"),
            );
        }
        let conditions = Conditions {
            white: self.white,
            noise: BiasNoise::walks(self.walks),
            gravity,
            timing: *timing,
            warmed: args.temperature,
            catalogue,
            watch: steps::watch(),
        };
        let spinner = spinner("trying recordings");
        let aim = separate(&ties, args.next, &conditions)?;
        spinner.finish_and_clear();
        Ok(aim)
    }
}

/// A line per tie.
pub fn rows(aim: &Aim) -> Vec<Row> {
    let row = |tie: &Separated| {
        let told_apart = ToldApart::of(tie.after);
        Row {
            named: tie.named.clone(),
            tied_to: tie.other.clone(),
            before: tie.before,
            after: tie.after,
            told_apart,
            instead: (told_apart == ToldApart::No).then(|| instead(tie)),
        }
    };
    aim.ties.iter().map(row).collect()
}

/// Returns the alternative that would resolve a tie left by the plan.
fn instead(tie: &Separated) -> &'static str {
    match tie.shown_by() {
        ShownBy::Temperature => {
            "warm the device while it records and let it cool: `--temperature` plans that"
        }
        ShownBy::Time => {
            "longer rests, the first of five minutes right after switching on: `--rest 20`"
        }
        ShownBy::Instant => {
            "nothing to record: a step belongs to the recording it is in; another recording without one speaks for the step"
        }
        ShownBy::Nothing => {
            "no placement, turn or temperature of a hand-held recording; the effects are too small, or do the same"
        }
    }
}

/// Explains the figures, and names the alternative for each remaining tie.
pub fn words(rows: &[Row]) -> Vec<String> {
    if rows.is_empty() {
        return Vec::new();
    }
    let mut all = vec![format!(
        "Before and after: how far the two are apart, lambda (1 - rho^2) in chi^2. From {LIKELY} on the right one is named in 95 \
         of 100 recordings, from {SETTLED:.0} on also 20 to 1."
    )];
    for row in rows {
        if let Some(instead) = row.instead {
            all.push(format!(
                "No placement or turn tells {} from {}. What would: {instead}.",
                row.named, row.tied_to
            ));
        }
    }
    all
}
