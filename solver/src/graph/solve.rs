//! From a graph and its start to a report: Levenberg–Marquardt over sparse normal equations.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::Ordering;

use super::bounds::Bounds;
use super::bounds::step::{BoundedStep, Model};
use super::damping::Lambda;
use super::options::{GraphOptions, GraphReport};
use super::problem::Graph;
use crate::clock::{Moment, after};
use crate::error::Error;
use crate::graph::elimination::Factored;
use crate::graph::elimination::equations::{Equations, Failure, Normal};
use crate::graph::elimination::structure::Structure;
use crate::linear::vector::scaled_norm;
use crate::minimise::scaling::Scaling;
use crate::minimise::system::Evaluations;
use crate::report::{Iteration, Termination};
use crate::rules::{FLAT_STEPS, NEAR};

/// Damping up to which the damped step tells the offset.
pub(super) const TELLING: f64 = 1e-3;

/// Nearness to 1 of the last gain ratio if the next step is linearised before its cost is known.
const PREDICTED: f64 = 0.25;

/// Steps by a factor at hand that may be tried in vain.
pub(super) const TRIES: usize = 2;

/// Minimises `½ Σ ‖r_f‖²` (or half the sum of the losses) over the free blocks of a graph, from the
/// start that its blocks were given.
///
/// # Errors
/// A factor that reads a block that is not there or one twice, a start outside its bounds or at which something
/// is not finite, nothing free, a loss of estimated scale, and a factorisation that does not fit in memory.
pub fn solve_graph(graph: &Graph<'_>, options: &GraphOptions) -> Result<GraphReport, Error> {
    solve_graph_observed(graph, options, &mut |_, _| ControlFlow::Continue(()))
}

/// [`solve_graph`] with a callback after every step tried, which sees the step and the stored values of all blocks after it (those
/// before it, if it was not taken), and may stop the run before the next step by `ControlFlow::Break`:
/// [`Termination::Cancelled`] then.
///
/// Where a loss is graduated, the costs that it sees are those of the stages.
///
/// # Errors
/// As [`solve_graph`].
///
/// # Examples
/// ```
/// use std::ops::ControlFlow;
/// use stillpoint_solver::{Euclidean, Graph, GraphOptions, Residual, Scalar, solve_graph_observed};
///
/// /// Rosenbrock's valley.
/// struct Valley;
///
/// impl<D: Scalar> Residual<D> for Valley {
///     fn residuals(&self, x: &[D], out: &mut Vec<D>) {
///         out.extend([(x[1] - x[0] * x[0]) * 10.0, -x[0] + 1.0]);
///     }
/// }
///
/// let mut graph = Graph::new();
/// let block = graph.add("x", Euclidean(2), &[-1.2, 1.0])?;
/// graph.add_factor(&[block], Valley);
/// let mut path = Vec::new();
/// let report = solve_graph_observed(&graph, &GraphOptions::default(), &mut |step, values| {
///     path.push((step.cost, values.to_vec()));
///     ControlFlow::Continue(())
/// })?;
/// assert_eq!(path.len(), report.iterations.len());
/// assert_eq!(path.last().map(|(_, values)| values), Some(&report.values));
/// # Ok::<(), stillpoint_solver::Error>(())
/// ```
pub fn solve_graph_observed(
    graph: &Graph<'_>,
    options: &GraphOptions,
    observer: &mut dyn FnMut(&Iteration, &[f64]) -> ControlFlow<()>,
) -> Result<GraphReport, Error> {
    graph.check()?;
    let structure = Arc::new(Structure::new(graph)?);
    let mut normal = Normal::default();
    let values = &graph.values;
    let bounds = Bounds::new(graph, &structure);
    bounds.check(graph, values)?;
    let equations = Equations::start(graph, &structure, options.threads, values, &mut normal)?;
    let few = (equations.counted(values)).is_some_and(|counted| counted < structure.unknowns());
    let factored = Factored::new(&structure)?;
    let mut run = Run::new(equations, factored, normal, options, observer);
    run.bounded = (!bounds.is_empty()).then(|| BoundedStep::new(bounds));
    let stop = match options.graduated || few {
        true => run.descend_graduated(),
        false => run.descend(),
    };
    let stop = if options.last_digits && matches!(stop, Stop::Near | Stop::Ended) {
        run.last_steps();
        Stop::Ended
    } else {
        stop
    };
    Ok(run.report(stop))
}

/// Why a phase was left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Stop {
    Near,
    Ended,
    Limit(Termination),
}

/// A graph on its way down.
pub(super) struct Run<'a> {
    pub equations: Equations<'a>,
    pub options: &'a GraphOptions,
    pub factored: Factored,
    pub normal: Normal,
    pub values: Vec<f64>,
    pub scaling: Scaling,
    pub lambda: Lambda,
    pub iterations: Vec<Iteration>,
    pub evaluations: Evaluations,
    pub deadline: Option<Moment>,
    pub offset: f64,
    pub relative_step: f64,
    /// True where the last step did what the linearised problem said.
    pub as_predicted: bool,
    /// Damping of the factor at hand; infinite where there is none.
    pub factor_damping: f64,
    /// Number of steps by the last factor that may still be tried in vain: where steps fall slowly in
    /// directions that are hardly determined, it would be so again and again.
    pub tries: usize,
    /// The bounded step; `None` without bounds.
    pub bounded: Option<BoundedStep>,
    pub more: Vec<f64>,
    pub step: Vec<f64>,
    observer: Observer<'a>,
    /// True where the observer has asked to stop.
    cancelled: bool,
}

/// Called after every step tried.
type Observer<'a> = &'a mut dyn FnMut(&Iteration, &[f64]) -> ControlFlow<()>;

impl<'a> Run<'a> {
    fn new(
        equations: Equations<'a>,
        factored: Factored,
        normal: Normal,
        options: &'a GraphOptions,
        observer: Observer<'a>,
    ) -> Self {
        let unknowns = equations.structure.unknowns();
        let values = equations.graph.values.clone();
        let mut run = Self {
            equations,
            options,
            factored,
            normal,
            values,
            scaling: Scaling::new(unknowns),
            lambda: Lambda::new(options.damping, options.first_damping),
            iterations: Vec::new(),
            evaluations: Evaluations::default(),
            deadline: options.time_limit.and_then(after),
            offset: f64::INFINITY,
            relative_step: f64::INFINITY,
            as_predicted: false,
            factor_damping: f64::INFINITY,
            tries: TRIES,
            bounded: None,
            more: vec![0.0; unknowns],
            step: vec![0.0; unknowns],
            observer,
            cancelled: false,
        };
        run.evaluations.jacobians = 1;
        run.update_scaling();
        run
    }

    pub fn linearize(&mut self) -> Result<(), Failure> {
        self.evaluations.jacobians += 1;
        self.equations.linearize(&self.values, &mut self.normal)?;
        self.update_scaling();
        Ok(())
    }

    fn update_scaling(&mut self) {
        let norms = self.equations.structure.column_norms(&self.normal.h);
        self.scaling.update(&norms);
    }

    /// The damped step into `self.step`; `false` where the equations are not positive definite.
    /// Updates offset and relative step.
    pub(super) fn solve(&mut self, lambda: f64) -> bool {
        let scale = self.scaling.diagonal();
        for (more, d) in self.more.iter_mut().zip(scale) {
            *more = lambda * d * d;
        }
        self.factor_damping = f64::INFINITY;
        if !self.minimum_of_model() {
            return false;
        }
        self.factor_damping = lambda;
        self.judge_step();
        true
    }

    /// The minimum of the model damped by `self.more`, within the bounds, into `self.step`.
    fn minimum_of_model(&mut self) -> bool {
        if let Some(bounded) = &mut self.bounded {
            let model = Model {
                structure: self.equations.structure,
                normal: &self.normal,
                more: &self.more,
                values: &self.values,
                scale: self.scaling.diagonal(),
            };
            return bounded.minimum(&model, &mut self.factored, &mut self.step);
        }
        for (p, g) in self.step.iter_mut().zip(&self.normal.gradient) {
            *p = -g;
        }
        self.factored
            .factor_and_solve(&self.normal.h, &self.more, &mut self.step)
    }

    /// All stored values after the step at hand.
    pub(super) fn stepped(&self) -> Vec<f64> {
        let mut next = self.equations.stepped(&self.values, &self.step);
        if let Some(bounded) = &self.bounded {
            bounded.bounds.cut(&mut next);
        }
        next
    }

    /// Damped steps until the offset is small.
    pub fn descend(&mut self) -> Stop {
        self.descend_to(self.near())
    }

    /// Relative offset at which damped steps end.
    fn near(&self) -> f64 {
        if self.options.last_digits {
            NEAR.max(self.options.gradient_tolerance)
        } else {
            self.options.gradient_tolerance
        }
    }

    /// Damped steps until the offset is so small.
    pub fn descend_to(&mut self, near: f64) -> Stop {
        let mut flat = 0;
        loop {
            if let Some(limit) = self.limit() {
                return Stop::Limit(limit);
            }
            if self.is_near_by_last_factor(near) {
                if !self.options.last_digits {
                    self.take_if_lower();
                }
                return Stop::Near;
            }
            let lambda = self.lambda.value;
            if !self.solve(lambda) {
                self.record(f64::INFINITY, lambda, 0.0, false);
                self.lambda.rejected();
                if self.lambda.exhausted() {
                    return Stop::Ended;
                }
                continue;
            }
            if self.offset <= near {
                if lambda > TELLING {
                    self.lambda.value = TELLING * TELLING * lambda;
                    continue;
                }
                if !self.options.last_digits {
                    self.take_if_lower();
                }
                return Stop::Near;
            }
            if self.relative_step <= self.options.step_tolerance {
                return Stop::Ended;
            }
            match self.try_step(lambda) {
                Some(fall) if fall <= f64::EPSILON * self.normal.cost => flat += 1,
                Some(_) => flat = 0,
                None if self.lambda.exhausted() => return Stop::Ended,
                None => {}
            }
            if flat >= FLAT_STEPS {
                return Stop::Ended;
            }
        }
    }

    /// Takes the step if the cost falls, and tells by how much.
    fn try_step(&mut self, lambda: f64) -> Option<f64> {
        let scale = self.scaling.diagonal();
        let length = scaled_norm(&self.step, scale);
        let decrement = self.decrement();
        // ‖r‖² less ‖r + J p‖², halved: with (H + λD²) p = −g no product by J is needed.
        let predicted = 0.5 * (decrement + lambda * length * length);
        let next = self.stepped();
        let before = self.normal.cost;
        let cost = match self.as_predicted {
            true => None,
            false => {
                self.evaluations.residuals += 1;
                Some(self.equations.cost(&next))
            }
        };
        let mut tried = cost.unwrap_or(f64::INFINITY);
        if cost.is_none_or(|cost| cost < before) {
            let kept = std::mem::replace(&mut self.values, next);
            let finite = self.linearize_at_step();
            tried = cost.unwrap_or(self.normal.cost);
            let fall = before - tried;
            if finite && fall > 0.0 {
                self.update_scaling();
                self.record(tried, lambda, length, true);
                let ratio = fall / predicted;
                self.as_predicted = (ratio - 1.0).abs() < PREDICTED;
                self.lambda.accepted(ratio);
                return Some(fall);
            }
            self.values = kept;
            // The point before was finite.
            let _ = self.linearize_at_step();
            self.normal.cost = before;
        }
        self.as_predicted = false;
        self.record(tried, lambda, length, false);
        self.lambda.rejected();
        None
    }

    /// Linearises where a step leads; `false` where that fails.
    fn linearize_at_step(&mut self) -> bool {
        self.evaluations.jacobians += 1;
        let formed = self.equations.linearize(&self.values, &mut self.normal);
        formed.is_ok()
    }

    /// The step at hand, if the cost does not rise.
    fn take_if_lower(&mut self) {
        let next = self.stepped();
        self.evaluations.residuals += 1;
        let cost = self.equations.cost(&next);
        if cost <= self.normal.cost {
            self.values = next;
            self.normal.cost = cost;
        }
    }

    /// Writes the trace and shows it to the observer, whose wish to stop is met before the next step.
    pub(super) fn record(&mut self, cost: f64, lambda: f64, step: f64, accepted: bool) {
        let iteration = Iteration {
            cost,
            lambda,
            step,
            accepted,
        };
        self.cancelled |= (self.observer)(&iteration, &self.values).is_break();
        self.iterations.push(iteration);
    }

    pub(super) fn limit(&self) -> Option<Termination> {
        if self.cancelled {
            return Some(Termination::Cancelled);
        }
        if self.iterations.len() >= self.options.max_iterations {
            return Some(Termination::IterationLimit);
        }
        if self.deadline.is_some_and(Moment::is_past) {
            return Some(Termination::TimeLimit);
        }
        let flag = self.options.cancel.as_ref();
        flag.is_some_and(|flag| flag.load(Ordering::Relaxed))
            .then_some(Termination::Cancelled)
    }
}
