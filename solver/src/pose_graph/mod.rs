//! Pose graphs: `min ½ Σ ‖U log(Z⁻¹ A⁻¹ B)‖²` over poses `A`, `B` of which motions `Z` are measured, as g2o's files hold them.
//!
//! ```text
//! file ─ PoseGraph::read ─► PoseGraph ─ chordal_start ─► PoseGraph ─ graph ─► Graph ─ solve_graph ─► GraphReport
//! ```
//!
//! | to … | see |
//! |---|---|
//! | read and write g2o's files | [`PoseGraph::read`], [`PoseGraph::write`] |
//! | start where the file's poses are bad or missing | [`PoseGraph::chordal_start`], [`PoseGraph::better_start`] |
//! | choose the error of an edge | [`EdgeError`] |
//! | take information matrices that are none | [`Indefinite`] |
//!
//! ```
//! use stillpoint_solver::pose_graph::{EdgeError, Indefinite, PoseGraph};
//! use stillpoint_solver::{GraphOptions, solve_graph};
//!
//! // Three poses on a triangle; the last edge closes the loop.
//! let text = "EDGE_SE2 0 1 1.0 0.0 2.0944 1 0 0 1 0 1\n\
//!             EDGE_SE2 1 2 1.0 0.0 2.0944 1 0 0 1 0 1\n\
//!             EDGE_SE2 2 0 1.1 0.0 2.0944 1 0 0 1 0 1\n";
//! let poses = PoseGraph::read(text, Indefinite::Refused)?.better_start()?;
//! let report = solve_graph(&poses.graph(EdgeError::Apart)?, &GraphOptions::default())?;
//! assert!(report.cost < 0.01);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod chordal;
mod edge;
mod g2o;
mod information;
mod linear;
mod order;

pub use edge::{EdgeError, PlanarEdge, SpatialEdge};
pub use g2o::{ReadError, ReadErrorKind};
pub use information::Indefinite;

use edge::{PlanarFactor, SpatialFactor};

use crate::error::Error;
use crate::graph::{Block, Graph, PlanarMotion, RigidMotion};

/// Poses, in the plane or in space, and the motions measured between them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PoseGraph {
    /// Poses in the plane, `(x, y, angle in rad)`.
    pub planar: Vec<[f64; 3]>,
    /// Motions between them: the numbers of the first and the second pose, and the edge.
    pub planar_edges: Vec<(u32, u32, PlanarEdge)>,
    /// Poses in space, `(t, w, x, y, z)` with a unit quaternion.
    pub spatial: Vec<[f64; 7]>,
    /// Motions between them.
    pub spatial_edges: Vec<(u32, u32, SpatialEdge)>,
    /// Poses in the plane that are held; where a part of the graph has none its first pose is.
    pub planar_held: Vec<u32>,
    /// The same in space.
    pub spatial_held: Vec<u32>,
}

impl PoseGraph {
    /// The graph, with blocks `x0, x1, …` (poses in space after those in the plane); in every connected part
    /// the poses that the file holds are held, or else the first.
    ///
    /// # Errors
    /// [`Error::BlockStart`] for a pose that is not finite.
    pub fn graph(&self, error: EdgeError) -> Result<Graph<'static>, Error> {
        let mut graph = Graph::new();
        let mut blocks: Vec<Block> = Vec::with_capacity(self.planar.len() + self.spatial.len());
        for pose in &self.planar {
            blocks.push(graph.add(format!("x{}", blocks.len()), PlanarMotion, pose)?);
        }
        for pose in &self.spatial {
            blocks.push(graph.add(format!("x{}", blocks.len()), RigidMotion, pose)?);
        }
        let (planar, spatial) = blocks.split_at(self.planar.len());
        for (a, b, edge) in &self.planar_edges {
            let edge = PlanarFactor {
                edge: edge.clone(),
                error,
            };
            graph.add_factor(&[planar[*a as usize], planar[*b as usize]], edge);
        }
        for (a, b, edge) in &self.spatial_edges {
            let edge = SpatialFactor {
                edge: edge.clone(),
                error,
            };
            graph.add_factor(&[spatial[*a as usize], spatial[*b as usize]], edge);
        }
        for held in self.planar_anchors() {
            graph.hold(planar[held as usize]);
        }
        for held in self.spatial_anchors() {
            graph.hold(spatial[held as usize]);
        }
        Ok(graph)
    }

    /// The same edges with the poses where a [`GraphReport`](crate::GraphReport) of [`graph`](Self::graph) ended.
    pub fn at(&self, values: &[f64]) -> Self {
        let mut moved = self.clone();
        let (planar, spatial) = values.split_at((3 * self.planar.len()).min(values.len()));
        for (pose, at) in moved.planar.iter_mut().zip(planar.chunks_exact(3)) {
            pose.copy_from_slice(at);
        }
        for (pose, at) in moved.spatial.iter_mut().zip(spatial.chunks_exact(7)) {
            pose.copy_from_slice(at);
        }
        moved
    }

    /// Poses in the plane that are held.
    fn planar_anchors(&self) -> Vec<u32> {
        let ends = self.planar_edges.iter().map(|(a, b, _)| (*a, *b));
        order::anchors(self.planar.len(), ends, &self.planar_held)
    }

    /// Poses in space that are held.
    fn spatial_anchors(&self) -> Vec<u32> {
        let ends = self.spatial_edges.iter().map(|(a, b, _)| (*a, *b));
        order::anchors(self.spatial.len(), ends, &self.spatial_held)
    }
}
