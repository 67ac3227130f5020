//! Robust losses that begin wide, and whether they count enough.

use super::damping::Lambda;
use super::evaluate::gather;
use super::solve::{Run, Stop, TRIES};
use super::stage::Stage;
use crate::graph::elimination::equations::Equations;
use crate::loss::LossScale;
use crate::loss::graduation::{FIRST, widths};
use crate::loss::robust::robust_sigma;

/// Relative offset at which a stage ends: the next one begins near enough.
const LOOSE: f64 = 1e-3;

impl Equations<'_> {
    /// From which multiple of the scales on all factors count nearly in full at these values.
    pub(crate) fn widest(&self, values: &[f64]) -> f64 {
        2.0 * self.relative(values).into_iter().fold(0.0, f64::max)
    }

    /// From which multiple of the scales on most factors do, after a fit of least absolute values.
    pub(crate) fn spread(&self, values: &[f64]) -> f64 {
        FIRST * robust_sigma(&self.relative(values))
    }

    /// `‖r‖ / σ` of every factor with a loss.
    fn relative(&self, values: &[f64]) -> Vec<f64> {
        let mut all = Vec::new();
        self.visit_losses(values, &mut |factor, residuals| {
            let loss = self.graph.loss_of(factor);
            if let Some(LossScale::Given(scale)) = loss.and_then(|loss| loss.scale()) {
                all.push(square(residuals).sqrt() / scale);
            }
        });
        all
    }

    /// Number of residuals that count, those of factors whose loss has a slope; `None` where there are no losses.
    pub(crate) fn counted(&self, values: &[f64]) -> Option<usize> {
        if self.graph.losses.is_empty() {
            return None;
        }
        let mut counted = 0;
        self.visit_losses(values, &mut |factor, residuals| {
            let loss = self.loss_of(factor);
            let counts = loss.is_none_or(|loss| loss.slope_and_bend(square(residuals)).0 > 0.0);
            counted += if counts { residuals.len() } else { 0 };
        });
        Some(counted)
    }

    /// Shows every factor's residuals.
    fn visit_losses(&self, values: &[f64], see: &mut dyn FnMut(usize, &[f64])) {
        let (mut x, mut out) = (Vec::new(), Vec::new());
        for (factor, entry) in self.graph.factors.iter().enumerate() {
            gather(self.graph, self.graph.blocks_of(factor), values, &mut x);
            entry.factor.values(&x, &mut out);
            see(factor, &out);
        }
    }
}

impl Run<'_> {
    /// Damped steps under losses that begin wide, by two ways: from what is least squares, and from the fit
    /// of least absolute values, which one-sided outliers bend less. Ends where the cost is lower.
    pub fn descend_graduated(&mut self) -> Stop {
        let start = self.values.clone();
        let first = self.narrowed(self.equations.widest(&start));
        if matches!(first, Stop::Limit(_)) {
            return first;
        }
        let (values, cost) = (std::mem::replace(&mut self.values, start), self.normal.cost);
        let mut second = Stop::Ended;
        if self.under(Stage::Absolute) {
            second = self.descend_to(LOOSE);
            if !matches!(second, Stop::Limit(_)) {
                second = self.narrowed(self.equations.spread(&self.values));
            }
        }
        let lower = self.equations.stage == Stage::Meant && self.normal.cost < cost;
        if lower {
            return second;
        }
        self.values = values;
        self.under(Stage::Meant);
        match second {
            Stop::Limit(limit) => Stop::Limit(limit),
            _ => self.descend(),
        }
    }

    /// Damped steps under ever narrower losses, and those that are meant.
    fn narrowed(&mut self, widening: f64) -> Stop {
        for width in widths(widening) {
            if self.under(Stage::Wide(width))
                && let Stop::Limit(limit) = self.descend_to(LOOSE)
            {
                self.under(Stage::Meant);
                return Stop::Limit(limit);
            }
        }
        match self.under(Stage::Meant) {
            true => self.descend(),
            false => Stop::Ended,
        }
    }

    /// Goes on under other losses; `false` where they are not finite here.
    fn under(&mut self, stage: Stage) -> bool {
        self.equations.stage = stage;
        self.lambda = Lambda::new(self.options.damping, self.options.first_damping);
        self.as_predicted = false;
        self.factor_damping = f64::INFINITY;
        self.tries = TRIES;
        (self.offset, self.relative_step) = (f64::INFINITY, f64::INFINITY);
        self.linearize().is_ok()
    }
}

fn square(residuals: &[f64]) -> f64 {
    residuals.iter().map(|r| r * r).sum()
}
