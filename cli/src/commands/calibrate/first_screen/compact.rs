//! The matrices and biases of a calibration in one table, in the units that people use.

use std::cmp::Ordering;

use calib::Calibration;
use calib::calibration::{EffectParameter, EffectValues, Triad};
use sensor::{PLACES, Sensor, base_names};

use crate::commands::calibrate::field::field_unit;
use crate::pages::parameters::overall;
use crate::pages::session::short_names;
use crate::{show, terminal};

const AXES: [&str; 3] = ["x", "y", "z"];

/// A sensor as the table has it.
struct Shown<'a> {
    name: &'static str,
    sensor: Sensor,
    triad: &'a Triad,
    /// People's unit of the bias, and how many of it make that of the corrected readings.
    bias: (&'static str, f64),
}

fn sensors(calibration: &Calibration) -> Vec<Shown<'_>> {
    let of = |name, sensor, bias| {
        let triad = calibration.triad(sensor)?;
        Some(Shown {
            name,
            sensor,
            triad,
            bias,
        })
    };
    let all = [
        of("accel", Sensor::Accelerometer, ("mm/s²", 1e3)),
        of(
            "gyro",
            Sensor::Gyroscope,
            ("°/h", 3600.0 * 1f64.to_degrees()),
        ),
        of("mag", Sensor::Magnetometer, (field_unit(calibration), 1.0)),
    ];
    all.into_iter().flatten().collect()
}

/// The table, and what has to be said of its units; empty where no sensor was calibrated.
pub fn text(calibration: &Calibration) -> String {
    let all = sensors(calibration);
    if all.is_empty() {
        return String::new();
    }
    let mut rows: Vec<[String; 5]> = all.iter().flat_map(rows).collect();
    let (of_biases, apart) = biases(&all);
    let header = [
        "± 1 σ".into(),
        "scale, ppm".into(),
        "misalignment,".into(),
        "mrad".into(),
        of_biases,
    ];
    if 4 + widths(&header, &rows).iter().sum::<usize>() > terminal::width() {
        let cells = rows.iter_mut().flatten();
        cells.for_each(|cell| *cell = cell.replace(" ± ", "±"));
    }
    let widths = widths(&header, &rows);
    // Two columns between the cells where the terminal has them.
    let wide = 2 + widths.iter().sum::<usize>() + 2 * (widths.len() - 1) <= terminal::width();
    let between = if wide { "  " } else { " " };
    let line = |row: &[String; 5]| {
        let [a, b, c, d, e] = row;
        let [wa, wb, wc, wd, we] = widths;
        // The heading of the two columns of angles is one.
        let gap = if row == &header { " " } else { between };
        let wd = wd + between.len() - gap.len();
        let indent = if wide { "  " } else { "" };
        format!("{indent}{a:<wa$}{between}{b:>wb$}{between}{c:>wc$}{gap}{d:<wd$}{between}{e:>we$}")
    };
    let mut lines: Vec<String> = std::iter::once(&header).chain(&rows).map(line).collect();
    lines.extend(apart);
    lines.extend(calibration.effects.iter().filter_map(effect));
    lines.extend(all.iter().filter_map(of_counts));
    lines.join("\n")
}

/// An effect by the parameter that is known best beside its size.
fn effect(values: &EffectValues) -> Option<String> {
    let beside = |p: &&EffectParameter| Some(p.value.abs() / p.std.filter(|std| *std > 0.0)?);
    let known = values.parameters.iter().filter(|p| beside(p).is_some());
    let best = known.max_by(|a, b| beside(a).partial_cmp(&beside(b)).unwrap_or(Ordering::Equal))?;
    let more = match values.parameters.len() - 1 {
        0 => String::new(),
        more => format!(", {more} more with -v"),
    };
    let (name, size) = (
        show::name(&values.name),
        show::with_error(best.value, best.std),
    );
    Some(format!(
        "  {name}: {} {size} {}{more}",
        best.name, best.unit
    ))
}

/// The columns that the cells of each take.
fn widths(header: &[String; 5], rows: &[[String; 5]]) -> [usize; 5] {
    [0, 1, 2, 3, 4].map(|k| {
        let cells = std::iter::once(header).chain(rows);
        cells.map(|row| row[k].chars().count()).max().unwrap_or(0)
    })
}

/// The heading of the biases, and a line where they are not of the same recordings for each sensor.
fn biases(all: &[Shown<'_>]) -> (String, Option<String>) {
    let said = |shown: &Shown<'_>| Some((shown.name, of_which(shown)?));
    let each: Vec<(&str, String)> = all.iter().filter_map(said).collect();
    let are_alike = each.windows(2).all(|pair| pair[0].1 == pair[1].1);
    match each.first() {
        None => ("bias".into(), None),
        Some((_, of)) if are_alike => (format!("bias, {of}"), None),
        Some(_) => {
            let each: Vec<String> = each
                .iter()
                .map(|(name, of)| format!("{name} {of}"))
                .collect();
            ("bias".into(), Some(format!("  bias: {}", each.join(", "))))
        }
    }
}

/// `mean of 3` or `of rec_3`, where each recording has a bias of its own.
fn of_which(shown: &Shown<'_>) -> Option<String> {
    let own = &shown.triad.recordings;
    let names: Vec<&str> = own.iter().map(|r| r.recording.as_str()).collect();
    let last = short_names(&names).pop()?;
    Some(match shown.triad.has_mean_bias() {
        true => format!("mean of {}", names.len()),
        false => format!("of {last}"),
    })
}

fn of_counts(shown: &Shown<'_>) -> Option<String> {
    let unit = match shown.sensor {
        Sensor::Accelerometer => "m/s²",
        Sensor::Gyroscope => "rad/s",
        Sensor::Magnetometer => return None,
    };
    let scale = overall(shown.triad);
    (scale != 1.0).then(|| {
        format!(
            "  {}: ppm of {scale:.5e} {unit} per unit of its readings",
            shown.name
        )
    })
}

fn rows(shown: &Shown<'_>) -> [[String; 5]; 3] {
    let Shown {
        name,
        sensor,
        triad,
        bias: (unit, factor),
    } = shown;
    let scale = overall(triad);
    let names = base_names(*sensor);
    [0, 1, 2].map(|i| {
        let s = 1e6 * (triad.t[i][i] / scale - 1.0);
        let angles = PLACES
            .iter()
            .zip(&names)
            .filter_map(|((row, column), name)| {
                let is_own = *row == i && column != row;
                let std = triad.t_std[*row][*column];
                let value = 1e3 * triad.t[*row][*column] / scale;
                // One that the choice of the axes makes zero says nothing.
                let says = is_own && (std.is_some() || value != 0.0);
                let (_, angle) = name.rsplit_once('_')?;
                says.then(|| {
                    format!(
                        "{angle} {}",
                        show::with_error(value, std.map(|v| 1e3 * v / scale))
                    )
                })
            });
        let mut angles = angles.collect::<Vec<String>>().into_iter();
        let bias = factor * scale * triad.bias[i];
        let bias_std = triad.bias_std[i].map(|v| factor * scale * v);
        [
            format!("{name} {}", AXES[i]),
            match triad.t_std[i][i] {
                None if s == 0.0 => "–".into(),
                std => show::with_error(s, std.map(|v| 1e6 * v / scale)),
            },
            angles.next().unwrap_or_default(),
            angles.next().unwrap_or_default(),
            format!("{} {unit}", show::with_error(bias, bias_std)),
        ]
    })
}
