//! A spec from a TOML text, with errors that name the line.

use findings::{Finding, Kind};
use recording::Error;
use recording::toml_place::{at_key, not_toml};

use super::complaint::Complaint;
use super::{OwnEffects, Spec};

/// A spec that shows what can be said, with comments.
pub const EXAMPLE: &str = include_str!("example.toml");

impl Spec {
    /// The spec in `text`; `name` is what messages call the file.
    ///
    /// # Errors
    /// [`Error::Input`] as `name:line:column: key: …` for what is not TOML, an unknown key (with the
    /// nearest known one), and a value that makes no sense.
    pub fn from_toml(text: &str, name: &str) -> Result<Self, Error> {
        Self::from_toml_with(text, name, OwnEffects::default())
    }

    /// The spec in `text`, which may name effects of another crate.
    ///
    /// # Errors
    /// As [`Spec::from_toml`].
    pub fn from_toml_with(text: &str, name: &str, own: OwnEffects) -> Result<Self, Error> {
        let mut spec: Self = toml::from_str(text).map_err(|e| {
            let found = not_toml(name, text, &e);
            Error::input(found)
        })?;
        spec.own = own;
        match spec.complaint() {
            None => Ok(spec),
            Some(Complaint { key, what }) => Err(Error::input(at_key(*what, name, text, &key))),
        }
    }

    /// The spec as a TOML text that [`Spec::from_toml`] reads back.
    ///
    /// # Errors
    /// [`Error::Usage`] for a seed above 2⁶³ − 1, which TOML cannot hold.
    pub fn to_toml(&self) -> Result<String, Error> {
        let unwritable = |e: toml::ser::Error| {
            Error::usage(Finding::of(Kind::UNWRITABLE).detail("reason", e.to_string()))
        };
        toml::to_string(self).map_err(unwritable)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(text: &str) -> String {
        Spec::from_toml(text, "a.toml").unwrap_err().to_string()
    }

    #[test]
    fn a_misspelled_key_is_named_with_its_line_and_the_nearest_key() {
        let message = refused("seed = 1\nrtae = 3\n");
        assert!(
            message.starts_with(
                "a.toml:2:1: the program cannot read this place of the file: unknown field `rtae`"
            ),
            "{message}"
        );
        assert!(message.ends_with("did you mean `rate`?"), "{message}");
        let message = refused("seed = 1\n[motion.hand_held]\nplacments = 30\n");
        assert!(message.starts_with("a.toml:3:1: "), "{message}");
        assert!(message.ends_with("did you mean `placements`?"), "{message}");
        let message = refused("grade = \"consumr\"");
        assert!(message.ends_with("did you mean `consumer`?"), "{message}");
    }

    #[test]
    fn a_misspelled_effect_or_parameter_is_named_with_its_line() {
        let message = refused("[effects.gyro_drfit]\nx = 1e-6\n");
        let expected = "a.toml:1:10: effects.gyro_drfit: there is no such effect (source of error); \
                        did you mean `gyro_drift`?";
        assert_eq!(message, expected);
        let message = refused("[effects.gyro_warmup]\nx = 1e-6\ntua = 3.0\n");
        assert!(
            message.starts_with("a.toml:3:1: effects.gyro_warmup.tua: "),
            "{message}"
        );
        assert!(message.ends_with("did you mean `tau`?"), "{message}");
        let message = refused("[parameters]\n\"accel.s_q\" = 1.0\n");
        assert!(
            message.starts_with("a.toml:2:1: parameters.accel.s_q: "),
            "{message}"
        );
    }

    #[test]
    fn a_number_out_of_range_is_named_with_its_line_and_the_range() {
        assert_eq!(
            refused("\nrate = -3"),
            "a.toml:2:1: rate: is -3, expected 0.01 to 100000; correct the value"
        );
        let message = refused("[motion.hand_held]\nrest = [8.0, 6.0]\n");
        assert!(
            message.starts_with("a.toml:2:1: motion.hand_held.rest: is 6"),
            "{message}"
        );
        let message = refused("[[faults]]\ngap = { start = 1.0, length = -1.0 }");
        assert!(
            message.starts_with("a.toml:2:22: faults.0.gap.length: is -1"),
            "{message}"
        );
        assert!(refused("gravity = nan").contains("is NaN"));
    }

    #[test]
    fn what_is_not_toml_is_an_input_error() {
        for text in [
            "rate =",
            "[motion",
            "rate = 1\nrate = 2",
            "\u{feff}\0",
            "seed = -1",
            "= 3",
        ] {
            assert!(
                matches!(Spec::from_toml(text, "a"), Err(Error::Input(_))),
                "{text:?}"
            );
        }
    }

    #[test]
    fn the_example_runs() {
        let spec = Spec::from_toml(EXAMPLE, "example.toml").unwrap();
        let session = spec.run().unwrap();
        let effects = [
            "accel_warmup",
            "accel_temperature",
            "accel_swirl",
            "gyro_g_sensitivity",
            "earth_rate",
        ];
        assert_eq!(session.truth.effects, effects);
        assert_eq!(session.truth.get("accel.s_x"), Some(1.01));
        assert_eq!(session.truth.get("accel_warmup.tau"), Some(90.0));
    }

    #[test]
    fn a_spec_survives_the_way_through_toml() {
        let mut spec = Spec::hand_held(9)
            .with_effect("accel_temperature", 2.0)
            .with_effect("accel_vibration_rectification", 1.0);
        spec.parameters.insert("gyro.b_x".into(), 0.01);
        spec.faults.push(crate::Fault::Gap {
            start: 3.0,
            length: 0.5,
        });
        let text = spec.to_toml().unwrap();
        assert_eq!(Spec::from_toml(&text, "a.toml").unwrap(), spec);
    }
}
