//! Figures of noise in the units and words that people use.

use calib::noise::{AxisNoise, NoiseSummary, NoiseTerm, SensorNoise, TermValue};
use sensor::Sensor;

/// The sensors there are, gyroscope first, in the order of their plots.
pub fn sensors(
    summary: &NoiseSummary,
) -> impl Iterator<Item = (&'static str, Sensor, &SensorNoise)> {
    let gyroscope = summary.gyroscope.as_ref();
    let accelerometer = summary.accelerometer.as_ref();
    let gyroscope = gyroscope.map(|noise| ("Gyroscope", Sensor::Gyroscope, noise));
    let accelerometer = accelerometer.map(|noise| ("Accelerometer", Sensor::Accelerometer, noise));
    gyroscope.into_iter().chain(accelerometer)
}

/// The unit in which a term is shown, and how many of it make that of the readings.
pub fn shown_unit(term: NoiseTerm, sensor: Sensor, noise: &SensorNoise) -> (&'static str, f64) {
    match is_in_counts(noise) {
        true => (term.unit_in_counts(), 1.0),
        false => human(term, sensor),
    }
}

/// Returns true if the readings are in counts.
pub fn is_in_counts(noise: &SensorNoise) -> bool {
    noise.unit == "counts"
}

/// The unit people use for a term, and how many of it make the SI unit.
fn human(term: NoiseTerm, sensor: Sensor) -> (&'static str, f64) {
    let degree = 1f64.to_degrees();
    let mg = 1.0 / (1e-3 * calib::calibrate::STANDARD_GRAVITY);
    match (term, sensor) {
        (NoiseTerm::Quantisation, Sensor::Gyroscope) => ("″", 3600.0 * degree),
        (NoiseTerm::WhiteNoise, Sensor::Gyroscope) => ("°/√h", 60.0 * degree),
        (NoiseTerm::BiasInstability, Sensor::Gyroscope) => ("°/h", 3600.0 * degree),
        (NoiseTerm::RandomWalk, Sensor::Gyroscope) => ("°/h/√h", 60.0 * 3600.0 * degree),
        (NoiseTerm::Ramp, Sensor::Gyroscope) => ("°/h²", 3600.0 * 3600.0 * degree),
        (NoiseTerm::Quantisation, Sensor::Accelerometer) => ("mm/s", 1e3),
        (NoiseTerm::WhiteNoise, Sensor::Accelerometer) => ("m/s/√h", 60.0),
        (NoiseTerm::BiasInstability, Sensor::Accelerometer) => ("mg", mg),
        (NoiseTerm::RandomWalk, Sensor::Accelerometer) => ("mg/√h", 60.0 * mg),
        (NoiseTerm::Ramp, Sensor::Accelerometer) => ("mg/h", 3600.0 * mg),
        (_, Sensor::Magnetometer) => (term.unit(sensor), 1.0),
    }
}

/// Returns true if the white noise of an axis is not seen: steps of the readings or a filter hide it.
fn has_hidden_noise(noise: &SensorNoise) -> bool {
    let mut white = noise.axes.iter().filter_map(white);
    white.any(|term| term.lower == 0.0)
}

/// The largest white noise of the axes, in a unit of which `factor` make that of the readings; that of an axis whose noise is
/// not seen is its bound.
pub fn largest_white(noise: &SensorNoise, (unit, factor): (&str, f64)) -> String {
    let is_seen = |term: &&TermValue| term.lower > 0.0;
    let terms: Vec<&TermValue> = noise.axes.iter().filter_map(white).collect();
    let seen = terms.iter().copied().filter(is_seen).map(|term| term.value);
    let seen = seen.fold(0.0, f64::max);
    let bounds = terms.iter().copied().filter(|term| !is_seen(term));
    let bound = bounds.map(|term| term.upper.unwrap_or(f64::INFINITY));
    match bound.fold(0.0, f64::max) {
        bound if bound.is_infinite() => "not known".into(),
        // Readings that never change show no noise, which is no noise of zero.
        0.0 if seen == 0.0 => "not known".into(),
        bound if bound > seen => format!("below {} {unit}", significant(factor * bound)),
        _ => format!("{} {unit}", significant(factor * seen)),
    }
}

fn white(axis: &AxisNoise) -> Option<&TermValue> {
    let mut terms = axis.terms.iter();
    terms.find(|term| term.term == NoiseTerm::WhiteNoise)
}

/// Three significant figures.
pub fn significant(v: f64) -> String {
    if v == 0.0 {
        return "0".into();
    }
    let decade = v.abs().log10().floor();
    if !(-4.0..5.0).contains(&decade) {
        return format!("{v:.2e}");
    }
    let decimals = (2.0 - decade).max(0.0) as usize;
    format!("{v:.decimals$}")
}

/// Returns the amount of data analysed: length, rate and interruptions.
pub fn extent(noise: &SensorNoise) -> String {
    let seconds = (noise.samples + noise.bridged) as f64 * noise.step;
    let length = match seconds {
        s if s < 120.0 => format!("{s:.1} s"),
        s if s < 7200.0 => format!("{:.1} min", s / 60.0),
        s => format!("{:.2} h", s / 3600.0),
    };
    let gaps = if noise.gaps == 0 {
        String::new()
    } else {
        format!(
            ", {} gap{}",
            noise.gaps,
            if noise.gaps == 1 { "" } else { "s" }
        )
    };
    let bridged = match noise.bridged {
        0 => String::new(),
        missing => format!(", {missing} missing and bridged"),
    };
    let outliers = match noise.outliers {
        0 => String::new(),
        count => format!(", {count} left out"),
    };
    format!(
        "{} samples at {:.2} Hz, {length}{outliers}{bridged}{gaps}",
        noise.samples,
        1.0 / noise.step
    )
}

/// Returns the recommended static time before a calibration, in words.
pub fn advice(summary: &NoiseSummary) -> String {
    match (summary.initial_static_time, &summary.gyroscope) {
        (Some(time), _) => format!(
            "initial static time: {} s (from there on the gyroscope's deviation is within 10 % of its \
             smallest)",
            time.ceil()
        ),
        (None, Some(gyroscope)) if has_hidden_noise(gyroscope) => {
            "initial static time: not known, for the noise of the gyroscope is hidden".into()
        }
        (None, Some(_)) => "initial static time: longer than this recording can tell".into(),
        (None, None) => "initial static time: no gyroscope in the recording".into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn terms_are_shown_in_the_units_of_data_sheets() {
        // 1 °/h is 4.848e-6 rad/s; 1 mg is 9.80665e-3 m/s².
        let (unit, factor) = human(NoiseTerm::BiasInstability, Sensor::Gyroscope);
        assert_eq!(
            (unit, significant(4.848_137e-6 * factor)),
            ("°/h", "1.00".into())
        );
        let (unit, factor) = human(NoiseTerm::BiasInstability, Sensor::Accelerometer);
        assert_eq!(
            (unit, significant(9.806_65e-3 * factor)),
            ("mg", "1.00".into())
        );
    }

    fn with_white(terms: [(f64, f64, Option<f64>); 3]) -> SensorNoise {
        let axis = |(value, lower, upper): (f64, f64, Option<f64>)| AxisNoise {
            terms: vec![TermValue {
                term: NoiseTerm::WhiteNoise,
                name: String::new(),
                unit: String::new(),
                density_unit: None,
                value,
                lower,
                upper,
            }],
            model_error: None,
            shortest_tau: None,
            coarse_step: None,
            steps: Vec::new(),
            drift: None,
            curve: Vec::new(),
        };
        SensorNoise {
            samples: 0,
            step: 0.01,
            gaps: 0,
            bridged: 0,
            outliers: 0,
            unit: String::new(),
            densities: None,
            held: Vec::new(),
            axes: terms.map(axis),
        }
    }

    #[test]
    fn noise_that_is_not_seen_is_shown_with_its_bound() {
        let seen = (1.0, 0.9, Some(1.1));
        let shown = [
            (0.4, 0.3, Some(0.5)),
            (0.4, 0.0, Some(2.5)),
            (0.4, 0.0, None),
        ]
        .map(|last| largest_white(&with_white([seen, seen, last]), ("m", 2.0)));
        assert_eq!(shown, ["2.00 m", "below 5.00 m", "not known"]);
    }

    #[test]
    fn numbers_have_three_figures() {
        let shown = [0.0, 0.012_345, 123_456.0, 1_234.5, 99.96].map(significant);
        assert_eq!(shown, ["0", "0.0123", "1.23e5", "1234", "100.0"]);
    }
}
