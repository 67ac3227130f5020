//! Bounds and linear constraints, by parameter name.

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::parameters::Parameters;

/// Bounds and linear constraints `lower ≤ Σ cₖ xₖ ≤ upper`.
///
/// ```
/// use stillpoint_solver::Constraints;
/// let constraints = Constraints::new()
///     .bound("scale", 0.5, f64::INFINITY)
///     .order("tau_fast", "tau_slow")
///     .tie("alpha_xz", "alpha_zx");
/// assert_eq!(constraints.len(), 3);
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Constraints {
    rows: Vec<Constraint>,
}

/// One constraint `lower ≤ Σ cₖ xₖ ≤ upper`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Constraint {
    /// Names and coefficients.
    pub terms: Vec<(String, f64)>,
    /// Least value, `-∞` where there is none.
    #[serde(with = "crate::infinite::below")]
    pub lower: f64,
    /// Greatest value, `∞` where there is none.
    #[serde(with = "crate::infinite")]
    pub upper: f64,
}

impl Constraints {
    /// None.
    pub fn new() -> Self {
        Self::default()
    }

    /// Their number.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// True if there are none.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// All of them.
    pub fn rows(&self) -> &[Constraint] {
        &self.rows
    }

    /// `lower ≤ name ≤ upper`; infinite where there is no bound.
    pub fn bound(self, name: &str, lower: f64, upper: f64) -> Self {
        self.linear(&[(name, 1.0)], lower, upper)
    }

    /// `lower ≤ Σ cₖ xₖ ≤ upper`.
    pub fn linear(mut self, terms: &[(&str, f64)], lower: f64, upper: f64) -> Self {
        let terms = terms
            .iter()
            .map(|&(name, c)| (name.to_owned(), c))
            .collect();
        self.rows.push(Constraint {
            terms,
            lower,
            upper,
        });
        self
    }

    /// `Σ cₖ xₖ = value`.
    pub fn equal(self, terms: &[(&str, f64)], value: f64) -> Self {
        self.linear(terms, value, value)
    }

    /// `a = b`.
    pub fn tie(self, a: &str, b: &str) -> Self {
        self.equal(&[(a, 1.0), (b, -1.0)], 0.0)
    }

    /// `smaller ≤ larger`.
    pub fn order(self, smaller: &str, larger: &str) -> Self {
        self.linear(&[(larger, 1.0), (smaller, -1.0)], 0.0, f64::INFINITY)
    }

    /// Bounds `lower[k] ≤ xₖ ≤ upper[k]` for all parameters in order.
    pub fn bounds(mut self, parameters: &Parameters, lower: &[f64], upper: &[f64]) -> Self {
        for (name, (&lower, &upper)) in parameters.names().iter().zip(lower.iter().zip(upper)) {
            if lower != f64::NEG_INFINITY || upper != f64::INFINITY {
                self = self.bound(name, lower, upper);
            }
        }
        self
    }
}

impl Constraint {
    /// The constraint's left side, as `alpha_xz - 2 alpha_zx`.
    pub fn in_words(&self) -> String {
        let mut words = String::new();
        for (name, c) in &self.terms {
            let sign = if *c < 0.0 { "-" } else { "+" };
            words += &match (words.is_empty(), *c < 0.0) {
                (true, false) => String::new(),
                (true, true) => sign.to_owned(),
                _ => format!(" {sign} "),
            };
            if c.abs() != 1.0 {
                words += &format!("{} ", c.abs());
            }
            words += name;
        }
        words
    }

    /// The error that no value fits.
    pub(crate) fn empty(&self) -> Error {
        Error::EmptyRange {
            constraint: self.in_words(),
            lower: self.lower,
            upper: self.upper,
        }
    }
}

/// A constraint that holds with equality at the solution.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ActiveConstraint {
    /// Its left side in words, a parameter's name for a bound.
    pub constraint: String,
    /// The value it is held at.
    pub value: f64,
    /// Change of the minimum per unit by which the constraint's value is raised, `∂cost/∂value`:
    /// not negative at a lower limit, not positive at an upper one.
    pub multiplier: f64,
}
