//! Factors between poses.

use solver::quaternion::{logarithm, multiply, rotate_back};
use solver::{Residual, Scalar, lit};

/// The motion from one pose to another as measured, in the plane: whitened by the root `U` of its
/// information, `UᵀU`.
#[derive(Clone, Debug)]
pub struct PlanarEdge {
    /// `(x, y, angle in rad)` of the second pose as seen from the first.
    pub measured: [f64; 3],
    /// `U`, upper triangular, row after row.
    pub root: [f64; 9],
}

/// The same in space.
#[derive(Clone, Debug)]
pub struct Edge {
    /// `(t, w, x, y, z)` of the second pose as seen from the first.
    pub measured: [f64; 7],
    /// `U`, upper triangular, row after row.
    pub root: [f64; 36],
}

impl<D: Scalar> Residual<D> for PlanarEdge {
    #[inline(always)]
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        let (sine, cosine) = x[2].sin_cos();
        let (east, north) = (x[3] - x[0], x[4] - x[1]);
        let mut turn = x[5] - x[2] - self.measured[2];
        let turns = (turn.re() / std::f64::consts::TAU).round();
        turn -= turns * std::f64::consts::TAU;
        let e = [
            cosine * east + sine * north - self.measured[0],
            cosine * north - sine * east - self.measured[1],
            turn,
        ];
        whiten(&self.root, &e, out);
    }
}

impl<D: Scalar> Residual<D> for Edge {
    #[inline(always)]
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        let (a, b) = x.split_at(7);
        let moved = rotate_back(&a[3..], &[b[0] - a[0], b[1] - a[1], b[2] - a[2]]);
        let inverse = [a[3], -a[4], -a[5], -a[6]];
        let turned = multiply(&inverse, &b[3..]);
        let m = &self.measured;
        let back = [m[3], -m[4], -m[5], -m[6]].map(lit::<D>);
        let turn = logarithm(&multiply(&back, &turned));
        let e = [
            moved[0] - m[0],
            moved[1] - m[1],
            moved[2] - m[2],
            turn[0],
            turn[1],
            turn[2],
        ];
        whiten(&self.root, &e, out);
    }
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
