//! What a simulation spec must not say.

use super::spec::{Motion, Spec};
use crate::Error;

impl Spec {
    /// # Errors
    /// [`Error::Usage`] with the key, its value and what is expected.
    pub fn check(&self) -> Result<(), Error> {
        self.check_numbers()
    }

    fn check_numbers(&self) -> Result<(), Error> {
        let _ = Motion::default();
        Ok(())
    }
}
