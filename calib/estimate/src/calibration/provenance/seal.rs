//! The hash of what corrects a reading: another one shows an edit.

use sha2::{Digest, Sha256};

use super::inputs::hexadecimal;
use crate::calibration::Calibration;

impl Calibration {
    /// Writes down the hash of gravity, both sensors and the effects.
    pub fn seal(&mut self) {
        self.provenance.numbers_sha256 = self.numbers();
    }

    /// Whether gravity, a sensor or an effect is not as it was written; `None` where no hash was.
    pub fn was_edited(&self) -> Option<bool> {
        let sealed = self.provenance.numbers_sha256.as_ref()?;
        Some(Some(sealed) != self.numbers().as_ref())
    }

    fn numbers(&self) -> Option<String> {
        let all = (
            self.gravity,
            &self.accelerometer,
            &self.gyroscope,
            &self.effects,
        );
        let mut text = serde_json::to_string(&all).ok()?;
        if let Some(magnetometer) = &self.magnetometer {
            text += &serde_json::to_string(magnetometer).ok()?;
        }
        Some(hexadecimal(&Sha256::digest(text)))
    }
}
