//! Effects that users define as expressions in a TOML file.
//!
//! ```toml
//! [[definitions]]
//! name = "accel_swirl"
//! sensor = "accelerometer"
//! x = "k * fy * fz"              # error of the axis in the sensor's unit; an axis left out has none
//! z = "c * exp(-t/tau)"
//! parameters = [
//!     { name = "k", unit = "1/(m/s^2)", typical = 1e-4 },
//!     { name = "c", unit = "m/s^2", typical = 1e-2 },
//!     { name = "tau", unit = "s", nominal = 60.0, typical = 60.0 },
//! ]
//! ```
//!
//! Variables are the names of [`sensor::Covariate`]: `fx fy fz` (m/s²), `wx wy wz` (rad/s),
//! `alphax alphay alphaz` (rad/s²), `vibrationx …` ((m/s²)²), `changex …` (−1, 0, 1), `t` (s), `T` (°C),
//! `dT` (`T` less 25 °C), `rateT` (K/s), `warming` (−1, 0, 1), `turnx …` (last turn, rad), `sinceturn` (s). An effect must be silent at its nominal parameters (0 where none is given).

use std::path::Path;

use findings::{Finding, Kind};
use recording::Error;
use recording::shown::shown_path;
use recording::toml_place::{at_key, not_toml};
use sensor::{Definition, DefinitionError, DefinitionFault, EffectRef};
use serde::{Deserialize, Serialize};

use crate::catalogue;

/// Content of an effect file.
#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct EffectFile {
    definitions: Vec<Definition>,
}

/// The effects of the file at `path`.
///
/// # Errors
/// [`Error::Io`] where it cannot be read, [`Error::Input`] as `file:line:column: key: …` for what is
/// not TOML, an unknown key, an expression that cannot be read, a name that is taken.
pub fn read_effects(path: &Path) -> Result<Vec<EffectRef>, Error> {
    let text = recording::read_text(path)?;
    parse_effects(&text, &shown_path(path))
}

/// The effects in `text`; `name` is what messages call the file.
///
/// # Errors
/// As [`read_effects`].
pub fn parse_effects(text: &str, name: &str) -> Result<Vec<EffectRef>, Error> {
    let file: EffectFile = toml::from_str(text).map_err(|e| {
        let found = not_toml(name, text, &e);
        Error::input(found)
    })?;
    effects_of(&file.definitions).map_err(|error| {
        let key = error.key.clone();
        Error::input(at_key(error.into(), name, text, &key))
    })
}

/// These definitions as the text of an effect file.
///
/// # Errors
/// [`Error::Usage`] where TOML cannot hold them.
pub fn to_toml(definitions: &[Definition]) -> Result<String, Error> {
    let definitions = definitions.to_vec();
    toml::to_string(&EffectFile { definitions })
        .map_err(|e| Error::usage(Finding::of(Kind::UNWRITABLE).detail("reason", e.to_string())))
}

/// The effects of `definitions`, with names that are neither in the catalogue nor there twice.
///
/// # Errors
/// The key of what is wrong, and what.
pub fn effects_of(definitions: &[Definition]) -> Result<Vec<EffectRef>, DefinitionError> {
    let mut effects: Vec<EffectRef> = Vec::new();
    for (k, definition) in definitions.iter().enumerate() {
        let effect = definition.effect().map_err(|e| DefinitionError {
            key: format!("definitions.{k}.{}", e.key),
            fault: e.fault,
        })?;
        let taken = catalogue_with(&effects).any(|other| other.name() == effect.name());
        if taken {
            return Err(DefinitionError {
                key: format!("definitions.{k}.name"),
                fault: DefinitionFault::EffectTaken(effect.name().to_owned()),
            });
        }
        effects.push(effect);
    }
    Ok(effects)
}

/// The catalogue with these effects after it.
pub fn catalogue_with(extra: &[EffectRef]) -> impl Iterator<Item = EffectRef> {
    catalogue().chain(extra.to_vec())
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;
    use sensor::{Axis, Covariate, Formula, Kinematics, Sensor, Term};

    use super::*;

    const SWIRL: &str = r#"
[[definitions]]
name = "accel_swirl"
sensor = "accelerometer"
x = "k * fy * fz"
parameters = [{ name = "k", unit = "1/(m/s^2)", typical = 1e-4 }]
"#;

    fn refused(text: &str) -> String {
        parse_effects(text, "a.toml").unwrap_err().to_string()
    }

    #[test]
    fn an_effect_file_adds_to_the_catalogue() {
        let effects = parse_effects(SWIRL, "a.toml").unwrap();
        let truth = Kinematics::at_rest(Vector3::new(0.0, 2.0, 3.0));
        assert_eq!(effects[0].error_f64(&truth, &[2.0]), Vector3::x() * 12.0);
        let all: Vec<_> = catalogue_with(&effects).collect();
        assert_eq!(all.len(), catalogue().count() + 1);
        assert_eq!(all[all.len() - 1].name(), "accel_swirl");
    }

    #[test]
    fn what_is_wrong_is_named_with_file_line_and_key() {
        let message = refused(&SWIRL.replace("fy", "fq"));
        let place = "a.toml:5:1: definitions.0.x: `k * fq * fz`, column 5: there is no `fq`";
        assert!(message.starts_with(place), "{message}");
        let message = refused(&SWIRL.replace("accel_swirl", "accel_cubic"));
        let place = "a.toml:3:1: definitions.0.name: `accel_cubic` is another effect already; choose another name";
        assert_eq!(message, place);
        assert!(
            refused(&format!("{SWIRL}{SWIRL}")).starts_with("a.toml:9:1: definitions.1.name: ")
        );
        let message = refused(&SWIRL.replace("x =", "q ="));
        assert!(
            message.starts_with(
                "a.toml:5:1: the program cannot read this place of the file: unknown field `q`"
            ),
            "{message}"
        );
        let message = refused(&SWIRL.replace("accelerometer", "acelerometer"));
        assert!(
            message.ends_with("did you mean `accelerometer`?"),
            "{message}"
        );
        assert!(refused("[[definition]]").ends_with("did you mean `definitions`?"));
    }

    #[test]
    fn a_formula_survives_the_way_through_a_file() {
        let term = Term::new(Axis::Z, &[(Covariate::AngularRate(Axis::X), 3)], 2e-4);
        let formula = Formula::new(Sensor::Gyroscope, vec![term]);
        let text = to_toml(&[formula.definition("gyro_proposed")]).unwrap();
        let read = parse_effects(&text, "a.toml").unwrap();
        let direct = formula.effect("gyro_proposed").unwrap();
        assert_eq!(read[0].definition(), direct.definition());
    }
}
