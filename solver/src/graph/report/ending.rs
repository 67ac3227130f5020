//! Judgement of the last point of a graph.

use crate::graph::bounds::Held;
use crate::graph::options::GraphReport;
use crate::graph::solve::{Run, Stop};
use crate::graph::uncertainty::null_space::{self, NullVector};
use crate::report::Termination;

/// Most free directions that are followed at the end.
const FOLLOWED: usize = 32;

/// Relative step that counts as none: what is left is rounding.
const SMALL_STEP: f64 = 1e-7;

impl Run<'_> {
    /// True where the losses count fewer residuals than there are unknowns to determine.
    fn is_weightless(&self) -> bool {
        let held = self.held().map_or(0, |held| held.count);
        let unknowns = self.equations.structure.unknowns() - held;
        let counted = self.equations.counted(&self.values);
        counted.is_some_and(|counted| counted < unknowns)
    }

    /// True where the residuals are no larger than what rounding of the values makes of them, as in the dense solver.
    fn is_zero(&self) -> bool {
        self.normal.square.sqrt() <= f64::EPSILON * self.size()
    }

    /// The unknowns that bounds hold.
    fn held(&self) -> Option<Held> {
        let unknowns = self.equations.structure.unknowns();
        let bounds = &self.bounded.as_ref()?.bounds;
        bounds.held(unknowns, &self.values, &self.normal.gradient)
    }

    /// Rank, and what no factor determines, where that is asked for.
    fn determined(&mut self, ended: Termination) -> (Option<usize>, Vec<NullVector>) {
        let interrupted = matches!(ended, Termination::Cancelled | Termination::TimeLimit);
        if !self.options.rank || interrupted {
            return (None, Vec::new());
        }
        let held = self.held();
        let equations = &self.equations;
        let structure = equations.structure;
        let mut left = Vec::new();
        let h = match &held {
            Some(held) => {
                held.leave(structure, &self.normal.h, &mut left);
                &left
            }
            None => &self.normal.h,
        };
        let local = null_space::Local {
            equations,
            values: &self.values,
            h,
            units: &structure.units(h),
            held: held.as_ref(),
        };
        let unknowns = local.free();
        let most = FOLLOWED.min(unknowns);
        match null_space::seek(&local, &mut self.factored, most) {
            Err(_) => (None, Vec::new()),
            Ok(None) => (Some(unknowns), Vec::new()),
            Ok(Some(null)) => {
                let free = null.basis.len();
                let rank = (free < most || most == unknowns).then(|| unknowns - free);
                let named = null_space::in_names(&null, equations.graph, structure, local.units);
                (rank, named)
            }
        }
    }

    pub fn report(mut self, stop: Stop) -> GraphReport {
        let termination = match stop {
            Stop::Limit(Termination::Cancelled) => Termination::Cancelled,
            _ if self.is_weightless() => Termination::Weightless,
            _ if self.is_zero() => Termination::Zero,
            _ if self.offset <= self.options.gradient_tolerance => Termination::Gradient,
            Stop::Limit(limit) => limit,
            _ if self.relative_step <= SMALL_STEP => Termination::Step,
            _ => Termination::Stalled,
        };
        let (rank, null_space) = self.determined(termination);
        let active = self.bounded.as_ref().map_or_else(Vec::new, |bounded| {
            let gradient = &self.normal.gradient;
            (bounded.bounds).active(self.equations.graph, &self.values, gradient)
        });
        GraphReport {
            active,
            rank,
            null_space,
            first: GraphReport::first(self.equations.graph),
            values: self.values,
            cost: self.normal.cost,
            residuals: self.equations.rows(),
            unknowns: self.equations.structure.unknowns(),
            termination,
            iterations: self.iterations,
            evaluations: self.evaluations,
            relative_offset: self.offset,
            relative_step: self.relative_step,
            method: self.factored.method(),
        }
    }
}
