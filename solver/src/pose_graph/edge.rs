//! Edges between poses and their errors.

use crate::graph::quaternion::{conjugate, cross, logarithm, multiply, rotate_back};
use crate::graph::wrapped;
use crate::residual::Residual;
use crate::scalar::{Scalar, lit};

/// Below this square of an angle, in rad², the inverse of its `V` is taken by series.
const SMALL: f64 = 1e-4;

/// The error of an edge: what is left of the measured motion `Z` in `E = Z⁻¹ A⁻¹ B`.
///
/// All three have the translation of `E`, in the frame that the measured motion leads to; a file's information matrix weighs
/// it with the rotation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum EdgeError {
    /// Translation and rotation vector of `E`, each on its own; in the plane g2o's own error.
    #[default]
    Apart,
    /// The logarithm of `E` in SE(2) or SE(3): the rotation turns the translation as it goes. GTSAM's error.
    Logarithm,
    /// Translation and vector part of the quaternion of `E`, half of the angle where it is small: g2o's error in space
    /// (Kümmerle et al., g2o, `EdgeSE3::computeError`, `toVectorMQT`). In the plane as [`Apart`](Self::Apart).
    Quaternion,
}

/// A motion measured in the plane, whitened by the root `U` of its information, `UᵀU`.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanarEdge {
    /// `(x, y, angle in rad)` of the second pose as seen from the first.
    pub measured: [f64; 3],
    /// `U`, upper triangular, 3 × 3, row after row.
    pub root: [f64; 9],
}

/// A motion measured in space, whitened by the root `U` of its information, `UᵀU`.
#[derive(Clone, Debug, PartialEq)]
pub struct SpatialEdge {
    /// `(t, w, x, y, z)` of the second pose as seen from the first, with a unit quaternion.
    pub measured: [f64; 7],
    /// `U`, upper triangular, 6 × 6, row after row: translation before rotation.
    pub root: [f64; 36],
}

/// `U` times the error of a planar edge, 3 rows over two poses.
#[derive(Debug)]
pub(super) struct PlanarFactor {
    pub edge: PlanarEdge,
    pub error: EdgeError,
}

/// `U` times the error of an edge in space, 6 rows over two poses.
#[derive(Debug)]
pub(super) struct SpatialFactor {
    pub edge: SpatialEdge,
    pub error: EdgeError,
}

impl<D: Scalar> Residual<D> for PlanarFactor {
    #[inline(always)]
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        let m = &self.edge.measured;
        let moved = turned_back(x[2], [x[3] - x[0], x[4] - x[1]]);
        let missed = [moved[0] - m[0], moved[1] - m[1]];
        let (sine, cosine) = m[2].sin_cos();
        let t = [
            missed[0] * cosine + missed[1] * sine,
            missed[1] * cosine - missed[0] * sine,
        ];
        let turn = wrapped(x[5] - x[2] - m[2]);
        let t = match self.error {
            EdgeError::Logarithm => planar_logarithm(turn, t),
            EdgeError::Apart | EdgeError::Quaternion => t,
        };
        whiten(&self.edge.root, &[t[0], t[1], turn], out);
    }
}

/// A vector of the plane turned by `−angle`.
#[inline(always)]
fn turned_back<D: Scalar>(angle: D, v: [D; 2]) -> [D; 2] {
    let (sine, cosine) = angle.sin_cos();
    [cosine * v[0] + sine * v[1], cosine * v[1] - sine * v[0]]
}

/// `V(φ)⁻¹ t`, the translation in the logarithm of a motion in the plane.
#[inline(always)]
fn planar_logarithm<D: Scalar>(angle: D, t: [D; 2]) -> [D; 2] {
    let half = angle * 0.5;
    let square = half * half;
    // (φ/2) cot(φ/2)
    let a = if square.re() < SMALL {
        lit::<D>(1.0) - square * (1.0 / 3.0) - square * square * (1.0 / 45.0)
    } else {
        let (sine, cosine) = half.sin_cos();
        half * cosine / sine
    };
    [a * t[0] + half * t[1], a * t[1] - half * t[0]]
}

impl<D: Scalar> Residual<D> for SpatialFactor {
    #[inline(always)]
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        let (a, b) = x.split_at(7);
        let m = &self.edge.measured;
        let moved = rotate_back(&a[3..], &[b[0] - a[0], b[1] - a[1], b[2] - a[2]]);
        let missed = [moved[0] - m[0], moved[1] - m[1], moved[2] - m[2]];
        let measured = [m[3], m[4], m[5], m[6]].map(lit::<D>);
        let t = rotate_back(&measured, &missed);
        let turned = multiply(&conjugate(&a[3..]), &b[3..]);
        let left = multiply(&conjugate(&measured), &turned);
        let (t, turn) = match self.error {
            EdgeError::Apart => (t, logarithm(&left)),
            EdgeError::Logarithm => {
                let turn = logarithm(&left);
                (spatial_logarithm(&left, &turn, &t), turn)
            }
            EdgeError::Quaternion => {
                let sign = if left[0].re() < 0.0 { -1.0 } else { 1.0 };
                (t, [left[1] * sign, left[2] * sign, left[3] * sign])
            }
        };
        let e = [t[0], t[1], t[2], turn[0], turn[1], turn[2]];
        whiten(&self.edge.root, &e, out);
    }
}

/// `V(φ)⁻¹ t = t − ½ φ × t + b φ × (φ × t)`, `b = (1 − (φ/2) cot(φ/2)) / φ²`: the translation in the logarithm of a motion in
/// space, of which `q` is the quaternion and `φ` the rotation vector.
#[inline(always)]
fn spatial_logarithm<D: Scalar>(q: &[D; 4], turn: &[D; 3], t: &[D; 3]) -> [D; 3] {
    let square = turn[0] * turn[0] + turn[1] * turn[1] + turn[2] * turn[2];
    let b = if square.re() < SMALL {
        lit::<D>(1.0 / 12.0) + square * (1.0 / 720.0) + square * square * (1.0 / 30_240.0)
    } else {
        let sign = if q[0].re() < 0.0 { -1.0 } else { 1.0 };
        let sine = (q[1] * q[1] + q[2] * q[2] + q[3] * q[3]).sqrt();
        let half = square.sqrt() * 0.5;
        (lit::<D>(1.0) - half * q[0] * sign / sine) / square
    };
    let once = cross(turn, t);
    let twice = cross(turn, &once);
    [0, 1, 2].map(|k| t[k] - once[k] * 0.5 + twice[k] * b)
}

/// `U e`.
#[inline(always)]
fn whiten<D: Scalar>(root: &[f64], e: &[D], out: &mut Vec<D>) {
    let n = e.len();
    for i in 0..n {
        let mut sum = e[i] * root[i * n + i];
        for k in i + 1..n {
            if root[i * n + k] != 0.0 {
                sum += e[k] * root[i * n + k];
            }
        }
        out.push(sum);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::quaternion::{exponential, rotate};

    const POSES: [f64; 14] = [
        0.3, -1.0, 2.0, 0.5, 0.5, -0.5, 0.5, 1.1, 0.4, 2.2, 0.7, 0.1, -0.7, 0.1,
    ];

    fn unit_poses() -> Vec<f64> {
        let mut x = POSES.to_vec();
        let length = x[10..].iter().map(|q| q * q).sum::<f64>().sqrt();
        x[10..].iter_mut().for_each(|q| *q /= length);
        x
    }

    fn spatial(measured: [f64; 7], error: EdgeError) -> Vec<f64> {
        let mut root = [0.0; 36];
        (0..6).for_each(|k| root[7 * k] = 1.0);
        let edge = SpatialEdge { measured, root };
        let mut out = Vec::new();
        Residual::<f64>::residuals(&SpatialFactor { edge, error }, &unit_poses(), &mut out);
        out
    }

    /// `A⁻¹ B exp(−ξ)` is measured, with `exp` of SE(3) by its series of matrices.
    fn measured_less(xi: [f64; 6]) -> [f64; 7] {
        let x = unit_poses();
        let between = rotate_back(&x[3..7], &[x[7] - x[0], x[8] - x[1], x[9] - x[2]]);
        let turned = multiply(&conjugate(&x[3..7]), &x[10..]);
        let phi = [-xi[3], -xi[4], -xi[5]];
        // V(φ) t by its series Σ (φ×)ⁿ t / (n+1)!.
        let t = [-xi[0], -xi[1], -xi[2]];
        let (mut term, mut sum) = (t, t);
        for n in 2..40 {
            term = cross(&phi, &term).map(|v| v / f64::from(n));
            (0..3).for_each(|k| sum[k] += term[k]);
        }
        let moved = rotate(&turned, &sum);
        let q = multiply(&turned, &exponential(&phi));
        [
            between[0] + moved[0],
            between[1] + moved[1],
            between[2] + moved[2],
            q[0],
            q[1],
            q[2],
            q[3],
        ]
    }

    #[test]
    fn the_logarithm_undoes_the_exponential_of_rigid_motions() {
        for size in [1e-6, 4e-3, 0.1, 1.0] {
            let xi = [0.4, -0.3, 0.8, 1.2, 0.5, -1.6].map(|v| v * size);
            let found = spatial(measured_less(xi), EdgeError::Logarithm);
            for (a, b) in found.iter().zip(xi) {
                assert!((a - b).abs() < 1e-12, "{found:?} {xi:?}");
            }
        }
    }

    #[test]
    fn the_quaternion_error_is_half_the_rotation_vector_and_its_translation_the_same() {
        let measured = measured_less([0.0, 0.0, 0.0, 1e-4, -2e-4, 3e-4]);
        let apart = spatial(measured, EdgeError::Apart);
        let quaternion = spatial(measured, EdgeError::Quaternion);
        for k in 0..3 {
            assert!((apart[k] - quaternion[k]).abs() < 1e-15);
            assert!((0.5 * apart[3 + k] - quaternion[3 + k]).abs() < 1e-11);
        }
    }

    /// g2o: `SE2 delta = measurement⁻¹ (v1⁻¹ v2)`, `error = delta.toVector()`, here by 3 × 3 matrices.
    #[test]
    fn a_planar_edge_has_the_error_of_g2o() {
        let (a, b, z) = ([1.0, 2.0, 0.7], [2.5, 1.0, -2.9], [1.2, -0.4, 2.5]);
        let matrix = |p: [f64; 3]| {
            let (s, c) = p[2].sin_cos();
            [[c, -s, p[0]], [s, c, p[1]], [0.0, 0.0, 1.0]]
        };
        let inverse = |p: [f64; 3]| {
            let t = turned_back(p[2], [-p[0], -p[1]]);
            matrix([t[0], t[1], -p[2]])
        };
        let delta = product(inverse(z), product(inverse(a), matrix(b)));
        let edge = PlanarEdge {
            measured: z,
            root: [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
        };
        let error = EdgeError::Apart;
        let mut out = Vec::new();
        let x = [a[0], a[1], a[2], b[0], b[1], b[2]];
        Residual::<f64>::residuals(&PlanarFactor { edge, error }, &x, &mut out);
        let angle = delta[1][0].atan2(delta[0][0]);
        for (found, due) in out.iter().zip([delta[0][2], delta[1][2], angle]) {
            assert!((found - due).abs() < 1e-14, "{out:?} {delta:?}");
        }
    }

    fn product(a: [[f64; 3]; 3], b: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
        std::array::from_fn(|i| std::array::from_fn(|k| (0..3).map(|j| a[i][j] * b[j][k]).sum()))
    }

    /// Printed by g2o's own classes: `benches/peers/g2o_convention.py`.
    #[test]
    fn errors_are_those_that_g2o_itself_prints() {
        let lines = "VERTEX_SE2 0 0.3 -1 0.4\nVERTEX_SE2 1 1.1 0.4 1.7\nEDGE_SE2 0 1 0.9 0.7 1.5 1 0 0 1 0 1\n";
        let planar = super::super::PoseGraph::read(lines, Default::default()).unwrap();
        let graph = planar.graph(EdgeError::Apart).unwrap();
        let due = [0.304_278_497_147_806_86, -0.361_416_016_982_579_75, -0.2];
        for (found, due) in graph.residuals(graph.values()).iter().zip(due) {
            assert!((found - due).abs() < 1e-14, "{found} {due}");
        }
        let unit = "1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1";
        let lines = format!(
            "VERTEX_SE3:QUAT 0 0.3 -1 2 0.5 -0.5 0.5 0.5\nVERTEX_SE3:QUAT 1 1.1 0.4 2.2 0.1 -0.7 0.1 0.7\n\
             EDGE_SE3:QUAT 0 1 0.4 0.1 1.3 0.2 -0.1 0.6 0.8 {unit}\n"
        );
        let spatial = super::super::PoseGraph::read(&lines, Default::default()).unwrap();
        let graph = spatial.graph(EdgeError::Quaternion).unwrap();
        let due = [
            -1.876_190_476_190_476_2,
            -0.538_095_238_095_238_4,
            -2.080_952_380_952_381,
            -0.624_576_046_687_061_2,
            0.429_396_032_097_354_5,
            -0.409_878_030_638_383_85,
        ];
        for (found, due) in graph.residuals(graph.values()).iter().zip(due) {
            assert!((found - due).abs() < 1e-14, "{found} {due}");
        }
    }
}
