//! Cone programs: a quadratic cost over a product of cones, by the interior point of `clarabel`.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, SolverStatus, SupportedConeT};

/// `min ½ xᵀ P x + qᵀ x` over `b − A x ∈ K`.
///
/// | symbol | meaning | shape |
/// |---|---|---|
/// | `P` | curvature of the cost, its upper triangle | n × n |
/// | `q` | slope of the cost | n |
/// | `A`, `b` | the slack `b − A x` | m × n, m |
/// | `K` | product of cones, in the order of the rows | m |
///
/// The one place where `clarabel` runs: it is generic, and every crate that called it would compile it anew.
#[derive(Clone, Copy, Debug)]
pub struct ConeProgram<'a> {
    /// `P`.
    pub curvature: &'a CscMatrix<f64>,
    /// `q`.
    pub slope: &'a [f64],
    /// `A`.
    pub matrix: &'a CscMatrix<f64>,
    /// `b`.
    pub limits: &'a [f64],
    /// `K`.
    pub cones: &'a [SupportedConeT<f64>],
}

/// End of the interior point method on a [`ConeProgram`].
#[derive(Clone, Debug)]
pub struct ConeSolution {
    /// `x` (`n`).
    pub x: Vec<f64>,
    /// `b − A x` (`m`).
    pub slack: Vec<f64>,
    /// Multipliers of the slack (`m`).
    pub dual: Vec<f64>,
    /// It is the minimum, to full or to reduced accuracy.
    pub solved: bool,
}

impl ConeProgram<'_> {
    /// Runs the interior point; `None` for shapes that do not fit together.
    pub fn solve(&self) -> Option<ConeSolution> {
        let settings = DefaultSettings {
            verbose: false,
            ..DefaultSettings::default()
        };
        let mut solver = DefaultSolver::new(
            self.curvature,
            self.slope,
            self.matrix,
            self.limits,
            self.cones,
            settings,
        )
        .ok()?;
        solver.solve();
        let solved = matches!(
            solver.solution.status,
            SolverStatus::Solved | SolverStatus::AlmostSolved
        );
        let solution = solver.solution;
        Some(ConeSolution {
            x: solution.x,
            slack: solution.s,
            dual: solution.z,
            solved,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `min ½ ‖x‖² − x₀` over `x₀ ≤ ½`: at the limit, which pulls with `1 − ½`.
    #[test]
    fn a_limit_that_holds_has_its_multiplier() {
        let program = ConeProgram {
            curvature: &CscMatrix::identity(2),
            slope: &[-1.0, 0.0],
            matrix: &CscMatrix::new(1, 2, vec![0, 1, 1], vec![0], vec![1.0]),
            limits: &[0.5],
            cones: &[SupportedConeT::NonnegativeConeT(1)],
        };
        let found = program.solve().unwrap();
        assert!(found.solved);
        // The accuracy that the interior point asks of itself is 1e-8.
        assert!((found.x[0] - 0.5).abs() < 1e-7 && found.x[1].abs() < 1e-7);
        assert!((found.dual[0] - 0.5).abs() < 1e-7 && found.slack[0].abs() < 1e-7);
    }

    #[test]
    fn shapes_that_do_not_fit_are_refused() {
        let program = ConeProgram {
            curvature: &CscMatrix::identity(2),
            slope: &[0.0],
            matrix: &CscMatrix::zeros((0, 2)),
            limits: &[],
            cones: &[],
        };
        assert!(program.solve().is_none());
    }
}
