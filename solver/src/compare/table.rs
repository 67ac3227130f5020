//! The table of a comparison: in words, as CSV, by `serde`.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Relative distance from the least cost at which a run counts as a success.
const CLOSE: f64 = 1e-6;

/// The same relative to the cost at the start, for costs that go to zero.
const FALLEN: f64 = 1e-12;

/// One fit of a comparison.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ComparedRun {
    /// Name of the problem.
    pub problem: String,
    /// Number of the start, from 1.
    pub start: usize,
    /// Name of the variant.
    pub variant: String,
    /// True where the cost is the least: to 1e-6 of it, or to 1e-12 of the cost at the start.
    pub success: bool,
    /// True where the solver says that it converged.
    pub converged: bool,
    /// Residuals evaluated alone.
    pub residuals: usize,
    /// Jacobians evaluated.
    pub jacobians: usize,
    /// Second derivatives evaluated, each along one direction.
    pub second_derivatives: usize,
    /// Time taken, s; not a number where there is no clock.
    pub seconds: f64,
    /// Value of the minimised cost at the end.
    #[serde(with = "crate::infinite")]
    pub cost: f64,
    /// `½ ‖r‖²` at the start.
    #[serde(with = "crate::infinite")]
    pub first_cost: f64,
    /// Digits agreed with the solution known, in the worst parameter; of the cost if none is known.
    pub digits: f64,
    /// Why it stopped.
    pub reason: String,
}

/// The fits of a comparison. `Display` shows every run and then the [`summary`](Self::summary);
/// [`to_csv`](Self::to_csv) and `serde` (JSON) have every run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Table {
    /// Start by start, variant by variant.
    pub runs: Vec<ComparedRun>,
}

/// Effort that a performance profile counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Measure {
    /// Residuals and Jacobians, a Jacobian as many as one residual.
    Evaluations,
    /// Jacobians.
    Jacobians,
    /// Time.
    Seconds,
}

impl ComparedRun {
    /// Success and digits, given the least cost.
    pub(super) fn judge(&mut self, best: f64) {
        let room = (CLOSE * best.abs()).max(FALLEN * self.first_cost);
        self.success = self.cost <= best + room;
        if self.digits.is_nan() {
            let relative = (self.cost - best).abs() / best.abs().max(f64::MIN_POSITIVE);
            self.digits = (-relative.log10()).clamp(0.0, 16.0);
        }
    }

    /// Value of a measure for it.
    pub(super) fn measured(&self, measure: Measure) -> f64 {
        match measure {
            Measure::Evaluations => (self.residuals + self.jacobians) as f64,
            Measure::Jacobians => self.jacobians as f64,
            Measure::Seconds => self.seconds,
        }
    }
}

impl Table {
    /// The runs of another table after those of this one.
    pub fn append(&mut self, other: Self) {
        self.runs.extend(other.runs);
    }

    /// Names of the variants, in the order they first appear.
    pub fn variants(&self) -> Vec<String> {
        let mut names: Vec<String> = Vec::new();
        for run in &self.runs {
            if !names.contains(&run.variant) {
                names.push(run.variant.clone());
            }
        }
        names
    }

    /// Runs of a variant that found the least cost.
    pub fn successes(&self, variant: &str) -> usize {
        let of = self.runs.iter().filter(|run| run.variant == variant);
        of.filter(|run| run.success).count()
    }

    /// Every run as a line of comma-separated values, under a line of names.
    pub fn to_csv(&self) -> String {
        let mut text = String::from(
            "problem,start,variant,success,converged,r,J,r2,seconds,cost,digits,reason\n",
        );
        for run in &self.runs {
            text += &format!(
                "{},{},{},{},{},{},{},{},{:e},{:e},{:.1},{}\n",
                quoted(&run.problem),
                run.start,
                quoted(&run.variant),
                run.success,
                run.converged,
                run.residuals,
                run.jacobians,
                run.second_derivatives,
                run.seconds,
                run.cost,
                run.digits,
                quoted(&run.reason)
            );
        }
        text
    }

    /// One line per variant: successes, all evaluations, time, false endings.
    pub fn summary(&self) -> String {
        let mut text = format!(
            "{:26} {:>9} {:>8} {:>8} {:>9} {:>10} {:>7}\n",
            "variant", "successes", "r", "J", "r″", "ms", "false"
        );
        for variant in self.variants() {
            let of = || self.runs.iter().filter(|run| run.variant == variant);
            let sum = |f: fn(&ComparedRun) -> usize| of().map(f).sum::<usize>();
            text += &format!(
                "{variant:26} {:>9} {:>8} {:>8} {:>9} {:>10.2} {:>7}\n",
                format!("{}/{}", self.successes(&variant), of().count()),
                sum(|run| run.residuals),
                sum(|run| run.jacobians),
                sum(|run| run.second_derivatives),
                1e3 * of().map(|run| run.seconds).sum::<f64>(),
                of().filter(|run| run.success != run.converged).count(),
            );
        }
        text + "false: converged above the least cost, or at it without saying so\n"
    }
}

fn quoted(word: &str) -> String {
    if word.contains([',', '"', '\n']) {
        format!("\"{}\"", word.replace('"', "\"\""))
    } else {
        word.to_owned()
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let widest = |name: fn(&ComparedRun) -> usize| self.runs.iter().map(name).max();
        let problem = widest(|run| run.problem.chars().count())
            .unwrap_or(0)
            .max(7);
        writeln!(
            f,
            "{:problem$} {:>5} {:26} {:7} {:>6} {:>6} {:>6} {:>9} {:>15} {:>6}  reason",
            "problem", "start", "variant", "least", "r", "J", "r″", "ms", "cost", "digits"
        )?;
        for run in &self.runs {
            writeln!(
                f,
                "{:problem$} {:>5} {:26} {:7} {:>6} {:>6} {:>6} {:>9.3} {:>15.8e} {:>6.1}  {}",
                run.problem,
                run.start,
                run.variant,
                if run.success { "yes" } else { "NO" },
                run.residuals,
                run.jacobians,
                run.second_derivatives,
                1e3 * run.seconds,
                run.cost,
                run.digits,
                run.reason
            )?;
        }
        write!(f, "\n{}", self.summary())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ended_at(cost: f64) -> ComparedRun {
        ComparedRun {
            problem: "valley".to_owned(),
            start: 1,
            variant: "automatic".to_owned(),
            success: false,
            converged: true,
            residuals: 4,
            jacobians: 3,
            second_derivatives: 0,
            seconds: 0.1,
            cost,
            first_cost: 100.0,
            digits: f64::NAN,
            reason: String::new(),
        }
    }

    #[test]
    fn digits_are_those_by_which_the_cost_agrees_with_the_least() {
        for (cost, success, digits) in [
            (2.0, true, 16.0),
            (2.0 + 2e-8, true, 8.0),
            (2.2, false, 1.0),
        ] {
            let mut run = ended_at(cost);
            run.judge(2.0);
            assert_eq!(run.success, success, "{cost}");
            assert!((run.digits - digits).abs() < 1e-6, "{cost}: {}", run.digits);
        }
        // A cost of nothing is compared with that at the start.
        let mut run = ended_at(1e-11);
        run.judge(0.0);
        assert!(run.success);
        assert_eq!(run.digits, 0.0);
    }

    #[test]
    fn words_with_commas_are_quoted() {
        let mut run = ended_at(2.0);
        run.reason = "slow, \"far\"".to_owned();
        let table = Table { runs: vec![run] };
        assert!(table.to_csv().contains("\"slow, \"\"far\"\"\""));
    }
}
