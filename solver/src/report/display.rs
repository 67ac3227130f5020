//! A report in words: what a person reads first.

use std::fmt;

use crate::report::Report;

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let count = self.evaluations;
        writeln!(f, "{}", self.termination)?;
        writeln!(
            f,
            "cost {:.6e}, rms {:.3e}, {} residuals, rank {} of {}, condition {:.1e}",
            self.cost,
            self.rms(),
            self.residuals.len(),
            self.rank,
            self.uncertainty.names.len(),
            self.uncertainty.condition
        )?;
        writeln!(
            f,
            "{} steps tried; evaluations: r {}, J {}, r″ {}",
            self.iterations.len(),
            count.residuals,
            count.jacobians,
            count.second_derivatives
        )?;
        let outliers = self.weights.iter().filter(|w| **w < 0.5).count();
        if outliers > 0 {
            writeln!(f, "{outliers} residuals count less than half")?;
        }
        let width = (self.parameters.names().iter())
            .map(|n| n.chars().count())
            .max();
        let width = width.unwrap_or(0);
        let each = (self.parameters.names().iter())
            .zip(self.parameters.units())
            .zip(self.parameters.values());
        for ((name, unit), value) in each {
            let free = self.uncertainty.names.iter().position(|n| n == name);
            let error = match free.map(|k| self.standard_error(k)) {
                None => "held".to_owned(),
                Some(None) => "± unknown".to_owned(),
                Some(Some(sigma)) => format!("± {sigma:.2e}"),
            };
            writeln!(f, "  {name:width$}  {value:>16.9e}  {error:<12} {unit}")?;
        }
        for held in &self.active {
            writeln!(
                f,
                "  {} = {} (multiplier {:.2e})",
                held.constraint, held.value, held.multiplier
            )?;
        }
        for direction in &self.uncertainty.unobservable {
            writeln!(f, "  the data do not determine {direction}")?;
        }
        Ok(())
    }
}
