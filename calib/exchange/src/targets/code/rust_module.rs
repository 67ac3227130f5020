//! A Rust module without dependencies, `no_std`.

use std::fmt::Write as _;

use sensor::expression::Language;
use sensor::{Base, Sensor};

use crate::error::Error;
use crate::kept::Kept;
use crate::source::Source;
use crate::target::{Form, Settings, Target, Written};

use super::effects::{Effects, ROUNDS};

/// `f = T (A − b)` and `w = T (W − b) − G f` in `f64`.
pub const TARGET: Target = Target {
    name: "rust",
    about: "a Rust module: correct_accelerometer(raw) and correct_gyroscope(raw) in f64, and with effects; no dependencies",
    form: Form::File,
    keeps: |source| Kept {
        g_sensitivity: true,
        formulas: true,
        ..Kept::sensors_of(source)
    },
    write,
};

fn write(source: &Source<'_>, _: &Settings) -> Result<Written, Error> {
    let mut text = source.provenance("//");
    text.push_str(
        "// At rest specific force is +g on the axis that points up; rates are right-handed about each axis.\n\n",
    );
    for (sensor, base) in source.bases() {
        text.push_str(&module(source, sensor, base));
    }
    if let Some(effects) = Effects::of(source, Language::Rust) {
        text.push_str(&whole(&effects));
    }
    Ok(Written::text(text))
}

fn module(source: &Source<'_>, sensor: Sensor, base: &Base<f64>) -> String {
    let (name, unit) = match sensor {
        Sensor::Accelerometer => ("accelerometer", "m/s^2"),
        Sensor::Gyroscope => ("gyroscope", "rad/s"),
        Sensor::Magnetometer => ("magnetometer", source.field_unit()),
    };
    let upper = name.to_uppercase();
    let reading = source.unit(sensor).unwrap_or_default();
    let g = source.g_sensitivity.filter(|_| sensor == Sensor::Gyroscope);
    let b = base.bias;
    let mut text = format!(
        "/// Scale factors and misalignments of the {name}, {unit} per {reading}.\npub const {upper}_T: [[f64; 3]; 3] = \
         {};\n/// Its bias, {reading}.\npub const {upper}_BIAS: [f64; 3] = {:?};\n",
        matrix(&base.t),
        [b.x, b.y, b.z]
    );
    if let Some(g) = g {
        let _ = writeln!(
            text,
            "/// Sensitivity of the gyroscope to specific force, (rad/s)/(m/s^2).\npub const G_SENSITIVITY: [[f64; 3]; 3] = {};",
            matrix(&g)
        );
    }
    let (argument, rule, term) = match g {
        Some(_) => (
            ", force: [f64; 3]",
            "`T (raw - b) - G force`, `force` as `correct_accelerometer` gives it.",
            "\n            - (G_SENSITIVITY[i][0] * force[0] + G_SENSITIVITY[i][1] * force[1] + G_SENSITIVITY[i][2] * force[2])",
        ),
        None => ("", "`T (raw - b)`.", ""),
    };
    let _ = writeln!(
        text,
        "\n/// The corrected reading, {unit}: {rule}\npub fn correct_{name}(raw: [f64; 3]{argument}) -> [f64; 3] {{\n\
         \x20   let d = [0, 1, 2].map(|k: usize| raw[k] - {upper}_BIAS[k]);\n\
         \x20   [0, 1, 2].map(|i: usize| {{\n        {upper}_T[i][0] * d[0] + {upper}_T[i][1] * d[1] + {upper}_T[i][2] * d[2]{term}\n    }})\n}}\n"
    );
    text
}

/// Both sensors with the effects.
fn whole(effects: &Effects) -> String {
    let (mut arguments, mut first) = (String::new(), String::new());
    let (mut known, mut next) = (String::new(), String::new());
    for own in &effects.signals {
        let (name, base, signal) = (own.name, own.base, own.signal);
        let beside = if own.takes_force { ", [0.0; 3]" } else { "" };
        let _ = write!(arguments, "raw_{name}: [f64; 3], ");
        let _ = writeln!(
            first,
            "    let {base} = correct_{name}(raw_{name}{beside});\n    let mut {signal} = {base};"
        );
        for (component, axis) in &own.seen {
            let _ = writeln!(known, "        let {component} = {signal}[{axis}];");
        }
        for (axis, error) in own.errors.iter().enumerate() {
            let _ = writeln!(
                next,
                "        {signal}[{axis}] = {base}[{axis}] - ({error});"
            );
        }
    }
    let surroundings = effects.surroundings.iter();
    let surroundings: String = surroundings
        .map(|set| format!("    let {set};\n"))
        .collect();
    let signals: Vec<&str> = effects.signals.iter().map(|own| own.signal).collect();
    let (kind, value) = match signals.as_slice() {
        [one] => ("[f64; 3]", (*one).to_owned()),
        all => ("([f64; 3], [f64; 3])", format!("({})", all.join(", "))),
    };
    format!(
        "/// The whole calibration with the effects of the sensors: force in m/s^2 and rate in rad/s of one instant, at a temperature\n\
         /// in °C and a time since the first sample in s. The functions above leave the effects out.\n\
         #[allow(non_snake_case, unused_parens)]\n\
         pub fn correct({arguments}celsius: f64, seconds: f64) -> {kind} {{\n    let _ = (celsius, seconds);\n\
         {surroundings}{first}    for _ in 0..{ROUNDS} {{\n{known}{next}    }}\n    {value}\n}}\n"
    )
}

fn matrix(m: &nalgebra::Matrix3<f64>) -> String {
    let rows: Vec<String> = m
        .row_iter()
        .map(|r| format!("    [{:?}, {:?}, {:?}],\n", r[0], r[1], r[2]))
        .collect();
    format!("[\n{}]", rows.concat())
}
