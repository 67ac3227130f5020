//! Test for a part of the data in which a sensor has other scale factors and misalignments.

use faer::Mat;
use nalgebra::{DMatrix, DVector};
use sensor::{PLACES, Sensor, base_names};
use statrs::distribution::{ContinuousCDF, FisherSnedecor};

use crate::methods::joint::blocks::basis::Basis;
use crate::methods::joint::blocks::columns::Columns;
use crate::methods::joint::fit::JointFit;
use crate::methods::joint::result::marginal::without;

/// Fewest static intervals of a recording whose halves are compared.
const FEWEST: usize = 16;

/// A column of which the others leave less than this share of its length is one of them.
const DEPENDS: f64 = 1e-6;

/// A part of the data.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Portion {
    /// A recording by its place, against the others.
    Recording(usize),
    /// The second half of a recording's static intervals, against the first.
    SecondHalf(usize),
}

/// A change of a parameter, near SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct PartChange {
    /// The parameter.
    pub parameter: String,
    /// Its value in the part less that in the others.
    pub size: f64,
    /// The standard error of that.
    pub std: f64,
}

/// A sensor that is another in a part of the data.
#[derive(Clone, Debug, PartialEq)]
pub struct Apart {
    /// The sensor.
    pub sensor: Sensor,
    /// The part.
    pub part: Portion,
    /// The changes of the scale factors and misalignments.
    pub changes: Vec<PartChange>,
    /// The place of the one that is the most standard errors.
    pub most: usize,
    /// Chance of so much difference of the scale factors, or of the misalignments, in one part.
    pub p_value: f64,
}

impl JointFit {
    /// The parts in which a sensor differs most from the others, for every sensor that recordings or halves of a recording
    /// determine, by the scale factors and misalignments that the fit would have with as many more for a part alone: an F test, as
    /// the misfit that they make is in the weights. Biases are free in every part.
    pub fn apart(&self) -> Vec<Apart> {
        let taken = Basis::of(&self.jacobian);
        let parts = self.parts();
        let both = [Sensor::Accelerometer, Sensor::Gyroscope].into_iter();
        let both = both.filter(|sensor| *sensor == Sensor::Accelerometer || self.has_gyroscope());
        both.flat_map(|sensor| parts.iter().map(move |part| (sensor, *part)))
            .filter_map(|(sensor, part)| self.apart_in(sensor, part, &taken))
            .collect()
    }

    fn parts(&self) -> Vec<Portion> {
        let count = self.data.sources.len();
        let recordings = match count {
            // The second against the first is the first against the second.
            2 => 1..2,
            1 => 0..0,
            _ => 0..count,
        };
        let has_halves = |k: &usize| self.rests_of(*k).len() >= FEWEST;
        let halves = (0..count).filter(has_halves).map(Portion::SecondHalf);
        recordings.map(Portion::Recording).chain(halves).collect()
    }

    fn rests_of(&self, recording: usize) -> Vec<usize> {
        let rests = self.data.rests.iter().enumerate();
        let own = rests.filter(|(_, rest)| rest.recording == recording);
        own.map(|(place, _)| place).collect()
    }

    fn apart_in(&self, sensor: Sensor, part: Portion, taken: &Basis) -> Option<Apart> {
        let there: Vec<usize> = match part {
            Portion::Recording(k) => self.rests_of(k),
            Portion::SecondHalf(k) => {
                let all = self.rests_of(k);
                all[all.len() / 2..].to_vec()
            }
        };
        let names = &base_names(sensor)[..PLACES.len()];
        let place = |name: &String| {
            let place = self.parameters.index(name)?;
            self.free.iter().position(|free| *free == place)
        };
        let own: Vec<&String> = names.iter().filter(|name| place(name).is_some()).collect();
        let scales = own.iter().filter_map(|name| Some(vec![place(name)?]));
        let biases = ["b_x", "b_y", "b_z"].map(|axis| {
            let common = format!("{}.{axis}", sensor.prefix());
            let names = self.parameters.names();
            let is_it = |name: &str| {
                let other = name.strip_prefix(&common);
                other.is_some_and(|end| end.is_empty() || end.starts_with('['))
            };
            let all = self.free.iter().enumerate();
            let all = all.filter(|(_, place)| is_it(&names[**place]));
            all.map(|(k, _)| k).collect()
        });
        let wanted: Vec<Vec<usize>> = scales.chain(biases).collect();
        let all: Vec<usize> = wanted.iter().flatten().copied().collect();
        let columns = self.white_jacobian.select(&all).to_dense();
        let ends = wanted.iter().scan(0, |end, own| {
            let from = *end;
            *end += own.len();
            Some(from..*end)
        });
        let spans: Vec<_> = ends.collect();
        let there = Mat::from_fn(columns.nrows(), wanted.len(), |i, k| {
            let is_there = there.binary_search(&self.rest_of_row[i]).is_ok();
            let all = spans[k].clone().map(|column| columns[(i, column)]);
            if is_there { all.sum() } else { 0.0 }
        });
        let whole = Columns::cut(&there, self.white_jacobian.groups());
        let whole = self.whitening.finish_columns(whole);
        let lengths = whole.norms();
        let left = taken.without(&whole).to_dense();
        let n = own.len();
        let free_bias = |k: &usize| left.col(*k).norm_l2() > DEPENDS * lengths[*k];
        let biases: Vec<usize> = (n..wanted.len()).filter(free_bias).collect();
        let biases = Mat::from_fn(left.nrows(), biases.len(), |i, k| left[(i, biases[k])]);
        let left = without(&biases, &left.subcols(0, n).to_owned());
        let residuals = Mat::from_fn(self.residuals.len(), 1, |i, _| self.residuals[i]);
        let residuals = without(&biases, &residuals);
        let (gram, moved) = (left.transpose() * &left, left.transpose() * &residuals);
        let inverse = DMatrix::from_fn(n, n, |i, k| gram[(i, k)])
            .cholesky()?
            .inverse();
        let change = -(&inverse * DVector::from_fn(n, |i, _| moved[(i, 0)]));
        let explained = -(0..n).map(|i| change[i] * moved[(i, 0)]).sum::<f64>();
        let spare = self
            .residuals
            .len()
            .saturating_sub(taken.rank() + n + biases.ncols());
        let rest = residuals.squared_norm_l2() - explained;
        if spare < 1 || rest <= 0.0 {
            return None;
        }
        let of_rest = rest / spare as f64;
        let (scales, angles): (Vec<usize>, Vec<usize>) =
            (0..n).partition(|k| own[*k].contains(".s_"));
        let both = [&scales, &angles].into_iter();
        let chances = both.filter_map(|group| {
            let covariance = inverse.select_rows(group).select_columns(group) * of_rest;
            let change = change.select_rows(group);
            let square = change.dot(&covariance.cholesky()?.solve(&change));
            let law = FisherSnedecor::new(group.len() as f64, spare as f64).ok()?;
            Some(2.0 * law.sf(square / group.len() as f64))
        });
        let p_value = chances.fold(1.0, f64::min);
        let changes = own.into_iter().enumerate().map(|(k, name)| PartChange {
            parameter: name.clone(),
            size: change[k],
            std: (inverse[(k, k)] * of_rest).sqrt(),
        });
        let changes: Vec<PartChange> = changes.collect();
        let times = |k: &usize| (changes[*k].size / changes[*k].std).abs();
        let most = (0..n).max_by(|a, b| times(a).total_cmp(&times(b)))?;
        Some(Apart {
            sensor,
            part,
            changes,
            most,
            p_value,
        })
    }
}
