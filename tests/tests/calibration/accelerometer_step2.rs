//! The second step of the stepwise accelerometer calibration, whose Jacobian has rank 6 of 9.

use solver::{Mask, Options, Parameters, Residual, Scalar, Variant, lit, solve};

/// `‖T (A − b)‖ − g` for the nine elements of `T`, row by row.
struct GravityNorm {
    means: Vec<[f64; 3]>,
    bias: [f64; 3],
    gravity: f64,
}

impl<D: Scalar> Residual<D> for GravityNorm {
    fn residuals(&self, t: &[D], out: &mut Vec<D>) {
        for mean in &self.means {
            let mut square = lit::<D>(0.0);
            for row in t.chunks(3) {
                let f = (0..3).fold(lit::<D>(0.0), |sum, k| {
                    sum + row[k] * (mean[k] - self.bias[k])
                });
                square += f * f;
            }
            out.push(square.sqrt() - lit::<D>(self.gravity));
        }
    }
}

/// Means `T⁻¹ g u + b` for an upper triangular `T` and directions `u` on a spiral over the sphere.
fn simulated(t: [[f64; 3]; 3], bias: [f64; 3], gravity: f64) -> Vec<[f64; 3]> {
    (0..23)
        .map(|i| {
            let z = 1.0 - (2.0 * i as f64 + 1.0) / 23.0;
            let (angle, radius) = (2.4 * i as f64, (1.0 - z * z).sqrt());
            let f = [
                gravity * radius * angle.cos(),
                gravity * radius * angle.sin(),
                gravity * z,
            ];
            let c = f[2] / t[2][2];
            let b = (f[1] - t[1][2] * c) / t[1][1];
            let a = (f[0] - t[0][1] * b - t[0][2] * c) / t[0][0];
            [a + bias[0], b + bias[1], c + bias[2]]
        })
        .collect()
}

/// Square root of a symmetric positive definite matrix by the Newton iteration of Denman and Beavers.
fn square_root(m: nalgebra::Matrix3<f64>) -> nalgebra::Matrix3<f64> {
    let (mut y, mut z) = (m, nalgebra::Matrix3::identity());
    for _ in 0..30 {
        let (yi, zi) = (y.try_inverse().unwrap(), z.try_inverse().unwrap());
        (y, z) = (0.5 * (y + zi), 0.5 * (z + yi));
    }
    y
}

#[test]
fn minimum_norm_steps_find_the_symmetric_polar_factor_in_a_few_iterations() {
    let t = [
        [0.9997, 2.8e-4, 3.1e-4],
        [0.0, 0.9998, 2.0e-4],
        [0.0, 0.0, 0.9983],
    ];
    let (bias, gravity) = ([0.040, 0.004, -0.019], 9.79);
    let problem = GravityNorm {
        means: simulated(t, bias, gravity),
        bias,
        gravity,
    };
    let start = Parameters::unnamed(&[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
    let options = Options {
        variant: Variant::GaussNewtonMinimumNorm,
        ..Options::default()
    };
    let report = solve(&problem, &start, &Mask::all(9), &options).unwrap();
    assert!(report.termination.converged(), "{:?}", report.termination);
    assert_eq!(report.uncertainty.rank, 6);
    assert!(
        report.jacobian_evaluations <= 6,
        "{}",
        report.jacobian_evaluations
    );
    let upper = nalgebra::Matrix3::from_fn(|i, k| t[i][k]);
    let symmetric = square_root(upper.transpose() * upper);
    for i in 0..3 {
        for k in 0..3 {
            // Two elements off the diagonal move as squares of 3e-4 between the two frames.
            let x = report.parameters.values()[3 * i + k];
            assert!(
                (x - symmetric[(i, k)]).abs() < 1e-7,
                "{x} {}",
                symmetric[(i, k)]
            );
        }
    }
}
