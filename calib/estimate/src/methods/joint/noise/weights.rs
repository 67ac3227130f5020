//! From the noise of the rows to residuals of unit variance.

use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::{Mat, MatMut, Par, Side};
use nalgebra::DMatrix;

use super::chain::Chain;
use super::exposure::Exposure;
use crate::methods::earth::EARTH_COMPONENT;
use crate::methods::joint::blocks::column::Column;
use crate::methods::joint::blocks::columns::Columns;
use crate::methods::joint::blocks::covariance::{Covariance, combined, independent};
use crate::methods::joint::blocks::groups::RowGroups;
use crate::methods::joint::noise::rows::RowNoise;

findings::tuning! {
    /// Error of the integration over a turn that is always granted, rad: what the coning terms leave out.
    INTEGRATION: f64 = 1e-8;
}

/// Whitening by the white noise alone: independent rows, and the two rows of each turn.
#[derive(Clone, Debug)]
pub struct White {
    /// Diagonal of the Cholesky factor (`m`).
    diagonal: Vec<f64>,
    /// Its entries beside the diagonal (`m`).
    beside: Vec<f64>,
    /// The rows of the recordings.
    groups: RowGroups,
}

impl White {
    /// Builds the whitening of these rows, the turns' from `first_turn` on.
    pub fn new(noise: &RowNoise, first_turn: usize) -> Self {
        let m = noise.variance.len();
        let (mut diagonal, mut beside) = (vec![0.0; m], vec![0.0; m]);
        for i in 0..m {
            let extra = if i >= first_turn {
                INTEGRATION.get().powi(2)
            } else {
                0.0
            };
            if noise.with_before[i] != 0.0 {
                beside[i] = noise.with_before[i] / diagonal[i - 1];
            }
            diagonal[i] = (noise.variance[i] + extra - beside[i] * beside[i])
                .max(f64::MIN_POSITIVE)
                .sqrt();
        }
        Self {
            diagonal,
            beside,
            groups: noise.groups.clone(),
        }
    }

    /// The rows of the recordings.
    pub fn groups(&self) -> &RowGroups {
        &self.groups
    }

    /// `L⁻¹ A` (`m × k`) of columns with few entries.
    pub fn sparse(&self, columns: &[&Column]) -> Columns {
        let mut columns = Columns::sparse(&self.groups, columns);
        columns.apply(|rows, own| self.apply_rows(rows, own));
        columns
    }

    /// `L⁻¹ A` in place.
    pub fn apply(&self, a: MatMut<'_, f64>) {
        for column in a.col_iter_mut() {
            let mut before = 0.0;
            let factor = self.beside.iter().zip(&self.diagonal);
            for (v, (beside, diagonal)) in column.iter_mut().zip(factor) {
                before = (*v - beside * before) / diagonal;
                *v = before;
            }
        }
    }

    /// The same of some rows, in ascending order, with both rows of every turn among them or none.
    pub fn apply_rows(&self, rows: &[usize], a: MatMut<'_, f64>) {
        for column in a.col_iter_mut() {
            let mut before = 0.0;
            for (v, &row) in column.iter_mut().zip(rows) {
                before = (*v - self.beside[row] * before) / self.diagonal[row];
                *v = before;
            }
        }
    }

    /// `L⁻¹ r` of a column.
    pub fn whiten(&self, r: &[f64]) -> Vec<f64> {
        let mut column = Mat::from_fn(r.len(), 1, |i, _| r[i]);
        self.apply(column.as_mut());
        column.col(0).iter().copied().collect()
    }

    /// The same for the rows from `first` on that share noise with no other.
    pub fn apply_block(&self, first: usize, a: &mut DMatrix<f64>) {
        for mut column in a.column_iter_mut() {
            let mut before = 0.0;
            for (i, v) in column.iter_mut().enumerate() {
                before = (*v - self.beside[first + i] * before) / self.diagonal[first + i];
                *v = before;
            }
        }
    }

    /// Whitens the exposure of rows to a walk.
    pub fn exposure(&self, exposure: &Exposure) -> Exposure {
        let first = exposure.rows.start;
        let mut whole = exposure.clone();
        self.apply_block(first, &mut whole.own);
        whole.own.transpose_mut();
        self.apply_block(first, &mut whole.own);
        self.apply_block(first, &mut whole.total);
        self.apply_block(first, &mut whole.moment);
        whole
    }

    /// `L A` in place: undoes [`White::apply`].
    pub fn restore(&self, mut a: MatMut<'_, f64>) {
        for k in 0..a.ncols() {
            for i in (0..a.nrows()).rev() {
                let before = if i > 0 { a[(i - 1, k)] } else { 0.0 };
                a[(i, k)] = self.diagonal[i] * a[(i, k)] + self.beside[i] * before;
            }
        }
    }

    /// `½ ln |C|` of the noise.
    pub fn log_determinant(&self) -> f64 {
        self.diagonal.iter().map(|d| d.ln()).sum()
    }

    /// The standard deviation of a row.
    pub fn std(&self, row: usize) -> f64 {
        self.diagonal[row].hypot(self.beside[row])
    }

    /// `L⁻¹ C L⁻ᵀ`.
    pub fn both_sides(&self, c: &Covariance) -> Covariance {
        c.map(|rows, c| {
            let mut half = c.clone();
            self.apply_rows(rows, half.as_mut());
            let mut whole = half.transpose().to_owned();
            self.apply_rows(rows, whole.as_mut());
            whole
        })
    }
}

/// Component of the noise beside the white one: a covariance among the rows, for a variance of one.
#[derive(Clone, Debug)]
pub struct Component {
    /// Kind of the noise.
    pub kind: ComponentKind,
    /// `L⁻¹ C L⁻ᵀ` (`m × m`) within the recordings; nothing of an error that all recordings share.
    pub covariance: Covariance,
    /// The same in the form that takes time in proportion to the rows.
    pub form: Form,
}

/// The form of a covariance.
#[derive(Clone, Debug)]
pub enum Form {
    /// Covariance that is passed on from station to station.
    Passed(Chain),
    /// `U Uᵀ` of a few columns.
    Columns(Columns),
}

impl Form {
    /// Returns the chain; `None` for columns.
    pub fn chain(&self) -> Option<&Chain> {
        match self {
            Self::Passed(chain) => Some(chain),
            Self::Columns(_) => None,
        }
    }
}

/// Kinds of noise that are estimated from the fit's own residuals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ComponentKind {
    /// Random walk of the accelerometer's bias; the root of its variance is a density in m/s²/√s.
    AccelerometerWalk,
    /// Random walk of the gyroscope's bias, rad/s/√s.
    GyroscopeWalk,
    /// Flicker noise of the accelerometer's bias on one axis; the root of its variance is the bias instability, m/s².
    AccelerometerFlicker(usize),
    /// The same of the gyroscope, rad/s.
    GyroscopeFlicker(usize),
    /// Scatter of the accelerometer from rest to rest that no walk explains, m/s².
    ForceScatter,
    /// Scatter of the gyroscope from rest to rest, rad/s.
    RateScatter,
    /// Scatter of the turns, rad.
    TurnScatter,
    /// Scatter of the turns beyond the noise of their samples that has to be expected where too few of them show it,
    /// rad.
    TurnDoubt,
    /// Dependence of the specific force on the orientation that no effect of the model explains, m/s² at one g.
    ForceOfOrientation,
    /// The same of the rate at the static intervals, rad/s at one g.
    RateOfOrientation,
    /// The rotation of the earth where nobody says the latitude: its size is known, its direction is not; rad/s per
    /// component.
    EarthRotation,
    /// Error of the gyroscope's bias by rounding to steps wider than the noise, the same in every static interval.
    CommonRounding,
}

impl ComponentKind {
    /// Returns true if it is a random walk of a bias.
    pub fn is_walk(self) -> bool {
        matches!(self, Self::AccelerometerWalk | Self::GyroscopeWalk)
    }

    /// Returns true if it depends on the orientation: it enlarges the errors, and the rows are weighted as without it.
    ///
    /// Weights with this component would attribute to it what belongs to scale factors and biases as well. A model that
    /// misses an effect predicts other orientations best with the parameters that fit best.
    pub fn is_of_orientation(self) -> bool {
        matches!(self, Self::ForceOfOrientation | Self::RateOfOrientation)
    }

    /// Returns true if it is flicker noise of a bias.
    pub fn is_flicker(self) -> bool {
        matches!(
            self,
            Self::AccelerometerFlicker(_) | Self::GyroscopeFlicker(_)
        )
    }

    /// Returns true if it is noise that was measured or is known, and not the remainder of a misfit.
    pub fn is_noise(self) -> bool {
        self.is_walk() || self.is_flicker() || self.known_variance().is_some()
    }

    /// Its variance where that is known before any fit, for a covariance of unit size.
    pub fn known_variance(self) -> Option<f64> {
        match self {
            Self::EarthRotation => Some(EARTH_COMPONENT * EARTH_COMPONENT),
            Self::CommonRounding => Some(1.0),
            _ => None,
        }
    }
}

/// A component and how much of it there is, near SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NoiseLevel {
    /// Kind of the component.
    pub kind: ComponentKind,
    /// Its size: the root of the factor on the component's covariance.
    pub size: f64,
}

/// The levels that rows are weighted by: those of what depends on the orientation enlarge the errors alone.
pub fn weighing(levels: &[NoiseLevel]) -> Vec<NoiseLevel> {
    let weighs = |level: &&NoiseLevel| !level.kind.is_of_orientation();
    levels.iter().filter(weighs).copied().collect()
}

/// `I + Σ size² C` (`m × m`), white-whitened; `None` where that is the identity.
pub fn covariance_at(components: &[Component], levels: &[NoiseLevel]) -> Option<Covariance> {
    let present = levels.iter().filter(|l| l.size > 0.0).filter_map(|level| {
        let component = components.iter().find(|c| c.kind == level.kind)?;
        Some((level.size * level.size, &component.covariance))
    });
    let present: Vec<(f64, &Covariance)> = present.collect();
    combined(present.first()?.1.size(), 1.0, &present)
}

/// The whole whitening: by white noise, then by what else there is.
#[derive(Clone, Debug)]
pub struct Whitening {
    /// By white noise.
    pub white: White,
    /// Rows that share noise: those of a recording, or of several where a covariance connects them.
    groups: RowGroups,
    /// Cholesky factors of `I + Σ size² C` for every group; empty where that is the identity.
    factors: Vec<Vec<Factor>>,
}

/// A Cholesky factor of the covariance of rows that share no noise with others.
#[derive(Clone, Debug)]
struct Factor {
    /// The rows.
    rows: Vec<usize>,
    /// Their places in their group.
    places: Vec<usize>,
    lower: Mat<f64>,
}

impl Whitening {
    /// For these levels of the components.
    pub fn new(white: White, components: &[Component], levels: &[NoiseLevel]) -> Self {
        match covariance_at(components, levels) {
            Some(covariance) => Self::with_covariance(white, &covariance),
            None => Self::by(white),
        }
    }

    /// The white noise alone.
    fn by(white: White) -> Self {
        Self {
            groups: white.groups.clone(),
            factors: Vec::new(),
            white,
        }
    }

    /// For white noise and what else there is, `covariance` (`m × m`) after the white noise is whitened;
    /// the white noise alone where it is not positive definite.
    pub fn with_covariance(white: White, covariance: &Covariance) -> Self {
        let groups = white.groups.connected_by(std::iter::once(covariance));
        let mut factors: Vec<Vec<Factor>> = vec![Vec::new(); groups.iter().len()];
        for rows in independent(&[covariance], covariance.size()) {
            let own = covariance.part(&rows).map(|own| own.llt(Side::Lower));
            let (Some(&first), Some(Ok(factor))) = (rows.first(), own) else {
                return Self::by(white);
            };
            factors[groups.of(first)].push(Factor {
                places: rows.iter().map(|&row| groups.place(row)).collect(),
                lower: factor.L().to_owned(),
                rows,
            });
        }
        Self {
            white,
            groups,
            factors,
        }
    }

    /// Rows that share noise.
    pub fn groups(&self) -> &RowGroups {
        &self.groups
    }

    /// Whitens columns.
    pub fn whiten(&self, mut columns: Columns) -> Columns {
        columns.apply(|rows, a| self.white.apply_rows(rows, a));
        self.finish_columns(columns)
    }

    /// Whitens a column.
    pub fn whiten_column(&self, r: &[f64]) -> Vec<f64> {
        self.finish_column(&self.white.whiten(r))
    }

    /// The second step alone, of what the white noise has whitened. Every row is mixed with rows before
    /// it only.
    fn finish(&self, mut a: MatMut<'_, f64>) {
        for factor in self.factors.iter().flatten() {
            solve_rows(&factor.rows, &factor.lower, a.as_mut());
        }
    }

    /// Whitens the rows of one group in place.
    pub fn apply_group(&self, rows: &[usize], mut a: MatMut<'_, f64>) {
        self.white.apply_rows(rows, a.as_mut());
        let group = rows.first().map(|&row| self.groups.of(row));
        self.finish_group(group.unwrap_or(0), a);
    }

    /// The second step alone for one group.
    fn finish_group(&self, group: usize, mut a: MatMut<'_, f64>) {
        for factor in self.factors.get(group).into_iter().flatten() {
            solve_rows(&factor.places, &factor.lower, a.as_mut());
        }
    }

    /// The same of columns in groups of rows.
    pub fn finish_columns(&self, columns: Columns) -> Columns {
        let mut columns = columns.regrouped(&self.groups);
        for group in 0..columns.parts().len() {
            self.finish_group(group, columns.part_mut(group).values.as_mut());
        }
        columns
    }

    /// The same of a column.
    pub fn finish_column(&self, r: &[f64]) -> Vec<f64> {
        let mut column = Mat::from_fn(r.len(), 1, |i, _| r[i]);
        self.finish(column.as_mut());
        column.col(0).iter().copied().collect()
    }
}

/// `L⁻¹ A` of some rows.
fn solve_rows(rows: &[usize], lower: &Mat<f64>, mut a: MatMut<'_, f64>) {
    let mut own = Mat::from_fn(rows.len(), a.ncols(), |i, k| a[(rows[i], k)]);
    solve_lower_triangular_in_place(lower.as_ref(), own.as_mut(), Par::Seq);
    for k in 0..own.ncols() {
        for (i, &row) in rows.iter().enumerate() {
            a[(row, k)] = own[(i, k)];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_whitened_is_restored_and_a_row_has_the_variance_of_its_noise() {
        let noise = RowNoise {
            variance: vec![4.0, 9.0, 0.25],
            with_before: vec![0.0, 3.0, 0.0],
            exposures: [Vec::new(), Vec::new()],
            by_share: Vec::new(),
            groups: RowGroups::whole(3),
        };
        let white = White::new(&noise, 3);
        let before = Mat::from_fn(3, 2, |i, k| (i + 3 * k) as f64 - 1.5);
        let mut a = before.clone();
        white.apply(a.as_mut());
        white.restore(a.as_mut());
        assert!((a - before).norm_max() < 1e-14);
        for (row, std) in [2.0, 3.0, 0.5].into_iter().enumerate() {
            assert!((white.std(row) - std).abs() < 1e-14);
        }
    }
}
