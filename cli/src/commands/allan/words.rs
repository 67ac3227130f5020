//! Figures of noise in the units and words that people use.

use calib::noise::{NoiseSummary, NoiseTerm, SensorNoise};
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
    format!(
        "{} samples at {:.2} Hz, {length}{bridged}{gaps}",
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

    #[test]
    fn numbers_have_three_figures() {
        let shown = [0.0, 0.012_345, 123_456.0, 1_234.5, 99.96].map(significant);
        assert_eq!(shown, ["0", "0.0123", "1.23e5", "1234", "100.0"]);
    }
}
