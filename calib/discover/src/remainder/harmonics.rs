//! A fine pattern over orientation: spherical harmonics of the direction of specific force.

use estimate::methods::joint::Instant;
use nalgebra::Vector3;
use sensor::Sensor;

use super::shape::Way;

/// Every harmonic on every axis, or along gravity.
pub(super) fn fine_orientation<'a>(sensor: Sensor) -> Vec<Way<'a>> {
    match sensor {
        // Only what is along gravity is seen well at rest: the norm.
        Sensor::Accelerometer => vec![(
            16,
            Box::new(|i: &Instant<'_>, out: &mut Vec<Vector3<f64>>| {
                let u = i.truth.specific_force.normalize();
                let values = harmonics(&u);
                out.extend(values.iter().map(|y| u * *y));
            }),
            None,
        )],
        Sensor::Gyroscope | Sensor::Magnetometer => (0..3)
            .map(|axis| -> Way<'a> {
                (
                    16,
                    Box::new(move |i: &Instant<'_>, out: &mut Vec<Vector3<f64>>| {
                        let u = i.truth.specific_force.normalize();
                        out.extend(harmonics(&u).iter().map(|y| {
                            let mut e = Vector3::zeros();
                            e[axis] = *y;
                            e
                        }));
                    }),
                    None,
                )
            })
            .collect(),
    }
}

/// The real spherical harmonics of degree 3 (seven) and 4 (nine), not normalised.
fn harmonics(u: &Vector3<f64>) -> [f64; 16] {
    let (x, y, z) = (u.x, u.y, u.z);
    let (xx, yy, zz) = (x * x, y * y, z * z);
    [
        y * (3.0 * xx - yy),
        2.0 * x * y * z * 3.0,
        y * (5.0 * zz - 1.0),
        z * (5.0 * zz - 3.0),
        x * (5.0 * zz - 1.0),
        3.0 * (xx - yy) * z,
        x * (xx - 3.0 * yy),
        4.0 * x * y * (xx - yy),
        3.0 * y * (3.0 * xx - yy) * z,
        2.0 * x * y * (7.0 * zz - 1.0),
        y * z * (7.0 * zz - 3.0),
        35.0 / 8.0 * zz * zz - 30.0 / 8.0 * zz + 3.0 / 8.0,
        x * z * (7.0 * zz - 3.0),
        (xx - yy) * (7.0 * zz - 1.0),
        3.0 * x * (xx - 3.0 * yy) * z,
        xx * (xx - 3.0 * yy) - yy * (3.0 * xx - yy),
    ]
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    #[test]
    fn the_harmonics_of_two_degrees_are_orthogonal_to_lower_ones() {
        // Means over a fine grid of the sphere, by latitude (weighted) and longitude.
        let (mut with_constant, mut with_linear) = ([0.0; 16], [0.0; 16]);
        for a in 0..200 {
            let z = -1.0 + (f64::from(a) + 0.5) / 100.0;
            for b in 0..60 {
                let phi = PI * f64::from(b) / 30.0;
                let r = (1.0 - z * z).sqrt();
                let u = Vector3::new(r * phi.cos(), r * phi.sin(), z);
                for (k, y) in harmonics(&u).iter().enumerate() {
                    with_constant[k] += y / 12_000.0;
                    with_linear[k] += y * (u.x + u.y + u.z) / 12_000.0;
                }
            }
        }
        for k in 0..16 {
            // The grid of 200 latitudes is good to 1e-4.
            assert!(with_constant[k].abs() < 1e-3, "{k}");
            assert!(with_linear[k].abs() < 1e-3, "{k}");
        }
    }
}
