//! A report of a graph in words.

use std::fmt;

use crate::graph::options::GraphReport;
use crate::report::Termination;

impl fmt::Display for GraphReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let count = self.evaluations;
        writeln!(f, "{}", self.termination)?;
        write!(
            f,
            "cost {:.6e}, {} residuals, {} free coordinates of {} blocks",
            self.cost,
            self.residuals,
            self.unknowns,
            self.first.len().saturating_sub(1)
        )?;
        match self.rank {
            Some(rank) => writeln!(f, ", rank {rank}")?,
            None => writeln!(f, ", rank not known")?,
        }
        writeln!(
            f,
            "{} steps tried; evaluations: r {}, J {}{}",
            self.iterations.len(),
            count.residuals,
            count.jacobians,
            self.what_is_left()
        )?;
        if !self.termination.converged() && self.relative_offset.is_finite() {
            writeln!(
                f,
                "not at a minimum: the last linearised problem promised to lower the cost by {:.1e} of itself",
                self.relative_offset.powi(2)
            )?;
        }
        let method = self.method;
        writeln!(
            f,
            "{} blocks eliminated one by one, {} coordinates left, {}, {} entries in their factor",
            method.eliminated,
            method.left,
            if method.dense { "dense" } else { "sparse" },
            method.factor_entries
        )?;
        for held in &self.active {
            writeln!(
                f,
                "  {} = {} (multiplier {:.2e})",
                held.constraint, held.value, held.multiplier
            )?;
        }
        for direction in &self.null_space {
            writeln!(f, "  no factor determines {}", direction.words)?;
        }
        if !self.null_space.is_empty() {
            writeln!(
                f,
                "  the solution is one of many: hold a block or add a factor on it"
            )?;
        }
        Ok(())
    }
}

impl GraphReport {
    /// The offset, where it is more than rounding.
    fn what_is_left(&self) -> String {
        match self.termination {
            Termination::Zero => String::new(),
            Termination::Step => format!("; relative step {:.1e}", self.relative_step),
            _ => format!("; relative offset {:.1e}", self.relative_offset),
        }
    }
}
