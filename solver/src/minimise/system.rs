//! A problem in its free parameters: what the loop works on.

use std::cell::{Cell, Ref, RefCell};

use serde::{Deserialize, Serialize};

use crate::linear::vector::half_square;
use crate::linear::{Jacobian, Linearization};
use crate::parameters::{Mask, Parameters};
use crate::residual::{Problem, of_shape};

/// Residuals, linearisation and curvature at free parameters `z` (`n`).
pub(crate) trait System {
    /// `r(z)` (`m`).
    fn residuals(&self, z: &[f64]) -> Vec<f64>;

    /// Minimised cost from residuals; infinite where one is not finite.
    fn cost_of(&self, residuals: &[f64]) -> f64 {
        half_square(residuals)
    }

    /// Residuals, cost and Jacobian at `z`; entries may be infinite or not a number.
    fn linearize(&self, z: &[f64]) -> Linearization;

    /// `d²/dt² r(z + t·v)` at `t = 0`, where the problem offers it.
    fn second_derivative(&self, z: &[f64], v: &[f64]) -> Option<Vec<f64>>;

    /// The column to blame for a derivative of residual `row` that is not finite; see [`culprit`].
    fn culprit(&self, z: &[f64], row: usize) -> Option<usize>;

    /// Minimised cost at `z`.
    fn cost(&self, z: &[f64]) -> f64 {
        self.cost_of(&self.residuals(z))
    }

    /// True where second derivatives were asked for and the problem has none to offer.
    fn refuses_second_derivatives(&self) -> bool {
        false
    }

    /// True where second derivatives were asked for and the problem had them.
    fn offers_second_derivatives(&self) -> bool {
        false
    }
}

/// A [`Problem`] with a dense Jacobian and some parameters held.
pub(crate) struct Dense<'a> {
    problem: &'a dyn Problem,
    /// All parameters; the free ones as they were last asked for.
    full: RefCell<Vec<f64>>,
    /// A direction, zero where parameters are held.
    direction: RefCell<Vec<f64>>,
    free: Vec<usize>,
    /// The residuals of a step tried, of which only the cost is asked.
    tried: RefCell<Vec<f64>>,
    /// Number of residuals seen last: room for the next ones.
    rows: Cell<usize>,
}

impl<'a> Dense<'a> {
    /// The parameters not freed by `mask` stay at their values in `start`.
    pub fn new(problem: &'a dyn Problem, start: &Parameters, mask: &Mask) -> Self {
        Self {
            problem,
            full: RefCell::new(start.values().to_vec()),
            direction: RefCell::new(vec![0.0; start.len()]),
            free: mask.free_indices(),
            tried: RefCell::default(),
            rows: Cell::new(0),
        }
    }

    /// True where there are more residuals, or fewer, than there were: costs cannot be compared.
    fn is_other_length(&self, rows: usize) -> bool {
        self.rows.get() != 0 && rows != self.rows.get()
    }

    fn room(&self) -> Vec<f64> {
        Vec::with_capacity(self.rows.get())
    }

    /// The free entries of a full vector.
    pub fn restrict(&self, x: &[f64]) -> Vec<f64> {
        self.free.iter().map(|&k| x[k]).collect()
    }

    /// All parameters, the free ones at `z`.
    pub fn embed(&self, z: &[f64]) -> Ref<'_, Vec<f64>> {
        self.scatter(&self.full, z)
    }

    /// Writes the free entries of a full vector.
    fn scatter<'v>(&self, x: &'v RefCell<Vec<f64>>, z: &[f64]) -> Ref<'v, Vec<f64>> {
        for (&k, &value) in self.free.iter().zip(z) {
            x.borrow_mut()[k] = value;
        }
        x.borrow()
    }
}

impl System for Dense<'_> {
    fn residuals(&self, z: &[f64]) -> Vec<f64> {
        let mut residuals = self.room();
        self.problem.values(&self.embed(z), &mut residuals);
        residuals
    }

    fn linearize(&self, z: &[f64]) -> Linearization {
        let mut residuals = self.room();
        let jacobian = self
            .problem
            .linearize(&self.embed(z), &self.free, &mut residuals);
        let jacobian = of_shape(jacobian, residuals.len(), self.free.len());
        if self.is_other_length(residuals.len()) {
            residuals.fill(f64::NAN);
        } else {
            self.rows.set(residuals.len());
        }
        let cost = half_square(&residuals);
        Linearization {
            residuals,
            cost,
            jacobian: Jacobian(jacobian),
        }
    }

    fn second_derivative(&self, z: &[f64], v: &[f64]) -> Option<Vec<f64>> {
        let mut out = self.room();
        let direction = self.scatter(&self.direction, v);
        let offered = self
            .problem
            .second_derivative(&self.embed(z), &direction, &mut out);
        let offered = offered && !self.is_other_length(out.len());
        (offered && out.iter().all(|v| v.is_finite())).then_some(out)
    }

    fn culprit(&self, z: &[f64], row: usize) -> Option<usize> {
        culprit(self.problem, &self.embed(z), &self.free, row)
    }

    fn cost(&self, z: &[f64]) -> f64 {
        let mut tried = self.tried.borrow_mut();
        self.problem.values(&self.embed(z), &mut tried);
        if self.is_other_length(tried.len()) {
            return f64::INFINITY;
        }
        self.cost_of(&tried)
    }
}

/// The first of the parameters `free` by which the derivative of residual `row` is not finite.
///
/// Asked for one at a time: where several derivatives are carried along together, an infinite one
/// turns the others, as `∞ · 0`, into what is not a number.
pub(crate) fn culprit(
    problem: &dyn Problem,
    x: &[f64],
    free: &[usize],
    row: usize,
) -> Option<usize> {
    let mut residuals = Vec::new();
    free.iter().position(|&k| {
        let column = problem.linearize(x, &[k], &mut residuals);
        row < column.nrows() && column.ncols() == 1 && !column[(row, 0)].is_finite()
    })
}

/// Numbers of evaluations of the problem, the last steps to double precision included, of which a trace of the
/// iterations says nothing where they are judged by the gradient.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Evaluations {
    /// Residuals alone; where a step is sure to be taken they come with the Jacobian.
    pub residuals: usize,
    /// Residuals with their Jacobian.
    pub jacobians: usize,
    /// Second derivatives along one direction.
    pub second_derivatives: usize,
}

/// Share of the second derivatives that is kept for where a run stalls: one in so many.
const RESERVE: usize = 4;

/// A system that counts.
pub(crate) struct Counted<'a> {
    inner: &'a dyn System,
    count: Cell<Evaluations>,
    /// Most second derivatives; beyond, none are offered.
    budget: usize,
    /// Number of them that is kept for a run that has stalled.
    reserve: Cell<usize>,
    refused: Cell<bool>,
    /// The last points whose cost was asked for: descent and search ask for the same.
    known: RefCell<[(Vec<f64>, f64); 2]>,
}

impl<'a> Counted<'a> {
    /// Nothing counted yet.
    pub fn new(inner: &'a dyn System, budget: usize) -> Self {
        Self {
            inner,
            count: Cell::default(),
            budget,
            reserve: Cell::new(budget / RESERVE),
            refused: Cell::new(false),
            known: RefCell::default(),
        }
    }

    /// The count so far.
    pub fn evaluations(&self) -> Evaluations {
        self.count.get()
    }

    /// Offers what was kept, from now on.
    pub fn open_reserve(&self) {
        self.reserve.set(0);
    }

    fn add(&self, one: impl FnOnce(&mut Evaluations)) {
        let mut count = self.count.get();
        one(&mut count);
        self.count.set(count);
    }
}

impl System for Counted<'_> {
    fn residuals(&self, z: &[f64]) -> Vec<f64> {
        self.add(|count| count.residuals += 1);
        self.inner.residuals(z)
    }

    fn cost_of(&self, residuals: &[f64]) -> f64 {
        self.inner.cost_of(residuals)
    }

    fn linearize(&self, z: &[f64]) -> Linearization {
        self.add(|count| count.jacobians += 1);
        self.inner.linearize(z)
    }

    fn second_derivative(&self, z: &[f64], v: &[f64]) -> Option<Vec<f64>> {
        let most = self.budget - self.reserve.get();
        if self.refused.get() || self.count.get().second_derivatives >= most {
            return None;
        }
        let offered = self.inner.second_derivative(z, v);
        if offered.is_some() {
            self.add(|count| count.second_derivatives += 1);
        } else if self.count.get().second_derivatives == 0 {
            self.refused.set(true);
        }
        offered
    }

    fn refuses_second_derivatives(&self) -> bool {
        self.refused.get()
    }

    fn offers_second_derivatives(&self) -> bool {
        self.count.get().second_derivatives > 0
    }

    fn culprit(&self, z: &[f64], row: usize) -> Option<usize> {
        self.inner.culprit(z, row)
    }

    fn cost(&self, z: &[f64]) -> f64 {
        let mut known = self.known.borrow_mut();
        if let Some(place) = known.iter().position(|(at, _)| at == z) {
            return known[place].1;
        }
        self.add(|count| count.residuals += 1);
        let cost = self.inner.cost(z);
        known.rotate_right(1);
        (known[0].0).clear();
        known[0].0.extend_from_slice(z);
        known[0].1 = cost;
        cost
    }
}
