//! The hashes of a calibration as it was written: other ones show an edit.

use findings::{Finding, Kind};
use serde::Serialize;
use sha2::{Digest, Sha256};

use super::inputs::{Provenance, hexadecimal};
use crate::calibration::Calibration;

/// The part of a calibration that is not as it was written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Edited {
    /// Gravity, a sensor or an effect: what corrects a reading.
    Numbers,
    /// Method, covariance, gates, inputs or another entry that says what the numbers are worth.
    Basis,
}

impl Edited {
    /// The same as a finding.
    pub fn finding(self) -> Finding {
        Finding::of(match self {
            Self::Numbers => Kind::NUMBERS_EDITED,
            Self::Basis => Kind::BASIS_EDITED,
        })
    }

    /// The same in words.
    pub fn in_words(self) -> String {
        self.finding().to_string()
    }
}

impl Calibration {
    /// Writes down the hashes of what corrects a reading and of everything that says what that is worth.
    pub fn seal(&mut self) {
        self.provenance.numbers_sha256 = self.numbers();
        self.provenance.basis_sha256 = self.basis();
    }

    /// The same after a change, but not of a calibration that had been edited: it stays so.
    pub fn seal_again(&mut self, before: &Self) {
        if before.edited().is_none() {
            self.seal();
        }
    }

    /// The part that is not as it was written; `None` where all is or no hash was.
    pub fn edited(&self) -> Option<Edited> {
        let differs = |sealed: &Option<String>, now: fn(&Self) -> Option<String>| {
            sealed.is_some() && *sealed != now(self)
        };
        let Provenance {
            numbers_sha256,
            basis_sha256,
            ..
        } = &self.provenance;
        if differs(numbers_sha256, Self::numbers) {
            Some(Edited::Numbers)
        } else if differs(basis_sha256, Self::basis) {
            Some(Edited::Basis)
        } else {
            None
        }
    }

    /// Returns true if gravity, a sensor or an effect was edited; `None` where the file has no hash.
    pub fn was_edited(&self) -> Option<bool> {
        self.provenance.numbers_sha256.as_ref()?;
        Some(self.edited() == Some(Edited::Numbers))
    }

    /// Computes the hash of gravity, the sensors and the effects.
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
        if !self.scalars.is_empty() {
            text += &serde_json::to_string(&self.scalars).ok()?;
        }
        Some(hexadecimal(&Sha256::digest(text)))
    }

    /// Computes the hash of everything else that decides what the calibration is used for. A new field has to be put among
    /// those that decide or those that do not.
    fn basis(&self) -> Option<String> {
        let Self {
            gravity_source,
            method,
            magnetic_field,
            parameters,
            covariance,
            misfit,
            left_out,
            failed_gates,
            not_calibrated,
            limits,
            prior,
            clocks,
            history,
            provenance,
            // In the hash of the numbers.
            gravity: _,
            accelerometer: _,
            gyroscope: _,
            magnetometer: _,
            scalars: _,
            effects: _,
            // Words and names.
            schema: _,
            created_by: _,
            warnings: _,
            next: _,
        } = self;
        let Provenance {
            sign_convention,
            inputs,
            options,
            version: _,
            numbers_sha256: _,
            basis_sha256: _,
        } = provenance;
        let mut hash = Sha256::new();
        add(&mut hash, &(gravity_source, method, magnetic_field))?;
        add(&mut hash, &(parameters, covariance, misfit, left_out))?;
        // Words may change from version to version: a gate counts by its kind, one without a kind by its text.
        let gate = |gate: &Finding| gate.own_text().unwrap_or(gate.kind.name()).to_owned();
        let failed_gates: Vec<String> = failed_gates.iter().map(gate).collect();
        add(&mut hash, &(failed_gates, limits, prior, clocks, history))?;
        for own in not_calibrated {
            add(
                &mut hash,
                &(own.sensor.name(), own.reason, own.bias, own.bias_std),
            )?;
        }
        add(&mut hash, &(sign_convention, inputs, options))?;
        Some(hexadecimal(&hash.finalize()))
    }
}

fn add(hash: &mut Sha256, part: &impl Serialize) -> Option<()> {
    hash.update(serde_json::to_string(part).ok()?);
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::calibration::BiasUpdate;
    use crate::calibration::gravity::tests::perfect;
    use crate::gravity::GravitySource;

    fn written_and_read(calibration: &Calibration) -> Calibration {
        let text = serde_json::to_string(calibration).unwrap();
        serde_json::from_str(&text).unwrap()
    }

    #[test]
    fn every_entry_that_decides_is_under_a_seal() {
        let whole = written_and_read(&perfect());
        assert_eq!(whole.edited(), None);
        type Edit = fn(&mut Calibration);
        let edits: [(Edit, Edited); 8] = [
            (|c| c.gravity += 1e-4, Edited::Numbers),
            (|c| c.method = "joint".into(), Edited::Basis),
            (|c| c.covariance[0][0] += 0.5, Edited::Basis),
            (|c| c.parameters[0] = "accel.s_q".into(), Edited::Basis),
            (|c| c.gravity_source = GravitySource::Assumed, Edited::Basis),
            (|c| c.failed_gates.push("a gate"), Edited::Basis),
            (|c| c.history.clear(), Edited::Basis),
            (|c| c.provenance.sign_convention.clear(), Edited::Basis),
        ];
        for (k, (edit, found)) in edits.into_iter().enumerate() {
            let mut edited = whole.clone();
            edited.history.push(BiasUpdate {
                sensor: "accel".into(),
                recording: "r".into(),
                rests: 1,
                bias_before: [0.0; 3],
                bias: [0.0; 3],
            });
            edited.seal();
            edit(&mut edited);
            assert_eq!(written_and_read(&edited).edited(), Some(found), "edit {k}");
            // What is done to it afterwards does not hide it.
            let mut later = edited.clone();
            later.seal_again(&edited);
            assert_eq!(later.edited(), Some(found), "edit {k}");
        }
    }

    #[test]
    fn files_of_before_verify_by_the_hash_that_they_have() {
        let mut old = perfect();
        old.provenance.basis_sha256 = None;
        assert_eq!(written_and_read(&old).edited(), None);
        old.bias_moved();
        assert_eq!(written_and_read(&old).edited(), Some(Edited::Numbers));
        old.provenance.numbers_sha256 = None;
        assert_eq!(written_and_read(&old).edited(), None);
    }

    impl Calibration {
        fn bias_moved(&mut self) {
            if let Some(triad) = &mut self.accelerometer {
                triad.bias[0] += 0.1;
            }
        }
    }
}
