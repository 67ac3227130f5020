//! The nonlinear regression problems of NIST's Statistical Reference Datasets.
//!
//! Source: National Institute of Standards and Technology, Statistical Reference Datasets,
//! nonlinear regression, <https://www.itl.nist.gov/div898/strd/nls/nls_main.shtml>.

mod data;
mod models;

pub use data::{Dataset, ReadError, default_folder};
pub use models::Model;

use std::path::Path;

use solver::{Parameters, Residual, Scalar, lit};

/// A data set with its model: residuals `model(x; b) − y`.
#[derive(Clone, Debug)]
pub struct Regression {
    /// Data, starts and certified values.
    pub data: Dataset,
    /// The model.
    pub model: Model,
}

impl Regression {
    /// Reads `DIR/NAME.dat`.
    ///
    /// # Errors
    /// A file that is missing or not in NIST's format.
    pub fn read(folder: &Path, name: &str, model: Model) -> Result<Self, ReadError> {
        Ok(Self {
            data: Dataset::read(&folder.join(format!("{name}.dat")))?,
            model,
        })
    }

    /// The 27 problems, from `*.dat` in `folder`.
    ///
    /// # Errors
    /// The first file that is missing or not in NIST's format.
    pub fn all(folder: &Path) -> Result<Vec<Self>, ReadError> {
        Model::ALL
            .iter()
            .map(|&(name, model)| Self::read(folder, name, model))
            .collect()
    }

    /// Parameters `b1 …` at start 1 or 2, or at the certified values (3).
    pub fn start(&self, number: usize) -> Parameters {
        let values = match number {
            1 => &self.data.starts[0],
            2 => &self.data.starts[1],
            _ => &self.data.certified,
        };
        let mut parameters = Parameters::new();
        for (k, &value) in values.iter().enumerate() {
            parameters.push(format!("b{}", k + 1), "", value);
        }
        parameters
    }

    /// Digits agreed with the certified values in the worst parameter, from 0 to 11 (the certified
    /// values carry eleven): `min −log₁₀(|b − c| / |c|)`.
    pub fn digits(&self, b: &[f64]) -> f64 {
        let each = b.iter().zip(&self.data.certified).map(|(b, c)| {
            let relative = (b - c).abs() / c.abs();
            if relative.is_nan() {
                0.0
            } else {
                (-relative.log10()).clamp(0.0, 11.0)
            }
        });
        each.fold(11.0, f64::min)
    }
}

impl<D: Scalar> Residual<D> for Regression {
    fn residuals(&self, b: &[D], out: &mut Vec<D>) {
        for row in &self.data.rows {
            let response = if self.model == Model::Nelson {
                row[0].ln()
            } else {
                row[0]
            };
            out.push(self.model.predict(b, &row[1..]) - lit::<D>(response));
        }
    }
}
