//! The calibration as tables for people.

use std::fmt::Write as _;

use calib::calibrate::Outcome;
use calib::calibration::{Calibration, EffectValues, MagneticField, RecordingField, Triad};
use sensor::{PLACES, Sensor, base_names};

use super::field::{field_reading_unit, field_unit};
use super::{clocks, joint, left_out};
use crate::pages::session::short_names;
use crate::show;

/// Units of the readings of accelerometer and gyroscope.
pub fn units(outcome: &Outcome) -> [&'static str; 2] {
    let calibration = &outcome.calibration;
    let unit = |triad: &Option<Triad>, si: &'static str| {
        let units = triad.as_ref().and_then(|triad| triad.units.as_ref());
        match units.map(|units| units.reading.as_str()) {
            Some("g") => "g",
            Some("deg/s") => "°/s",
            Some("count") => "counts",
            _ => si,
        }
    };
    [
        unit(&calibration.accelerometer, "m/s²"),
        unit(&calibration.gyroscope, "rad/s"),
    ]
}

/// The tables for people.
pub fn text(outcome: &Outcome) -> String {
    let calibration = &outcome.calibration;
    let mut text = String::new();
    if let Some(triad) = &calibration.accelerometer {
        let _ = writeln!(
            text,
            "Accelerometer   a = T (A - b), gravity {} m/s²",
            calibration.gravity
        );
        let _ = writeln!(
            text,
            "{}",
            triad_table(triad, units(outcome)[0], Sensor::Accelerometer)
        );
        let _ = writeln!(
            text,
            "{} static intervals, residual {} mm/s² rms{}{}, condition {:.1}, rank {}",
            triad.static_intervals.unwrap_or(0),
            show::figures(1e3 * triad.residual_rms, 3),
            outcome.joint.as_ref().map_or("", |_| joint::BY_WEIGHTS),
            over_noise(triad),
            triad.condition,
            triad.rank
        );
        if let Some(fit) = &outcome.accelerometer {
            let _ = writeln!(
                text,
                "the size of gravity leaves the frame free; reported in the {} frame",
                if triad.t[1][0] == 0.0 {
                    "triangular"
                } else {
                    "symmetric"
                }
            );
            if let Some(p) = fit.common_bias_p {
                let _ = writeln!(
                    text,
                    "{} (a common bias would leave so much in {:.2} % of cases)",
                    if fit.own_bias {
                        "each recording has a bias of its own"
                    } else {
                        "one bias for all recordings"
                    },
                    100.0 * p
                );
            }
        }
        text.push_str(&bias_time(triad, 1e3, "mm/s²"));
        let _ = writeln!(text);
    }
    if let Some(triad) = &calibration.gyroscope {
        let _ = writeln!(text, "Gyroscope   w = T (W - b)");
        let _ = writeln!(
            text,
            "{}",
            triad_table(triad, units(outcome)[1], Sensor::Gyroscope)
        );
        if let Some(fit) = &outcome.gyroscope {
            let _ = writeln!(
                text,
                "{} turns, gravity predicted to {:.3}° rms (raw {:.3}°){}, condition {:.1}, rank {}",
                fit.chords.len(),
                fit.rms().to_degrees(),
                fit.rms_before().to_degrees(),
                over_noise(triad),
                triad.condition,
                triad.rank
            );
        }
    }
    if let Some(triad) = &calibration.gyroscope {
        text.push_str(&bias_time(triad, 1.0_f64.to_degrees() * 3600.0, "°/h"));
    }
    if let Some(fit) = &outcome.joint {
        text.push_str(&joint::text(fit));
    }
    text.push_str(&magnetometer(calibration));
    text.push_str(&clocks::text(calibration));
    for effect in &calibration.effects {
        let header = [effect.name.as_str(), "value", "std error", "unit"];
        let table = show::table_of(&header, coefficients(effect));
        let _ = writeln!(text, "\n{table}");
    }
    text.push_str(&left_out::text(calibration, units(outcome)));
    text
}

/// The magnetometer and the field that it was calibrated in.
fn magnetometer(calibration: &Calibration) -> String {
    let (Some(triad), Some(field)) = (&calibration.magnetometer, &calibration.magnetic_field)
    else {
        return String::new();
    };
    let unit = field_reading_unit(calibration);
    let mut text = String::from("\nMagnetometer   m = T (M - b)");
    if !field.strength_given {
        text.push_str(", T of determinant 1 (--field gives the scale)");
    }
    let _ = writeln!(text, "\n{}", triad_table(triad, unit, Sensor::Magnetometer));
    let _ = writeln!(
        text,
        "{} static intervals and {} turns, residual {} {unit} rms{}",
        triad.static_intervals.unwrap_or(0),
        triad.dynamic_intervals.unwrap_or(0),
        show::error(Some(triad.residual_rms)),
        over_noise(triad)
    );
    text + &self::field(calibration)
}

/// The magnetic field of the place in words.
pub fn field(calibration: &Calibration) -> String {
    let Some(field) = &calibration.magnetic_field else {
        return String::new();
    };
    let (unit, mut text) = (field_unit(calibration), String::new());
    if field.recordings.is_empty() {
        text.push_str(&of_place(&field.last, unit, ""));
    }
    let names: Vec<&str> = field
        .recordings
        .iter()
        .map(|own| own.recording.as_str())
        .collect();
    for (own, name) in field.recordings.iter().zip(short_names(&names)) {
        text.push_str(&of_place(own, unit, &format!(" in {name}")));
    }
    text + &uneven(field, unit)
}

fn of_place(field: &RecordingField, unit: &str, name: &str) -> String {
    let strength = match field.strength_std {
        Some(std) => format!(
            "{} ± {}",
            show::value(field.strength, Some(std)),
            show::error(Some(std))
        ),
        None => format!("{} (given)", field.strength),
    };
    format!(
        "the magnetic field{name}: {strength} {unit}, {} ± {}° below the horizontal\n",
        show::value(field.inclination, Some(field.inclination_std)),
        show::error(Some(field.inclination_std))
    )
}

fn uneven(field: &MagneticField, unit: &str) -> String {
    if field.unevenness == 0.0 {
        return String::new();
    }
    format!(
        "it differs by {} {unit} per axis from one static interval to the next, beyond the noise\n",
        show::error(Some(field.unevenness))
    )
}

/// For which time the bias holds and how much it moved, where that is known; `factor` carries SI units to `unit`.
fn bias_time(triad: &Triad, factor: f64, unit: &str) -> String {
    let Some(time) = &triad.bias_time else {
        return String::new();
    };
    let moved = |k: usize| {
        let scale = factor * triad.t[k][k].abs();
        format!(
            "{:+.2} ± {:.2}",
            scale * time.change[k],
            scale * time.change_std[k]
        )
    };
    format!(
        "the bias is the {}, t = {:.1} to {:.1} s; over that time it moved by {}, {}, {} {unit}\n",
        time.holds,
        time.from,
        time.to,
        moved(0),
        moved(1),
        moved(2)
    )
}

/// Returns the ratio of the residual to the noise within the intervals, in words.
pub fn over_noise(triad: &Triad) -> String {
    triad.reduced_chi2.map_or(String::new(), |chi2| {
        format!(" ({:.1} times the noise in the intervals)", chi2.sqrt())
    })
}

/// Header of [`parameters`].
pub const PARAMETERS: [&str; 4] = ["parameter", "value", "std error", "unit"];

fn triad_table(triad: &Triad, unit: &str, sensor: Sensor) -> comfy_table::Table {
    show::table_of(&PARAMETERS, parameters(triad, unit, sensor))
}

/// The coefficients of an effect: name, value, standard error and unit.
pub fn coefficients(effect: &EffectValues) -> impl Iterator<Item = [String; 4]> {
    effect.parameters.iter().map(|p| {
        let digits = |v: f64| format!("{v:.3e}");
        let std = p.std.map_or("fixed".into(), digits);
        [p.name.clone(), digits(p.value), std, p.unit.clone()]
    })
}

/// The parameters of a sensor's base model, a row each.
pub fn parameters(triad: &Triad, unit: &str, sensor: Sensor) -> Vec<[String; 4]> {
    let mut rows = Vec::new();
    for (name, (i, j)) in base_names(sensor).iter().zip(PLACES) {
        let (value, std) = (triad.t[i][j], triad.t_std[i][j]);
        let name = name.split_once('.').map_or(name.as_str(), |(_, own)| own);
        rows.push([
            name.to_owned(),
            show::value(value, std),
            show::error(std),
            String::new(),
        ]);
    }
    let biases =
        |rows: &mut Vec<[String; 4]>, suffix: &str, bias: &[f64; 3], std: &[Option<f64>; 3]| {
            for (k, axis) in ["x", "y", "z"].iter().enumerate() {
                rows.push([
                    format!("b_{axis}{suffix}"),
                    show::value(bias[k], std[k]),
                    show::error(std[k]),
                    unit.to_owned(),
                ]);
            }
        };
    if triad.recordings.is_empty() {
        biases(&mut rows, "", &triad.bias, &triad.bias_std);
    }
    let names: Vec<&str> = triad
        .recordings
        .iter()
        .map(|own| own.recording.as_str())
        .collect();
    for (own, name) in triad.recordings.iter().zip(short_names(&names)) {
        biases(&mut rows, &format!(" in {name}"), &own.bias, &own.bias_std);
    }
    rows
}
