//! Quantities that an effect depends on, determined by trial.

use nalgebra::Vector3;

use crate::attitude::Attitude;
use crate::effect::any_effect::AnyEffect;
use crate::kinematics::{Kinematics, Since};
use crate::quantity::Quantity;

/// Returns the quantities that change the error of `effect` at some of the trial instants and parameters.
///
/// They are the needs of an effect that does not declare them, and the reference to test a declaration.
pub fn observed_needs(effect: &dyn AnyEffect) -> Vec<Quantity> {
    let depends = |quantity: &Quantity| {
        trials(effect).any(|(truth, p)| {
            [0.3, 1.0, -1.0].into_iter().any(|size| {
                let other = quantity.changed(&truth, size);
                effect.error_f64(&truth, &p) != effect.error_f64(&other, &p)
            })
        })
    };
    Quantity::ALL.into_iter().filter(depends).collect()
}

/// The parameters, by their place, that show in no static interval, each with the quantities that it waits for.
///
/// Only static intervals say something of an accelerometer: such a parameter of one cannot be estimated.
pub fn silent_at_rest(effect: &dyn AnyEffect) -> Vec<(usize, Vec<Quantity>)> {
    let moving = Quantity::ALL
        .into_iter()
        .filter(|q| q.vanishes_at_rest())
        .collect::<Vec<_>>();
    let still = |truth: &Kinematics<f64>| moving.iter().fold(*truth, |t, q| q.at_rest(&t));
    let shows = |k: usize, at: &dyn Fn(&Kinematics<f64>) -> Kinematics<f64>| {
        trials(effect).any(|(truth, p)| {
            let mut without = p.clone();
            without[k] = effect.params()[k].nominal;
            let truth = at(&truth);
            without[k] != p[k] && effect.error_f64(&truth, &p) != effect.error_f64(&truth, &without)
        })
    };
    (0..effect.params().len())
        .filter(|&k| shows(k, &|truth| *truth) && !shows(k, &still))
        .map(|k| {
            let all = effect.needs().into_iter();
            (k, all.filter(|q| q.vanishes_at_rest()).collect())
        })
        .collect()
}

/// Instants and parameters that an effect is tried at.
pub(super) fn trials(
    effect: &dyn AnyEffect,
) -> impl Iterator<Item = (Kinematics<f64>, Vec<f64>)> + '_ {
    (0..4).flat_map(move |k| {
        [1.0, -0.7].into_iter().map(move |size| {
            let value = |(k, p): (usize, &crate::Param)| match p.nominal {
                0.0 => size * effect.typical_of(k),
                nominal => nominal * (1.0 + 0.3 * size),
            };
            let p = effect.params().iter().enumerate().map(value).collect();
            (instant(k), p)
        })
    })
}

/// Brisk motion in one direction and another, early and late, warm and cold.
fn instant(k: u8) -> Kinematics<f64> {
    let sign = if k.is_multiple_of(2) { 1.0 } else { -1.0 };
    let part = 1.0 + 0.2 * f64::from(k);
    Kinematics {
        time: 45.0 + 31.0 * f64::from(k),
        temperature: 31.0 - 7.0 * f64::from(k),
        angular_acceleration: Vector3::new(5.0, -7.0, 3.0) * (sign * part),
        specific_force_rate: Vector3::new(-20.0, 30.0, 10.0) * (sign * part),
        last_change: Vector3::new(1.0, -1.0, 1.0) * sign,
        vibration: Vector3::new(0.1, 0.2, 0.3) * part,
        temperature_rate: 0.02 * sign * part,
        warming: sign,
        last_turn: Vector3::new(1.2, -0.8, 0.6) * (sign * part),
        since_turn: Since {
            from: 0.3 * part,
            to: 4.0 * part,
        },
        attitude: Attitude::exp(&(Vector3::new(0.3, -0.5, 0.7) * (sign * part))),
        magnetic_field: Vector3::new(20.0, -30.0, 25.0) * (sign * part),
        ..Kinematics::new(
            Vector3::new(6.0, -5.0, 4.0) * (sign * part),
            Vector3::new(-1.0, 2.0, 3.0) * (sign * part),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{DefinedParam, Definition, Sensor};

    #[test]
    fn a_definition_needs_what_its_expressions_name_and_no_more() {
        let effect = Definition {
            name: "accel_lag_and_swirl".into(),
            x: "k * alphay + c * fy".into(),
            y: "c * step(t - 50) * changez".into(),
            parameters: vec![
                DefinedParam::new("k", "m", 1e-3),
                DefinedParam::new("c", "", 1e-3),
            ],
            ..Definition::silent(Sensor::Accelerometer)
        }
        .effect()
        .unwrap();
        let needs = [
            Quantity::SpecificForce,
            Quantity::Time,
            Quantity::AngularAcceleration,
            Quantity::LastChange,
        ];
        assert_eq!(effect.needs(), needs);
        assert_eq!(observed_needs(&*effect), needs);
        let silent = silent_at_rest(&*effect);
        assert_eq!(silent, [(0, vec![Quantity::AngularAcceleration])]);
    }
}
