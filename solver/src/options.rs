//! Options of a user; the default needs no change.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::constraints::Constraints;
use crate::descent::{
    Constrained, ConstrainedDogleg, ConstrainedGaussNewton, Damped, Descent, Dogleg, GaussNewton,
    Local, MinimumNorm, Step,
};
use crate::feasible::Polytope;
use crate::linear::LinearSolver;
use crate::loss::{Loss, RowLoss};
use crate::search::{Damping, Lambda, LineSearch, Search, TrustRadius};

/// A descent and a search.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Variant {
    /// The best on problems in general: Levenberg–Marquardt with delayed gratification and geodesic
    /// acceleration where the problem offers second derivatives, with Nielsen's damping elsewhere. Second derivatives are asked for
    /// only where the straight step does not do what it promises, and the damping falls faster where it does.
    #[default]
    Automatic,
    /// Damped steps, bent along the geodesic if wanted and if second derivatives are there.
    LevenbergMarquardt {
        /// Rule by which `λ` moves.
        damping: Damping,
        /// True to add the geodesic acceleration.
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
    /// One's own; it is not written (`serde` refuses it).
    #[serde(skip)]
    Own(OwnVariant),
}

/// A descent and a search of one's own.
///
/// ```
/// use stillpoint_solver::{Descent, Local, Options, OwnVariant, Search, Step, Trial, Variant};
///
/// /// Levenberg's step `argmin ‖J p + r‖² + λ ‖D p‖²`.
/// struct Plain;
///
/// impl Descent for Plain {
///     fn step(&self, local: &Local<'_>, lambda: f64) -> Option<Step> {
///         Some(local.step(local.factor().damped(local.residuals(), lambda)?))
///     }
/// }
///
/// /// Halves the damping on success, trebles it on failure.
/// struct Halving(f64);
///
/// impl Search for Halving {
///     fn size(&self) -> f64 { self.0 }
///     fn accepted(&mut self, _: Trial) { self.0 *= 0.5; }
///     fn rejected(&mut self, _: Trial) { self.0 *= 3.0; }
///     fn exhausted(&self) -> bool { self.0 > 1e20 }
/// }
///
/// let variant = Variant::own("halving", &Plain, |options, _| Box::new(Halving(options.first_damping)));
/// let options = Options { variant, ..Options::default() };
/// # use stillpoint_solver::{DualNum, Jet, Mask, Parameters, from_fn, solve};
/// let circle = from_fn(|x: &[Jet], out: &mut Vec<Jet>| out.extend([x[0] * x[0] - 2.0, x[0] - x[1]]));
/// let fit = solve(&circle, &Parameters::unnamed(&[1.0, 0.0]), &Mask::all(2), &options)?;
/// assert!((fit.parameters.values()[1] - 2f64.sqrt()).abs() < 1e-12);
/// # Ok::<(), stillpoint_solver::Error>(())
/// ```
#[derive(Clone, Copy)]
pub struct OwnVariant {
    name: &'static str,
    descent: &'static (dyn Descent + Sync),
    search: NewSearch,
}

/// A search for a start of scaled length `‖D x‖`.
pub type NewSearch = fn(&Options, f64) -> Box<dyn Search>;

impl std::fmt::Debug for OwnVariant {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("OwnVariant").field(&self.name).finish()
    }
}

impl PartialEq for OwnVariant {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
            && std::ptr::addr_eq(self.descent, other.descent)
            && std::ptr::fn_addr_eq(self.search, other.search)
    }
}

impl Variant {
    /// A descent of one's own, a constant or a `static`, with a search of one's own.
    pub fn own(
        name: &'static str,
        descent: &'static (dyn Descent + Sync),
        search: NewSearch,
    ) -> Self {
        Self::Own(OwnVariant {
            name,
            descent,
            search,
        })
    }

    /// True of variants that ask for second derivatives where the problem has them.
    pub(crate) fn uses_second_derivatives(self) -> bool {
        matches!(
            self,
            Self::Automatic | Self::LevenbergMarquardt { geodesic: true, .. }
        )
    }

    /// Every variant, to compare them; the default, [`Automatic`](Self::Automatic), first.
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
        std::iter::once(Self::Automatic)
            .chain(levenberg)
            .chain(others)
            .collect()
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
            Self::Automatic => "automatic".into(),
            Self::Own(own) => own.name.into(),
        }
    }

    /// The descent of the variant, within the constraints where the variant knows how.
    pub(crate) fn descent(self, polytope: Option<&Polytope>) -> Box<dyn Descent> {
        let within = |damped: Damped| -> Box<dyn Descent> {
            match polytope.cloned() {
                Some(polytope) => Box::new(Constrained { polytope, damped }),
                None => Box::new(damped),
            }
        };
        let damped = |geodesic: bool, sparing: bool| within(Damped { geodesic, sparing });
        match (self, polytope.cloned()) {
            // Within constraints every step asks for the second derivative: a straight one locks MGH11 on a bound, where its sum is
            // 35 times the least.
            (Self::Automatic, _) => damped(true, polytope.is_none()),
            (Self::LevenbergMarquardt { geodesic, .. }, _) => damped(geodesic, false),
            (Self::Dogleg, None) => Box::new(Dogleg),
            (Self::Dogleg, Some(polytope)) => Box::new(ConstrainedDogleg { polytope }),
            (Self::GaussNewton, None) => Box::new(GaussNewton),
            (Self::GaussNewton, Some(polytope)) => Box::new(ConstrainedGaussNewton { polytope }),
            (Self::GaussNewtonMinimumNorm, _) => Box::new(MinimumNorm),
            (Self::Own(own), _) => Box::new(Borrowed(own.descent)),
        }
    }
}

/// A descent of the user's.
struct Borrowed(&'static (dyn Descent + Sync));

impl Descent for Borrowed {
    fn step(&self, local: &Local<'_>, size: f64) -> Option<Step> {
        self.0.step(local, size)
    }
}

impl Options {
    /// The search of the variant, for a start of scaled length `‖D x‖`.
    ///
    /// Within constraints the damping falls slowly: a long step may lock a number on a bound.
    pub(crate) fn search(&self, scaled_size: f64, is_constrained: bool) -> Box<dyn Search> {
        let lambda = self.first_damping;
        match self.variant {
            Variant::Automatic => {
                let damping = Lambda::new(Damping::DelayedGratification, lambda);
                Box::new(match is_constrained {
                    true => damping,
                    false => damping.quick(),
                })
            }
            Variant::LevenbergMarquardt { damping, .. } => Box::new(Lambda::new(damping, lambda)),
            Variant::Dogleg => Box::new(TrustRadius::new(scaled_size, self.first_radius)),
            Variant::GaussNewton | Variant::GaussNewtonMinimumNorm => {
                Box::new(LineSearch::default())
            }
            Variant::Own(own) => (own.search)(self, scaled_size),
        }
    }
}

/// Way to solve and conditions to stop. What is missing where it is read is as in the default.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(default)]
pub struct Options {
    /// The variant; the default is the best on problems in general.
    pub variant: Variant,
    /// Method for the linear problem of each step.
    pub linear_solver: LinearSolver,
    /// Most steps tried.
    pub max_iterations: usize,
    /// Relative offset `‖P r‖ / ‖r‖` (`P` projects on the columns of the Jacobian) at which the
    /// residual counts as orthogonal; the last steps go on to `1e-11`, or to what double precision allows.
    ///
    /// Source: Bates and Watts, "A relative offset orthogonality convergence criterion for
    /// nonlinear least squares", 1981.
    pub gradient_tolerance: f64,
    /// True to take those last steps; `false` ends with the step that reaches `gradient_tolerance`, with as many digits fewer.
    pub last_digits: bool,
    /// Smallest step `‖D p‖` relative to `‖D x‖`.
    pub step_tolerance: f64,
    /// First damping `λ` of Levenberg–Marquardt; it multiplies unit columns.
    pub first_damping: f64,
    /// First trust radius of the dogleg relative to `‖D x‖`.
    pub first_radius: f64,
    /// Most second derivatives along a direction; beyond, steps are straight.
    pub max_second_derivatives: usize,
    /// Bounds and linear constraints; every variant but the minimum norm and one's own.
    pub constraints: Constraints,
    /// Cost of a residual.
    pub loss: Loss,
    /// Other losses for some of the rows; the first that names a row holds.
    pub row_losses: Vec<RowLoss>,
    /// If true, robust losses start wide, as least squares, and narrow to their scale in at most 20 stages
    /// (graduated non-convexity: Blake and Zisserman, "Visual Reconstruction", 1987): for starts far
    /// from the solution. Where too few residuals count at the start this happens by itself.
    pub graduated: bool,
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
            last_digits: true,
            step_tolerance: 1e-15,
            first_damping: 1e-3,
            first_radius: 100.0,
            max_second_derivatives: 10_000,
            constraints: Constraints::new(),
            loss: Loss::Quadratic,
            row_losses: Vec::new(),
            graduated: false,
            time_limit: None,
            cancel: None,
        }
    }
}
