//! Gauss–Newton steps, damped where they have to be, for the points on the way.

use crate::methods::joint::blocks::arrow::{Arrow, ArrowFactor};
use crate::methods::joint::blocks::columns::Columns;
use crate::methods::joint::noise::weights::{White, Whitening};
use crate::methods::joint::rows::{Linear, Rows};

findings::tuning! {
    /// Steps at most, those that fail included: a point on the way need not be a minimum, and the last fit is the solver's.
    STEPS: usize = 24;

    /// A step whose effect on the rows is below this share of their length is the last: a hundredth of a
    /// standard deviation of all parameters together.
    NEAR: f64 = 1e-6;

    /// The same, as a sum of squares, of steps that have to be held back: a tenth of a standard deviation.
    IN_A_VALLEY: f64 = 0.01;

    /// Most steps with the same Jacobian.
    CHORDS: usize = 8;

    /// Relative rise of the cost that rounding explains.
    ROUNDING: f64 = 1e-9;

    /// Smallest squared pivot of normal equations with unit columns that keep digits enough for a step.
    SAFE: f64 = 1e-10;

    /// Damping added to the diagonal of normal equations that are closer to singular: combinations that hardly change the
    /// rows stay where they are.
    HELD_UP: f64 = 1e-9;

    /// The first damping of a step that raised the cost.
    LEAST_DAMPING: f64 = 1e-6;
}

/// Rows under a whitening.
pub struct Weighted<'a> {
    /// The rows.
    pub rows: &'a Rows<'a>,
    /// Their whitening.
    pub whitening: &'a Whitening,
}

impl Linear {
    /// Residuals and free columns, whitened by everything.
    pub fn whitened(&self, free: &[usize], whitening: &Whitening) -> (Vec<f64>, Columns) {
        let jacobian = whitening.whiten(self.jacobian.select(free));
        (whitening.whiten_column(&self.residuals), jacobian)
    }

    /// The same, whitened by the white noise alone.
    pub fn whitened_by(&self, free: &[usize], white: &White) -> (Vec<f64>, Columns) {
        let mut jacobian = self.jacobian.select(free);
        jacobian.apply(|rows, a| white.apply_rows(rows, a));
        (white.whiten(&self.residuals), jacobian)
    }

    /// The rows at `x` as they would be without its parameters from `plain` on, which are disturbances.
    pub fn without_disturbances(&self, x: &[f64], plain: usize) -> Self {
        let kept: Vec<usize> = (0..plain).collect();
        let own: Vec<usize> = (plain..self.jacobian.ncols()).collect();
        let explained = self.jacobian.select(&own).times(&x[plain..]);
        let residuals = self.residuals.iter().zip(explained);
        Self {
            residuals: residuals.map(|(r, by)| r - by).collect(),
            jacobian: self.jacobian.select(&kept),
        }
    }
}

/// Steps from `x` until they are small against the noise, or as many as a point on the way is worth; `None` where the
/// rows are no numbers.
///
/// A step is undamped until one raises the cost; then `λ` holds it back (Levenberg 1944, unit columns), ten times more
/// on every failure and ten times less on every second success in a row.
pub fn approach(weighted: &Weighted<'_>, x: &[f64], free: &[usize]) -> Option<Approached> {
    let mut x = x.to_vec();
    let mut at = Near::new(weighted, &x, free)?;
    let (mut damping, mut held_back) = (0.0, false);
    let mut taken = 1;
    while taken < STEPS.get() {
        let (step, left) = at.equations.step(&at.residuals);
        let enough = if damping > 0.0 {
            IN_A_VALLEY.get()
        } else {
            NEAR.get() * (1.0 + at.cost)
        };
        if left <= enough {
            break;
        }
        let step = if damping > 0.0 {
            at.equations.damped(damping, &at.residuals)?
        } else {
            step
        };
        let mut tried = x.clone();
        add(&mut tried, free, &step);
        let next = Near::new(weighted, &tried, free);
        taken += 1;
        match next.filter(|next| next.cost <= at.cost * (1.0 + ROUNDING.get())) {
            Some(next) => {
                (x, at) = (tried, next);
                if !held_back {
                    damping = if damping > LEAST_DAMPING.get() {
                        0.1 * damping
                    } else {
                        0.0
                    };
                }
                held_back = false;
            }
            None => {
                damping = (10.0 * damping).max(LEAST_DAMPING.get());
                held_back = true;
            }
        }
    }
    Some(Approached {
        x,
        linear: at.linear,
        equations: at.equations,
        taken,
    })
}

/// The rows at a point on the way.
struct Near {
    linear: Linear,
    residuals: Vec<f64>,
    cost: f64,
    equations: Normal,
}

impl Near {
    /// `None` where the cost is no number.
    fn new(weighted: &Weighted<'_>, x: &[f64], free: &[usize]) -> Option<Self> {
        let linear = weighted.rows.linearize(x);
        let (residuals, jacobian) = linear.whitened(free, weighted.whitening);
        let cost: f64 = residuals.iter().map(|v| v * v).sum();
        Some(Self {
            equations: Normal::new(jacobian).filter(|_| cost.is_finite())?,
            linear,
            residuals,
            cost,
        })
    }
}

/// Point reached by plain Gauss–Newton steps.
pub struct Approached {
    /// The parameters.
    pub x: Vec<f64>,
    /// The rows there.
    pub linear: Linear,
    equations: Normal,
    /// Number of linearisations of the rows.
    pub taken: usize,
}

impl Approached {
    /// Goes on with the Jacobian as it is, at the price of residuals alone: each step leaves about a
    /// thousandth of the way, until rounding stops them. Where that leads, and the square of what its last step did to the
    /// rows.
    pub fn settled(&self, weighted: &Weighted<'_>, free: &[usize]) -> (Vec<f64>, f64) {
        let mut x = self.x.clone();
        let mut before = f64::INFINITY;
        for _ in 0..CHORDS.get() {
            let r = weighted
                .whitening
                .whiten_column(&weighted.rows.residuals(&x));
            let (step, square) = self.equations.step(&r);
            if square.is_nan() || square > 0.1 * before {
                break;
            }
            add(&mut x, free, &step);
            before = square;
        }
        (x, before)
    }
}

fn add(x: &mut [f64], free: &[usize], step: &[f64]) {
    for (&place, step) in free.iter().zip(step) {
        x[place] += step;
    }
}

/// Normal equations with unit columns.
struct Normal {
    jacobian: Columns,
    norms: Vec<f64>,
    matrix: Arrow,
    factor: ArrowFactor,
}

impl Normal {
    /// Held up where they are close to singular; `None` where they are no numbers.
    fn new(mut jacobian: Columns) -> Option<Self> {
        let unit_if_zero = |norm: f64| if norm > 0.0 { norm } else { 1.0 };
        let norms: Vec<f64> = jacobian.norms().into_iter().map(unit_if_zero).collect();
        jacobian.divide(&norms);
        let matrix = Arrow::gram(&jacobian);
        let factor = matrix.factor(0.0).filter(is_safe);
        Some(Self {
            factor: match factor {
                Some(factor) => factor,
                None => matrix.factor(HELD_UP.get())?,
            },
            jacobian,
            norms,
            matrix,
        })
    }

    /// The Gauss–Newton step `p` for residuals `r`, and `‖J p‖²`.
    fn step(&self, r: &[f64]) -> (Vec<f64>, f64) {
        let right = self.right(r);
        let scaled = self.factor.solve(&right);
        let square = scaled.iter().zip(&right).map(|(s, r)| s * r).sum();
        (self.unscaled(&scaled), square)
    }

    /// The step of `(JᵀJ + λ I) p = −Jᵀ r`.
    fn damped(&self, damping: f64, r: &[f64]) -> Option<Vec<f64>> {
        let factor = self.matrix.factor(damping)?;
        Some(self.unscaled(&factor.solve(&self.right(r))))
    }

    fn right(&self, r: &[f64]) -> Vec<f64> {
        let by = self.jacobian.transposed_times(r);
        by.into_iter().map(|v| -v).collect()
    }

    fn unscaled(&self, scaled: &[f64]) -> Vec<f64> {
        let scaled = scaled.iter().zip(&self.norms);
        scaled.map(|(s, n)| s / n).collect()
    }
}

/// Returns true if the pivots keep enough digits for a step.
fn is_safe(factor: &ArrowFactor) -> bool {
    let least = factor
        .pivots()
        .fold(f64::INFINITY, |least, pivot| least.min(pivot * pivot));
    least >= SAFE.get()
}
