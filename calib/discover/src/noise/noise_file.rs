//! Noise of the biases from a noise file.

use std::path::Path;

use ::findings::{Finding, Findings, Kind};
use estimate::calibration::refuse_newer;
use estimate::methods::joint::BiasNoise;
use noise::{NOISE_SCHEMA, NoiseSummary, NoiseTerm, SensorNoise, TermValue};
use recording::Error;
use recording::shown::shown_path;
use sensor::Sensor;

findings::tuning! {
    /// Larger densities are no sensor's, m/s²/√s and rad/s/√s: they would explain anything.
    LARGEST: f64 = 1.0;
}

/// Noise of the biases with what the user should know of it.
#[derive(Clone, Debug, PartialEq)]
pub struct GivenNoise {
    /// Random walk densities of accelerometer (m/s²/√s) and gyroscope (rad/s/√s).
    pub noise: BiasNoise,
    /// Notes about densities for which the file has only an upper bound.
    pub notes: Findings,
}

/// The random walk densities in a file that `allan` has written: of each sensor the root mean square over its axes.
///
/// An axis whose walk the recording only bounds counts with its bound: too large a walk hides an effect, too small a
/// one makes up names.
///
/// # Errors
/// An unreadable file, another schema, and a walk that the file does not bound.
pub fn noise_in(path: &Path) -> Result<GivenNoise, Error> {
    let text = recording::read_text(path)?;
    refuse_newer(path, &text, NOISE_SCHEMA)?;
    let in_file = |found: Finding| found.in_file(shown_path(path));
    let summary = parse(&text).map_err(|found| Error::input(in_file(*found)))?;
    let mut given = GivenNoise {
        noise: BiasNoise::default(),
        notes: Findings::new(),
    };
    let sensors = [
        (Sensor::Accelerometer, summary.accelerometer),
        (Sensor::Gyroscope, summary.gyroscope),
    ];
    for (place, (sensor, noise)) in sensors.into_iter().enumerate() {
        let of = |kind| in_file(Finding::of(kind)).of_sensor(sensor);
        let noise = noise.ok_or_else(|| Error::input(of(Kind::NOISE_OF_ONE_SENSOR)))?;
        let walk = noise.random_walk();
        let walk = walk.ok_or_else(|| Error::input(of(Kind::WALK_UNBOUNDED)))?;
        if walk.density > LARGEST.get() {
            let found = of(Kind::WALK_IMPOSSIBLE)
                .number("density", walk.density, "1")
                .number("largest", LARGEST.get(), "1");
            return Err(Error::input(found));
        }
        given.noise.walk[place] = walk.density;
        given.noise.flicker[place] = instability(&noise);
        if walk.is_bound {
            given.notes.push(of(Kind::WALK_ONLY_BOUNDED));
        }
    }
    Ok(given)
}

fn parse(text: &str) -> Result<NoiseSummary, Box<Finding>> {
    let summary: NoiseSummary = serde_json::from_str(text).map_err(|e| {
        Finding::of(Kind::NOT_A_NOISE_FILE)
            .at_line(e.line() as u64)
            .at_column(e.column() as u64)
            .detail("reason", e.to_string())
    })?;
    if summary.schema == NOISE_SCHEMA {
        Ok(summary)
    } else {
        Err(Box::new(
            Finding::of(Kind::OTHER_SCHEMA)
                .detail("found", summary.schema)
                .detail("expected", NOISE_SCHEMA),
        ))
    }
}

/// The bias instability of every axis; nothing of one where it is only bounded.
fn instability(noise: &SensorNoise) -> [f64; 3] {
    let of = |terms: &[TermValue]| {
        let mut known = terms.iter().filter(|t| t.lower > 0.0);
        let term = known.find(|t| t.term == NoiseTerm::BiasInstability);
        term.map_or(0.0, |t| t.value)
    };
    [0, 1, 2].map(|axis| noise.axes.get(axis).map_or(0.0, |a| of(&a.terms)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A noise file whose axes have these `(value, lower, upper)` of the walk in both sensors.
    fn file(axes: [(f64, f64, Option<f64>); 3], schema: &str) -> tempfile::NamedTempFile {
        let axes = axes.map(|(value, lower, upper)| {
            serde_json::json!({"terms": [{"term": "random_walk", "name": "", "unit": "", "value": value,
                "lower": lower, "upper": upper}], "model_error": null, "curve": []})
        });
        let sensor = serde_json::json!({"samples": 1, "step": 0.01, "gaps": 0, "axes": axes});
        let whole = serde_json::json!({"schema": schema, "created_by": "", "accelerometer": sensor,
            "gyroscope": sensor, "initial_static_time": null, "warnings": []});
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), whole.to_string()).unwrap();
        file
    }

    #[test]
    fn a_density_is_the_root_mean_square_over_the_axes_and_a_bound_counts_in_full() {
        let known = file([(0.3, 0.2, Some(0.4)); 3], NOISE_SCHEMA);
        let given = noise_in(known.path()).unwrap();
        assert!(given.noise.walk.iter().all(|w| (w - 0.3).abs() < 1e-12));
        assert!(given.notes.is_empty());
        // (1 + 4 + 49)/3 = 18 = (3 √2)².
        let axes = [
            (0.1, 0.05, Some(0.2)),
            (0.2, 0.1, None),
            (0.0, 0.0, Some(0.7)),
        ];
        let given = noise_in(file(axes, NOISE_SCHEMA).path()).unwrap();
        assert!((given.noise.walk[1] - 0.1 * 18f64.sqrt()).abs() < 1e-12);
        assert_eq!(given.notes.len(), 2);
    }

    #[test]
    fn a_walk_without_bound_or_beyond_all_sensors_and_another_schema_are_refused() {
        let unbounded = file([(0.0, 0.0, None); 3], NOISE_SCHEMA);
        let said = noise_in(unbounded.path()).unwrap_err().to_string();
        assert!(said.contains("not bounded"), "{said}");
        let absurd = file([(1e300, 1e299, None); 3], NOISE_SCHEMA);
        let said = noise_in(absurd.path()).unwrap_err().to_string();
        assert!(said.contains("no such sensor wanders"), "{said}");
        let other = file([(1.0, 1.0, None); 3], "stillpoint.noise/9");
        let said = noise_in(other.path()).unwrap_err().to_string();
        assert!(said.contains("noise/9"), "{said}");
    }
}
