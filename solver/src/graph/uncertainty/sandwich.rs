//! The covariance of a graph that does not believe in equal variances.

use super::Products;
use crate::error::Error;
use crate::graph::elimination::equations::Equations;
use crate::graph::elimination::structure::NONE;
use crate::graph::problem::Block;
use crate::graph::reweight::rewrite;

impl Products<'_> {
    /// The sandwich covariance `m / (m − p) · H⁺ (Σ_f g_f g_fᵀ) H⁺` among the free coordinates of some blocks,
    /// in their order, `g_f` the gradient of what factor `f` costs and `p` the rank.
    ///
    /// [`covariance`](Self::covariance) is for independent residuals of variance one; this one takes from
    /// every factor how large and how correlated its residuals are, and so holds where that differs from factor
    /// to factor. It needs many factors a block, independent of each other: the errors of a block that few
    /// factors read come out too small.
    ///
    /// Source: White, "A heteroskedasticity-consistent covariance matrix estimator", 1980; Liang and Zeger,
    /// "Longitudinal data analysis using generalized linear models", 1986, for residuals in groups.
    ///
    /// # Errors
    /// A graph without a spare residual.
    pub fn sandwich(&self, blocks: &[Block]) -> Result<Vec<Vec<f64>>, Error> {
        let (residuals, rank) = (self.residuals, self.rank());
        let spare = residuals.checked_sub(rank).filter(|&spare| spare > 0);
        let spare = spare.ok_or(Error::NoSpareResidual { residuals, rank })?;
        let structure = &*self.structure;
        let n = self.unknowns();
        let places: Vec<usize> = blocks.iter().flat_map(|&b| self.places(b)).collect();
        let columns = self.columns(&places);
        let equations = Equations::of(self.graph, structure);
        let mut sandwich = vec![vec![0.0; places.len()]; places.len()];
        let mut influence = vec![0.0; places.len()];
        // What is finite was found to be so before.
        let _ = equations.visit(&self.values, &mut |factor, r, jacobian| {
            let width = jacobian.len() / r.len().max(1);
            if let Some(loss) = equations.loss_of(factor) {
                rewrite(&loss, r, jacobian, width);
            }
            let unknowns: Vec<usize> = (self.graph.blocks_of(factor).iter())
                .map(|&b| structure.position[b as usize])
                .filter(|&p| p != NONE)
                .flat_map(|p| structure.first[p as usize]..structure.first[p as usize + 1])
                .collect();
            influence.fill(0.0);
            for (place, &unknown) in unknowns.iter().enumerate() {
                let rows = jacobian.iter().skip(place).step_by(width.max(1));
                let slope: f64 = rows.zip(&*r).map(|(j, r)| j * r).sum();
                for (sum, column) in influence.iter_mut().zip(columns.chunks_exact(n)) {
                    *sum += slope * column[unknown];
                }
            }
            for (row, a) in sandwich.iter_mut().zip(&influence) {
                row.iter_mut()
                    .zip(&influence)
                    .for_each(|(s, b)| *s += a * b);
            }
        });
        let few = residuals as f64 / spare as f64;
        let all = sandwich.iter_mut().flatten();
        all.for_each(|entry| *entry *= few);
        Ok(sandwich)
    }
}
