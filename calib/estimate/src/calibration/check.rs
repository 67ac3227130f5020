//! Reading `cal.json` back, and refusing one that cannot be used.

use std::path::Path;

use findings::{Finding, Kind, Remedy};
use recording::shown::{shown, shown_path};
use recording::{Error, figure};
use sensor::EffectRef;

use super::document::marks;
use super::{Calibration, Outside, SCHEMA, Triad};
use crate::unreadable::of_json;

findings::tuning! {
    /// Largest ratio of the singular values of `T`: sensitivities of one chip differ by a tenth, units of its axes not at all.
    MOST_UNEQUAL: f64 = 10.0;
}

/// Largest bias that is believed of readings in SI units, and of counts, m/s²: twice gravity, and twice what 200 g are.
const LARGEST_FORCE: [f64; 2] = [20.0, 4000.0];

/// The same of rates, rad/s: more than a quarter turn a second, and twice what 4000 °/s are.
const LARGEST_RATE: [f64; 2] = [2.0, 140.0];

/// The schema of findings.json, which contains a calibration.
pub const FINDINGS_SCHEMA: &str = "stillpoint.findings/1";

/// Reads a calibration file; findings serve as the calibration that they contain.
///
/// # Errors
/// An unreadable file, one that is no calibration of this schema, and one whose numbers cannot be
/// used (a matrix without inverse, an unknown effect); the message names the entry.
pub fn load(path: &Path) -> Result<Calibration, Error> {
    load_with(path, &[])
}

/// [`load`] for files with effects of other crates: `outside` are those, found by their names.
///
/// # Errors
/// As [`load`].
pub fn load_with(path: &Path, outside: &[EffectRef]) -> Result<Calibration, Error> {
    read_calibration(&recording::read_text(path)?, path, outside)
}

/// [`load_with`] of a text that was read; `path` is what messages call it.
///
/// # Errors
/// As [`load`].
pub fn read_calibration(
    text: &str,
    path: &Path,
    outside: &[EffectRef],
) -> Result<Calibration, Error> {
    refuse_newer(path, text, SCHEMA)?;
    refuse_newer(path, text, FINDINGS_SCHEMA)?;
    let text = within_findings(text.to_owned());
    parse(&text, outside).map_err(|found| Error::input(found.in_file(shown_path(path))))
}

/// The calibration that findings contain; the text itself of anything else.
fn within_findings(text: String) -> String {
    let Ok(mut whole) = serde_json::from_str::<serde_json::Value>(&text) else {
        return text;
    };
    let schema = whole.get("schema").and_then(|s| s.as_str());
    if schema != Some(FINDINGS_SCHEMA) {
        return text;
    }
    let own = whole.get_mut("calibration").map(serde_json::Value::take);
    own.map_or(text, |calibration| calibration.to_string())
}

/// Refuses a file of a version of `schema` that this program is too old for: another program is to be called.
///
/// # Errors
/// [`Error::Usage`] with both versions.
pub fn refuse_newer(path: &Path, text: &str, schema: &str) -> Result<(), Error> {
    #[derive(serde::Deserialize)]
    struct Tag {
        schema: String,
    }
    let version = |schema: &str| {
        let (name, version) = schema.rsplit_once('/')?;
        Some((name.to_owned(), version.parse::<u32>().ok()?))
    };
    let found = serde_json::from_str::<Tag>(text)
        .map(|tag| tag.schema)
        .unwrap_or_default();
    match (version(&found), version(schema)) {
        (Some((name, new)), Some((own, known))) if name == own && new > known => Err(Error::usage(
            Finding::of(Kind::WRITTEN_BY_NEWER)
                .in_file(shown_path(path))
                .detail("found", shown(&found))
                .detail("schema", schema),
        )),
        _ => Ok(()),
    }
}

/// An entry that says another thing than expected.
fn other(key: impl Into<String>, found: &str, expected: impl Into<String>) -> Finding {
    Finding::of(Kind::ENTRY_OTHER)
        .detail("key", key)
        .detail("found", shown(found))
        .detail("expected", expected)
}

/// There are more or fewer of something than there should be.
fn count(key: impl Into<String>, found: String, expected: String) -> Finding {
    Finding::of(Kind::COUNT_OTHER)
        .detail("key", key)
        .detail("found", found)
        .detail("expected", expected)
}

/// The calibration in `text`.
fn parse(text: &str, outside: &[EffectRef]) -> Result<Calibration, Box<Finding>> {
    let any: serde_json::Value = serde_json::from_str(text).map_err(|e| {
        let found = of_json(Kind::NOT_JSON, &e);
        match text.trim_start().starts_with('{') {
            true => found,
            false => found.remedy(Remedy::SwapFiles),
        }
    })?;
    match any.get("schema").and_then(|s| s.as_str()) {
        Some(SCHEMA) => {}
        Some(found) => {
            let found = other("schema", found, SCHEMA);
            return Err(found.remedy(Remedy::CalibrateAgain).into());
        }
        None => {
            let missing = Finding::of(Kind::SCHEMA_MISSING);
            return Err(missing.detail("schema", SCHEMA).into());
        }
    }
    let is_whole = marks(&any).is_ok_and(|marks| marks.is_empty());
    let read = match is_whole {
        // The text has lines and columns.
        true => Calibration::deserialize(&mut serde_json::Deserializer::from_str(text))
            .and_then(|own| own.with_findings(&any)),
        false => Calibration::from_value(any),
    };
    let mut calibration = read.map_err(|e| of_json(Kind::UNREADABLE, &e))?;
    for values in &mut calibration.effects {
        let own = outside.iter().find(|effect| effect.name() == values.name);
        values.outside = own.map(|effect| Outside(effect.clone()));
    }
    check(&calibration)?;
    Ok(calibration)
}

fn check(calibration: &Calibration) -> Result<(), Box<Finding>> {
    let triads = [
        ("accelerometer", &calibration.accelerometer, "a = "),
        ("gyroscope", &calibration.gyroscope, "w = "),
        ("magnetometer", &calibration.magnetometer, "m = "),
    ];
    for (name, triad, equation) in triads {
        let Some(triad) = triad else { continue };
        if !triad.model.starts_with(equation) {
            let key = format!("{name}.model");
            let found = other(key, &triad.model, format!("{equation}…"));
            return Err(found.remedy(Remedy::SwapSensors).into());
        }
        let base = triad.base();
        let size = base.t.norm();
        if base.t.determinant().abs() <= 1e-9 * size.powi(3) {
            let found = Finding::of(Kind::MATRIX_SINGULAR).remedy(Remedy::CalibrateAgain);
            return Err(found.detail("key", format!("{name}.T")).into());
        }
        // What `calibrate` wrote is as it is; its gates say what is wrong with it.
        if calibration.was_edited() != Some(false) {
            absurd(name, triad)?;
        }
    }
    let gravity = calibration.gravity;
    if !(1.0..100.0).contains(&gravity) {
        let found = Finding::of(Kind::OUT_OF_RANGE)
            .detail("key", "gravity")
            .detail("value", figure(gravity))
            .detail("expected", GRAVITIES);
        return Err(found.into());
    }
    let (names, rows) = (calibration.parameters.len(), &calibration.covariance);
    let is_square = rows.len() == names && rows.iter().all(|row| row.len() == names);
    if !is_square && !rows.is_empty() {
        let (found, expected) = (format!("{} rows", rows.len()), format!("{names} × {names}"));
        return Err(count("covariance", found, expected).into());
    }
    for values in &calibration.effects {
        let effect = values
            .effect()
            .map_err(|found| found.detail("key", "effects"))?;
        let (expected, found) = (effect.params().len(), values.parameters.len());
        let key = format!("effects.{}", values.name);
        if expected != found {
            let parameters = format!("{found} parameters");
            return Err(count(key, parameters, expected.to_string()).into());
        }
        let pairs = effect.params().iter().zip(&values.parameters).enumerate();
        for (k, (expected, found)) in pairs {
            if expected.name != found.name {
                let key = format!("{key}.parameters.{k}");
                return Err(other(key, &found.name, &*expected.name).into());
            }
        }
    }
    Ok(())
}

/// Gravity as messages expect it.
const GRAVITIES: &str = "m/s², such as 9.80665";

/// Refuses numbers that no device has.
fn absurd(name: &str, triad: &Triad) -> Result<(), Box<Finding>> {
    let base = triad.base();
    let sizes = base.t.singular_values();
    let (largest, least) = (sizes.max(), sizes.min());
    if largest > MOST_UNEQUAL.get() * least {
        let found = Finding::of(Kind::MATRIX_UNEQUAL)
            .detail("key", format!("{name}.T"))
            .detail("times", figure((largest / least).round()));
        return Err(found.into());
    }
    let scale = base.scale();
    let (range, unit) = match name {
        "accelerometer" => (LARGEST_FORCE, "m/s²"),
        "gyroscope" => (LARGEST_RATE, "rad/s"),
        // Hard iron may be far stronger than the field, and readings are in any unit.
        _ => return Ok(()),
    };
    // Counts may lie around any zero.
    let most = if (0.5..2.0).contains(&scale) {
        range[0]
    } else {
        range[1]
    };
    let offset = (base.t * base.bias).norm();
    if offset > most || !offset.is_finite() {
        let found = Finding::of(Kind::BIAS_BEYOND)
            .detail("key", format!("{name}.bias"))
            .detail("found", figure(base.bias.norm()))
            .detail("offset", figure(offset))
            .detail("unit", unit);
        return Err(found.into());
    }
    Ok(())
}
