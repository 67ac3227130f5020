//! The limits file.

use std::path::Path;

use effects::catalogue;
use findings::{Finding, Kind};
use recording::shown::shown_path;
use recording::toml_place::{at_key, not_toml};
use recording::{Error, figure};
use sensor::{Param, Sensor, base_names};

use super::Limits;

/// The limits of the file at `path`.
///
/// # Errors
/// [`Error::Io`] where it cannot be read; as [`parse_limits`].
pub fn read_limits(path: &Path) -> Result<Limits, Error> {
    parse_limits(&recording::read_text(path)?, &shown_path(path))
}

/// The limits in `text`; `name` is what messages call the file.
///
/// # Errors
/// [`Error::Usage`] as `name:line:column: key: …` for what is not TOML, an unknown key, effect or parameter (with the
/// nearest known one), a limit that is negative or no number, a range the wrong way round.
///
/// # Examples
/// ```
/// use stillpoint_estimate::limits::parse_limits;
/// let limits = parse_limits("[gyroscope]\nresidual_deg = 0.5\n", "limits.toml").unwrap();
/// assert_eq!(limits.gyroscope.residual_deg, Some(0.5));
/// let wrong = parse_limits("[gyroscope]\nresidual_dge = 0.5\n", "limits.toml").unwrap_err();
/// assert!(wrong.to_string().ends_with("did you mean `residual_deg`?"));
/// ```
pub fn parse_limits(text: &str, name: &str) -> Result<Limits, Error> {
    let limits: Limits = toml::from_str(text).map_err(|e| {
        let found = not_toml(name, text, &e);
        Error::usage(found)
    })?;
    match complaint(&limits) {
        None => Ok(limits),
        Some((key, what)) => {
            let found = at_key(what, name, text, &key);
            Err(Error::usage(found.detail("key", key)))
        }
    }
}

/// The first key that makes no sense, and why.
fn complaint(limits: &Limits) -> Option<(String, Finding)> {
    let (force, rate) = (&limits.accelerometer, &limits.gyroscope);
    let fixed = [
        ("accelerometer.residual_mm_s2", force.residual_mm_s2),
        ("accelerometer.reduced_chi2", force.reduced_chi2),
        ("accelerometer.scale", force.scale),
        ("accelerometer.misalignment", force.misalignment),
        ("accelerometer.bias", force.bias),
        ("accelerometer.intervals", force.intervals),
        ("gyroscope.residual_deg", rate.residual_deg),
        ("gyroscope.reduced_chi2", rate.reduced_chi2),
        ("gyroscope.scale", rate.scale),
        ("gyroscope.misalignment", rate.misalignment),
        ("gyroscope.bias", rate.bias),
        ("gyroscope.intervals", rate.intervals),
    ];
    let fixed = fixed.into_iter().map(|(key, v)| (key.to_owned(), v));
    let effects = limits.effects.iter();
    let effects = effects.map(|(name, v)| (format!("effects.{name}"), Some(*v)));
    let errors = limits.standard_errors.iter();
    let errors = errors.map(|(name, v)| (format!("standard_errors.{name}"), Some(*v)));
    for (key, value) in fixed.chain(effects).chain(errors) {
        if let Some(v) = value.filter(|v| !(v.is_finite() && *v >= 0.0)) {
            let found = Finding::of(Kind::OUT_OF_RANGE)
                .detail("value", figure(v))
                .detail("expected", "0 or more");
            return Some((key, found));
        }
    }
    let names: Vec<String> = catalogue().map(|e| e.name().to_owned()).collect();
    for name in limits.effects.keys() {
        if !names.contains(name) {
            let found = Finding::of(Kind::EFFECT_UNKNOWN);
            let found = found.or_nearest(name, names.iter().map(String::as_str));
            return Some((format!("effects.{name}"), found));
        }
    }
    let known = parameter_names();
    let tables = [
        (
            "standard_errors",
            limits.standard_errors.keys().collect::<Vec<_>>(),
        ),
        ("values", limits.values.keys().collect()),
    ];
    for (table, name) in tables
        .iter()
        .flat_map(|(t, names)| names.iter().map(move |n| (t, *n)))
    {
        if !known.contains(name) {
            let found = Finding::of(Kind::PARAMETER_UNKNOWN);
            let found = found.or_nearest(name, known.iter().map(String::as_str));
            return Some((format!("{table}.{name}"), found));
        }
    }
    let ranges = limits.values.iter();
    ranges
        .filter(|(_, [low, high])| !(*low..=*high).contains(low))
        .map(|(name, [low, high])| {
            let found = Finding::of(Kind::BACKWARDS)
                .detail("from", figure(*low))
                .detail("to", figure(*high));
            (format!("values.{name}"), found)
        })
        .next()
}

/// Every name that a parameter of a calibration may have.
fn parameter_names() -> Vec<String> {
    let base = [Sensor::Accelerometer, Sensor::Gyroscope]
        .into_iter()
        .flat_map(base_names);
    let of = |e: sensor::EffectRef| {
        let full = |p: &Param| format!("{}.{}", e.name(), p.name);
        e.params().iter().map(full).collect::<Vec<_>>()
    };
    base.chain(catalogue().flat_map(of)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(text: &str) -> String {
        let error = parse_limits(text, "l.toml").unwrap_err();
        assert!(matches!(error, Error::Usage(_)));
        error.to_string()
    }

    #[test]
    fn a_wrong_key_is_named_with_its_place_and_the_nearest_name() {
        let found = refused("required = [\"gyroscop\"]");
        assert!(
            found.starts_with("l.toml:1:13: ") && found.ends_with("did you mean `gyroscope`?"),
            "{found}"
        );
        let found = refused("[accelerometer]\nbais = 1");
        assert!(
            found.starts_with("l.toml:2:1: ") && found.ends_with("did you mean `bias`?"),
            "{found}"
        );
        let found = refused("[effects]\ngyro_g_sensitvity = 1e-4");
        assert!(
            found.starts_with("l.toml:2:1: effects.")
                && found.ends_with("did you mean `gyro_g_sensitivity`?"),
            "{found}"
        );
        let found = refused("\n[standard_errors]\n\"accel.s_q\" = 1e-4");
        assert!(
            found.starts_with("l.toml:3:1: standard_errors.accel.s_q: "),
            "{found}"
        );
        let found = refused("[values]\n\"gyro.b_x\" = [1.0, -1.0]");
        assert!(
            found.starts_with("l.toml:2:1: values.gyro.b_x: from 1 to -1"),
            "{found}"
        );
        let found = refused("[gyroscope]\nbias = nan");
        assert!(
            found.starts_with("l.toml:2:1: gyroscope.bias: is NaN"),
            "{found}"
        );
    }
}
