//! What a user may choose; the default needs no change.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::constraints::Constraints;
use crate::descent::{Constrained, Damped, Descent, Dogleg, GaussNewton, MinimumNorm};
use crate::feasible::Polytope;
use crate::linear::LinearSolver;
use crate::loss::Loss;
use crate::search::{DelayedGratification, LineSearch, Marquardt, Nielsen, Search, TrustRadius};

/// How `λ` moves in Levenberg–Marquardt.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Damping {
    /// A tenth on success, ten times on failure.
    Marquardt,
    /// By the gain ratio, accelerating on failure.
    Nielsen,
    /// A third on success, twice on failure.
    DelayedGratification,
}

/// A descent and a search.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Variant {
    /// Damped steps, bent along the geodesic if wanted and if second derivatives are there.
    LevenbergMarquardt {
        /// How `λ` moves.
        damping: Damping,
        /// Whether to add the geodesic acceleration.
        geodesic: bool,
    },
    /// Powell's dogleg in a trust region.
    Dogleg,
    /// Undamped steps, halved until the cost falls.
    GaussNewton,
    /// Undamped steps of minimum norm in the parameters' own units, halved until the cost falls:
    /// finds the minimum nearest the start where the rank is short. Its result depends on the
    /// units; that of every other variant does not.
    GaussNewtonMinimumNorm,
}

impl Default for Variant {
    fn default() -> Self {
        Self::LevenbergMarquardt {
            damping: Damping::DelayedGratification,
            geodesic: true,
        }
    }
}

impl Variant {
    /// Every variant, to compare them.
    pub fn all() -> Vec<Self> {
        let dampings = [
            Damping::Marquardt,
            Damping::Nielsen,
            Damping::DelayedGratification,
        ];
        let levenberg = dampings.into_iter().flat_map(|damping| {
            [true, false].map(|geodesic| Self::LevenbergMarquardt { damping, geodesic })
        });
        let others = [
            Self::Dogleg,
            Self::GaussNewton,
            Self::GaussNewtonMinimumNorm,
        ];
        levenberg.chain(others).collect()
    }

    /// A short name.
    pub fn name(self) -> String {
        match self {
            Self::LevenbergMarquardt { damping, geodesic } => {
                let rule = match damping {
                    Damping::Marquardt => "marquardt",
                    Damping::Nielsen => "nielsen",
                    Damping::DelayedGratification => "delayed",
                };
                format!("lm-{rule}{}", if geodesic { "-geodesic" } else { "" })
            }
            Self::Dogleg => "dogleg".into(),
            Self::GaussNewton => "gauss-newton".into(),
            Self::GaussNewtonMinimumNorm => "gauss-newton-minimum-norm".into(),
        }
    }

    /// The descent of the variant, within the constraints where the variant knows how.
    pub(crate) fn descent(self, polytope: Option<&Polytope>) -> Box<dyn Descent> {
        match self {
            Self::LevenbergMarquardt { geodesic, .. } => match polytope {
                Some(p) => Box::new(Constrained {
                    polytope: p.clone(),
                    damped: Damped { geodesic },
                }),
                None => Box::new(Damped { geodesic }),
            },
            Self::Dogleg => Box::new(Dogleg),
            Self::GaussNewton => Box::new(GaussNewton),
            Self::GaussNewtonMinimumNorm => Box::new(MinimumNorm),
        }
    }

    /// The search of the variant, for a start of scaled length `‖D x‖`.
    pub(crate) fn search(self, scaled_size: f64) -> Box<dyn Search> {
        match self {
            Self::LevenbergMarquardt { damping, .. } => match damping {
                Damping::Marquardt => Box::new(Marquardt::default()),
                Damping::Nielsen => Box::new(Nielsen::default()),
                Damping::DelayedGratification => Box::new(DelayedGratification::default()),
            },
            Self::Dogleg => Box::new(TrustRadius::new(scaled_size)),
            Self::GaussNewton | Self::GaussNewtonMinimumNorm => Box::new(LineSearch::default()),
        }
    }
}

/// How to solve and when to stop. What is missing where it is read is as in the default.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(default)]
pub struct Options {
    /// The variant; the default is the best on problems in general.
    pub variant: Variant,
    /// How the linear problem of each step is solved.
    pub linear_solver: LinearSolver,
    /// Most steps tried.
    pub max_iterations: usize,
    /// Relative offset `‖P r‖ / ‖r‖` (`P` projects on the columns of the Jacobian) at which the
    /// residual counts as orthogonal; the last steps go on to what double precision allows.
    ///
    /// Source: Bates and Watts, "A relative offset orthogonality convergence criterion for
    /// nonlinear least squares", 1981.
    pub gradient_tolerance: f64,
    /// Smallest step `‖D p‖` relative to `‖D x‖`.
    pub step_tolerance: f64,
    /// Bounds and linear constraints; Levenberg–Marquardt only.
    pub constraints: Constraints,
    /// What a residual costs.
    pub loss: Loss,
    /// Longest time to spend; looked at before every step.
    pub time_limit: Option<Duration>,
    /// Set from another thread, it stops the run before its next step. Not written.
    #[serde(skip)]
    pub cancel: Option<Arc<AtomicBool>>,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            variant: Variant::default(),
            linear_solver: LinearSolver::default(),
            max_iterations: 5_000,
            gradient_tolerance: 1e-8,
            step_tolerance: 1e-15,
            constraints: Constraints::new(),
            loss: Loss::Quadratic,
            time_limit: None,
            cancel: None,
        }
    }
}
