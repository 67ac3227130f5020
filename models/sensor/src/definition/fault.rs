//! Errors in the definition of an effect.

use std::fmt;

use crate::expression::ParseError;

/// An entry of a definition and what is wrong with it; the words are those of the crate `findings`.
#[derive(Clone, Debug, PartialEq)]
pub struct DefinitionError {
    /// The entry: `name`, `x`, `parameters.1.typical` …
    pub key: String,
    /// Fault of the entry.
    pub fault: DefinitionFault,
}

impl DefinitionError {
    pub(crate) fn new(key: impl Into<String>, fault: DefinitionFault) -> Self {
        Self {
            key: key.into(),
            fault,
        }
    }
}

/// Fault of an entry of a definition.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum DefinitionFault {
    /// This name is not in snake case.
    NotSnakeCase(String),
    /// This name means something else already.
    NameTaken(String),
    /// This name is that of another effect.
    EffectTaken(String),
    /// There is no parameter that switches the effect off.
    NoParameter,
    /// A size is not positive.
    NotPositive(f64),
    /// A value is no number.
    NotFinite(f64),
    /// An expression cannot be read.
    Unreadable {
        /// The expression.
        text: String,
        /// Position and cause of the error.
        error: ParseError,
    },
    /// There is no expression on any axis.
    NoExpression,
    /// The expressions take too many steps.
    Costly {
        /// Steps that they take.
        cost: u64,
        /// Steps that they may take.
        most: u64,
        /// Steps of a function.
        call: u64,
    },
    /// The effect has this size at its nominal parameters.
    NotSilent(f64),
    /// The effect is this at its typical parameters in some motion.
    NoNumber(f64),
    /// A factor with this covariate has the power of zero.
    PowerOfZero(String),
}

impl fmt::Display for DefinitionError {
    /// The entry and the fault as data.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {:?}", self.key, self.fault)
    }
}

impl std::error::Error for DefinitionError {}
