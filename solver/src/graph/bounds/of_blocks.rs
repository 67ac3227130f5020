//! Bounds on the numbers of blocks: how a graph is given them.

use crate::error::Error;
use crate::graph::problem::{Block, Graph};
use crate::graph::ranges::keep;

impl Graph<'_> {
    /// Keeps one number of a block within `lower ≤ x ≤ upper`; infinite where there is no bound. Where it is held it stays as it
    /// is, bounds or not.
    ///
    /// Any number of a plain block ([`Euclidean`](crate::Euclidean)) will do, of a curved one those to which a step's coordinate
    /// is added ([`Manifold::plain`](crate::Manifold::plain)): the angle of a [`PlanarMotion`](crate::PlanarMotion), the
    /// place of the pair `(Euclidean(3), Rotation)`, which stores what a [`RigidMotion`](crate::RigidMotion) does, the focal
    /// length of a camera `(RotationVector, Euclidean(6))`. `coordinate` counts the coordinates of a step, as in
    /// [`hold_part`](Self::hold_part).
    ///
    /// Every step goes to the minimum of the damped linearised problem within all bounds; those that hold at the
    /// end are named in [`GraphReport::active`](crate::GraphReport::active), and to [`Products`](crate::Products) what they hold is known exactly.
    ///
    /// ```
    /// use stillpoint_solver::{Euclidean, Graph, GraphOptions, Residual, Scalar, solve_graph};
    ///
    /// struct Near([f64; 2]);
    /// impl<D: Scalar> Residual<D> for Near {
    ///     fn residuals(&self, x: &[D], out: &mut Vec<D>) {
    ///         out.extend([x[0] - self.0[0], x[1] - x[0] * self.0[1]]);
    ///     }
    /// }
    ///
    /// let mut graph = Graph::new();
    /// let rate = graph.add("rate", Euclidean(2), &[0.5, 0.5])?;
    /// graph.bound(rate, 0, 0.0, 1.0)?;
    /// graph.add_factor(&[rate], Near([3.0, 2.0]));
    /// let report = solve_graph(&graph, &GraphOptions::default())?;
    /// assert_eq!(report.value(rate)[0], 1.0);
    /// assert_eq!(report.active[0].constraint, "rate.0");
    /// assert!((report.active[0].multiplier + 2.0).abs() < 1e-12); // raised by 1, the bound lowers the cost by 2
    /// # Ok::<(), stillpoint_solver::Error>(())
    /// ```
    ///
    /// # Errors
    /// A block or a coordinate that is not there, a coordinate that turns or bends what is stored, and bounds between which
    /// nothing lies.
    pub fn bound(
        &mut self,
        block: Block,
        coordinate: usize,
        lower: f64,
        upper: f64,
    ) -> Result<(), Error> {
        let blocks = self.variables.len();
        let Some(variable) = self.variables.get(block.number()) else {
            let block = block.number();
            return Err(Error::UnknownBlock { block, blocks });
        };
        if coordinate >= variable.dimension as usize {
            let name = format!("{}.{coordinate}", variable.name);
            return Err(Error::UnknownParameter { name });
        }
        if variable.manifold.plain(coordinate).is_none() {
            return Err(Error::Unsupported {
                variant: format!(
                    "coordinate {coordinate} of the curved block {}",
                    variable.name
                ),
                what: "bounds: take a pair such as (Euclidean(3), Rotation), whose numbers are steps too",
            });
        }
        let name = variable.coordinate(coordinate);
        let key = (block.0, coordinate as u32);
        keep(&mut self.ranges, key, name, [lower, upper])
    }

    /// Keeps every number of a plain block within the same bounds; see [`bound`](Self::bound).
    ///
    /// # Errors
    /// As [`bound`](Self::bound).
    pub fn bound_block(&mut self, block: Block, lower: f64, upper: f64) -> Result<(), Error> {
        let dimension = self.variables.get(block.number()).map(|v| v.dimension);
        for coordinate in 0..dimension.unwrap_or(1).max(1) {
            self.bound(block, coordinate as usize, lower, upper)?;
        }
        Ok(())
    }

    /// Moves the start of every bounded number that lies outside onto the nearer bound.
    pub fn move_within_bounds(&mut self) {
        for (&(block, coordinate), &(lower, upper)) in &self.ranges {
            let variable = &self.variables[block as usize];
            let is_free = (variable.free_coordinates()).any(|k| k == coordinate as usize);
            if let (true, Some(number)) = (is_free, variable.plain(coordinate as usize)) {
                let x = &mut self.values[variable.first + number];
                *x = x.clamp(lower, upper);
            }
        }
    }
}
