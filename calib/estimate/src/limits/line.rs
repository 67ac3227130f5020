//! A limit with what it judges.

use findings::{Finding, Kind, OptionName, Remedy};
use serde::{Deserialize, Serialize};

/// One limit, the value it is for, and whether that passes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LimitLine {
    /// The key of the limits file, such as `accelerometer.residual_mm_s2`.
    pub name: String,
    /// On which side the value must be.
    pub kind: Bound,
    /// The limit; least and greatest for [`Bound::Between`], 1 for [`Bound::Present`].
    pub limit: Limit,
    /// The value; none where the calibration does not have it.
    pub value: Option<f64>,
    /// Unit of both; empty where there is none.
    pub unit: String,
    /// True if the value is within the limit; false where there is no value.
    pub pass: bool,
    /// True if the limit is built in and needs no file.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub built_in: bool,
}

/// On which side of its limit a value must be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Bound {
    /// `value ≤ limit`.
    AtMost,
    /// `value ≥ limit`.
    AtLeast,
    /// `limit[0] ≤ value ≤ limit[1]`.
    Between,
    /// It must be there.
    Present,
}

/// A limit's number or numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Limit {
    /// One.
    One(f64),
    /// Least and greatest.
    Range([f64; 2]),
}

/// The limits that are not kept, in their order. Of a quantity that fails the file's limit the one built in is not repeated.
pub fn not_kept(lines: &[LimitLine]) -> Vec<&LimitLine> {
    let mut failed: Vec<&LimitLine> = Vec::new();
    for line in lines.iter().filter(|line| !line.pass) {
        if !failed.iter().any(|other| other.name == line.name) {
            failed.push(line);
        }
    }
    failed
}

impl LimitLine {
    /// The judged quantity, in words: a limit on a class of parameters is one on their standard errors.
    pub fn words(&self) -> String {
        match self.name.split_once('.') {
            Some((_, "scale" | "misalignment" | "bias")) => {
                format!("{} (standard error)", self.name)
            }
            _ => self.name.clone(),
        }
    }

    /// The finding that it is not kept.
    pub fn finding(&self) -> Finding {
        if self.kind == Bound::Present {
            let sensor = self.name.trim_start_matches("required.");
            return Finding::of(Kind::REQUIRED_MISSING).detail("sensor", sensor);
        }
        let shown = |value: f64| findings::human(value, &self.unit);
        let allowed = match (self.kind, self.limit) {
            (Bound::AtLeast, Limit::One(least)) => format!("at least {}", shown(least)),
            (_, Limit::One(most)) => format!("at most {}", shown(most)),
            (_, Limit::Range([least, most])) => format!("{} to {}", shown(least), shown(most)),
        };
        let found = Finding::of(Kind::LIMIT_NOT_KEPT)
            .detail("name", self.words())
            .detail("allowed", allowed);
        match (self.value, self.name.strip_prefix("effects.")) {
            (Some(value), _) => found.detail("value", shown(value)),
            (None, Some(effect)) => found
                .detail("value", "not known")
                .remedy(Remedy::set_to(OptionName::Effects, effect)),
            (None, None) => found.detail("value", "not known"),
        }
    }

    /// Judged.
    pub fn new(
        name: impl Into<String>,
        unit: impl Into<String>,
        kind: Bound,
        limit: Limit,
        value: Option<f64>,
    ) -> Self {
        let within = |v: f64| match (kind, limit) {
            (Bound::AtMost, Limit::One(most)) => v <= most,
            (Bound::AtLeast | Bound::Present, Limit::One(least)) => v >= least,
            (_, Limit::Range([least, greatest])) => (least..=greatest).contains(&v),
            (Bound::Between, Limit::One(_)) => false,
        };
        Self {
            name: name.into(),
            kind,
            limit,
            value,
            unit: unit.into(),
            pass: value.is_some_and(within),
            built_in: false,
        }
    }
}
