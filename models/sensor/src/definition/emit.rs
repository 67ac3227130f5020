//! A proposed formula as the source of an effect, in the form of those in the catalogue.

use std::fmt::Write as _;

use nalgebra::Vector3;

use super::formula::{Formula, Term};
use crate::axis::Axis;
use crate::covariate::Covariate;
use crate::definition::DefinitionError;
use crate::effect::AnyEffect;
use crate::kinematics::{Kinematics, REFERENCE_TEMPERATURE, Sensor, Since};

/// The source file of an effect called `name` that is `formula`.
///
/// Put into the `effects` folder of the sensor's crate as `name.rs`, with `mod name;` and
/// `pub use name::Name;` in `effects.rs` and `&Name` in its registry, it is one of the catalogue. It
/// holds a test and is laid out as `rustfmt` does.
///
/// # Errors
/// As [`Formula::effect`].
pub fn emit_effect(formula: &Formula, name: &str) -> Result<String, DefinitionError> {
    let effect = formula.effect(name)?;
    let parts = [
        head(formula),
        doc(formula, &*effect),
        implementation(formula, &*effect),
        test(formula, &*effect),
    ];
    Ok(parts.concat())
}

/// `gyro_swirl` as `GyroSwirl`.
fn type_name(name: &str) -> String {
    let capital = |word: &str| {
        let mut letters = word.chars();
        let first = letters.next().map(|c| c.to_ascii_uppercase());
        first.into_iter().chain(letters).collect::<String>()
    };
    name.split('_').map(capital).collect()
}

fn sensor_words(sensor: Sensor) -> (&'static str, &'static str, &'static str) {
    match sensor {
        Sensor::Accelerometer => ("an accelerometer", "Accelerometer", "m/s²"),
        Sensor::Gyroscope => ("a gyroscope", "Gyroscope", "rad/s"),
        Sensor::Magnetometer => ("a magnetometer", "Magnetometer", "µT"),
    }
}

fn covariates(formula: &Formula) -> Vec<Covariate> {
    let factors = formula.terms.iter().flat_map(|term| &term.factors);
    let mut all: Vec<Covariate> = factors.map(|factor| factor.covariate).collect();
    all.sort();
    all.dedup();
    all
}

fn head(formula: &Formula) -> String {
    let reference = match covariates(formula).contains(&Covariate::TemperatureChange) {
        true => "REFERENCE_TEMPERATURE, ",
        false => "",
    };
    format!(
        "//! An error of {} that was proposed from data.\n\n\
         use nalgebra::Vector3;\n\
         use sensor::{{Effect, Kinematics, Param, {reference}Sensor}};\n\
         use solver::{{Scalar, lit}};\n\n",
        sensor_words(formula.sensor).0
    )
}

fn doc(formula: &Formula, effect: &dyn AnyEffect) -> String {
    let (of, signal, unit) = sensor_words(formula.sensor);
    let mut text = format!("/// A sum of products in the reading of {of}:\n");
    for term in &formula.terms {
        let _ = writeln!(text, "/// `e_{} += {}`", term.axis, written(term));
    }
    text += "///\n/// | symbol | meaning | unit | shape |\n/// |---|---|---|---|\n";
    let _ = writeln!(
        text,
        "/// | `e` | {} error | {unit} | 3 |",
        signal.to_lowercase()
    );
    for (term, p) in formula.terms.iter().zip(effect.params()) {
        let unit = if p.unit.is_empty() { "1" } else { &p.unit };
        let axis = term.axis;
        let _ = writeln!(
            text,
            "/// | `{}` | coefficient on {axis} | {unit} | 1 |",
            p.name
        );
    }
    for covariate in covariates(formula) {
        let (meaning, unit) = covariate.meaning();
        let _ = writeln!(text, "/// | `{covariate}` | {meaning} | {unit} | 1 |");
    }
    text + "///\n/// Source: selected by its fit to recordings, not derived from a model of the sensor.\n"
}

/// `x_fx_fy2 fx fy²` as one would write it: coefficient, then factors.
fn written(term: &Term) -> String {
    let mut text = term.name();
    for factor in &term.factors {
        text += &format!(" {factor}");
    }
    text
}

fn implementation(formula: &Formula, effect: &dyn AnyEffect) -> String {
    let name = type_name(effect.name());
    let equation = format!("const EQUATION: &'static str = {:?};", effect.equation());
    // An axis per line where one line is too short: rustfmt leaves strings alone.
    let equation = match equation.chars().count() + 4 <= 100 {
        true => equation,
        false => equation.replace(", ", ", \\\n        "),
    };
    let truth = match covariates(formula).is_empty() {
        true => "_truth",
        false => "truth",
    };
    format!(
        "#[derive(Clone, Copy, Debug)]\n\
         pub struct {name};\n\n\
         impl Effect for {name} {{\n    \
             const NAME: &'static str = \"{}\";\n    \
             const SENSOR: Sensor = Sensor::{};\n    \
             {equation}\n    \
             const PARAMS: &'static [Param] = {};\n    \
             const TYPICAL: f64 = {};\n\n    \
             fn error<D: Scalar>(&self, {truth}: &Kinematics<D>, p: &[D]) -> Vector3<D> {{\n        \
                 let mut e = Vector3::from_element(lit(0.0));\n\
         {}        e\n    }}\n}}\n",
        effect.name(),
        sensor_words(formula.sensor).1,
        params(effect),
        size(effect.typical()),
        terms(formula),
    )
}

/// To two digits: a typical size is no more than that.
fn size(size: f64) -> String {
    format!("{size:.1e}")
}

/// The parameters, in one line where rustfmt would have them so.
fn params(effect: &dyn AnyEffect) -> String {
    let written = effect.params().iter().enumerate().map(|(k, p)| {
        let size = size(effect.typical_of(k));
        format!("Param::new({:?}, {:?}, 0.0).sized({size})", p.name, p.unit)
    });
    let all: Vec<String> = written.collect();
    match all.as_slice() {
        [one] if one.chars().count() <= 58 => format!("&[{one}]"),
        _ => format!("&[\n        {},\n    ]", all.join(",\n        ")),
    }
}

/// One statement per term: `e.x += p[0] * truth.specific_force.y * …;`
fn terms(formula: &Formula) -> String {
    let mut text = String::new();
    for (k, term) in formula.terms.iter().enumerate() {
        let mut product = vec![format!("p[{k}]")];
        for factor in &term.factors {
            let source = factor.covariate.source();
            product.extend((0..factor.power).map(|_| source.clone()));
        }
        text += &statement(term.axis, &product);
    }
    text
}

/// A statement in one line, or with a factor per line where it would be longer than rustfmt allows.
fn statement(axis: Axis, product: &[String]) -> String {
    let line = format!("        e.{axis} += {};\n", product.join(" * "));
    if line.trim_end().chars().count() <= 100 {
        return line;
    }
    let split = product.join("\n            * ");
    format!("        e.{axis} += {split};\n")
}

/// The motion that the emitted test looks at: small primes, so that no two terms can be confused.
fn probe() -> Kinematics<f64> {
    Kinematics {
        time: 2.0,
        temperature: REFERENCE_TEMPERATURE + 3.0,
        angular_acceleration: Vector3::new(29.0, 31.0, 37.0),
        vibration: Vector3::new(17.0, 19.0, 23.0),
        last_change: Vector3::new(1.0, -1.0, 1.0),
        temperature_rate: 41.0,
        warming: -1.0,
        last_turn: Vector3::new(43.0, 47.0, 53.0),
        since_turn: Since::at(59.0),
        ..Kinematics::new(Vector3::new(2.0, 3.0, 5.0), Vector3::new(7.0, 11.0, 13.0))
    }
}

/// The fields of an instant that few formulas look at, where this one does.
fn more(formula: &Formula, truth: &Kinematics<f64>) -> String {
    let used = covariates(formula);
    let looks_at = |wanted: fn(&Covariate) -> bool| used.iter().any(wanted);
    let fields = [
        (
            looks_at(|c| matches!(c, Covariate::TemperatureRate)),
            format!("temperature_rate: {:?}", truth.temperature_rate),
        ),
        (
            looks_at(|c| matches!(c, Covariate::Warming)),
            format!("warming: {:?}", truth.warming),
        ),
        (
            looks_at(|c| matches!(c, Covariate::LastTurn(_))),
            format!("last_turn: {}", vector(&truth.last_turn)),
        ),
        (
            looks_at(|c| matches!(c, Covariate::SinceTurn)),
            format!(
                "since_turn: sensor::Since::at({:?})",
                truth.since_turn.middle()
            ),
        ),
    ];
    let own = fields.into_iter().filter(|(used, _)| *used);
    own.map(|(_, field)| field + ",\n            ").collect()
}

fn test(formula: &Formula, effect: &dyn AnyEffect) -> String {
    let truth = probe();
    let p: Vec<f64> = (1..=formula.terms.len()).map(|k| k as f64).collect();
    let e = effect.error_f64(&truth, &p);
    let numbers: Vec<String> = p.iter().map(|v| format!("{v:?}")).collect();
    let numbers = match numbers.join(", ") {
        short if short.len() <= 60 => format!("[{short}]"),
        long => wrapped(&long),
    };
    let name = type_name(effect.name());
    format!(
        "\n#[cfg(test)]\nmod tests {{\n    use super::*;\n\n    #[test]\n    \
         fn each_term_is_its_coefficient_times_its_product() {{\n        \
         let truth = Kinematics {{\n            \
         time: {:?},\n            \
         temperature: {:?},\n            \
         angular_acceleration: {},\n            \
         vibration: {},\n            \
         last_change: {},\n            \
         {}..Kinematics::new({}, {})\n        \
         }};\n        \
         let e = {name}.error(&truth, &{numbers});\n        \
         let expected = {};\n        \
         assert!((e - expected).norm() <= 1e-14 * expected.norm());\n    }}\n}}\n",
        truth.time,
        truth.temperature,
        vector(&truth.angular_acceleration),
        vector(&truth.vibration),
        vector(&truth.last_change),
        more(formula, &truth),
        vector(&truth.specific_force),
        vector(&truth.angular_rate),
        vector(&e),
    )
}

/// A long array as rustfmt fills its lines.
fn wrapped(numbers: &str) -> String {
    let mut text = String::from("[\n            ");
    let mut width = 12;
    for number in numbers.split(", ") {
        let piece = format!("{number},");
        if width + piece.len() > 100 {
            text = text.trim_end().to_owned() + "\n            ";
            width = 12;
        }
        width += piece.len() + 1;
        text += &piece;
        text += " ";
    }
    text.trim_end().to_owned() + "\n        ]"
}

fn vector(v: &Vector3<f64>) -> String {
    format!("Vector3::new({:?}, {:?}, {:?})", v.x, v.y, v.z)
}
