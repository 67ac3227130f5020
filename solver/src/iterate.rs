//! The loop, and nothing else: linearise, step, accept or reject.

use crate::descent::{Descent, Local};
use crate::linear::Factor;
use crate::options::Options;
use crate::point::{NotFinite, Point};
use crate::report::Iteration;
use crate::scaling::Scaling;
use crate::search::{Search, Trial};
use crate::system::System;
use crate::vector::{add, norm, scaled_norm};

/// Relative offset below which the cost no longer tells two points apart (it changes by the square
/// of the offset) and the last steps are judged by the gradient instead.
const NEAR: f64 = 1e-6;

/// Falls of the cost in a row, each below rounding, after which it counts as flat.
const FLAT_STEPS: usize = 3;

/// Why the loop was left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Stop {
    /// The residual is nearly orthogonal to the columns of the Jacobian.
    Near,
    /// The step no longer changes the parameters.
    Step,
    /// The cost no longer falls.
    Flat,
    /// The step limit.
    IterationLimit,
    /// No step leads down.
    Stalled,
    /// Every step leads to where the problem is not finite.
    NotFinite(NotFinite),
}

/// A run under way.
pub(crate) struct Run<'a> {
    /// The problem.
    pub system: &'a dyn System,
    /// The best point so far.
    pub point: Point,
    /// The steps so far.
    pub iterations: Vec<Iteration>,
    /// Jacobians evaluated so far.
    pub jacobian_evaluations: usize,
    options: &'a Options,
    scaling: Scaling,
    descent: Box<dyn Descent>,
    search: Box<dyn Search>,
    flat: usize,
    not_finite: Option<NotFinite>,
}

impl<'a> Run<'a> {
    /// A run from `start`, which has been linearised once.
    pub fn new(system: &'a dyn System, start: Point, options: &'a Options) -> Self {
        let mut scaling = Scaling::new(start.z.len());
        scaling.update(&start.at.jacobian.column_norms());
        let search = options
            .variant
            .search(scaled_norm(&start.z, scaling.diagonal()));
        Self {
            system,
            point: start,
            iterations: Vec::new(),
            jacobian_evaluations: 1,
            options,
            scaling,
            descent: options.variant.descent(),
            search,
            flat: 0,
            not_finite: None,
        }
    }

    /// Steps until a reason to stop.
    pub fn minimise(&mut self) -> Stop {
        loop {
            match self.next_point() {
                Ok(next) => self.point = next,
                Err(stop) => return stop,
            }
            if self.flat >= FLAT_STEPS {
                return Stop::Flat;
            }
            self.scaling.update(&self.point.at.jacobian.column_norms());
        }
    }

    /// Tries ever smaller steps from the current point until one is taken.
    fn next_point(&mut self) -> Result<Point, Stop> {
        let residuals = &self.point.at.residuals;
        let scale = self.scaling.diagonal().to_vec();
        let point = self.point.clone();
        let factor = point.at.jacobian.factor(&scale, self.options.linear_solver);
        if factor.tangential(residuals) <= NEAR * norm(residuals) {
            return Err(Stop::Near);
        }
        self.not_finite = None;
        loop {
            if self.iterations.len() >= self.options.max_iterations {
                return Err(Stop::IterationLimit);
            }
            if let Some(next) = self.attempt(factor.as_ref(), &scale)? {
                return Ok(next);
            }
            if self.search.exhausted() {
                return Err(self.not_finite.map_or(Stop::Stalled, Stop::NotFinite));
            }
        }
    }

    /// One step: `Some` if it was taken, `None` if the next has to be smaller.
    fn attempt(&mut self, factor: &dyn Factor, scale: &[f64]) -> Result<Option<Point>, Stop> {
        let size = self.search.size();
        let local = Local {
            system: self.system,
            point: &self.point,
            factor,
            scale,
        };
        let Some(step) = self.descent.step(&local, size) else {
            self.record(f64::INFINITY, size, f64::NAN, false);
            self.search.rejected(Trial {
                ratio: f64::NAN,
                length: 0.0,
            });
            return Ok(None);
        };
        let length = scaled_norm(&step.p, scale);
        if length <= self.options.step_tolerance * scaled_norm(&self.point.z, scale) {
            return Err(Stop::Step);
        }
        let z = add(&self.point.z, 1.0, &step.p);
        let cost = self.system.cost(&z);
        let fall = self.point.at.cost - cost;
        let trial = Trial {
            ratio: fall / step.predicted,
            length,
        };
        let next = if fall > 0.0 { self.linearize(z) } else { None };
        self.record(cost, size, length, next.is_some());
        match next {
            Some(_) => {
                self.search.accepted(trial);
                let is_flat = fall <= f64::EPSILON * cost;
                self.flat = if is_flat { self.flat + 1 } else { 0 };
            }
            None => self.search.rejected(trial),
        }
        Ok(next)
    }

    fn linearize(&mut self, z: Vec<f64>) -> Option<Point> {
        self.jacobian_evaluations += 1;
        match Point::new(self.system, z) {
            Ok(point) => Some(point),
            Err(place) => {
                self.not_finite = Some(place);
                None
            }
        }
    }

    fn record(&mut self, cost: f64, lambda: f64, step: f64, accepted: bool) {
        self.iterations.push(Iteration {
            cost,
            lambda,
            step,
            accepted,
        });
    }
}
