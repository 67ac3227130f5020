//! The camera of the bundle adjustments and its Jacobian by hand: that of the benches.

const SMALL: f64 = 1e-10;

/// Residuals and, if asked, `2 × 12` derivatives by the camera and the point.
pub fn project(
    c: &[f64],
    x: &[f64],
    seen: &[f64; 2],
    jacobian: Option<&mut [[f64; 12]; 2]>,
) -> [f64; 2] {
    let square = c[0] * c[0] + c[1] * c[1] + c[2] * c[2];
    let (a, b, k) = if square < SMALL {
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
    let hat = [[0.0, -c[2], c[1]], [c[2], 0.0, -c[0]], [-c[1], c[0], 0.0]];
    let (mut r, mut j) = ([[0.0; 3]; 3], [[0.0; 3]; 3]);
    for i in 0..3 {
        for l in 0..3 {
            let one = f64::from(u8::from(i == l));
            let of_square = c[i] * c[l] - one * square;
            r[i][l] = one + a * hat[i][l] + b * of_square;
            j[i][l] = one - b * hat[i][l] + k * of_square;
        }
    }
    let p: [f64; 3] =
        std::array::from_fn(|i| r[i][0] * x[0] + r[i][1] * x[1] + r[i][2] * x[2] + c[3 + i]);
    let inverse = -1.0 / p[2];
    let (u, v) = (p[0] * inverse, p[1] * inverse);
    let n = u * u + v * v;
    let (f, k1, k2) = (c[6], c[7], c[8]);
    let d = 1.0 + n * (k1 + k2 * n);
    if let Some(jacobian) = jacobian {
        let bend = 2.0 * (k1 + 2.0 * k2 * n);
        let (uu, uv, vv) = (
            f * (d + bend * u * u),
            f * bend * u * v,
            f * (d + bend * v * v),
        );
        let by_p = [
            [uu * inverse, uv * inverse, (uu * u + uv * v) * inverse],
            [uv * inverse, vv * inverse, (uv * u + vv * v) * inverse],
        ];
        for ((out, row), own) in jacobian.iter_mut().zip(&by_p).zip([u, v]) {
            let b: [f64; 3] =
                std::array::from_fn(|k| row[0] * r[0][k] + row[1] * r[1][k] + row[2] * r[2][k]);
            let across = [
                b[2] * x[1] - b[1] * x[2],
                b[0] * x[2] - b[2] * x[0],
                b[1] * x[0] - b[0] * x[1],
            ];
            for k in 0..3 {
                out[k] = across[0] * j[0][k] + across[1] * j[1][k] + across[2] * j[2][k];
            }
            out[3..6].copy_from_slice(row);
            out[6..9].copy_from_slice(&[d * own, f * n * own, f * n * n * own]);
            out[9..].copy_from_slice(&b);
        }
    }
    [f * d * u - seen[0], f * d * v - seen[1]]
}
