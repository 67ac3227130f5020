//! Biases estimated again on a recording, scale factors and misalignments kept.

use findings::{Finding, Kind};
use nalgebra::{Matrix3, Vector3};
use recording::intervals::{Segmentation, Span};
use recording::readings::error_of_steps;
use recording::{Error, Recording};
use sensor::{Sensor, inverse, is_bias};
use solver::{Options, Uncertainty, solve};

use super::{bias_errors, earth, static_means_by};
use crate::calibration::{BiasUpdate, Calibration, apply_with};
use crate::residuals::GravityNorm;
use crate::truth::{Models, Truth};

/// A rest must be longer than this to say anything new of a gyroscope's bias (Liu et al. 2021,
/// section 4.2), s.
pub const LONG_ENOUGH: f64 = 20.0;

findings::tuning! {
    /// Fewest rests for an accelerometer's bias: one more than its three numbers.
    FEWEST_RESTS: usize = 4;

    /// Orientations whose bias is worse conditioned than this do not tell the axes apart.
    WORST_CONDITION: f64 = 30.0;
}

/// The gyroscope's bias seen in one rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// The rest.
    pub span: Span,
    /// Mean of the corrected rate, rad/s, without what is known of the earth's rotation: what the bias has changed by.
    pub residual: Vector3<f64>,
    /// Its standard error, rad/s: by means over seconds, and by those over longer parts where these differ by more.
    pub std: Vector3<f64>,
    /// Error of the mean by the rotation of the earth, rad/s, whose horizontal part points nobody knows where.
    pub by_earth: Vector3<f64>,
    /// Error of the mean by steps of the readings that are wider than the noise, rad/s, however long the rest is.
    pub by_steps: Vector3<f64>,
    /// By how much the rate drifts from the beginning of the rest to its end, rad/s; zero where it does no more than noise.
    pub drift: Vector3<f64>,
}

/// The rests longer than [`LONG_ENOUGH`] and the corrected gyroscope's mean in each.
///
/// # Errors
/// A recording without gyroscope, a calibration without one, and no rest that is long enough.
pub fn gyroscope_stretches(
    calibration: &Calibration,
    recording: &Recording,
    segmentation: &Segmentation,
) -> Result<Vec<Stretch>, Error> {
    // What is left is that of the bias which is updated.
    let corrected = apply_with(&calibration.with_one_bias(), recording, Some(segmentation))?;
    let (Some(stream), Some(_)) = (&corrected.gyroscope, &calibration.gyroscope) else {
        let kind = match calibration.gyroscope {
            Some(_) => Kind::SENSOR_NOT_RECORDED,
            None => Kind::SENSOR_NOT_IN_CALIBRATION,
        };
        let found = Finding::of(kind).in_recording(&recording.name);
        return Err(Error::not_enough(found.of_sensor(Sensor::Gyroscope)));
    };
    let by_steps = calibration
        .triad(Sensor::Gyroscope)
        .map_or(Vector3::zeros(), |triad| {
            triad.base().t.abs() * error_of_steps(Sensor::Gyroscope, recording, segmentation)
        });
    let options = calibration.provenance.options.as_ref();
    let latitude = options.and_then(|options| options.latitude);
    let long = |span: &Span| span.length() > LONG_ENOUGH;
    let stretches: Vec<Stretch> = segmentation
        .statics
        .iter()
        .map(|rest| rest.span)
        .filter(long)
        .filter_map(|span| {
            let samples = stream.between(span.from, span.to);
            let mean = Mean::of(&stream.values[samples], span.length() as usize)?;
            let up = corrected.accelerometer.as_ref().and_then(|force| {
                let force = force.values[force.between(span.from, span.to)].iter();
                force.sum::<Vector3<f64>>().try_normalize(0.0)
            });
            let earth = earth::at_rest(latitude, up);
            Some(Stretch {
                span,
                residual: mean.value - earth.known,
                std: mean.std,
                by_earth: earth.std,
                by_steps,
                drift: mean.drift,
            })
        })
        .collect();
    if stretches.is_empty() {
        let longest = segmentation
            .statics
            .iter()
            .map(|r| r.span.length())
            .fold(0.0, f64::max);
        return Err(Error::not_enough(
            Finding::of(Kind::REST_TOO_SHORT)
                .in_recording(&recording.name)
                .of_sensor(Sensor::Gyroscope)
                .number("longest", longest, "s")
                .number("least", LONG_ENOUGH, "s"),
        ));
    }
    Ok(stretches)
}

/// The finding about a bias that moves within a rest; `None` where it does no more than noise.
pub fn drift_at_rest(recording: &str, stretches: &[Stretch]) -> Option<Finding> {
    let most = |stretch: &Stretch| stretch.drift.amax();
    let farthest = stretches
        .iter()
        .max_by(|a, b| most(a).total_cmp(&most(b)))?;
    let change = most(farthest);
    (change > 0.0).then(|| {
        Finding::of(Kind::BIAS_DRIFTS)
            .in_recording(recording)
            .of_sensor(Sensor::Gyroscope)
            .between(farthest.span.from, farthest.span.to)
            .number("change", change, "rad/s")
            .number("time", farthest.span.length(), "s")
            .affects("corrected_reading", 0.5 * change, "rad/s")
    })
}

/// The finding about the earth's rotation in the bias.
pub fn earth_in_bias(recording: &str, stretches: &[Stretch]) -> Option<Finding> {
    let largest = stretches.iter().map(|stretch| stretch.by_earth.amax());
    let error = largest.fold(0.0, f64::max);
    (error > 0.0).then(|| {
        Finding::of(Kind::EARTH_IN_BIAS)
            .in_recording(recording)
            .of_sensor(Sensor::Gyroscope)
            .number("error", error, "rad/s")
    })
}

/// Adds the mean over all stretches, weighted by their length, to the gyroscope's bias.
///
/// # Errors
/// A calibration without gyroscope, or with a matrix without inverse.
pub fn update_gyroscope(
    calibration: &Calibration,
    recording: &str,
    stretches: &[Stretch],
) -> Result<Calibration, Error> {
    let time: f64 = stretches.iter().map(|s| s.span.length()).sum();
    let weighted = |f: fn(&Stretch) -> Vector3<f64>, power: i32| {
        let sum: Vector3<f64> = stretches
            .iter()
            .map(|s| f(s) * (s.span.length() / time).powi(power))
            .sum();
        sum
    };
    let residual = weighted(|s| s.residual, 1);
    let within = weighted(|s| s.std.map(|v| v * v), 2);
    let count = stretches.len() as f64;
    let between: Vector3<f64> = stretches
        .iter()
        .map(|s| (s.residual - residual).map(|d| d * d) / (count * (count - 1.0).max(1.0)))
        .sum();
    // What rounding makes of a bias is the same in every rest, and the earth turns the same way where the device lies as it lay.
    let by_steps = stretches.first().map_or(Vector3::zeros(), |s| s.by_steps);
    let by_earth = weighted(|s| s.by_earth, 1);
    let std = Vector3::from_fn(|k, _| {
        let seen = within[k].max(between[k]).sqrt().max(by_steps[k]);
        seen.hypot(by_earth[k])
    });
    shifted(
        calibration,
        Sensor::Gyroscope,
        recording,
        stretches.len(),
        residual,
        std,
    )
}

/// Fits the accelerometer's bias alone to the norm of gravity over the rests.
///
/// # Errors
/// Fewer than four rests, orientations that do not tell the axes apart, a calibration without
/// accelerometer, and what the solver refuses.
pub fn update_accelerometer(
    calibration: &Calibration,
    recording: &Recording,
    segmentation: &Segmentation,
) -> Result<Calibration, Error> {
    let truth = Truth::of(recording, Some(segmentation), Models::of(calibration))?;
    let means = static_means_by(&truth, segmentation);
    let of = |kind| {
        Finding::of(kind)
            .in_recording(&recording.name)
            .of_sensor(Sensor::Accelerometer)
    };
    let Some((model, p)) = calibration.model(Sensor::Accelerometer) else {
        return Err(Error::not_enough(of(Kind::SENSOR_NOT_IN_CALIBRATION)));
    };
    if means.len() < FEWEST_RESTS.get() {
        return Err(Error::not_enough(
            of(Kind::RESTS_TOO_FEW)
                .count("rests", means.len())
                .count("least", FEWEST_RESTS.get()),
        ));
    }
    let mut start = model.parameters();
    start.values_mut().copy_from_slice(&p);
    let mask = start.free_where(is_bias);
    let problem = GravityNorm {
        model: &model,
        means: &means,
        gravity: calibration.gravity,
    };
    let report = solve(&problem, &start, &mask, &Options::default())?;
    if !report.termination.converged() {
        return Err(Error::not_converged(
            of(Kind::FIT_STOPPED)
                .count("steps", report.iterations.len())
                .detail("ending", format!("{:?}", report.termination)),
        ));
    }
    let condition = condition(&report.uncertainty);
    if condition > WORST_CONDITION.get() {
        return Err(Error::not_enough(of(Kind::RESTS_IN_PLANE).number(
            "condition",
            condition,
            "1",
        )));
    }
    let values = report.parameters.values();
    let change = |k: usize| values[9 + k] - p[9 + k];
    let errors = bias_errors::covariance(&problem, values, start.names(), calibration);
    let std = errors.map_or(Vector3::repeat(f64::NAN), |c| c.diagonal().map(f64::sqrt));
    let t = calibration.triad(Sensor::Accelerometer).map(|t| t.base().t);
    let t = t.unwrap_or_else(Matrix3::identity);
    let residual = t * Vector3::from_fn(|k, _| change(k));
    let std = t.abs() * std;
    shifted(
        calibration,
        Sensor::Accelerometer,
        &recording.name,
        means.len(),
        residual,
        std,
    )
}

/// The calibration with `T⁻¹ residual` added to the bias of a sensor, and a line of history.
fn shifted(
    calibration: &Calibration,
    sensor: Sensor,
    recording: &str,
    rests: usize,
    residual: Vector3<f64>,
    std: Vector3<f64>,
) -> Result<Calibration, Error> {
    let mut updated = calibration.clone();
    let triad = updated.triad_mut(sensor);
    let back = triad.as_ref().and_then(|triad| inverse(&triad.base().t));
    let (Some(triad), Some(back)) = (triad, back) else {
        let found = Finding::of(Kind::MATRIX_SINGULAR).of_sensor(sensor);
        return Err(Error::not_enough(
            found.detail("key", format!("{}.T", sensor.name())),
        ));
    };
    let before = triad.bias;
    let change = back * residual;
    triad.bias = (Vector3::from(before) + change).into();
    triad.bias_std = (back.abs() * std).map(Some).into();
    // It holds from now on, whichever recording it is applied to.
    triad.recordings.clear();
    triad.bias_time = None;
    let (bias, std) = (triad.bias, triad.bias_std);
    set_errors(&mut updated, sensor, std);
    updated.history.push(BiasUpdate {
        sensor: sensor.prefix().into(),
        recording: recording.into(),
        rests,
        bias_before: before,
        bias,
    });
    updated.seal_again(calibration);
    Ok(updated)
}

/// Gives the biases of a sensor new errors in the covariance, which go with no other parameter's: they are of another recording.
fn set_errors(calibration: &mut Calibration, sensor: Sensor, std: [Option<f64>; 3]) {
    for (axis, std) in ["x", "y", "z"].into_iter().zip(std) {
        let name = format!("{}.b_{axis}", sensor.prefix());
        let place = calibration.parameters.iter().position(|own| *own == name);
        let (Some(place), Some(std)) = (place, std) else {
            continue;
        };
        for (k, row) in calibration.covariance.iter_mut().enumerate() {
            if k == place {
                row.fill(0.0);
            }
            if let Some(value) = row.get_mut(place) {
                *value = if k == place { std * std } else { 0.0 };
            }
        }
    }
}

/// Longest over shortest axis of the three biases' error ellipsoid: the condition of their columns as
/// they are, for the three share a unit and a column of nearly nothing is a blind axis.
fn condition(biases: &Uncertainty) -> f64 {
    if biases.rank < 3 {
        return f64::INFINITY;
    }
    let covariance = Matrix3::from_fn(|i, k| biases.covariance[i][k]);
    let axes = covariance.symmetric_eigenvalues();
    (axes.max() / axes.min().max(0.0)).sqrt()
}

/// The mean of a rate at rest.
struct Mean {
    value: Vector3<f64>,
    std: Vector3<f64>,
    drift: Vector3<f64>,
}

findings::tuning! {
    /// Parts of a rest whose means are compared with each other.
    PARTS: usize = 5;

    /// The variance of their means is this many times what noise makes of it in one rest of a hundred: `χ²(4)/4`.
    BY_CHANCE: f64 = 3.32;
}

impl Mean {
    /// The mean with its standard error: from the scatter of `batches` means in a row, which sees slow noise that single samples do not
    /// show, and from that of [`PARTS`] means, where they scatter by more than that makes them. What the bias does over a fifth of a rest
    /// it does over a motion behind it, however long the rest was.
    fn of(values: &[Vector3<f64>], batches: usize) -> Option<Self> {
        let value = values.iter().sum::<Vector3<f64>>() / values.len().max(1) as f64;
        let (_, by_batches) = scatter(values, batches.max(2))?;
        let count = (values.len() / (values.len() / batches.max(2))) as f64;
        let of_mean = by_batches / count;
        let parts = scatter(values, PARTS.get());
        let beyond = |axis: usize| {
            let (_, by_parts) = parts.as_ref()?;
            let by_noise = of_mean[axis] * PARTS.get() as f64;
            (by_parts[axis] > BY_CHANCE.get() * by_noise).then(|| by_parts[axis] - by_noise)
        };
        let drift = |axis: usize| {
            let (means, _) = parts.as_ref()?;
            beyond(axis)?;
            Some(means.last()?[axis] - means.first()?[axis])
        };
        Some(Self {
            value,
            std: Vector3::from_fn(|k, _| (of_mean[k] + beyond(k).unwrap_or(0.0)).sqrt()),
            drift: Vector3::from_fn(|k, _| drift(k).unwrap_or(0.0)),
        })
    }
}

/// The means of so many parts in a row, and their variance; `None` of fewer samples.
fn scatter(values: &[Vector3<f64>], parts: usize) -> Option<(Vec<Vector3<f64>>, Vector3<f64>)> {
    let length = values
        .len()
        .checked_div(parts)
        .filter(|length| *length > 0)?;
    let means: Vec<Vector3<f64>> = values
        .chunks_exact(length)
        .map(|part| part.iter().sum::<Vector3<f64>>() / length as f64)
        .collect();
    let n = means.len() as f64;
    let mean = means.iter().sum::<Vector3<f64>>() / n;
    let squares = means.iter().map(|m| (m - mean).map(|d| d * d));
    Some((
        means.clone(),
        squares.sum::<Vector3<f64>>() / (n - 1.0).max(1.0),
    ))
}

#[cfg(test)]
mod tests {
    use recording::Stream;
    use recording::intervals::{Detector, segment};

    use super::*;
    use crate::methods::six_position::{Face, Placement, Six, SixPosition};

    const G: f64 = 9.8;
    /// Biases of the day: what a calibration from yesterday does not know.
    const FORCE: Vector3<f64> = Vector3::new(0.05, -0.02, 0.03);
    const RATE: Vector3<f64> = Vector3::new(1e-3, 2e-3, -5e-4);

    /// Yesterday's calibration: a perfect device.
    fn yesterday() -> Calibration {
        let placement = |face: &Face| Placement {
            label: face.name().into(),
            accelerometer: face.direction() * G,
            gyroscope: Some(Vector3::zeros()),
        };
        let six = Six::sort(Face::ALL.iter().map(placement).collect(), G).unwrap();
        SixPosition::solve(&six, G).calibration(false).unwrap()
    }

    /// Rests of `seconds` on each face with quick turns between, both sensors biased, with some noise.
    fn today(faces: &[Face], seconds: f64) -> (Recording, Segmentation) {
        let (mut force, mut rate) = (Stream::default(), Stream::default());
        let mut t = 0.0;
        for face in faces {
            for (length, size) in [(seconds, 1e-3), (1.0, 1.0)] {
                let end = t + length;
                while t < end {
                    let shake = Vector3::new((47.0 * t).sin(), (31.0 * t).sin(), (59.0 * t).sin());
                    for stream in [&mut force, &mut rate] {
                        stream.t.push(t);
                    }
                    force
                        .values
                        .push(face.direction() * G + FORCE + shake * size);
                    rate.values.push(RATE + shake * (0.01 * size));
                    t += 0.02;
                }
            }
        }
        let recording = Recording {
            name: "today".into(),
            accelerometer: Some(force),
            gyroscope: Some(rate),
            ..Recording::default()
        };
        let rests = segment(&recording, &Detector::default()).unwrap();
        assert_eq!(rests.statics.len(), faces.len());
        (recording, rests)
    }

    #[test]
    fn biases_of_the_day_are_found_and_nothing_else_changes() {
        let (recording, rests) = today(&Face::ALL, 25.0);
        let old = yesterday();
        let stretches = gyroscope_stretches(&old, &recording, &rests).unwrap();
        assert_eq!(stretches.len(), 6);
        let new = update_gyroscope(&old, "today", &stretches).unwrap();
        let new = update_accelerometer(&new, &recording, &rests).unwrap();
        let bias = |sensor| new.triad(sensor).unwrap().base().bias;
        // The shaking does not average out exactly over a rest: 1e-3 of it over 25 s.
        assert!((bias(Sensor::Gyroscope) - RATE).norm() < 1e-6);
        assert!((bias(Sensor::Accelerometer) - FORCE).norm() < 1e-3 * FORCE.norm());
        assert_eq!(new.history.len(), 2);
        assert_eq!(new.history[1].sensor, "accel");
        assert_eq!(new.accelerometer.unwrap().t, old.accelerometer.unwrap().t);
    }

    /// A calibration that states an error of every scale factor, 2e-5, and whose scale factors have it.
    fn known_within(errors: [f64; 3]) -> Calibration {
        let mut calibration = yesterday();
        let names = ["accel.s_x", "accel.s_y", "accel.s_z"];
        calibration.parameters = names.map(String::from).to_vec();
        let variance = |i, k| if i == k { 4e-10 } else { 0.0 };
        calibration.covariance = (0..3)
            .map(|i| (0..3).map(|k| variance(i, k)).collect())
            .collect();
        let triad = calibration.triad_mut(Sensor::Accelerometer).unwrap();
        for (k, error) in errors.into_iter().enumerate() {
            triad.t[k][k] *= 1.0 + error;
        }
        calibration
    }

    #[test]
    fn errors_of_few_rests_hold_whatever_the_residuals_are() {
        use rand::SeedableRng;
        use rand_distr::{Distribution, StandardNormal};
        let faces = [Face::XUp, Face::YUp, Face::ZUp, Face::ZDown];
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(5);
        let mut draw = || -> f64 { StandardNormal.sample(&mut random) };
        let (clean, rests) = today(&faces, 5.0);
        let (mut square, mut largest) = (0.0, 0.0_f64);
        const DRAWS: usize = 60;
        for _ in 0..DRAWS {
            let mut recording = clean.clone();
            for value in &mut recording.accelerometer.as_mut().unwrap().values {
                *value += Vector3::from_fn(|_, _| 1e-3 * draw());
            }
            let old = known_within([0; 3].map(|_| 2e-5 * draw()));
            let new = update_accelerometer(&old, &recording, &rests).unwrap();
            let triad = new.triad(Sensor::Accelerometer).unwrap();
            for k in 0..3 {
                let z = (triad.bias[k] - FORCE[k]) / triad.bias_std[k].unwrap();
                square += z * z;
                largest = largest.max(z.abs());
            }
        }
        let rms = (square / (3 * DRAWS) as f64).sqrt();
        assert!(
            (0.5..1.3).contains(&rms) && largest < 4.5,
            "{rms} {largest}"
        );
    }

    #[test]
    fn rests_in_one_plane_do_not_give_an_accelerometer_bias() {
        let plane = [Face::XUp, Face::YUp, Face::XDown, Face::YDown];
        let (recording, rests) = today(&plane, 5.0);
        let message = update_accelerometer(&yesterday(), &recording, &rests)
            .unwrap_err()
            .to_string();
        assert!(
            message.contains("too alike to tell the biases"),
            "{message}"
        );
    }

    #[test]
    fn short_rests_and_few_rests_are_refused() {
        let (recording, rests) = today(&[Face::XUp, Face::YUp, Face::ZUp], 10.0);
        let message = gyroscope_stretches(&yesterday(), &recording, &rests).unwrap_err();
        assert!(message.to_string().contains("more than 20 s"), "{message}");
        let message = update_accelerometer(&yesterday(), &recording, &rests).unwrap_err();
        assert!(
            message
                .to_string()
                .contains("3 rests: the bias of the accelerometer"),
            "{message}"
        );
    }
}
