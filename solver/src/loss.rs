//! Robust losses.

pub(crate) mod check;
pub(crate) mod graduation;
mod places;
pub(crate) mod robust;
pub(crate) mod sandwich;

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::loss::places::places;

/// Tolerance of `ρ(0)` and `ρ′(0)` of a loss of one's own are to 0 and 1.
const SHAPE: f64 = 1e-6;

/// Cost of a residual: `½ σ² Σ ρ((rᵢ / σ)²)` with `ρ(s) = s` for the quadratic loss.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Loss {
    /// `ρ = s`: least squares.
    #[default]
    Quadratic,
    /// `ρ = s` up to 1, then `2 √s − 1`: outliers count by their size.
    Huber(LossScale),
    /// `ρ = ln(1 + s)`: outliers count ever less.
    Cauchy(LossScale),
    /// `ρ = (1 − (1 − s)³) / 3` up to 1, then `1/3`: outliers do not count at all.
    Tukey(LossScale),
    /// `ρ = 2 (√(1 + s) − 1)`: Huber's loss without its corner.
    SoftL1(LossScale),
    /// `ρ = arctan s`: the cost of an outlier is bounded by `π/2`.
    Arctan(LossScale),
    /// `ρ = s / (1 + s)`: the cost of an outlier is bounded by 1.
    GemanMcClure(LossScale),
    /// A loss of one's own; it is not written (`serde` refuses it).
    #[serde(skip)]
    Own(OwnLoss, LossScale),
}

/// A loss `ρ(s)` of `s = (r / σ)²`, to be used as [`Loss::own`].
///
/// ```
/// use stillpoint_solver::{Loss, LossFunction, LossScale};
///
/// /// Fair: `ρ = 2 (√s − ln(1 + √s))`.
/// #[derive(Debug)]
/// struct Fair;
///
/// impl LossFunction for Fair {
///     fn at(&self, s: f64) -> [f64; 3] {
///         let root = s.sqrt().max(1e-150);
///         let below = 1.0 + root;
///         [2.0 * (root - root.ln_1p()), 1.0 / below, -0.5 / (root * below * below)]
///     }
/// }
///
/// let loss = Loss::own(&Fair, LossScale::Estimated(1.4));
/// assert_eq!(loss.weight(0.0, 1.0), 1.0);
/// ```
pub trait LossFunction: std::fmt::Debug + Sync {
    /// `ρ`, `ρ′` and `ρ″` at `s ≥ 0`, with `ρ(0) = 0`, `ρ′(0) = 1` and `ρ′ ≥ 0`, which is checked before a fit;
    /// [`check_loss`](crate::check_loss) compares the derivatives with differences.
    fn at(&self, s: f64) -> [f64; 3];
}

/// A [`LossFunction`] behind a reference; equal to itself only.
#[derive(Clone, Copy, Debug)]
pub struct OwnLoss(&'static dyn LossFunction);

impl PartialEq for OwnLoss {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::addr_eq(self.0, other.0)
    }
}

/// A loss for some rows of the residuals, in place of [`Options::loss`](crate::Options::loss).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RowLoss {
    /// The rows.
    pub rows: std::ops::Range<usize>,
    /// Their loss.
    pub loss: Loss,
}

/// The residual `σ` at which a loss bends.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LossScale {
    /// In the unit of the residuals.
    Given(f64),
    /// This many robust standard deviations, `1.4826 · median |r|`, estimated along with the
    /// parameters in at most 30 rounds. For 95 % efficiency on Gaussian residuals: Huber 1.345, Cauchy 2.385,
    /// Tukey 4.685.
    Estimated(f64),
}

impl Loss {
    /// A loss of one's own: a constant or a `static`.
    pub fn own(function: &'static dyn LossFunction, scale: LossScale) -> Self {
        Self::Own(OwnLoss(function), scale)
    }

    /// Check of a loss of one's own; the others pass.
    ///
    /// # Errors
    /// `ρ(0)` other than 0 or `ρ′(0)` other than 1, to 1e-6: such a loss does not count a small residual by its
    /// square, so that costs and standard errors mean something else. A slope below 0, or none: a larger residual
    /// would cost less, and weights have no square root.
    pub(crate) fn check(self) -> Result<(), Error> {
        let [value, slope, _] = self.at(0.0);
        let close = value.abs() <= SHAPE && (slope - 1.0).abs() <= SHAPE;
        if !close {
            return Err(Error::LossShape { value, slope });
        }
        if !matches!(self, Self::Own(..)) {
            return Ok(());
        }
        let slopes = places().map(|s| (s, self.at(s)[1]));
        match slopes
            .into_iter()
            .find(|(_, slope)| slope.is_nan() || *slope < 0.0)
        {
            Some((s, slope)) => Err(Error::LossSlope { s, slope }),
            None => Ok(()),
        }
    }

    /// Its scale, if it has one.
    pub fn scale(self) -> Option<LossScale> {
        match self {
            Self::Quadratic => None,
            Self::Huber(scale)
            | Self::Cauchy(scale)
            | Self::Tukey(scale)
            | Self::SoftL1(scale)
            | Self::Arctan(scale)
            | Self::GemanMcClure(scale)
            | Self::Own(_, scale) => Some(scale),
        }
    }

    /// `ρ`, `ρ′` and `ρ″` at `s = (r / σ)²`.
    pub(crate) fn at(self, s: f64) -> [f64; 3] {
        match self {
            Self::Quadratic => [s, 1.0, 0.0],
            Self::Huber(_) if s <= 1.0 => [s, 1.0, 0.0],
            Self::Huber(_) => {
                let root = s.sqrt();
                [2.0 * root - 1.0, 1.0 / root, -0.5 / (s * root)]
            }
            Self::Cauchy(_) => [s.ln_1p(), 1.0 / (1.0 + s), -(1.0 + s).powi(-2)],
            Self::Tukey(_) if s <= 1.0 => {
                let u = 1.0 - s;
                [(1.0 - u.powi(3)) / 3.0, u * u, -2.0 * u]
            }
            Self::Tukey(_) => [1.0 / 3.0, 0.0, 0.0],
            Self::SoftL1(_) => {
                let root = (1.0 + s).sqrt();
                // 2 (√(1 + s) − 1) without cancellation near zero.
                [
                    2.0 * s / (1.0 + root),
                    1.0 / root,
                    -0.5 / (root * (1.0 + s)),
                ]
            }
            Self::Arctan(_) => {
                let slope = 1.0 / (1.0 + s * s);
                [s.atan(), slope, -2.0 * s * slope * slope]
            }
            Self::GemanMcClure(_) => {
                let u = 1.0 / (1.0 + s);
                [s * u, u * u, -2.0 * u * u * u]
            }
            Self::Own(function, _) => function.0.at(s),
        }
    }

    /// `½ σ² Σ ρ((r / σ)²)`, infinite where that is not a number.
    pub(crate) fn cost(self, residuals: &[f64], scale: f64) -> f64 {
        let each = residuals.iter().map(|r| self.at((r / scale).powi(2))[0]);
        let cost = 0.5 * scale * scale * each.sum::<f64>();
        if cost.is_nan() { f64::INFINITY } else { cost }
    }

    /// `½ σ² ρ(s)` of a factor of `‖r‖²`, `s = ‖r‖² / σ²`, for a scale that is given; without one `½ ‖r‖²`.
    pub(crate) fn cost_of_square(self, square: f64) -> f64 {
        let variance = self.given_variance();
        0.5 * variance * self.at(square / variance)[0]
    }

    /// `ρ′(s)` and `ρ″(s) / σ²`, `s = ‖r‖² / σ²`.
    pub(crate) fn slope_and_bend(self, square: f64) -> (f64, f64) {
        let variance = self.given_variance();
        let [_, first, second] = self.at(square / variance);
        (first, second / variance)
    }

    fn given_variance(self) -> f64 {
        match self.scale() {
            Some(LossScale::Given(scale) | LossScale::Estimated(scale)) => scale * scale,
            None => 1.0,
        }
    }

    /// The same loss with a scale that is known.
    pub(crate) fn with_scale(self, scale: f64) -> Self {
        let given = LossScale::Given(scale);
        match self {
            Self::Quadratic => Self::Quadratic,
            Self::Huber(_) => Self::Huber(given),
            Self::Cauchy(_) => Self::Cauchy(given),
            Self::Tukey(_) => Self::Tukey(given),
            Self::SoftL1(_) => Self::SoftL1(given),
            Self::Arctan(_) => Self::Arctan(given),
            Self::GemanMcClure(_) => Self::GemanMcClure(given),
            Self::Own(function, _) => Self::Own(function, given),
        }
    }

    /// The weight `ρ′((r / σ)²)` of a residual: 1 where it counts in full, 0 where not at all.
    pub fn weight(self, residual: f64, scale: f64) -> f64 {
        self.at((residual / scale).powi(2))[1]
    }
}

/// The losses of the crate.
#[cfg(test)]
pub(crate) fn all(scale: LossScale) -> [Loss; 7] {
    [
        Loss::Quadratic,
        Loss::Huber(scale),
        Loss::Cauchy(scale),
        Loss::Tukey(scale),
        Loss::SoftL1(scale),
        Loss::Arctan(scale),
        Loss::GemanMcClure(scale),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slopes_and_curvatures_are_the_derivatives_of_the_loss() {
        let scale = LossScale::Given(1.0);
        for loss in all(scale) {
            for s in [0.1, 0.7, 1.3, 9.0] {
                let h = 1e-5;
                let ([below, slope_below, _], [above, slope_above, _]) =
                    (loss.at(s - h), loss.at(s + h));
                let [_, first, second] = loss.at(s);
                assert!(
                    (first - (above - below) / (2.0 * h)).abs() < 1e-9,
                    "{loss:?} {s}"
                );
                assert!(
                    (second - (slope_above - slope_below) / (2.0 * h)).abs() < 1e-9,
                    "{loss:?} {s}"
                );
            }
        }
    }
}
