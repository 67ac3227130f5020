//! A C header: constants and functions, C99 and C++.

use std::fmt::Write as _;

use findings::{Finding, Kind};
use nalgebra::{Matrix3, Vector3};
use sensor::expression::Language;
use sensor::{Base, Sensor};

use crate::error::Error;
use crate::kept::Kept;
use crate::source::Source;
use crate::target::{Form, Settings, Target, Written};

use super::effects::{Effects, ROUNDS};

/// Largest whole number that a 32-bit integer holds.
const LARGEST: f64 = 2_147_483_647.0;

/// Binary places of the integer functions: an accelerometer of 16 g has 5 mm/s² per count, so that its matrix keeps 18
/// bits, and a count of 2^15 times it needs 48.
const PLACES: i32 = 16;

/// `f = T (A − b)` in `float`, as `T A − T b`, and `w = T W − T b − G f`; of raw counts also in integers, mm/s² and µrad/s
/// by 16 binary places.
pub const TARGET: Target = Target {
    name: "c",
    about: "a C99 header: stillpoint_correct_accelerometer(raw, out) in float, in integers of raw counts, and with effects",
    form: Form::File,
    keeps: |source| Kept {
        g_sensitivity: true,
        formulas: true,
        ..Kept::sensors_of(source)
    },
    write,
};

fn write(source: &Source<'_>, _: &Settings) -> Result<Written, Error> {
    let mut text = String::from("/*\n");
    text.push_str(&source.provenance(" *"));
    text.push_str(
        " * at rest specific force is +g on the axis that points up; rates are right-handed about each axis\n */\n\
         #ifndef STILLPOINT_CALIBRATION_H\n#define STILLPOINT_CALIBRATION_H\n\n",
    );
    let effects = Effects::of(source, Language::C);
    text.push_str(match effects {
        Some(_) => "#include <math.h>\n#include <stdint.h>\n\n",
        None => "#include <stdint.h>\n\n",
    });
    for (sensor, base) in source.bases() {
        text.push_str(&function(source, sensor, base)?);
    }
    if let Some(effects) = effects {
        text.push_str(&whole(&effects));
    }
    text.push_str("#endif\n");
    Ok(Written::text(text))
}

fn function(source: &Source<'_>, sensor: Sensor, base: &Base<f64>) -> Result<String, Error> {
    let (name, unit, small) = match sensor {
        Sensor::Accelerometer => ("accelerometer", "m/s^2", "mm/s^2"),
        Sensor::Gyroscope => ("gyroscope", "rad/s", "urad/s"),
        Sensor::Magnetometer => ("magnetometer", source.field_unit(), "nT"),
    };
    let reading = source.unit(sensor).unwrap_or_default();
    let g = source.g_sensitivity.filter(|_| sensor == Sensor::Gyroscope);
    let argument = if g.is_some() {
        ", const float force[3]"
    } else {
        ""
    };
    let mut text = format!("/* raw in {reading}, out in {unit}: out = T raw - T b");
    text.push_str(match g {
        Some(_) => " - G force, force in m/s^2 as the accelerometer's function gives it */\n",
        None => " */\n",
    });
    let offset = base.t * base.bias;
    let _ = writeln!(
        text,
        "static inline void stillpoint_correct_{name}(const float raw[3]{argument}, float out[3])\n{{\n{}{}",
        table("float", "T", &base.t, single),
        row("float", "offset", &offset, single)
    );
    if let Some(g) = g {
        let _ = writeln!(text, "{}", table("float", "G", &g, single).trim_end());
    }
    let mut term =
        String::from("T[i][0] * raw[0] + T[i][1] * raw[1] + T[i][2] * raw[2] - offset[i]");
    if g.is_some() {
        term.push_str(
            "\n               - (G[i][0] * force[0] + G[i][1] * force[1] + G[i][2] * force[2])",
        );
    }
    let _ = writeln!(
        text,
        "    int i;\n    for (i = 0; i < 3; ++i) {{\n        out[i] = {term};\n    }}\n}}\n"
    );
    if reading == "count" && g.is_none() {
        let scale = match sensor {
            Sensor::Accelerometer => 1e3,
            Sensor::Gyroscope => 1e6,
            Sensor::Magnetometer => 1e3,
        };
        text.push_str(&integers(base, name, small, scale)?);
    }
    Ok(text)
}

/// Both sensors with the effects.
fn whole(effects: &Effects) -> String {
    let signals = || effects.signals.iter();
    let raw = signals().map(|own| format!("const float raw_{}[3]", own.name));
    let out = signals().map(|own| format!("float {}[3]", own.signal));
    let surroundings = ["float celsius", "float seconds"].map(str::to_owned);
    let arguments: Vec<String> = raw.chain(surroundings).chain(out).collect();
    let mut text = format!(
        "/* the whole calibration, with the effects of the sensors: temperature in deg C, time since the first sample in s,\n\
         \x20  force in m/s^2 and rate in rad/s of one instant; the functions above leave the effects out */\n\
         static inline void stillpoint_correct({})\n{{\n",
        arguments.join(",\n                                      ")
    );
    for set in &effects.surroundings {
        let _ = writeln!(text, "    const float {set};");
    }
    let (mut first, mut known, mut next) = (String::new(), String::new(), String::new());
    for own in signals() {
        let (name, base, signal) = (own.name, own.base, own.signal);
        let mut beside = "";
        if own.takes_force {
            text.push_str("    const float nothing[3] = {0.0f, 0.0f, 0.0f};\n");
            beside = "nothing, ";
        }
        let _ = writeln!(text, "    float {base}[3];");
        let _ = writeln!(
            first,
            "    stillpoint_correct_{name}(raw_{name}, {beside}{base});\n    \
             for (i = 0; i < 3; ++i) {{\n        {signal}[i] = {base}[i];\n    }}"
        );
        for (component, axis) in &own.seen {
            let _ = writeln!(known, "        const float {component} = {signal}[{axis}];");
        }
        for (axis, error) in own.errors.iter().enumerate() {
            let _ = writeln!(
                next,
                "        {signal}[{axis}] = {base}[{axis}] - ({error});"
            );
        }
    }
    let _ = writeln!(
        text,
        "    int i, round;\n    (void)celsius;\n    (void)seconds;\n{first}    \
         for (round = 0; round < {ROUNDS}; ++round) {{\n{known}{next}    }}\n}}\n"
    );
    text
}

/// The same for counts of 16 bits in integers.
fn integers(base: &Base<f64>, name: &str, unit: &str, scale: f64) -> Result<String, Error> {
    let factor = scale * 2f64.powi(PLACES);
    let t = (base.t * factor).map(f64::round);
    let offset = (base.t * base.bias * factor).map(f64::round);
    if t.amax() > LARGEST {
        let found = Finding::of(Kind::SCALE_BEYOND_INTEGERS)
            .detail("of", name)
            .detail("target", "C header")
            .detail("value", (base.t.amax() * scale).to_string());
        return Err(Error::format(found.detail("unit", unit)));
    }
    let whole = |v: f64| format!("{v}");
    Ok(format!(
        "/* raw counts, out in {unit}, rounded to the nearest */\n\
         static inline void stillpoint_correct_{name}_counts(const int16_t raw[3], int32_t out[3])\n{{\n{}{}    int i;\n\
         \x20   for (i = 0; i < 3; ++i) {{\n        int64_t sum = (int64_t)T[i][0] * raw[0] + (int64_t)T[i][1] * raw[1]\n\
         \x20                     + (int64_t)T[i][2] * raw[2] - offset[i];\n\
         \x20       /* rounds halves up; division truncates towards zero */\n\
         \x20       sum += INT64_C({half});\n\
         \x20       out[i] = (int32_t)(sum >= 0 ? sum / INT64_C({one}) : -((-sum + INT64_C({last})) / INT64_C({one})));\n    }}\n}}\n\n",
        table("int32_t", "T", &t, whole),
        row("int64_t", "offset", &offset, |v| format!("INT64_C({v})")),
        half = 1i64 << (PLACES - 1),
        one = 1i64 << PLACES,
        last = (1i64 << PLACES) - 1,
    ))
}

/// A number as a `float`.
fn single(v: f64) -> String {
    format!("{v:.9e}f")
}

fn table(kind: &str, name: &str, m: &Matrix3<f64>, number: impl Fn(f64) -> String) -> String {
    let rows: Vec<String> = m
        .row_iter()
        .map(|r| {
            format!(
                "        {{{}, {}, {}}}",
                number(r[0]),
                number(r[1]),
                number(r[2])
            )
        })
        .collect();
    format!(
        "    static const {kind} {name}[3][3] = {{\n{}\n    }};\n",
        rows.join(",\n")
    )
}

fn row(kind: &str, name: &str, v: &Vector3<f64>, number: impl Fn(f64) -> String) -> String {
    let [x, y, z] = [v.x, v.y, v.z].map(number);
    format!("    static const {kind} {name}[3] = {{{x}, {y}, {z}}};\n")
}
