//! The loop, and nothing else: linearise, step, accept or reject.

use std::ops::ControlFlow;
use std::sync::atomic::Ordering;

use faer::Mat;

use crate::clock::Moment;
use crate::descent::{Descent, Local, Step};
use crate::feasible::{Face, Polytope};
use crate::linear::vector::{add, norm, scaled_norm};
use crate::linear::{Factor, Jacobian};
use crate::minimise::ending::is_zero;
use crate::minimise::newton;
use crate::minimise::point::{NotFinite, Point};
use crate::minimise::scaling::Scaling;
use crate::minimise::stop::Stop;
use crate::minimise::system::System;
use crate::options::{Options, Variant};
use crate::report::Iteration;
use crate::rules::{FLAT_STEPS, NEAR};
use crate::search::{Damping, Lambda, Search, Trial};

/// Cost relative to that of the start below which a slow run counts as one to zero: the residuals are below the rounding of
/// those at the start.
const NOTHING: f64 = 1e-32;

/// Steps taken after which a run counts as slow.
const SLOW: usize = 30;

/// Second derivatives per step taken that whole Hessians may take: a tenth of a Jacobian each, they are less than half of what a slow
/// run costs without.
const LOOKS: usize = 4;

/// Called after every step tried.
pub(crate) type Watch<'a> = &'a mut dyn FnMut(&Iteration, &[f64]) -> ControlFlow<()>;

/// A run under way, all but the point it stands at.
pub(crate) struct Run<'a> {
    system: &'a dyn System,
    polytope: Option<&'a Polytope>,
    options: &'a Options,
    watch: Watch<'a>,
    deadline: Option<Moment>,
    iterations: &'a mut Vec<Iteration>,
    scaling: Scaling,
    descent: Box<dyn Descent>,
    search: Box<dyn Search>,
    flat: usize,
    taken: usize,
    not_finite: Option<NotFinite>,
    /// Point to which the last step led, if its cost is infinite.
    lost: Option<Vec<f64>>,
    cancelled: bool,
    /// Relative offset at which the last steps are tried.
    near: f64,
    /// Cost at the start.
    first_cost: f64,
    /// Steps taken at which the whole Hessian is looked at next, and the number of steps to the look after it.
    next_hessian: usize,
    gap: usize,
    is_nielsen: bool,
    /// Second derivatives spent on whole Hessians.
    looked: usize,
}

/// Relative offset at which the steps of the loop end.
fn near(options: &Options) -> f64 {
    match options.last_digits {
        true => NEAR.max(options.gradient_tolerance),
        false => options.gradient_tolerance,
    }
}

impl<'a> Run<'a> {
    /// A run from `start`.
    pub fn new(
        system: &'a dyn System,
        start: &Point,
        polytope: Option<&'a Polytope>,
        options: &'a Options,
        deadline: Option<Moment>,
        iterations: &'a mut Vec<Iteration>,
        watch: Watch<'a>,
    ) -> Self {
        let mut scaling = Scaling::new(start.z.len());
        scaling.update(&start.at.jacobian.column_norms());
        Self {
            system,
            polytope,
            options,
            watch,
            deadline,
            iterations,
            descent: options.variant.descent(polytope),
            search: options.search(
                scaled_norm(&start.z, scaling.diagonal()),
                polytope.is_some(),
            ),
            scaling,
            flat: 0,
            taken: 0,
            not_finite: None,
            lost: None,
            cancelled: false,
            near: near(options),
            first_cost: start.at.cost,
            next_hessian: SLOW,
            gap: 1,
            is_nielsen: false,
            looked: 0,
        }
    }

    /// From a new point, with the size of the first step.
    pub fn restart(&mut self, point: &Point) {
        self.scaling = Scaling::new(point.z.len());
        self.scaling.update(&point.at.jacobian.column_norms());
        let size = scaled_norm(&point.z, self.scaling.diagonal());
        self.search = self.options.search(size, self.polytope.is_some());
        (self.near, self.flat) = (near(self.options), 0);
    }

    /// Goes on until the offset is `tolerance`; false where that was the aim already.
    pub fn nearer(&mut self, tolerance: f64) -> bool {
        let was = std::mem::replace(&mut self.near, tolerance);
        was > tolerance
    }

    /// Steps until a reason to stop; `point` becomes the best point.
    pub fn minimise(&mut self, point: &mut Point) -> Stop {
        loop {
            match self.next_point(point) {
                Ok(next) => *point = next,
                Err(stop) => return stop,
            }
            if self.flat >= FLAT_STEPS {
                return Stop::Flat;
            }
            if self.taken >= SLOW && (point.at.cost <= NOTHING * self.first_cost || is_zero(point))
            {
                return Stop::Zero;
            }
            self.scaling.update(&point.at.jacobian.column_norms());
        }
    }

    /// Tries ever smaller steps until one is taken.
    fn next_point(&mut self, point: &Point) -> Result<Point, Stop> {
        if self.cancelled {
            return Err(Stop::Cancelled);
        }
        let scale = self.scaling.diagonal().to_vec();
        let factor = point.at.jacobian.factor(&scale, self.options.linear_solver);
        let mut local = Local {
            system: self.system,
            point,
            factor: factor.as_ref(),
            scale: &scale,
            offset: 0.0,
            refused: 0,
        };
        let (tangential, size) = (self.tangential(&local), norm(&point.at.residuals));
        if tangential <= self.near * size {
            return Err(Stop::Near);
        }
        local.offset = tangential / size;
        (self.not_finite, self.lost) = (None, None);
        let hessian = self.missing_hessian(&local);
        loop {
            self.limits()?;
            let tried = self.attempt(&local, hessian.as_ref())?;
            self.without_second_derivatives();
            if let Some(next) = tried {
                self.taken += 1;
                return Ok(next);
            }
            if self.search.exhausted() {
                return Err(self.given_up(Stop::Stalled));
            }
            local.refused += 1;
        }
    }

    /// The reason to take no shorter step: where even the last one led to what is not finite, that.
    fn given_up(&self, otherwise: Stop) -> Stop {
        let residual = || {
            let residuals = self.system.residuals(self.lost.as_ref()?);
            let row = residuals.iter().position(|v| !v.is_finite())?;
            Some(NotFinite::Residual {
                row,
                value: residuals[row],
            })
        };
        let place = self.not_finite.or_else(residual);
        place.map_or(otherwise, Stop::NotFinite)
    }

    /// In a slow run of a variant that uses second derivatives, the part of the Hessian that
    /// Gauss–Newton leaves out, in scaled directions.
    ///
    /// It costs `n (n + 1) / 2` second derivatives: where it did not pay, the next look is twice as
    /// many steps away, up to `n / 2`.
    fn missing_hessian(&mut self, local: &Local<'_>) -> Option<Mat<f64>> {
        let wanted = self.options.variant.uses_second_derivatives();
        if !wanted || self.polytope.is_some() || self.taken < self.next_hessian {
            return None;
        }
        let n = local.scale.len();
        let whole = n * (n + 1) / 2;
        if self.looked + whole > LOOKS * self.taken {
            return None;
        }
        self.looked += whole;
        self.next_hessian = self.taken + self.gap;
        self.gap = (2 * self.gap).clamp(1, (n / 2).max(1));
        let directions = Mat::from_fn(n, n, |i, k| if i == k { 1.0 / local.scale[i] } else { 0.0 });
        newton::curvature(self.system, local.point, directions.as_ref())
    }

    /// `‖P r‖`, along the active constraints where there are any.
    fn tangential(&self, local: &Local<'_>) -> f64 {
        let residuals = &local.point.at.residuals;
        if let Some(polytope) = self.polytope {
            let Jacobian(jacobian) = &local.point.at.jacobian;
            let face = Face::at(polytope, local.point, local.scale);
            if !face.active().is_empty() {
                return face.factor(jacobian.as_ref()).tangential(residuals);
            }
        }
        local.factor.tangential(residuals)
    }

    /// One step: `Some` if it was taken, `None` if the next has to be smaller.
    fn attempt(
        &mut self,
        local: &Local<'_>,
        hessian: Option<&Mat<f64>>,
    ) -> Result<Option<Point>, Stop> {
        let size = self.search.size();
        let Some((step, cost)) = self.better_step(local, size, hessian) else {
            self.search.rejected(Trial {
                ratio: f64::NAN,
                length: 0.0,
            });
            self.record(
                Iteration {
                    cost: f64::INFINITY,
                    lambda: size,
                    step: 0.0,
                    accepted: false,
                },
                local.point,
            );
            return Ok(None);
        };
        let length = scaled_norm(&step.p, local.scale);
        if length <= self.options.step_tolerance * scaled_norm(&local.point.z, local.scale) {
            return Err(self.given_up(Stop::Step));
        }
        let z = self.landing(local.point, &step);
        (self.not_finite, self.lost) = (None, cost.is_infinite().then(|| z.clone()));
        let fall = local.point.at.cost - cost;
        let next = if fall > 0.0 { self.linearize(z) } else { None };
        let trial = Trial {
            ratio: fall / step.predicted,
            length,
        };
        match next {
            Some(_) => {
                self.search.accepted(trial);
                let is_flat = fall <= f64::EPSILON * cost;
                self.flat = if is_flat { self.flat + 1 } else { 0 };
            }
            None => self.search.rejected(trial),
        }
        let best = next.as_ref().unwrap_or(local.point);
        self.record(
            Iteration {
                cost,
                lambda: size,
                step: length,
                accepted: next.is_some(),
            },
            best,
        );
        Ok(next)
    }

    /// The step of the descent or, in a slow run, Newton's if that leads lower; with its cost.
    fn better_step(
        &mut self,
        local: &Local<'_>,
        size: f64,
        hessian: Option<&Mat<f64>>,
    ) -> Option<(Step, f64)> {
        let cost_of = |step: Step| {
            let cost = self.system.cost(&self.landing(local.point, &step));
            (step, cost)
        };
        let usual = self.descent.step(local, size).map(cost_of);
        let newton = hessian
            .and_then(|s| newton::damped_step(local, s, size))
            .map(cost_of);
        match (usual, newton) {
            (Some(usual), Some(newton)) if newton.1 < usual.1 => {
                (self.next_hessian, self.gap) = (self.taken + 1, 1);
                Some(newton)
            }
            (usual, newton) => usual.or(newton),
        }
    }

    /// The automatic variant that finds that the problem has no second derivatives goes on as
    /// the variant that is best without them.
    fn without_second_derivatives(&mut self) {
        let automatic = self.options.variant == Variant::Automatic;
        if automatic && !self.is_nielsen && self.system.refuses_second_derivatives() {
            self.is_nielsen = true;
            self.search = Box::new(Lambda::new(Damping::Nielsen, self.search.size()));
        }
    }

    /// Point to which a step leads, exactly on the bounds that it reaches.
    fn landing(&self, point: &Point, step: &Step) -> Vec<f64> {
        let mut z = add(&point.z, 1.0, &step.p);
        if let Some(polytope) = self.polytope {
            let length = norm(&point.at.residuals);
            polytope.settle(&mut z, &step.p, self.scaling.diagonal(), length);
        }
        z
    }

    fn linearize(&mut self, z: Vec<f64>) -> Option<Point> {
        match Point::new(self.system, z) {
            Ok(point) => Some(point),
            Err(place) => {
                self.not_finite = Some(place);
                None
            }
        }
    }

    /// Writes the trace and shows it to the user, whose wish to stop is met before the next step.
    fn record(&mut self, iteration: Iteration, best: &Point) {
        self.cancelled |= (self.watch)(&iteration, &best.z).is_break();
        self.iterations.push(iteration);
    }

    fn limits(&self) -> Result<(), Stop> {
        if self.iterations.len() >= self.options.max_iterations {
            return Err(Stop::IterationLimit);
        }
        if self.deadline.is_some_and(Moment::is_past) {
            return Err(Stop::TimeLimit);
        }
        let flagged = self
            .options
            .cancel
            .as_ref()
            .is_some_and(|flag| flag.load(Ordering::Relaxed));
        if self.cancelled || flagged {
            return Err(Stop::Cancelled);
        }
        Ok(())
    }
}
