//! What every effect of the catalogue must hold to.

use std::collections::HashSet;

use nalgebra::Vector3;
use sensor::attitude::Attitude;
use sensor::{BASE_PARAMETERS, EffectRef, Kinematics, Model, Sensor, Since};
use solver::scalar::{along, derivatives, second_derivative, variable};
use solver::{Jet, Jet2, LANES, lit};

/// The names that users script against.
const PROMISED: [(Sensor, &[&str]); 3] = [
    (
        Sensor::Accelerometer,
        &[
            "accel_quadratic",
            "accel_cubic",
            "accel_asymmetry",
            "accel_cross_axis",
            "accel_drift",
            "accel_warmup",
            "accel_temperature",
            "accel_temperature_quadratic",
            "accel_scale_drift",
            "accel_scale_temperature",
            "accel_step",
            "accel_hysteresis",
            "accel_vibration_rectification",
            "accel_misalignment_temperature",
            "accel_periodic",
            "accel_relaxation",
            "accel_room_field",
            "accel_temperature_rate",
            "accel_thermal_hysteresis",
            "time_offset",
        ],
    ),
    (
        Sensor::Gyroscope,
        &[
            "gyro_g_sensitivity",
            "gyro_g2_sensitivity",
            "gyro_drift",
            "gyro_warmup",
            "gyro_temperature",
            "gyro_scale_drift",
            "gyro_scale_temperature",
            "gyro_step",
            "gyro_quadratic",
            "gyro_cubic",
            "gyro_asymmetry",
            "gyro_delay",
            "gyro_low_pass",
            "gyro_misalignment_temperature",
            "gyro_relaxation",
            "gyro_room_field",
            "gyro_temperature_quadratic",
            "gyro_temperature_rate",
            "gyro_thermal_hysteresis",
            "gyro_vibration_rectification",
            "earth_rate",
        ],
    ),
    (
        Sensor::Magnetometer,
        &[
            "mag_temperature",
            "mag_scale_temperature",
            "mag_g_sensitivity",
            "mag_drift",
            "mag_quadratic",
            "mag_cubic",
        ],
    ),
];

fn catalogue() -> Vec<EffectRef> {
    calib::effects::catalogue().collect()
}

/// Numbers in (−1, 1) that look random and keep 0.01 away from 0, where some effects have kinks.
fn numbers(seed: usize) -> impl FnMut() -> f64 {
    let mut state = 0.37 + seed as f64 * 0.754_877_666;
    move || {
        state = (state + 0.618_033_988_749_895) % 1.0;
        let v = 2.0 * state - 1.0;
        0.99 * v + 0.01 * v.signum()
    }
}

/// An instant of brisk motion: up to 2 g and 10 rad/s, 20 K from the reference, minutes in.
fn instant(seed: usize) -> Kinematics<f64> {
    let mut next = numbers(seed);
    let mut vector = |size: f64| Vector3::from_fn(|_, _| size * next());
    Kinematics {
        time: 50.0 + 40.0 * seed as f64,
        temperature: 5.0 + 11.0 * seed as f64,
        angular_acceleration: vector(30.0),
        specific_force_rate: vector(50.0),
        last_change: vector(1.0).map(f64::signum),
        vibration: vector(0.5).map(|v| v * v),
        temperature_rate: vector(0.05).x,
        warming: vector(1.0).x.signum(),
        last_turn: vector(1.5),
        since_turn: Since::at(0.7 + seed as f64),
        attitude: Attitude::exp(&vector(1.5)),
        magnetic_field: vector(60.0),
        ..Kinematics::new(vector(19.6), vector(10.0))
    }
}

/// Coefficients of `size` typical sizes; time constants and instants as they are nominally.
fn coefficients(effect: &EffectRef, size: f64, seed: usize) -> Vec<f64> {
    let mut next = numbers(seed + 17);
    let value = |(k, p): (usize, &sensor::Param)| match p.nominal {
        0.0 => size * effect.typical_of(k) * next(),
        nominal => nominal,
    };
    effect.params().iter().enumerate().map(value).collect()
}

#[test]
fn an_effect_declares_all_that_it_looks_at_and_nothing_else() {
    for effect in catalogue() {
        let observed = sensor::observed_needs(&*effect);
        assert_eq!(effect.needs(), observed, "{}", effect.name());
    }
}

#[test]
fn every_promised_name_is_there_with_its_sensor() {
    for (sensor, promised) in PROMISED {
        let own = catalogue().into_iter().filter(|e| e.sensor() == sensor);
        let names: HashSet<String> = own.map(|e| e.name().to_owned()).collect();
        let missing: Vec<_> = promised.iter().filter(|n| !names.contains(**n)).collect();
        assert!(missing.is_empty(), "{missing:?}");
    }
}

#[test]
fn names_are_unique_and_in_snake_case() {
    let effects = catalogue();
    let names: HashSet<_> = effects.iter().map(|e| e.name()).collect();
    assert_eq!(names.len(), effects.len());
    let is_snake = |name: &str| {
        name.chars()
            .all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_')
            && !name.starts_with('_')
            && !name.ends_with('_')
            && !name.contains("__")
    };
    for effect in effects {
        let params: HashSet<_> = effect.params().iter().map(|p| &*p.name).collect();
        assert_eq!(params.len(), effect.params().len(), "{}", effect.name());
        assert!(is_snake(effect.name()) && params.iter().all(|p| is_snake(p)));
        assert!(!effect.equation().is_empty());
    }
}

#[test]
fn every_effect_is_silent_at_its_nominal_parameters() {
    for effect in catalogue() {
        let nominal: Vec<f64> = effect.params().iter().map(|p| p.nominal).collect();
        for seed in 0..5 {
            let error = effect.error_f64(&instant(seed), &nominal);
            assert_eq!(error, Vector3::zeros(), "{}", effect.name());
        }
    }
}

#[test]
fn no_effect_is_silent_at_its_typical_size() {
    for effect in catalogue() {
        let error = effect.error_f64(&instant(3), &coefficients(&effect, 1.0, 0));
        assert!(error.norm() > 1e-6, "{}", effect.name());
    }
}

/// The arguments of an effect as one list: parameters, specific force, angular rate.
fn arguments(effect: &EffectRef, truth: &Kinematics<f64>, size: f64, seed: usize) -> Vec<f64> {
    let mut x = coefficients(effect, size, seed);
    x.extend(truth.specific_force.iter().chain(&truth.angular_rate));
    x
}

fn split<D: solver::Scalar>(n: usize, truth: &Kinematics<f64>, x: &[D]) -> Kinematics<D> {
    let mut lifted = truth.cast();
    lifted.specific_force = Vector3::from_column_slice(&x[n..n + 3]);
    lifted.angular_rate = Vector3::from_column_slice(&x[n + 3..n + 6]);
    lifted
}

#[test]
fn derivatives_are_those_of_central_differences() {
    for effect in catalogue() {
        let n = effect.params().len();
        for seed in 0..5 {
            let truth = instant(seed);
            let x = arguments(&effect, &truth, 1.0, seed);
            let value = |x: &[f64]| effect.error_f64(&split(n, &truth, x), &x[..n]);
            for k in 0..x.len() {
                let mut jets: Vec<Jet> = x.iter().map(|&v| lit(v)).collect();
                jets[k] = variable(x[k], k % LANES);
                let error = effect.error_jet(&split(n, &truth, &jets), &jets[..n]);
                // Truncation is of the order of h² = 1e-12 relative, in a sine of 30 rad of 5e-9; rounding of 1e-16/1e-6.
                let h = 1e-6 * x[k].abs();
                let (mut up, mut down) = (x.clone(), x.clone());
                up[k] += h;
                down[k] -= h;
                let slope = (value(&up) - value(&down)) / (up[k] - down[k]);
                let scale = slope.amax().max(value(&x).amax() / x[k].abs());
                for i in 0..3 {
                    let exact = derivatives(&error[i])[k % LANES];
                    let off = (exact - slope[i]).abs();
                    assert!(off <= 1e-8 * scale, "{} {k} {i}: {off}", effect.name());
                }
                assert_eq!(error.map(|e| e.re), value(&x));
            }
        }
    }
}

#[test]
fn second_derivatives_are_those_of_the_first() {
    for effect in catalogue() {
        let n = effect.params().len();
        for seed in 0..5 {
            let truth = instant(seed);
            let x = arguments(&effect, &truth, 1.0, seed);
            let mut next = numbers(seed + 5);
            let direction: Vec<f64> = x.iter().map(|v| v * next()).collect();
            let at = |t: f64| -> Vector3<Jet2> {
                let jets: Vec<Jet2> = x
                    .iter()
                    .zip(&direction)
                    .map(|(&x, &d)| along(x + t * d, d))
                    .collect();
                effect.error_jet2(&split(n, &truth, &jets), &jets[..n])
            };
            let h = 1e-6;
            let (here, up, down) = (at(0.0), at(h), at(-h));
            let scale = here
                .map(|e| e.re.abs().max(second_derivative(&e).abs()))
                .amax();
            for i in 0..3 {
                let slope = (up[i].v1 - down[i].v1) / (2.0 * h);
                let off = (second_derivative(&here[i]) - slope).abs();
                assert!(off <= 1e-7 * scale, "{} {i}: {off}", effect.name());
            }
        }
    }
}

/// A sensor with this effect and the errors of a consumer-grade base model.
fn device(effect: &EffectRef, size: f64, seed: usize) -> (Model, Vec<f64>) {
    let model = Model::base(effect.sensor()).with(effect.clone());
    let mut next = numbers(seed + 29);
    let mut p: Vec<f64> = model.parameters().values()[..BASE_PARAMETERS]
        .iter()
        .map(|nominal| nominal + 0.02 * next())
        .collect();
    p.extend(coefficients(effect, size, seed));
    (model, p)
}

#[test]
fn correct_undoes_distort_at_ten_times_the_typical_size() {
    for effect in catalogue() {
        for (size, seed) in [1.0, 10.0]
            .into_iter()
            .flat_map(|s| (0..5).map(move |k| (s, k)))
        {
            let (model, p) = device(&effect, size, seed);
            let truth = instant(seed);
            let raw = model.distort(&truth, &p).unwrap();
            let signal = truth.signal(effect.sensor());
            let unknown = truth.with_signal(effect.sensor(), Vector3::zeros());
            let corrected = model.correct(&raw, &unknown, &p);
            let off = (corrected - signal).norm() / signal.norm();
            // A few roundings of a number of size 1.
            assert!(off < 2e-15, "{} at {size}: {off}", effect.name());
        }
    }
}

#[test]
fn all_effects_of_a_sensor_at_once_can_be_undone() {
    for sensor in Sensor::ALL {
        let own: Vec<_> = catalogue()
            .into_iter()
            .filter(|e| e.sensor() == sensor)
            .collect();
        let model = own.iter().fold(Model::base(sensor), |model, effect| {
            model.with(effect.clone())
        });
        let mut p = model.parameters().values()[..BASE_PARAMETERS].to_vec();
        own.iter()
            .enumerate()
            .for_each(|(k, effect)| p.extend(coefficients(effect, 3.0, k)));
        let truth = instant(2);
        let raw = model.distort(&truth, &p).unwrap();
        let corrected = model.correct(&raw, &truth.with_signal(sensor, Vector3::zeros()), &p);
        assert!((corrected - truth.signal(sensor)).norm() < 1e-14);
    }
}

#[test]
fn the_derivatives_of_a_corrected_reading_are_right() {
    for effect in catalogue() {
        let (model, p) = device(&effect, 10.0, 1);
        let truth = instant(1);
        let raw = model.distort(&truth, &p).unwrap();
        let correct = |p: &[f64]| model.correct(&raw, &truth, p);
        for k in 0..p.len() {
            let mut jets: Vec<Jet> = p.iter().map(|&v| lit(v)).collect();
            jets[k] = variable(p[k], 0);
            let corrected = model.correct(&raw.map(lit), &truth.cast(), &jets);
            let h = 1e-5 * p[k].abs().max(1e-2 * effect.typical());
            let (mut up, mut down) = (p.clone(), p.clone());
            up[k] += h;
            down[k] -= h;
            let slope = (correct(&up) - correct(&down)) / (up[k] - down[k]);
            for i in 0..3 {
                let exact = derivatives(&corrected[i])[0];
                // Rounding of the difference: 1e-15 of the signal over h.
                let allowed = 1e-7 * exact.abs() + 1e-14 * truth.signal(effect.sensor()).amax() / h;
                assert!(
                    (exact - slope[i]).abs() <= allowed,
                    "{} {k} {i}",
                    effect.name()
                );
            }
        }
    }
}

#[test]
fn the_second_derivative_of_a_corrected_reading_is_right() {
    for effect in catalogue() {
        let (model, p) = device(&effect, 10.0, 2);
        let truth = instant(2);
        let raw = model.distort(&truth, &p).unwrap();
        let mut next = numbers(3);
        let direction: Vec<f64> = p.iter().map(|v| v * next()).collect();
        let at = |t: f64| {
            let jets: Vec<Jet2> = p
                .iter()
                .zip(&direction)
                .map(|(&x, &d)| along(x + t * d, d))
                .collect();
            model.correct(&raw.map(lit), &truth.cast(), &jets)
        };
        let h = 1e-5;
        let (here, up, down) = (at(0.0), at(h), at(-h));
        for i in 0..3 {
            let slope = (up[i].v1 - down[i].v1) / (2.0 * h);
            let off = (second_derivative(&here[i]) - slope).abs();
            assert!(
                off <= 1e-7 * here.map(|e| e.re).amax(),
                "{} {i}: {off}",
                effect.name()
            );
        }
    }
}

#[test]
fn an_effect_that_calls_itself_linear_is_and_does_not_see_its_own_signal() {
    let linear = catalogue().into_iter().filter(|effect| effect.is_linear());
    let mut tried = 0;
    for (effect, seed) in linear.flat_map(|effect| (0..4).map(move |seed| (effect.clone(), seed))) {
        let truth = instant(seed);
        let other_signal = truth.with_signal(effect.sensor(), Vector3::new(0.3, -2.0, 5.0));
        let (p, q) = (
            coefficients(&effect, 1.0, seed),
            coefficients(&effect, 3.0, seed + 40),
        );
        let sum: Vec<f64> = p.iter().zip(&q).map(|(p, q)| 2.0 * p + q).collect();
        let parts = effect.error_f64(&truth, &p) * 2.0 + effect.error_f64(&truth, &q);
        let error = effect.error_f64(&truth, &sum) - parts;
        assert!(error.norm() <= 1e-14 * parts.norm(), "{}", effect.name());
        assert_eq!(
            effect.error_f64(&truth, &p),
            effect.error_f64(&other_signal, &p),
            "{}",
            effect.name()
        );
        tried += 1;
    }
    assert!(tried > 40);
}
