//! MATLAB and Octave: a script that makes a struct and two functions.

use std::fmt::Write as _;

use nalgebra::Matrix3;
use sensor::Sensor;
use serde_json::Value;

use super::document::{document, matrix, not_applied, numbers};
use crate::error::Error;
use crate::kept::Kept;
use crate::source::Source;
use crate::target::{Form, Settings, Target, Written};

/// `cal.accelerometer.T` and so on with the keys of `cal.json`; `cal_accelerometer(A)` and `cal_gyroscope(W)` correct readings
/// in the rows of a matrix. With a g-sensitivity it is `cal_gyroscope(W, f)`, `f` as the first gives it.
pub const TARGET: Target = Target {
    name: "matlab",
    about: "a MATLAB or Octave script: the struct cal with all of cal.json, and functions for rows of readings",
    form: Form::File,
    keeps: Kept::all_of,
    write,
};

fn write(source: &Source<'_>, _: &Settings) -> Result<Written, Error> {
    let mut text = source.provenance("%");
    let _ = writeln!(text, "cal = {};", literal(&document(source)?));
    for (sensor, _) in source.bases() {
        let name = sensor.name();
        let g = source.g_sensitivity.filter(|_| sensor == Sensor::Gyroscope);
        let argument = if g.is_some() { ", force" } else { "" };
        let term = g.map(|g| format!(" - force * {}'", matrix_of(&g)));
        let _ = writeln!(
            text,
            "cal_{name} = @(raw{argument}) (raw - cal.{name}.bias) * cal.{name}.T'{};",
            term.unwrap_or_default()
        );
    }
    Ok(Written {
        notes: not_applied(source),
        ..Written::text(text)
    })
}

fn literal(value: &Value) -> String {
    if let Some(rows) = matrix(value) {
        return in_brackets(rows.iter().map(|row| row_of(row)));
    }
    if let Some(row) = numbers(value) {
        return format!("[{}]", row_of(&row));
    }
    match value {
        Value::Null => "[]".into(),
        Value::Bool(v) => v.to_string(),
        Value::Number(n) => number(n.as_f64().unwrap_or(f64::NAN)),
        Value::String(s) => string(s),
        Value::Array(all) => {
            let all: Vec<String> = all.iter().map(literal).collect();
            format!("{{{}}}", all.join(", "))
        }
        Value::Object(all) => {
            // In a list of fields a cell would make an array of structs: it stands in a cell of its own.
            let fields: Vec<String> = all
                .iter()
                .map(|(key, v)| format!("{}, {{{}}}", string(key), literal(v)))
                .collect();
            format!("struct({})", fields.join(", ...\n  "))
        }
    }
}

fn in_brackets(rows: impl Iterator<Item = String>) -> String {
    format!("[{}]", rows.collect::<Vec<_>>().join("; "))
}

fn matrix_of(m: &Matrix3<f64>) -> String {
    in_brackets(m.row_iter().map(|row| row_of(&[row[0], row[1], row[2]])))
}

fn row_of(row: &[f64]) -> String {
    let all: Vec<String> = row.iter().map(|v| number(*v)).collect();
    all.join(" ")
}

fn number(v: f64) -> String {
    if v.is_nan() {
        "NaN".into()
    } else {
        format!("{v:?}")
    }
}

/// A text of one line in single quotes, which are doubled in it.
fn string(s: &str) -> String {
    let kept = |c: char| if c.is_control() { ' ' } else { c };
    let text: String = s.chars().map(kept).collect();
    format!("'{}'", text.replace('\'', "''"))
}
