//! The effects of a calibration with their parameters.

use effects::effect_named;
use findings::{Finding, Kind};
use recording::shown::shown;
use sensor::{Definition, DefinitionError, EffectRef};
use serde::{Deserialize, Serialize};

/// An effect and its parameters.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EffectValues {
    /// Name in the catalogue, or of `definition`.
    pub name: String,
    /// The text of an effect that is not in the catalogue.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub definition: Option<Definition>,
    /// Its parameters, in order.
    pub parameters: Vec<EffectParameter>,
    /// The effect itself, where it is compiled and in no catalogue of this program.
    #[serde(skip)]
    pub outside: Option<Outside>,
}

impl EffectValues {
    /// The effect: that of its definition, or of its name in the catalogue.
    ///
    /// # Errors
    /// What is wrong with the definition, or that there is no such effect.
    pub fn effect(&self) -> Result<EffectRef, Box<Finding>> {
        match &self.definition {
            Some(definition) if definition.name != self.name => {
                let found = Finding::of(Kind::DEFINITION_OF_OTHER)
                    .detail("effect", shown(&self.name))
                    .detail("other", shown(&definition.name));
                Err(Box::new(found))
            }
            Some(definition) => definition.effect().map_err(|error| {
                let key = format!("definition.{}", error.key);
                let fault = error.fault;
                Box::new(DefinitionError { key, fault }.into())
            }),
            None => effect_named(&self.name)
                .or_else(|| self.outside.as_ref().map(|outside| outside.0.clone()))
                .ok_or_else(|| {
                    let unknown = Finding::of(Kind::EFFECT_UNKNOWN);
                    Box::new(unknown.detail("effect", shown(&self.name)))
                }),
        }
    }
}

/// One parameter of an effect.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EffectParameter {
    /// Name within the effect.
    pub name: String,
    /// Value.
    pub value: f64,
    /// Standard error.
    pub std: Option<f64>,
    /// Unit.
    pub unit: String,
}

/// A compiled effect that is in no catalogue of this program. Two are the same where their names are.
#[derive(Clone, Debug)]
pub struct Outside(pub EffectRef);

impl PartialEq for Outside {
    fn eq(&self, other: &Self) -> bool {
        self.0.name() == other.0.name()
    }
}
