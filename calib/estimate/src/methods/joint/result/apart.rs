//! Test for a recording in which the gyroscope has other scale factors and misalignments.

use faer::Mat;
use nalgebra::{DMatrix, DVector};
use sensor::{PLACES, Sensor, base_names};
use statrs::distribution::{ContinuousCDF, FisherSnedecor};

use crate::methods::joint::blocks::basis::Basis;
use crate::methods::joint::blocks::columns::Columns;
use crate::methods::joint::fit::JointFit;

/// A parameter that is another in one recording.
#[derive(Clone, Debug, PartialEq)]
pub struct Apart {
    /// The recording's place.
    pub recording: usize,
    /// The parameter that differs most, near SI units.
    pub parameter: String,
    /// Change of the parameter there against the other recordings.
    pub change: f64,
    /// Its standard error.
    pub std: f64,
    /// Chance of so much difference of all of them.
    pub p_value: f64,
}

impl JointFit {
    /// The recording whose gyroscope differs most from that of the others, by the scale factors and misalignments that the fit
    /// would have with nine more for it alone: an F test, as the misfit that they make is in the weights. `None` of a single
    /// recording, and where nothing is left to compare with.
    pub fn gyroscope_apart(&self) -> Option<Apart> {
        let recordings = self.data.sources.len();
        if recordings < 2 || !self.has_gyroscope() {
            return None;
        }
        let taken = Basis::of(&self.jacobian);
        let all = (0..recordings).filter_map(|recording| self.apart_in(recording, &taken));
        all.min_by(|a, b| a.p_value.total_cmp(&b.p_value))
    }

    fn apart_in(&self, recording: usize, taken: &Basis) -> Option<Apart> {
        let names = &base_names(Sensor::Gyroscope)[..PLACES.len()];
        let place = |k: usize| {
            let place = self.parameters.index(&names[k])?;
            Some((self.free.iter().position(|free| *free == place)?, k))
        };
        let (own, of): (Vec<usize>, Vec<usize>) = (0..names.len()).filter_map(place).unzip();
        let columns = self.white_jacobian.select(&own).to_dense();
        let is_there = |row: usize| self.data.rests[self.rest_of_row[row]].recording == recording;
        let there = Mat::from_fn(columns.nrows(), columns.ncols(), |i, k| {
            if is_there(i) { columns[(i, k)] } else { 0.0 }
        });
        let there = Columns::cut(&there, self.white_jacobian.groups());
        let left = taken
            .without(&self.whitening.finish_columns(there))
            .to_dense();
        let residuals = Mat::from_fn(self.residuals.len(), 1, |i, _| self.residuals[i]);
        let (gram, moved) = (left.transpose() * &left, left.transpose() * &residuals);
        let n = own.len();
        let inverse = DMatrix::from_fn(n, n, |i, k| gram[(i, k)])
            .cholesky()?
            .inverse();
        let change = -(&inverse * DVector::from_fn(n, |i, _| moved[(i, 0)]));
        let explained = -(0..n).map(|i| change[i] * moved[(i, 0)]).sum::<f64>();
        let spare = self.residuals.len() as f64 - taken.rank() as f64 - n as f64;
        let rest = residuals.squared_norm_l2() - explained;
        if spare < 1.0 || rest <= 0.0 {
            return None;
        }
        let (of_one, of_rest) = (explained / n as f64, rest / spare);
        let law = FisherSnedecor::new(n as f64, spare).ok()?;
        let std = |k: usize| (inverse[(k, k)] * of_rest).sqrt();
        let most = (0..n).max_by(|a, b| change[*a].abs().total_cmp(&change[*b].abs()))?;
        Some(Apart {
            recording,
            parameter: names[of[most]].clone(),
            change: change[most],
            std: std(most),
            p_value: law.sf(of_one / of_rest),
        })
    }
}
