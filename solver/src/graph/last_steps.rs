//! The last steps of a graph: undamped, to what double precision allows.

use super::solve::{Run, TELLING};
use crate::linear::vector::dot;
use crate::rules::{RESOLVED, RISE_BY_ROUNDING};

/// Damping of the last steps: what is not determined stays where it is.
const LAST: f64 = 1e-11;

/// Most last steps, and the largest damping of one.
const MOST_LAST: usize = 100;
const MOST_DAMPING: f64 = 1e4;

/// A last step that shortens the tangential residual by less than this was too long or too short.
const SLOW: f64 = 0.5;

impl Run<'_> {
    /// Steps while they shorten the tangential part of the residual: undamped, and damped where those
    /// go too far.
    pub fn last_steps(&mut self) {
        let mut damping = LAST;
        while !self.solve(damping) {
            damping *= 100.0;
            if damping > 1.0 {
                return;
            }
        }
        let least = damping;
        let rounding = RESOLVED * (self.equations.rows() as f64).sqrt();
        for _ in 0..MOST_LAST {
            if self.offset <= rounding
                || self.relative_step <= 2.0 * f64::EPSILON
                || self.limit().is_some()
            {
                break;
            }
            let (offset, step) = (self.offset, self.step.clone());
            if self.last_step(damping, least) {
                let slow = self.offset > SLOW * offset;
                if slow && dot(&step, &self.step) < 0.0 {
                    damping = (4.0 * damping).max(TELLING);
                } else if slow && damping > least {
                    damping = (0.25 * damping).max(least);
                } else {
                    continue;
                }
                if !self.solve(damping) {
                    break;
                }
                continue;
            }
            // At a minimum of large residuals undamped steps go back and forth.
            let unknown = self.offset > self.options.gradient_tolerance;
            damping = (4.0 * damping).max(self.lambda.value).max(TELLING);
            if !unknown || damping > MOST_DAMPING || !self.solve(damping) {
                break;
            }
        }
        if damping > least && !self.solve(least) {
            self.offset = f64::INFINITY;
        }
    }

    /// One of the last steps; `false`, and back where it was, if it shortened nothing. Equations that nobody solves again stay those of the
    /// point that was tried, a last step away.
    fn last_step(&mut self, damping: f64, least: f64) -> bool {
        let (offset, relative_step) = (self.offset, self.relative_step);
        let (cost, square) = (self.normal.cost, self.normal.square);
        let next = self.stepped();
        let before = std::mem::replace(&mut self.values, next);
        let length = relative_step * self.size();
        let is_finite = self.linearize().is_ok();
        let better = is_finite
            && self.normal.cost <= cost * (1.0 + RISE_BY_ROUNDING)
            && self.solve(damping)
            && self.offset * self.normal.square.sqrt() < offset * square.sqrt();
        let tried = self.normal.cost;
        if !better {
            self.values = before;
            let unknown = offset > self.options.gradient_tolerance || self.bounded.is_some();
            if unknown || damping > least || !is_finite {
                // The point before was finite.
                let _ = self.linearize();
            }
            self.normal.cost = cost;
            (self.offset, self.relative_step) = (offset, relative_step);
        }
        self.record(tried, damping, length, better);
        better
    }
}
