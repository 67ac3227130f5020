//! The attitude for the eye: rates summed, pulled towards gravity.

use nalgebra::{UnitQuaternion, Vector3};

findings::tuning! {
    /// Time after which gravity has pulled the attitude to itself, s.
    PULL: f64 = 1.0;
    /// Specific force within this share of gravity counts as gravity.
    NEAR_GRAVITY: f64 = 0.1;
    /// Steps longer than this begin anew, s.
    LOST: f64 = 0.5;
}

/// Rotation from the device to the room, z up; its heading is free.
#[derive(Clone, Copy, Debug)]
pub struct Attitude {
    to_room: UnitQuaternion<f64>,
    t: Option<f64>,
}

impl Default for Attitude {
    fn default() -> Self {
        Self {
            to_room: UnitQuaternion::identity(),
            t: None,
        }
    }
}

impl Attitude {
    /// Goes on to time `t`, s, with the rate `rate`, rad/s, and the specific force `force` in units of gravity.
    pub fn advance(&mut self, t: f64, rate: &Vector3<f64>, force: &Vector3<f64>) {
        let step = self.t.replace(t).map_or(f64::INFINITY, |before| t - before);
        let is_lost = !(0.0..LOST.get()).contains(&step);
        if !is_lost {
            self.to_room *= UnitQuaternion::from_scaled_axis(rate * step);
        }
        let norm = force.norm();
        if (norm - 1.0).abs() > NEAR_GRAVITY.get() {
            return;
        }
        let up = self.to_room * (force / norm);
        let share = if is_lost {
            1.0
        } else {
            (step / PULL.get()).min(1.0)
        };
        if let Some(tilt) = UnitQuaternion::rotation_between(&up, &Vector3::z()) {
            self.to_room =
                UnitQuaternion::from_scaled_axis(tilt.scaled_axis() * share) * self.to_room;
        }
    }

    /// The rotation from the device to the room as w, x, y, z.
    pub fn quaternion(&self) -> [f64; 4] {
        let q = self.to_room;
        [q.w, q.i, q.j, q.k]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quarter_turn_is_followed_and_a_wrong_bias_does_not_pile_up() {
        let mut attitude = Attitude::default();
        let bias = Vector3::new(0.0, 0.02, 0.0);
        let about_x = |k: i32| 0.01 * f64::from(k.clamp(0, 100)) * std::f64::consts::FRAC_PI_2;
        for k in 0..2000 {
            let angle = about_x(k);
            let rate = Vector3::new((about_x(k + 1) - angle) / 0.01, 0.0, 0.0) + bias;
            // What points up in the room, seen from the device.
            let force = Vector3::new(0.0, angle.sin(), angle.cos());
            attitude.advance(0.01 * f64::from(k), &rate, &force);
        }
        let up = attitude.to_room * Vector3::y();
        assert!(up.z > 0.999, "{up}");
    }
}
