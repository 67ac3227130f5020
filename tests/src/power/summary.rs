//! The table of the issue, from the records.

use serde::Serialize;

use super::session::Record;

/// Words that say what a session outside the catalogue hides.
const SAYS: [(&str, &[&str]); 5] = [
    ("periodic", &["periodic in time, with"]),
    ("pattern", &["finer pattern", "goes with the placement"]),
    ("telegraph", &["jumps"]),
    ("heading", &["horizontal direction"]),
    ("relaxation", &["fades away"]),
];

/// Figures of one row, or of one kind of session in it.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Summary {
    /// Sessions.
    pub sessions: usize,
    /// Everything hidden named, and nothing else.
    pub exact: f64,
    /// The same, ties counted.
    pub with_ties: f64,
    /// A name that is not hidden nor has what is hidden among its ties.
    pub wrong: f64,
    /// Any effect named.
    pub any_name: f64,
    /// Something unexplained.
    pub unexplained: f64,
    /// What is outside the catalogue described as what it is.
    pub described: f64,
    /// An effect named and nothing unexplained beside it.
    pub name_alone: f64,
    /// The fault of the recording named, ties counted, and no effect beside it.
    pub integrity: f64,
    /// The hidden formula proposed and nothing named beside it.
    pub formula: f64,
    /// Any claim at all.
    pub any_claim: f64,
    /// Share of the 95 % intervals of parameters that cover.
    pub coverage: f64,
    /// How many intervals.
    pub intervals: usize,
    /// Share of held-out gaps within 10 % of the true model's.
    pub gap_within_tenth: f64,
    /// Seconds of a discovery, median.
    pub seconds: f64,
    /// Sessions that could not be looked into.
    pub refused: usize,
}

impl Record {
    fn claims(&self) -> Vec<&str> {
        self.named
            .iter()
            .chain(&self.integrity)
            .map(String::as_str)
            .collect()
    }

    /// Any claim but those that the condition makes right.
    pub fn is_claimed(&self) -> bool {
        let mut claims = self.claims();
        claims.retain(|name| !self.right.iter().any(|right| right == name));
        !claims.is_empty() || self.unexplained.is_some()
    }

    /// Everything hidden and nothing else.
    pub fn is_exact(&self) -> bool {
        let mut claims = self.claims();
        let mut hidden: Vec<&str> = self.hidden.iter().map(String::as_str).collect();
        claims.sort_unstable();
        hidden.sort_unstable();
        claims == hidden
    }

    /// Whether the words for what remains are those for what is hidden.
    pub fn is_described(&self) -> bool {
        let said = self.unexplained.as_deref().unwrap_or_default();
        let own = SAYS.iter().find(|(kind, _)| *kind == self.kind);
        own.is_some_and(|(_, words)| words.iter().any(|words| said.contains(words)))
    }

    /// Everything hidden is named or tied to a name, and every name is hidden or tied to what is.
    pub fn is_found(&self) -> bool {
        !self.is_wrong()
            && self.hidden.iter().all(|h| {
                let mut ties = self.ties.iter().chain(&self.fault_ties).flatten();
                self.claims().contains(&h.as_str()) || ties.any(|t| t == h)
            })
    }

    /// A name that is neither hidden nor tied to what is.
    pub fn is_wrong(&self) -> bool {
        let wrong_effect = self.named.iter().zip(&self.ties).any(|(name, ties)| {
            !self.hidden.contains(name)
                && !self.right.contains(name)
                && !ties.iter().any(|t| self.hidden.contains(t))
        });
        let wrong_fault = self.integrity.iter().enumerate().any(|(k, name)| {
            let ties = self.fault_ties.get(k);
            !self.hidden.contains(name)
                && !self.right.contains(name)
                && !ties.is_some_and(|ties| ties.iter().any(|t| self.hidden.contains(t)))
        });
        wrong_effect || wrong_fault
    }
}

/// Summarises records.
pub fn summarise<'a>(records: impl Iterator<Item = &'a Record> + Clone) -> Summary {
    let all: Vec<&Record> = records.collect();
    let share = |test: &dyn Fn(&Record) -> bool| {
        all.iter().filter(|r| test(r)).count() as f64 / all.len().max(1) as f64
    };
    let z: Vec<f64> = all.iter().flat_map(|r| r.z.iter().copied()).collect();
    let ratios: Vec<f64> = all
        .iter()
        .flat_map(|r| r.gap_ratio.iter().copied())
        .collect();
    let mut seconds: Vec<f64> = all.iter().map(|r| r.seconds).filter(|s| *s > 0.0).collect();
    seconds.sort_by(f64::total_cmp);
    let covered = z.iter().filter(|z| z.abs() < 1.959_963_984_540_054).count();
    let close = ratios.iter().filter(|r| (**r - 1.0).abs() <= 0.1).count();
    Summary {
        sessions: all.len(),
        exact: share(&|r| r.is_exact()),
        with_ties: share(&|r| r.is_found()),
        wrong: share(&|r| r.is_wrong()),
        any_name: share(&|r| !r.named.is_empty()),
        unexplained: share(&|r| r.unexplained.is_some()),
        described: share(&|r| r.is_described()),
        name_alone: share(&|r| !r.named.is_empty() && r.unexplained.is_none()),
        integrity: share(&|r| {
            let is_named = |h: &String| {
                r.integrity.contains(h) || r.fault_ties.iter().flatten().any(|t| t == h)
            };
            r.named.is_empty() && r.hidden.iter().all(is_named)
        }),
        formula: share(&|r| r.is_formula && r.claims().is_empty()),
        any_claim: share(&|r| r.is_claimed()),
        coverage: covered as f64 / z.len().max(1) as f64,
        intervals: z.len(),
        gap_within_tenth: close as f64 / ratios.len().max(1) as f64,
        seconds: seconds.get(seconds.len() / 2).copied().unwrap_or(0.0),
        refused: all.iter().filter(|r| r.refused.is_some()).count(),
    }
}
