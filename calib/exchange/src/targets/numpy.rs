//! Python with NumPy: a module.

use std::fmt::Write as _;

use sensor::Sensor;
use serde_json::Value;

use super::document::{document, matrix, not_applied, numbers};
use crate::error::Error;
use crate::kept::Kept;
use crate::source::Source;
use crate::target::{Form, Settings, Target, Written};

/// `calibration`, a dictionary with the keys of `cal.json`, and `accelerometer(A)`, `gyroscope(W)` for readings in the rows of
/// an array. With a g-sensitivity it is `gyroscope(W, f)`, `f` as the first gives it.
pub const TARGET: Target = Target {
    name: "numpy",
    about: "a Python module: the dictionary calibration with all of cal.json in NumPy arrays, and functions",
    form: Form::File,
    keeps: Kept::all_of,
    write,
};

fn write(source: &Source<'_>, _: &Settings) -> Result<Written, Error> {
    let mut text = source.provenance("#");
    text.push_str("import numpy as np\n\n");
    let _ = writeln!(text, "calibration = {}", literal(&document(source)?));
    for (sensor, _) in source.bases() {
        let name = sensor.name();
        let g = source.g_sensitivity.filter(|_| sensor == Sensor::Gyroscope);
        let (argument, rule) = match g {
            Some(_) => (", force", "T (raw - b) - G force"),
            None => ("", "T (raw - b)"),
        };
        let term = g.map(|g| {
            let rows = g.row_iter().map(|row| list(&[row[0], row[1], row[2]]));
            let rows: Vec<String> = rows.collect();
            format!(" - np.asarray(force) @ np.array([{}]).T", rows.join(", "))
        });
        let _ = write!(
            text,
            "\n\ndef {name}(raw{argument}):\n    \"\"\"{rule} of readings in rows.\"\"\"\n    own = calibration[\"{name}\"]\n    \
             return (np.asarray(raw) - own[\"bias\"]) @ own[\"T\"].T{}\n",
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
        let rows: Vec<String> = rows.iter().map(|row| list(row)).collect();
        return format!("np.array([{}])", rows.join(", "));
    }
    if let Some(row) = numbers(value).filter(|row| !row.is_empty()) {
        return format!("np.array({})", list(&row));
    }
    match value {
        Value::Null => "None".into(),
        Value::Bool(v) => if *v { "True" } else { "False" }.into(),
        // JSON's escapes are Python's.
        Value::String(_) | Value::Number(_) => value.to_string(),
        Value::Array(all) => {
            let all: Vec<String> = all.iter().map(literal).collect();
            format!("[{}]", all.join(", "))
        }
        Value::Object(all) => {
            let entries: Vec<String> = all
                .iter()
                .map(|(key, v)| format!("{}: {}", Value::String(key.clone()), literal(v)))
                .collect();
            format!("{{{}}}", entries.join(",\n    "))
        }
    }
}

fn list(row: &[f64]) -> String {
    let number = |v: &f64| {
        if v.is_nan() {
            "np.nan".into()
        } else {
            format!("{v:?}")
        }
    };
    let all: Vec<String> = row.iter().map(number).collect();
    format!("[{}]", all.join(", "))
}
