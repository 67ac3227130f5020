//! A start by two linear problems: rotations by their chordal distance, then places.
//!
//! Rotations minimise `Σ ‖R_b − R_a R_Z‖²/σ²` over all matrices, each row of them on its own, and are then brought to the nearest
//! rotations; places minimise `Σ ‖t_b − t_a − R_a t_Z‖²/σ²`.
//!
//! Source: Martinec and Pajdla, "Robust rotation and translation estimation in multiview reconstruction", 2007; Carlone, Tron,
//! Daniilidis and Dellaert, "Initialization techniques for 3D SLAM: a survey on rotation estimation and its use in pose graph
//! optimization", 2015.

use faer::{Mat, Side};

use super::PoseGraph;
use super::edge::{EdgeError, SpatialEdge};
use super::information::mean_variances;
use super::linear::{Row, solved};
use crate::error::Error;
use crate::graph::quaternion::rotate;

/// A start whose mean square of the whitened errors is below this is as near as a linear problem leads: no other is looked
/// for.
const NEAR: f64 = 30.0;

impl PoseGraph {
    /// The same edges with poses from two linear problems, whatever the poses at hand; only those that are held count.
    ///
    /// # Errors
    /// What is not finite.
    pub fn chordal_start(&self) -> Result<Self, Error> {
        let mut start = self.clone();
        if !self.planar_edges.is_empty() {
            start.planar = planar(self)?;
        }
        if !self.spatial_edges.is_empty() {
            start.spatial = spatial(self)?;
        }
        Ok(start)
    }

    /// The poses at hand, or those of [`chordal_start`](Self::chordal_start) where the cost is lower there. Poses that explain
    /// their edges well already are kept without a look.
    ///
    /// # Errors
    /// What is not finite.
    pub fn better_start(self) -> Result<Self, Error> {
        let cost = |poses: &Self| -> Result<f64, Error> {
            let graph = poses.graph(EdgeError::Apart)?;
            Ok(graph.cost(graph.values()))
        };
        let here = cost(&self)?;
        let rows = 3 * self.planar_edges.len() + 6 * self.spatial_edges.len();
        if 2.0 * here <= NEAR * rows as f64 {
            return Ok(self);
        }
        let chordal = self.chordal_start()?;
        Ok(match cost(&chordal)? < here {
            true => chordal,
            false => self,
        })
    }
}

fn planar(graph: &PoseGraph) -> Result<Vec<[f64; 3]>, Error> {
    let held = graph.planar_anchors();
    let variances = graph
        .planar_edges
        .iter()
        .map(|(_, _, edge)| mean_variances(&edge.root, 2));
    let variances: Vec<[f64; 2]> = variances.collect();
    let edges = || graph.planar_edges.iter().zip(&variances);
    let turned = edges().map(|((a, b, edge), [_, turn])| {
        let (sine, cosine) = edge.measured[2].sin_cos();
        Row {
            ends: (*a, *b),
            weight: turn.sqrt().recip(),
            matrix: [[cosine, -sine], [sine, cosine]],
            constant: [0.0; 2],
        }
    });
    let start: Vec<[f64; 2]> = graph
        .planar
        .iter()
        .map(|p| [p[2].cos(), p[2].sin()])
        .collect();
    let turned = solved(&start, &held, turned.collect())?;
    let mut angles: Vec<f64> = turned.iter().map(|[c, s]| s.atan2(*c)).collect();
    for &k in &held {
        angles[k as usize] = graph.planar[k as usize][2];
    }
    let moved = edges().map(|((a, b, edge), [way, _])| {
        let (sine, cosine) = angles[*a as usize].sin_cos();
        let [x, y, _] = edge.measured;
        Row {
            ends: (*a, *b),
            weight: way.sqrt().recip(),
            matrix: [[1.0, 0.0], [0.0, 1.0]],
            constant: [cosine * x - sine * y, sine * x + cosine * y],
        }
    });
    let start: Vec<[f64; 2]> = graph.planar.iter().map(|p| [p[0], p[1]]).collect();
    let places = solved(&start, &held, moved.collect())?;
    Ok(places
        .iter()
        .zip(angles)
        .map(|([x, y], angle)| [*x, *y, angle])
        .collect())
}

fn spatial(graph: &PoseGraph) -> Result<Vec<[f64; 7]>, Error> {
    let held = graph.spatial_anchors();
    let variances = graph
        .spatial_edges
        .iter()
        .map(|(_, _, edge)| mean_variances(&edge.root, 3));
    let variances: Vec<[f64; 2]> = variances.collect();
    let edges = || graph.spatial_edges.iter().zip(&variances);
    let mut rows: [Vec<[f64; 3]>; 3] = Default::default();
    for (k, solution) in rows.iter_mut().enumerate() {
        // Row k of R_b is that of R_a times R_Z: as columns, R_Zᵀ times it.
        let turned = edges().map(|((a, b, edge), [_, turn])| Row {
            ends: (*a, *b),
            weight: turn.sqrt().recip(),
            matrix: transposed(matrix(edge)),
            constant: [0.0; 3],
        });
        let start = graph.spatial.iter().map(|p| matrix_of(&p[3..])[k]);
        *solution = solved(&start.collect::<Vec<_>>(), &held, turned.collect())?;
    }
    let [first, second, third] = &rows;
    let mut turns: Vec<[f64; 4]> = first
        .iter()
        .zip(second)
        .zip(third)
        .map(|((a, b), c)| nearest_rotation([*a, *b, *c]))
        .collect();
    for &k in &held {
        turns[k as usize].copy_from_slice(&graph.spatial[k as usize][3..]);
    }
    let moved = edges().map(|((a, b, edge), [way, _])| Row {
        ends: (*a, *b),
        weight: way.sqrt().recip(),
        matrix: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        constant: rotate(&turns[*a as usize], &edge.measured[..3]),
    });
    let start: Vec<[f64; 3]> = graph.spatial.iter().map(|p| [p[0], p[1], p[2]]).collect();
    let places = solved(&start, &held, moved.collect())?;
    let poses = places.iter().zip(turns);
    let poses = poses.map(|(t, q)| [t[0], t[1], t[2], q[0], q[1], q[2], q[3]]);
    Ok(poses.collect())
}

/// The rotation of an edge as a matrix.
fn matrix(edge: &SpatialEdge) -> [[f64; 3]; 3] {
    matrix_of(&edge.measured[3..])
}

/// The matrix of a unit quaternion, row after row.
fn matrix_of(q: &[f64]) -> [[f64; 3]; 3] {
    let columns = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|e| rotate(q, &e));
    transposed(columns)
}

fn transposed(m: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    std::array::from_fn(|i| std::array::from_fn(|k| m[k][i]))
}

/// The unit quaternion whose matrix `R` maximises `tr(RᵀM)`: the eigenvector of the largest eigenvalue of a symmetric
/// 4 × 4 matrix, a proper rotation whatever the determinant of `M`.
///
/// Source: Horn, "Closed-form solution of absolute orientation using unit quaternions", 1987.
fn nearest_rotation(m: [[f64; 3]; 3]) -> [f64; 4] {
    let [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]] = m;
    let rows = [
        [xx + yy + zz, zy - yz, xz - zx, yx - xy],
        [zy - yz, xx - yy - zz, xy + yx, zx + xz],
        [xz - zx, xy + yx, yy - xx - zz, yz + zy],
        [yx - xy, zx + xz, yz + zy, zz - xx - yy],
    ];
    let all = Mat::from_fn(4, 4, |i, k| rows[i][k]);
    match all.self_adjoint_eigen(Side::Lower) {
        // In ascending order.
        Ok(eigen) => std::array::from_fn(|i| eigen.U()[(i, 3)]),
        Err(_) => [1.0, 0.0, 0.0, 0.0],
    }
}

#[cfg(test)]
mod tests {
    use super::super::Indefinite;
    use super::*;
    use crate::graph::quaternion::{exponential, multiply, rotate_back};
    use crate::graph::{GraphOptions, solve_graph};

    #[test]
    fn the_nearest_rotation_of_a_rotation_is_itself_and_of_a_mirror_a_rotation() {
        let q = exponential(&[0.4, -1.9, 0.8]);
        let found = nearest_rotation(matrix_of(&q));
        let same: f64 = q.iter().zip(found).map(|(a, b)| a * b).sum();
        assert!((same.abs() - 1.0).abs() < 1e-14);
        let mirror = nearest_rotation([[1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, -0.5]]);
        assert!((mirror.iter().map(|q| q * q).sum::<f64>() - 1.0).abs() < 1e-14);
        assert!((mirror[0].abs() - 1.0).abs() < 1e-14);
    }

    /// A ring of poses in space, each seen from the two before it; exact edges.
    fn ring(count: u32) -> PoseGraph {
        let mut graph = PoseGraph::default();
        let pose = |k: u32| {
            let turn = f64::from(k);
            let q = exponential(&[0.3 * turn, 0.2 * (turn * 0.7).sin(), 0.4 * turn]);
            [
                turn.cos() * 5.0,
                turn.sin() * 5.0,
                0.1 * turn,
                q[0],
                q[1],
                q[2],
                q[3],
            ]
        };
        for b in 0..count {
            graph.spatial.push([0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
            for a in b.saturating_sub(2)..b {
                let (from, to) = (pose(a), pose(b));
                let way = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
                let t = rotate_back(&from[3..], &way);
                let back = [from[3], -from[4], -from[5], -from[6]];
                let q = multiply(&back, &to[3..]);
                let mut root = [0.0; 36];
                (0..6).for_each(|k| root[7 * k] = if k < 3 { 10.0 } else { 50.0 });
                let measured = [t[0], t[1], t[2], q[0], q[1], q[2], q[3]];
                graph
                    .spatial_edges
                    .push((a, b, SpatialEdge { measured, root }));
            }
        }
        graph.spatial[0] = pose(0);
        graph
    }

    #[test]
    fn exact_edges_are_explained_by_the_chordal_start_alone() {
        let start = ring(40).chordal_start().unwrap();
        let graph = start.graph(EdgeError::Logarithm).unwrap();
        assert!(graph.cost(graph.values()) < 1e-12);
        let plane = "EDGE_SE2 0 1 1 0 1.5 1 0 0 1 0 1\nEDGE_SE2 1 2 2 1 1.5 1 0 0 1 0 1\nVERTEX_SE2 2 9 9 1\nVERTEX_SE2 0 1 1 3\n";
        let plane = PoseGraph::read(plane, Indefinite::Refused).unwrap();
        let graph = plane
            .chordal_start()
            .unwrap()
            .graph(EdgeError::Apart)
            .unwrap();
        assert!(graph.cost(graph.values()) < 1e-20);
    }

    #[test]
    fn a_bad_start_is_left_for_the_chordal_one_and_a_good_one_kept() {
        let bad = ring(40);
        let better = bad.clone().better_start().unwrap();
        assert_ne!(better.spatial, bad.spatial);
        let report = solve_graph(
            &better.graph(EdgeError::Apart).unwrap(),
            &GraphOptions::default(),
        );
        assert!(report.unwrap().cost < 1e-12);
        assert_eq!(better.clone().better_start().unwrap(), better);
    }
}
