//! Rules by which the dense and the graph solver judge a point alike.

/// Relative offset below which the cost no longer tells two points apart (it changes by the square of the offset) and the last steps are
/// judged by the gradient instead.
pub(crate) const NEAR: f64 = 1e-5;

/// Falls of the cost in a row, each below rounding, after which it counts as flat.
pub(crate) const FLAT_STEPS: usize = 3;

/// Relative offset per `√m` below which it is rounding.
pub(crate) const RESOLVED: f64 = 4.0 * f64::EPSILON;

/// Relative rise of the cost that rounding may explain.
pub(crate) const RISE_BY_ROUNDING: f64 = 1e-9;

/// Singular values of a matrix with unit columns below this fraction of the largest one count as zero.
pub(crate) const RANK_TOLERANCE: f64 = 1e-10;
