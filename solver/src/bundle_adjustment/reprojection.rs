//! The camera of the bundle adjustment in the large data sets: `r = f (1 + k₁ n + k₂ n²) p − seen`,
//! `p = −(P_x, P_y) / P_z`, `n = ‖p‖²`, `P = R(ω) X + t`.
//!
//! Source: Agarwal, Snavely, Seitz and Szeliski, "Bundle adjustment in the large", 2010; the layout is
//! that of its data sets.

use crate::graph::Factor;
use crate::residual::Residual;
use crate::scalar::Scalar;

/// Place at which a point was seen, in pixels: over a camera `(ω, t, f, k₁, k₂)` and a point `X`.
#[derive(Clone, Copy, Debug)]
pub struct Reprojection(pub [f64; 2]);

/// The same with an own Jacobian.
#[derive(Clone, Copy, Debug)]
pub struct AnalyticReprojection(pub [f64; 2]);

/// Square of an angle below which its functions are taken by series.
const SMALL: f64 = 1e-10;

impl<D: Scalar> Residual<D> for Reprojection {
    // Inlined, dual numbers are compiled for the vector instructions that the machine has.
    #[inline(always)]
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        let turned = turn(&[x[0], x[1], x[2]], &[x[9], x[10], x[11]]);
        let p = [turned[0] + x[3], turned[1] + x[4], turned[2] + x[5]];
        let inverse = -p[2].recip();
        let (u, v) = (p[0] * inverse, p[1] * inverse);
        let n = u * u + v * v;
        let scale = x[6] * (n * (x[7] + x[8] * n) + 1.0);
        out.extend_from_slice(&[scale * u - self.0[0], scale * v - self.0[1]]);
    }
}

/// `v` turned by the rotation vector `w`.
#[inline(always)]
fn turn<D: Scalar>(w: &[D; 3], v: &[D; 3]) -> [D; 3] {
    let square = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
    let cross = [
        w[1] * v[2] - w[2] * v[1],
        w[2] * v[0] - w[0] * v[2],
        w[0] * v[1] - w[1] * v[0],
    ];
    if square.re() < SMALL {
        // To the second order, so that the first derivatives hold.
        let again = [
            w[1] * cross[2] - w[2] * cross[1],
            w[2] * cross[0] - w[0] * cross[2],
            w[0] * cross[1] - w[1] * cross[0],
        ];
        return [
            v[0] + cross[0] + again[0] * 0.5,
            v[1] + cross[1] + again[1] * 0.5,
            v[2] + cross[2] + again[2] * 0.5,
        ];
    }
    let angle = square.sqrt();
    let (sine, cosine) = angle.sin_cos();
    let inverse = angle.recip();
    let a = sine * inverse;
    let dot = w[0] * v[0] + w[1] * v[1] + w[2] * v[2];
    let b = (-cosine + 1.0) * dot * (inverse * inverse);
    [
        v[0] * cosine + cross[0] * a + w[0] * b,
        v[1] * cosine + cross[1] * a + w[1] * b,
        v[2] * cosine + cross[2] * a + w[2] * b,
    ]
}

/// `R(w)` and `J(w)` with `∂(R X)/∂w = −R [X]× J`.
#[inline(always)]
fn rotation_and_slope(w: &[f64]) -> ([[f64; 3]; 3], [[f64; 3]; 3]) {
    let square = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
    let (a, b, c) = if square < SMALL {
        (1.0 - square / 6.0, 0.5 - square / 24.0, 1.0 / 6.0)
    } else {
        let angle = square.sqrt();
        let (sine, cosine) = angle.sin_cos();
        (
            sine / angle,
            (1.0 - cosine) / square,
            (angle - sine) / (square * angle),
        )
    };
    let hat = [[0.0, -w[2], w[1]], [w[2], 0.0, -w[0]], [-w[1], w[0], 0.0]];
    let mut r = [[0.0; 3]; 3];
    let mut j = [[0.0; 3]; 3];
    for i in 0..3 {
        for k in 0..3 {
            let one = f64::from(u8::from(i == k));
            let square_of_hat = w[i] * w[k] - one * square;
            r[i][k] = one + a * hat[i][k] + b * square_of_hat;
            j[i][k] = one - b * hat[i][k] + c * square_of_hat;
        }
    }
    (r, j)
}

impl Factor for AnalyticReprojection {
    fn values(&self, x: &[f64], out: &mut Vec<f64>) {
        out.clear();
        Residual::<f64>::residuals(&Reprojection(self.0), x, out);
    }

    // Inlined, it is compiled for the vector instructions that the machine has.
    #[inline(always)]
    fn linearize(&self, x: &[f64], residuals: &mut Vec<f64>, jacobian: &mut Vec<f64>) {
        let (r, slope) = rotation_and_slope(&x[..3]);
        let point = &x[9..12];
        let p: [f64; 3] = std::array::from_fn(|i| {
            r[i][0] * point[0] + r[i][1] * point[1] + r[i][2] * point[2] + x[3 + i]
        });
        let inverse = -1.0 / p[2];
        let (u, v) = (p[0] * inverse, p[1] * inverse);
        let n = u * u + v * v;
        let (f, k1, k2) = (x[6], x[7], x[8]);
        let d = 1.0 + n * (k1 + k2 * n);
        let bend = 2.0 * (k1 + 2.0 * k2 * n);
        residuals.clear();
        residuals.extend_from_slice(&[f * d * u - self.0[0], f * d * v - self.0[1]]);
        // By (u, v), then by P.
        let (uu, uv, vv) = (
            f * (d + bend * u * u),
            f * bend * u * v,
            f * (d + bend * v * v),
        );
        let by_p = [
            [uu * inverse, uv * inverse, (uu * u + uv * v) * inverse],
            [uv * inverse, vv * inverse, (uv * u + vv * v) * inverse],
        ];
        let mut rows = [[0.0; 12]; 2];
        for ((out, row), own) in rows.iter_mut().zip(&by_p).zip([u, v]) {
            let by_point: [f64; 3] =
                std::array::from_fn(|k| row[0] * r[0][k] + row[1] * r[1][k] + row[2] * r[2][k]);
            // −by_point [X]× J: the row times the cross product.
            let b = by_point;
            let across = [
                b[2] * point[1] - b[1] * point[2],
                b[0] * point[2] - b[2] * point[0],
                b[1] * point[0] - b[0] * point[1],
            ];
            let by_w: [f64; 3] = std::array::from_fn(|k| {
                across[0] * slope[0][k] + across[1] * slope[1][k] + across[2] * slope[2][k]
            });
            out[..3].copy_from_slice(&by_w);
            out[3..6].copy_from_slice(row);
            out[6..9].copy_from_slice(&[d * own, f * n * own, f * n * n * own]);
            out[9..].copy_from_slice(&by_point);
        }
        jacobian.clear();
        jacobian.extend_from_slice(rows.as_flattened());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_own_jacobian_is_that_of_dual_numbers() {
        let x = [
            0.3, -0.2, 0.5, 0.1, 0.2, -4.0, 500.0, -0.1, 0.02, 0.7, -0.4, 0.9,
        ];
        let (mut r, mut j) = (Vec::new(), Vec::new());
        let (mut own_r, mut own_j) = (Vec::new(), Vec::new());
        for turn in [1.0, 1e-7] {
            let mut x = x;
            x[..3].iter_mut().for_each(|w| *w *= turn);
            Factor::linearize(&Reprojection([1.0, 2.0]), &x, &mut r, &mut j);
            AnalyticReprojection([1.0, 2.0]).linearize(&x, &mut own_r, &mut own_j);
            for (a, b) in j.iter().zip(&own_j).chain(r.iter().zip(&own_r)) {
                assert!((a - b).abs() < 1e-9 * (1.0 + b.abs()), "{a} {b}");
            }
        }
    }
}
