//! Test for a part of the data in which a sensor has other scale factors and misalignments.

use faer::Mat;
use nalgebra::{DMatrix, DVector};
use sensor::{BasePart, PLACES, Sensor, base_names};

use crate::methods::chance;
use crate::methods::joint::blocks::basis::Basis;
use crate::methods::joint::blocks::columns::Columns;
use crate::methods::joint::fit::JointFit;
use crate::methods::joint::result::marginal::without;

findings::tuning! {
    /// Fewest static intervals of a recording whose halves are compared.
    FEWEST: usize = 16;

    /// A column of which the others leave less than this share of its length is one of them.
    DEPENDS: f64 = 1e-6;
}

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
        // What the misfit depends on besides is no difference of parts.
        let taken = Basis::of(&self.jacobian.beside(&self.carried));
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
        let has_halves = |k: &usize| self.rests_of(*k).len() >= FEWEST.get();
        let halves = (0..count).filter(has_halves).map(Portion::SecondHalf);
        recordings.map(Portion::Recording).chain(halves).collect()
    }

    fn rests_of(&self, recording: usize) -> Vec<usize> {
        let rests = self.data.rests.iter().enumerate();
        let own = rests.filter(|(_, rest)| rest.recording == recording);
        own.map(|(place, _)| place).collect()
    }

    fn rests_in(&self, part: Portion) -> Vec<usize> {
        match part {
            Portion::Recording(k) => self.rests_of(k),
            Portion::SecondHalf(k) => {
                let all = self.rests_of(k);
                all[all.len() / 2..].to_vec()
            }
        }
    }

    fn apart_in(&self, sensor: Sensor, part: Portion, taken: &Basis) -> Option<Apart> {
        let (names, scales) = self.scales_of(sensor);
        let wanted: Vec<Vec<usize>> = scales.into_iter().chain(self.biases_of(sensor)).collect();
        let columns = self.columns_in(&wanted, &self.rests_in(part));
        let left = taken.without(&columns).to_dense();
        let n = names.len();
        let lengths = columns.norms();
        let is_free = |k: &usize| left.col(*k).norm_l2() > DEPENDS.get() * lengths[*k];
        let biases: Vec<usize> = (n..wanted.len()).filter(is_free).collect();
        let biases = Mat::from_fn(left.nrows(), biases.len(), |i, k| left[(i, biases[k])]);
        let spare = self.residuals.len();
        let spare = spare.checked_sub(taken.rank() + n + biases.ncols())?;
        let residuals = Mat::from_fn(self.residuals.len(), 1, |i, _| self.residuals[i]);
        let change = Change::of(
            &without(&biases, &left.subcols(0, n).to_owned()),
            &without(&biases, &residuals),
            spare,
        )?;
        let (scales, angles): (Vec<usize>, Vec<usize>) =
            (0..n).partition(|k| BasePart::ScaleFactor.has(&names[*k]));
        let chances = [scales, angles];
        let chances = chances.iter().filter_map(|group| change.chance(group));
        // Two groups were tried.
        let p_value = chances.fold(1.0, |least: f64, p| least.min(2.0 * p));
        let most = (0..n).max_by(|a, b| change.times(*a).total_cmp(&change.times(*b)))?;
        let changes = names.into_iter().enumerate().map(|(k, name)| PartChange {
            parameter: name,
            size: change.size[k],
            std: change.std(k),
        });
        Some(Apart {
            sensor,
            part,
            changes: changes.collect(),
            most,
            p_value,
        })
    }

    /// The scale factors and misalignments of a sensor that are free, with their columns.
    fn scales_of(&self, sensor: Sensor) -> (Vec<String>, Vec<Vec<usize>>) {
        let names = base_names(sensor).into_iter().take(PLACES.len());
        let own = names.filter_map(|name| {
            let place = self.parameters.index(&name)?;
            let column = self.free.iter().position(|free| *free == place)?;
            Some((name, vec![column]))
        });
        own.unzip()
    }

    /// The columns of a sensor's biases by axis, those of all recordings.
    fn biases_of(&self, sensor: Sensor) -> [Vec<usize>; 3] {
        ["b_x", "b_y", "b_z"].map(|axis| {
            let common = format!("{}.{axis}", sensor.prefix());
            let is_it = |place: usize| {
                let other = self.parameters.names()[place].strip_prefix(&common);
                other.is_some_and(|end| end.is_empty() || end.starts_with('['))
            };
            let all = self.free.iter().enumerate();
            let own = all.filter(|(_, place)| is_it(**place));
            own.map(|(column, _)| column).collect()
        })
    }

    /// The sums of such columns where a row is of these `rests`, whitened.
    fn columns_in(&self, wanted: &[Vec<usize>], rests: &[usize]) -> Columns {
        let all: Vec<usize> = wanted.iter().flatten().copied().collect();
        let columns = self.white_jacobian.select(&all).to_dense();
        let ends = wanted.iter().scan(0, |end, own| {
            let from = *end;
            *end += own.len();
            Some(from..*end)
        });
        let spans: Vec<_> = ends.collect();
        let there = Mat::from_fn(columns.nrows(), wanted.len(), |i, k| {
            let all = spans[k].clone().map(|column| columns[(i, column)]);
            match rests.binary_search(&self.rest_of_row[i]) {
                Ok(_) => all.sum(),
                Err(_) => 0.0,
            }
        });
        let there = Columns::cut(&there, self.white_jacobian.groups());
        self.whitening.finish_columns(there)
    }
}

/// Parameters that a part has beside those of all, `c = −(XᵀX)⁻¹ Xᵀ r`.
struct Change {
    size: DVector<f64>,
    covariance: DMatrix<f64>,
    spare: usize,
}

impl Change {
    /// By columns `X` and residuals `r`, of which so many are beyond all parameters; `None` where the columns depend on each other.
    fn of(columns: &Mat<f64>, residuals: &Mat<f64>, spare: usize) -> Option<Self> {
        let n = columns.ncols();
        let (gram, moved) = (
            columns.transpose() * columns,
            columns.transpose() * residuals,
        );
        let gram = DMatrix::from_fn(n, n, |i, k| gram[(i, k)]);
        let inverse = gram.cholesky()?.inverse();
        let moved = DVector::from_fn(n, |i, _| moved[(i, 0)]);
        let size = -(&inverse * &moved);
        let rest = residuals.squared_norm_l2() + size.dot(&moved);
        (spare > 0 && rest > 0.0).then(|| Self {
            size,
            covariance: inverse * (rest / spare as f64),
            spare,
        })
    }

    fn std(&self, k: usize) -> f64 {
        self.covariance[(k, k)].sqrt()
    }

    /// The size in standard errors.
    fn times(&self, k: usize) -> f64 {
        (self.size[k] / self.std(k)).abs()
    }

    /// The chance of so large a change of a group of parameters, by an F test.
    fn chance(&self, group: &[usize]) -> Option<f64> {
        let covariance = self.covariance.select_rows(group).select_columns(group);
        let size = self.size.select_rows(group);
        let square = size.dot(&covariance.cholesky()?.solve(&size));
        let count = group.len() as f64;
        Some(chance::of_f(square / count, [count, self.spare as f64]))
    }
}
