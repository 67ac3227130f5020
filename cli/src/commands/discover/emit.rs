//! The proposed formula as the source of an effect.

use std::path::{Path, PathBuf};

use calib::discover::Findings;
use sensor::{Axis, Covariate, EffectRef, Formula, Sensor, Term, emit_effect};

use crate::exit::{BUG, Failure};
use crate::output::{Output, Replace};
use crate::show;

/// A claim on the file of an effect that bears the file's name.
#[derive(Debug)]
pub struct Emit {
    path: PathBuf,
    name: String,
    output: Output,
}

impl Emit {
    /// Claims `path`; the effects of `catalogue` have their names already.
    ///
    /// # Errors
    /// Status 2 for a file name that is not `some_name.rs` or the name of another effect; as [`Output::claim`].
    pub fn claim(
        path: &Path,
        replace: Replace,
        inputs: &[&Path],
        catalogue: &[EffectRef],
    ) -> Result<Self, Failure> {
        let name = name_in(path).ok_or_else(|| {
            refused(path, "the effect bears the file's name: a name in snake case with the ending .rs expected, such as gyro_proposed.rs")
        })?;
        if catalogue.iter().any(|effect| effect.name() == name) {
            return Err(refused(
                path,
                &format!("`{name}` is another effect already"),
            ));
        }
        let output = Output::claim(path, replace, inputs)?;
        Ok(Self {
            path: path.to_owned(),
            name,
            output,
        })
    }

    /// Writes the proposal; says so where there is none.
    ///
    /// # Errors
    /// As [`Output::write`].
    pub fn write(self, findings: &Findings) -> Result<(), Failure> {
        let Some(proposal) = &findings.proposed else {
            show::warn(&format!(
                "--emit-effect {}: not written: {}",
                show::path(&self.path),
                why_none(findings)
            ));
            return Ok(());
        };
        let source = emit_effect(&proposal.formula, &self.name)
            .map_err(|e| Failure::new(BUG, e.to_string()))?;
        self.output.write(source.as_bytes())
    }
}

fn why_none(findings: &Findings) -> &'static str {
    match findings.unexplained {
        None => "no formula is proposed, for nothing remains unexplained",
        Some(_) => {
            "no formula is proposed: no sum of a few products of covariates explains what remains, in this and in \
             intervals that the fit did not see"
        }
    }
}

fn refused(path: &Path, what: &str) -> Failure {
    Failure::usage(format!("--emit-effect {}: {what}", show::path(path)))
}

/// The name of the effect, where the file's is one.
fn name_in(path: &Path) -> Option<String> {
    let name = path.file_stem()?.to_str()?;
    let any = Term::new(Axis::X, &[(Covariate::Time, 1)], 1.0);
    let can_be = Formula::new(Sensor::Gyroscope, vec![any])
        .effect(name)
        .is_ok();
    (path.extension()? == "rs" && can_be).then(|| name.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_effect_bears_the_name_of_its_file() {
        let name = |path: &str| name_in(Path::new(path));
        assert_eq!(name("effects/gyro_swirl.rs").unwrap(), "gyro_swirl");
        for wrong in [
            "gyro_swirl",
            "gyro_swirl.toml",
            "Gyro.rs",
            "gyro-swirl.rs",
            ".rs",
        ] {
            assert_eq!(name(wrong), None, "{wrong}");
        }
    }
}
