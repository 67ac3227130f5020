//! Uncertainty of the scale factors by that of gravity.

use findings::{Finding, Kind, significant};
use sensor::{PLACES, Sensor, base_names};

use super::Calibration;
use crate::gravity::GravitySource;

impl Calibration {
    /// Writes down where gravity comes from, and adds what that leaves unknown to standard errors and covariance.
    ///
    /// `‖T (A − b)‖ = g` makes `T` proportional to `g`: with a standard deviation `σ` of `g`, the covariance of the
    /// elements of `T` grows by `(σ/g)² T Tᵀ` (`T` as a vector). The biases do not depend on `g`.
    pub fn carry_gravity(&mut self, source: GravitySource) {
        self.gravity_source = source;
        let relative = source.std() / self.gravity;
        let Some(triad) = self.accelerometer.as_mut().filter(|_| relative > 0.0) else {
            return;
        };
        let names = base_names(Sensor::Accelerometer);
        let mut moved = vec![0.0; self.parameters.len()];
        for (name, (i, j)) in names.iter().zip(PLACES) {
            let Some(std) = &mut triad.t_std[i][j] else {
                continue;
            };
            let change = relative * triad.t[i][j];
            *std = std.hypot(change);
            if let Some(place) = self.parameters.iter().position(|own| own == name) {
                moved[place] = change;
            }
        }
        for (row, a) in self.covariance.iter_mut().zip(&moved) {
            for (entry, b) in row.iter_mut().zip(&moved) {
                *entry += a * b;
            }
        }
        self.warnings.extend(assumed(source, self.gravity));
    }
}

/// Builds the finding about an assumed gravity or altitude; `None` where both are known.
fn assumed(source: GravitySource, gravity: f64) -> Option<Finding> {
    let kind = match source {
        GravitySource::Given
        | GravitySource::Place {
            altitude: Some(_), ..
        } => return None,
        GravitySource::Place { .. } => Kind::ALTITUDE_ASSUMED,
        GravitySource::Assumed => Kind::GRAVITY_ASSUMED,
    };
    let found = Finding::of(kind)
        .of_sensor(Sensor::Accelerometer)
        .detail("gravity", format!("{} m/s²", significant(gravity, 6)))
        .number("local_gravity", gravity, "m/s^2")
        .number("share", source.std() / gravity, "share")
        .affects("corrected_reading", source.std(), "m/s^2");
    Some(match source {
        GravitySource::Place { latitude, .. } => found.number("latitude", latitude, "°"),
        _ => found,
    })
}

#[cfg(test)]
pub(super) mod tests {
    use crate::calibration::Calibration;
    use crate::gravity::{GravitySource, STANDARD_GRAVITY};
    use crate::methods::six_position::{Face, Placement, Six, SixPosition};

    /// The calibration of a perfect accelerometer.
    pub(in crate::calibration) fn perfect() -> Calibration {
        let placement = |face: &Face| Placement {
            label: face.name().into(),
            accelerometer: face.direction() * STANDARD_GRAVITY,
            gyroscope: None,
        };
        let six = Six::sort(Face::ALL.iter().map(placement).collect(), STANDARD_GRAVITY).unwrap();
        let solution = SixPosition::solve(&six, STANDARD_GRAVITY);
        solution.calibration(false).unwrap()
    }

    #[test]
    fn an_unknown_gravity_is_a_common_error_of_the_scale_factors_and_said_once() {
        let (known, mut unknown) = (perfect(), perfect());
        unknown.carry_gravity(GravitySource::Assumed);
        let scale = |c: &Calibration, k: usize| c.covariance[k][k];
        let relative = GravitySource::Assumed.std() / STANDARD_GRAVITY;
        for k in 0..3 {
            let grown = scale(&unknown, k) - scale(&known, k);
            assert!((grown / relative.powi(2) - 1.0).abs() < 1e-9, "{grown}");
        }
        // A common factor: the scale factors' errors are fully correlated by it, biases stay.
        let across = unknown.covariance[0][1] - known.covariance[0][1];
        assert!((across / relative.powi(2) - 1.0).abs() < 1e-9);
        assert_eq!(scale(&unknown, 9), scale(&known, 9));
        assert_eq!(unknown.warnings.len(), known.warnings.len() + 1);
        let mut given = perfect();
        given.carry_gravity(GravitySource::Given);
        assert_eq!(given, known);
    }
}
