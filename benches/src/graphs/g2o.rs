//! Pose graph files of g2o: `VERTEX_SE2 id x y angle`, `EDGE_SE2 i j x y angle information…`,
//! `VERTEX_SE3:QUAT id x y z qx qy qz qw`, `EDGE_SE3:QUAT i j x y z qx qy qz qw information…`; the
//! information is the upper triangle, row after row.

use std::collections::HashMap;
use std::fmt::Write;

use solver::{Block, Error, Graph, PlanarMotion, RigidMotion};

use super::poses::{Edge, PlanarEdge};

/// A pose graph, in the plane or in space.
#[derive(Clone, Debug, Default)]
pub struct PoseGraph {
    /// Poses in the plane, `(x, y, angle)`.
    pub planar: Vec<[f64; 3]>,
    /// Edges between them.
    pub planar_edges: Vec<(u32, u32, PlanarEdge)>,
    /// Poses in space, `(t, w, x, y, z)`.
    pub poses: Vec<[f64; 7]>,
    /// Edges between them.
    pub edges: Vec<(u32, u32, Edge)>,
}

impl PoseGraph {
    /// Reads a file's text; lines of other kinds are passed over.
    ///
    /// # Errors
    /// A line with too few numbers, an edge between poses that are not there, and an information
    /// matrix that is not positive definite.
    pub fn read(text: &str) -> Result<Self, String> {
        let mut graph = Self::default();
        let mut places = HashMap::new();
        for (number, line) in text.lines().enumerate() {
            let mut words = line.split_whitespace();
            let kind = words.next().unwrap_or("");
            let values: Vec<f64> = words.filter_map(|w| w.parse().ok()).collect();
            let bad = |what: &str| format!("line {}: {what}", number + 1);
            let need = |n: usize| {
                let short = || bad(&format!("{n} numbers needed, {} found", values.len()));
                values.get(..n).ok_or_else(short)
            };
            let ends = || {
                let place = |id: f64| places.get(&(id as i64)).copied();
                place(values[0])
                    .zip(place(values[1]))
                    .ok_or_else(|| bad("an edge of a pose that is not there"))
            };
            let root_error = || bad("the information is not positive definite");
            match kind {
                "VERTEX_SE2" => {
                    let v = need(4)?;
                    places.insert(v[0] as i64, graph.planar.len() as u32);
                    graph.planar.push([v[1], v[2], v[3]]);
                }
                "VERTEX_SE3:QUAT" => {
                    let v = need(8)?;
                    places.insert(v[0] as i64, graph.poses.len() as u32);
                    graph.poses.push(pose(&v[1..]));
                }
                "EDGE_SE2" => {
                    let v = need(11)?;
                    let (a, b) = ends()?;
                    let measured = [v[2], v[3], v[4]];
                    let root = root(&v[5..]).ok_or_else(root_error)?;
                    graph
                        .planar_edges
                        .push((a, b, PlanarEdge { measured, root }));
                }
                "EDGE_SE3:QUAT" => {
                    let v = need(30)?;
                    let (a, b) = ends()?;
                    let measured = pose(&v[2..]);
                    let root = root(&v[9..]).ok_or_else(root_error)?;
                    graph.edges.push((a, b, Edge { measured, root }));
                }
                _ => {}
            }
        }
        Ok(graph)
    }

    /// The file's text.
    pub fn write(&self) -> String {
        let mut text = String::new();
        let quaternion = |p: &[f64; 7]| {
            format!(
                "{:e} {:e} {:e} {:e} {:e} {:e} {:e}",
                p[0], p[1], p[2], p[4], p[5], p[6], p[3]
            )
        };
        for (k, p) in self.planar.iter().enumerate() {
            let _ = writeln!(text, "VERTEX_SE2 {k} {:e} {:e} {:e}", p[0], p[1], p[2]);
        }
        for (k, p) in self.poses.iter().enumerate() {
            let _ = writeln!(text, "VERTEX_SE3:QUAT {k} {}", quaternion(p));
        }
        for (a, b, edge) in &self.planar_edges {
            let [x, y, angle] = edge.measured;
            let _ = write!(text, "EDGE_SE2 {a} {b} {x:e} {y:e} {angle:e}");
            write_information(&mut text, &edge.root, 3);
        }
        for (a, b, edge) in &self.edges {
            let _ = write!(text, "EDGE_SE3:QUAT {a} {b} {}", quaternion(&edge.measured));
            write_information(&mut text, &edge.root, 6);
        }
        text
    }

    /// The graph, with blocks `x0, x1, …`, the first one held.
    ///
    /// # Errors
    /// A start that is not finite.
    pub fn graph(&self) -> Result<Graph<'static>, Error> {
        let mut graph = Graph::new();
        let name = |k: usize| format!("x{k}");
        let planar: Vec<Block> = (0..self.planar.len())
            .map(|k| graph.add(name(k), PlanarMotion, &self.planar[k]))
            .collect::<Result<_, _>>()?;
        let poses: Vec<Block> = (0..self.poses.len())
            .map(|k| graph.add(name(k), RigidMotion, &self.poses[k]))
            .collect::<Result<_, _>>()?;
        for (a, b, edge) in &self.planar_edges {
            graph.add_factor(&[planar[*a as usize], planar[*b as usize]], edge.clone());
        }
        for (a, b, edge) in &self.edges {
            graph.add_factor(&[poses[*a as usize], poses[*b as usize]], edge.clone());
        }
        for first in planar.first().into_iter().chain(poses.first()) {
            graph.hold(*first);
        }
        Ok(graph)
    }
}

/// `(t, w, x, y, z)`, the quaternion of unit length, from the file's `(t, x, y, z, w)`.
fn pose(v: &[f64]) -> [f64; 7] {
    let length = v[3..7].iter().map(|q| q * q).sum::<f64>().sqrt();
    let q = |k: usize| v[k] / length;
    [v[0], v[1], v[2], q(6), q(3), q(4), q(5)]
}

/// The upper triangular `U` of `UᵀU`, row after row, from the upper triangle of the information.
fn root<const N: usize>(upper: &[f64]) -> Option<[f64; N]> {
    let n = N.isqrt();
    let mut u = [0.0; N];
    let mut entries = upper.iter();
    for i in 0..n {
        for k in i..n {
            u[i * n + k] = *entries.next()?;
        }
    }
    for i in 0..n {
        for k in i..n {
            for j in 0..i {
                u[i * n + k] -= u[j * n + i] * u[j * n + k];
            }
        }
        let pivot = u[i * n + i];
        if pivot.is_nan() || pivot <= 0.0 {
            return None;
        }
        (i..n).for_each(|k| u[i * n + k] /= pivot.sqrt());
    }
    Some(u)
}

fn write_information(text: &mut String, root: &[f64], n: usize) {
    for i in 0..n {
        for k in i..n {
            let entry: f64 = (0..=i).map(|j| root[j * n + i] * root[j * n + k]).sum();
            let _ = write!(text, " {entry:e}");
        }
    }
    text.push('\n');
}

#[cfg(test)]
mod tests {
    use super::super::walks::{Loops, planar, spatial};
    use super::*;

    #[test]
    fn what_is_written_is_read() {
        let loops = Loops::Anywhere;
        for graph in [planar(20, 3, loops), spatial(20, 3, loops)] {
            let read = PoseGraph::read(&graph.write()).unwrap();
            let costs = [&graph, &read].map(|g| {
                let options = solver::GraphOptions::default();
                solver::solve_graph(&g.graph().unwrap(), &options)
                    .unwrap()
                    .cost
            });
            assert!((costs[0] / costs[1] - 1.0).abs() < 1e-9, "{costs:?}");
        }
        assert!(PoseGraph::read("EDGE_SE2 0 1 1 2 3 1 0 0 1 0 1").is_err());
    }
}
