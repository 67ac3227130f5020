//! The result of an Allan analysis, as written to `noise.json`.

use findings::{Finding, Findings, Kind};
use recording::Error;
use recording::intervals::Span;
use sensor::Sensor;
use serde::{Deserialize, Serialize};

use super::allan::AllanCurve;
use super::curves::{RecordingCurves, SensorCurves};
use super::terms::identify::{NoiseTerms, identify};
use super::terms::octaves::spans_enough;
use super::terms::settling::settling_time;
use super::terms::term::NoiseTerm;
use super::warnings;

/// The schema this version writes.
pub const NOISE_SCHEMA: &str = "stillpoint.noise/1";

/// Noise of both sensors, SI units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NoiseSummary {
    /// [`NOISE_SCHEMA`].
    pub schema: String,
    /// Program and version.
    pub created_by: String,
    /// Accelerometer, m/s².
    pub accelerometer: Option<SensorNoise>,
    /// Gyroscope, rad/s.
    pub gyroscope: Option<SensorNoise>,
    /// Recommended static time before a calibration, s: the averaging time from which on the gyroscope's deviation is
    /// flat on every axis. Null if the recording is too short to determine it.
    pub initial_static_time: Option<f64>,
    /// Warnings for the user.
    #[serde(with = "findings::texts::of_warnings")]
    pub warnings: Findings,
}

/// The random walk density of a sensor: root mean square over its axes, in its own unit by `√s`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RandomWalk {
    /// The density; an axis whose walk the recording only bounds counts with its bound.
    pub density: f64,
    /// True if it is a bound on some axis.
    pub is_bound: bool,
}

/// Noise of one sensor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SensorNoise {
    /// Number of samples.
    pub samples: usize,
    /// Time between samples, s.
    pub step: f64,
    /// Gaps in the recording.
    pub gaps: usize,
    /// Samples that are missing singly or a few at a time, bridged by straight lines.
    #[serde(default)]
    pub bridged: usize,
    /// Single samples far from their neighbours, which are left out.
    #[serde(default)]
    pub outliers: usize,
    /// The unit of the readings: m/s², rad/s, or counts.
    #[serde(default)]
    pub unit: String,
    /// The densities that filters take; null without terms, or where the white noise is not bounded.
    #[serde(default)]
    pub densities: Option<Densities>,
    /// Stretches in which the readings stand still: begin and end, s.
    #[serde(default)]
    pub held: Vec<[f64; 2]>,
    /// x, y, z.
    pub axes: [AxisNoise; 3],
}

/// White noise and random walk of three axes as filters take them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Densities {
    /// White noise; the upper end of its interval where the recording only bounds it.
    pub noise_density: [f64; 3],
    /// rad/s/√Hz, m/s²/√Hz, or counts/√Hz.
    pub noise_density_unit: String,
    /// Random walk of the bias; zero where the fit does without.
    pub random_walk: [f64; 3],
    /// Upper end of its interval; null where the recording does not bound it.
    pub random_walk_upper: [Option<f64>; 3],
    /// rad/s²/√Hz, m/s³/√Hz, or counts/s/√Hz.
    pub random_walk_unit: String,
}

/// Noise of one axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AxisNoise {
    /// The five terms; empty where the recording is too short or the signal never changes.
    pub terms: Vec<TermValue>,
    /// Relative misfit of `σ²` beyond its scatter; the intervals include it.
    pub model_error: Option<f64>,
    /// Shortest averaging time that the terms were fitted to, s: longer than a step where a filter, say, makes readings go
    /// together that are near in time.
    #[serde(default)]
    pub shortest_tau: Option<f64>,
    /// Smallest step of the readings, where it is wider than their noise; else null.
    #[serde(default)]
    pub coarse_step: Option<f64>,
    /// Steps of the mean: when, s, and by how much.
    #[serde(default)]
    pub steps: Vec<[f64; 2]>,
    /// Drift of the mean, if it is smoother than any noise; else null.
    #[serde(default)]
    pub drift: Option<f64>,
    /// The Allan deviation.
    pub curve: Vec<CurvePoint>,
}

/// A noise term with its interval; the five of an axis hold together with 95 % confidence.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TermValue {
    /// Noise term.
    pub term: NoiseTerm,
    /// Its name for this sensor.
    pub name: String,
    /// SI unit, or counts.
    pub unit: String,
    /// The unit in which filters take the same number; null for other terms.
    #[serde(default)]
    pub density_unit: Option<String>,
    /// Coefficient; zero where the fit does without.
    pub value: f64,
    /// Lower end of the interval; above zero where the data need the term.
    pub lower: f64,
    /// Upper end; null where the recording does not bound it.
    pub upper: Option<f64>,
}

/// A point of the Allan deviation with its 95 % interval and the fit there.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CurvePoint {
    /// Averaging time, s.
    pub tau: f64,
    /// Allan deviation.
    pub deviation: f64,
    /// Lower end; null without a fit to this time.
    pub lower: Option<f64>,
    /// Upper end; null without a fit or without bound.
    pub upper: Option<f64>,
    /// The deviation that the terms give.
    pub fitted: Option<f64>,
}

impl SensorNoise {
    /// The random walk of the bias; `None` where the recording does not bound it on every axis.
    pub fn random_walk(&self) -> Option<RandomWalk> {
        let of = |terms: &[TermValue]| {
            let term = terms.iter().find(|t| t.term == NoiseTerm::RandomWalk)?;
            match term.lower > 0.0 {
                true => Some((term.value, false)),
                false => Some((term.upper?, true)),
            }
        };
        let axes: Option<Vec<(f64, bool)>> = self.axes.iter().map(|a| of(&a.terms)).collect();
        let axes = axes?;
        let square = axes.iter().map(|(v, _)| v * v).sum::<f64>() / axes.len() as f64;
        Some(RandomWalk {
            density: square.sqrt(),
            is_bound: axes.iter().any(|(_, is_bound)| *is_bound),
        })
    }
}

impl NoiseSummary {
    /// Identifies the noise terms of every axis.
    ///
    /// # Errors
    /// Curves without any sensor.
    pub fn of(curves: &RecordingCurves) -> Result<Self, Error> {
        if curves.accelerometer.is_none() && curves.gyroscope.is_none() {
            let found = Finding::of(Kind::NO_SAMPLES).only_remedies([]);
            return Err(Error::not_enough(found));
        }
        let mut warnings = Findings::new();
        let mut settling = Vec::new();
        let mut may_settle = true;
        let mut sensor = |curves: &Option<SensorCurves>, sensor: Sensor| {
            let curves = curves.as_ref()?;
            let fits = fits(curves);
            warnings.extend(warnings::of_sensor(curves, &fits, sensor));
            if sensor == Sensor::Gyroscope {
                settling = fits
                    .iter()
                    .map(|fit| settling_time(fit.as_ref()?, curves.axes[0].step))
                    .collect();
                // Where steps or a memory hide the terms, a longer recording does not show them, and that is said.
                may_settle = fits.iter().flatten().all(|fit| fit.is_known);
            }
            Some(sensor_noise(curves, &fits, sensor))
        };
        let accelerometer = sensor(&curves.accelerometer, Sensor::Accelerometer);
        let gyroscope = sensor(&curves.gyroscope, Sensor::Gyroscope);
        let initial_static_time = settling
            .into_iter()
            .collect::<Option<Vec<f64>>>()
            .filter(|times| !times.is_empty())
            .map(|times| times.into_iter().fold(0.0, f64::max));
        if gyroscope.is_some() && initial_static_time.is_none() && may_settle {
            warnings.push(Finding::of(Kind::SETTLING_UNKNOWN).of_sensor(Sensor::Gyroscope));
        }
        Ok(Self {
            schema: NOISE_SCHEMA.into(),
            created_by: concat!("stillpoint ", env!("CARGO_PKG_VERSION")).into(),
            accelerometer,
            gyroscope,
            initial_static_time,
            warnings,
        })
    }
}

/// The terms of each axis; those of coarse readings are bounded only, and beside a drift those that grow with time.
fn fits(curves: &SensorCurves) -> [Option<NoiseTerms>; 3] {
    std::array::from_fn(|k| {
        let fit = identify(&curves.axes[k])?;
        let bridged = curves.bridged as f64 / curves.axes[k].samples as f64;
        let fit = fit.with_bridges(bridged);
        let fit = match curves.drift[k] {
            Some(_) => fit.beside_a_drift(),
            None => fit,
        };
        Some(match curves.coarse[k] {
            Some(coarse) => fit.within_steps(coarse.step),
            None => fit,
        })
    })
}

fn sensor_noise(
    curves: &SensorCurves,
    fits: &[Option<NoiseTerms>; 3],
    sensor: Sensor,
) -> SensorNoise {
    let axis = |k: usize| AxisNoise {
        terms: fits[k]
            .as_ref()
            .map(|fit| terms(fit, sensor, curves.in_counts))
            .unwrap_or_default(),
        model_error: fits[k].as_ref().map(|fit| fit.model_error),
        shortest_tau: fits[k].as_ref().map(|fit| fit.shortest_tau),
        coarse_step: curves.coarse[k].map(|coarse| coarse.step),
        steps: curves.steps[k].iter().map(|s| [s.t, s.size]).collect(),
        drift: curves.drift[k].map(|drift| drift.change),
        curve: points(&curves.axes[k], fits[k].as_ref()),
    };
    let unit = if curves.in_counts {
        "counts"
    } else {
        NoiseTerm::BiasInstability.unit(sensor)
    };
    let held = curves.held.stretches.iter();
    SensorNoise {
        samples: curves.axes[0].samples - curves.bridged,
        step: curves.axes[0].step,
        gaps: curves.gaps,
        bridged: curves.bridged,
        outliers: curves.outliers.count,
        unit: unit.into(),
        densities: densities(fits, sensor, curves.in_counts),
        held: held.map(|&Span { from, to }| [from, to]).collect(),
        axes: [axis(0), axis(1), axis(2)],
    }
}

/// The unit of a term, and that of a density.
fn units(term: NoiseTerm, sensor: Sensor, in_counts: bool) -> (&'static str, Option<&'static str>) {
    let density = match term {
        _ if !in_counts => term.density_unit(sensor),
        NoiseTerm::WhiteNoise => Some("counts/√Hz"),
        NoiseTerm::RandomWalk => Some("counts/s/√Hz"),
        _ => None,
    };
    let unit = if in_counts {
        term.unit_in_counts()
    } else {
        term.unit(sensor)
    };
    (unit, density)
}

fn densities(fits: &[Option<NoiseTerms>; 3], sensor: Sensor, in_counts: bool) -> Option<Densities> {
    let [Some(x), Some(y), Some(z)] = fits else {
        return None;
    };
    let of = |term: NoiseTerm| [x, y, z].map(|fit| *fit.get(term));
    let unit = |term: NoiseTerm| {
        units(term, sensor, in_counts)
            .1
            .unwrap_or_default()
            .to_owned()
    };
    let walks = of(NoiseTerm::RandomWalk);
    let white = of(NoiseTerm::WhiteNoise);
    // Too large a density makes a filter slow, too small a one makes it sure of what is wrong.
    let white = white.map(|e| {
        if e.is_seen() {
            e.value
        } else {
            e.interval.upper
        }
    });
    if white.iter().any(|density| density.is_infinite()) {
        return None;
    }
    Some(Densities {
        noise_density: white,
        noise_density_unit: unit(NoiseTerm::WhiteNoise),
        random_walk: walks.map(|e| e.value),
        random_walk_upper: walks.map(|e| bounded(e.interval.upper)),
        random_walk_unit: unit(NoiseTerm::RandomWalk),
    })
}

fn bounded(upper: f64) -> Option<f64> {
    upper.is_finite().then_some(upper)
}

fn terms(fit: &NoiseTerms, sensor: Sensor, in_counts: bool) -> Vec<TermValue> {
    let value = |e: &super::terms::identify::Estimate| {
        let (unit, density_unit) = units(e.term, sensor, in_counts);
        TermValue {
            term: e.term,
            name: e.term.name(sensor).into(),
            unit: unit.into(),
            density_unit: density_unit.map(str::to_owned),
            value: e.value,
            lower: e.interval.lower,
            upper: bounded(e.interval.upper),
        }
    };
    fit.estimates.iter().map(value).collect()
}

/// The points that the recording has enough room for.
fn points(curve: &AllanCurve, fit: Option<&NoiseTerms>) -> Vec<CurvePoint> {
    curve
        .points
        .iter()
        .filter(|point| spans_enough(point))
        .map(|point| {
            let fit = fit.filter(|fit| fit.reach(point.tau));
            let interval = fit.map(|fit| fit.interval(point));
            CurvePoint {
                tau: point.tau,
                deviation: point.deviation,
                lower: interval.map(|i| i.lower),
                upper: interval.map(|i| i.upper).filter(|u| u.is_finite()),
                fitted: fit.map(|fit| fit.deviation(point.tau)),
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;
    use recording::{Described, Recording, Stream, UnitBy};

    use super::*;

    /// A number between 0 and 1 for every place, as if by chance.
    fn by_chance(k: usize) -> f64 {
        let z = (k as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        let z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Ten minutes at 50 Hz with `noise` of a sample, whole numbers, and a step of the x axis at 305 s.
    fn at_rest(unit: &'static str, step: f64) -> Recording {
        let value = |k: usize| {
            let noise = 10.0 * by_chance(k);
            Vector3::new(
                noise.round() + if k >= 305 * 50 { step } else { 0.0 },
                noise.round(),
                noise.round() + 16_384.0,
            )
        };
        let described = Described {
            sensor: Sensor::Accelerometer,
            source: "rest.csv".into(),
            columns: Vec::new(),
            unused: Vec::new(),
            unit,
            unit_by: UnitBy::Data,
            turned: false,
            flipped: Vec::new(),
        };
        let mut recording = Recording {
            accelerometer: Some(Stream {
                t: (0..30_000).map(|k| k as f64 * 0.02).collect(),
                values: (0..30_000).map(value).collect(),
            }),
            ..Recording::default()
        };
        recording.description.sensors.push(described);
        recording
    }

    fn summary(unit: &'static str, step: f64) -> NoiseSummary {
        NoiseSummary::of(&RecordingCurves::of(&at_rest(unit, step), None)).unwrap()
    }

    #[test]
    fn noise_of_counts_is_in_counts() {
        let noise = summary("counts", 0.0).accelerometer.unwrap();
        assert_eq!(noise.unit, "counts");
        let white = &noise.axes[0].terms[NoiseTerm::WhiteNoise as usize];
        assert_eq!(
            (white.unit.as_str(), white.density_unit.as_deref()),
            ("counts·√s", Some("counts/√Hz"))
        );
        let text = format!("{noise:?}");
        assert!(!text.contains("m/s"), "{text}");
    }

    #[test]
    fn densities_are_the_terms_in_the_units_of_filters() {
        let noise = summary("m/s^2", 0.0).accelerometer.unwrap();
        let densities = noise.densities.unwrap();
        assert_eq!(densities.noise_density_unit, "m/s²/√Hz");
        assert_eq!(densities.random_walk_unit, "m/s³/√Hz");
        let white = |k: usize| noise.axes[k].terms[NoiseTerm::WhiteNoise as usize].value;
        assert_eq!(densities.noise_density, [white(0), white(1), white(2)]);
    }

    #[test]
    fn a_step_is_said_with_its_time_its_size_and_a_stretch_without_it() {
        let found = summary("m/s^2", 4.0);
        let [step] = found.accelerometer.unwrap().axes[0].steps[..] else {
            panic!("{:?}", found.warnings);
        };
        assert!(
            (step[0] - 305.0).abs() < 2.5 && (step[1] - 4.0).abs() < 0.8,
            "{step:?}"
        );
        let step = found.warnings.iter().find(|f| f.kind == Kind::MEAN_STEPS);
        let said = step.unwrap().text(findings::Front::CommandLine);
        assert!(
            said.starts_with("the mean of accelerometer x jumps by")
                && said.contains("--rest 0,30"),
            "{said}"
        );
        assert!(!summary("m/s^2", 0.0).warnings.has(Kind::MEAN_STEPS));
    }

    /// Noise of standard deviation 1, from twelve numbers of even chance.
    fn normal(k: usize) -> f64 {
        (0..12).map(|n| by_chance(12 * k + n)).sum::<f64>() - 6.0
    }

    /// Ten minutes at 50 Hz.
    fn of_values(value: impl Fn(usize) -> Vector3<f64>) -> NoiseSummary {
        let mut recording = at_rest("m/s^2", 0.0);
        if let Some(stream) = &mut recording.accelerometer {
            stream.values = (0..stream.t.len()).map(value).collect();
        }
        let curves = RecordingCurves::of(&recording, None);
        assert_eq!(curves.stillness.motions, []);
        NoiseSummary::of(&curves).unwrap()
    }

    /// White noise of 1 a sample at 50 Hz, 1 m/s².
    const DENSITY: f64 = 0.141_421_356_237;

    fn white_of(axis: &AxisNoise) -> &TermValue {
        &axis.terms[NoiseTerm::WhiteNoise as usize]
    }

    #[test]
    fn readings_coarser_than_their_noise_bound_it_and_name_no_other_cause() {
        // Four and 5.7 standard deviations, at the middle, at the edge and between.
        for step in [4.0, 5.7] {
            let at = Vector3::new(0.0, 0.5, 0.3) * step;
            let value = |k: usize| {
                let noise = Vector3::new(normal(3 * k), normal(3 * k + 1), normal(3 * k + 2));
                ((at + noise) / step).map(f64::round) * step
            };
            let noise = of_values(value);
            let kinds: Vec<Kind> = noise.warnings.iter().map(|found| found.kind).collect();
            assert_eq!(kinds, [Kind::QUANTISED], "{:?}", noise.warnings);
            assert_eq!(
                noise.warnings.first().unwrap().word("axes"),
                Some("x, y, z")
            );
            let found = noise.accelerometer.unwrap();
            for axis in &found.axes {
                let white = white_of(axis);
                assert!(
                    white.lower == 0.0 && white.upper.unwrap() > DENSITY,
                    "{white:?}"
                );
                assert!((axis.coarse_step.unwrap() - step).abs() < 1e-9);
            }
            assert!(
                found
                    .densities
                    .unwrap()
                    .noise_density
                    .iter()
                    .all(|n| *n > DENSITY)
            );
        }
    }

    #[test]
    fn single_samples_far_off_are_left_out_and_the_rest_is_used() {
        let places = [1130, 18_500, 20_250];
        let value = |k: usize| {
            let spike = if places.contains(&k) { 5000.0 } else { 0.0 };
            Vector3::new(normal(3 * k) + spike, normal(3 * k + 1), normal(3 * k + 2))
        };
        let noise = of_values(value);
        let found = noise.warnings.first().unwrap();
        let said = found.text(findings::Front::CommandLine);
        assert_eq!(
            (found.kind, found.value("count")),
            (Kind::SPIKES, Some(3.0))
        );
        assert!(
            said.contains("3 single readings on x") && said.contains("t = 22.60, 370.00, 405.00 s"),
            "{said}"
        );
        let sensor = noise.accelerometer.unwrap();
        assert_eq!((sensor.samples, sensor.outliers), (30_000, 3));
        let white = white_of(&sensor.axes[0]);
        assert!(
            white.lower < DENSITY && DENSITY < white.upper.unwrap(),
            "{white:?}"
        );
    }

    #[test]
    fn a_filter_is_said_once_for_all_axes_and_with_the_times_that_hold() {
        let mut filtered = Vector3::zeros();
        let mut values = Vec::new();
        for k in 0..30_000 {
            let noise = Vector3::new(normal(3 * k), normal(3 * k + 1), normal(3 * k + 2));
            filtered += 0.4665 * (noise - filtered);
            values.push(filtered);
        }
        let noise = of_values(|k| values[k]);
        let misses = noise
            .warnings
            .iter()
            .filter(|f| f.kind == Kind::NOISE_MODEL_MISSES);
        let said: Vec<String> = misses
            .map(|f| f.text(findings::Front::CommandLine))
            .collect();
        assert_eq!(said.len(), 1, "{said:?}");
        assert!(
            said[0].contains("accelerometer x, y, z") && said[0].contains("and longer"),
            "{said:?}"
        );
        for axis in &noise.accelerometer.unwrap().axes {
            assert!(axis.shortest_tau.unwrap() > 0.07 && axis.model_error == Some(0.0));
            let white = white_of(axis);
            assert!(
                white.lower < DENSITY && DENSITY < white.upper.unwrap(),
                "{white:?}"
            );
            assert!((white.value / DENSITY - 1.0).abs() < 0.08, "{white:?}");
        }
    }
}
