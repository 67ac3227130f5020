//! The problem linearised at a solution, whitened, with disturbances beside it.

use faer::Mat;
use sensor::Sensor;

use crate::methods::joint::blocks::columns::Columns;
use crate::methods::joint::blocks::covariance::Covariance;
use crate::methods::joint::disturbance::trial::Trial;
use crate::methods::joint::faults::Suspect;
use crate::methods::joint::noise::chain::Chain;
use crate::methods::joint::noise::exposure::{Exposure, covariance};
use crate::methods::joint::noise::rows::RowNoise;
use crate::methods::joint::noise::stations::Stations;
use crate::methods::joint::noise::weights::{
    Component, ComponentKind, Form, NoiseLevel, White, Whitening, weighing,
};
use crate::methods::joint::rows::{Linear, Rows};

/// Residuals and Jacobian (free columns), whitened by the white noise alone.
#[derive(Clone, Debug)]
pub struct Analysis {
    /// Residuals (`m`).
    pub residuals: Vec<f64>,
    /// Jacobian (`m × n`).
    pub jacobian: Columns,
    /// Whitening by the white noise.
    pub white: White,
    /// Components of the noise beside the white one.
    pub components: Vec<Component>,
    /// Columns of errors that depend on the orientation, of unit size, whitened by the white noise (`m × q` each).
    pub(super) orientation: Vec<(ComponentKind, Columns)>,
    /// Columns of errors known to be in the noise, of unit size, whitened by the white noise (`m × q` each).
    pub(super) carried: Vec<Columns>,
    /// The rows in the order in which the biases pass them.
    pub stations: Stations,
    /// Exposures of the gyroscope's means, then of the turns, to its bias.
    pub(super) rate_exposures: Vec<Exposure>,
    /// True if the walk of the accelerometer's bias begins anew in every static interval.
    pub walk_ends_with_rests: bool,
}

impl Analysis {
    /// Whitens a linearised problem by the white part of its noise.
    pub fn new(rows: &Rows<'_>, linear: &Linear, noise: &RowNoise, free: &[usize]) -> Self {
        let white = White::new(noise, rows.first_turn_row());
        let (residuals, jacobian) = linear.whitened_by(free, &white);
        let stations = rows.stations(noise);
        Self {
            residuals,
            jacobian,
            orientation: Vec::new(),
            carried: Vec::new(),
            components: walks(noise, &white, &stations),
            stations,
            rate_exposures: whitened(&noise.exposures[1], &white),
            walk_ends_with_rests: false,
            white,
        }
    }

    /// The columns with those of the disturbances, and the residuals, whitened; errors that all recordings share held beside them.
    pub(super) fn whitened(&self, known: &[&Suspect], levels: &[NoiseLevel]) -> Whitened {
        let whitening = self.whitening(levels);
        let errors = whitening.finish_columns(self.carried(levels));
        let columns = whitening.finish_columns(self.with(known));
        let mut residuals = whitening.finish_column(&self.residuals);
        residuals.resize(self.residuals.len() + errors.ncols(), 0.0);
        Whitened {
            columns: columns.beside_errors(&errors),
            residuals,
            whitening,
            errors: errors.ncols(),
        }
    }

    /// Builds the columns of a shift of the gyroscope's readings in every static interval (`m × 3 rests`), whitened:
    /// the shift counts in full in the interval and by half in the turn on either side.
    pub(super) fn rate_shifts(&self, rows: &Rows<'_>) -> Columns {
        let means = rows.means(Sensor::Gyroscope);
        let of_means = means.map(|own| vec![(own.chunk.rest, 1.0)]);
        let turns = rows.data.turns.iter();
        let of_turns = turns.map(|turn| vec![(turn.from, 0.5), (turn.from + 1, 0.5)]);
        let mut of_group = vec![Vec::new(); rows.groups().iter().len()];
        for (k, rest) in rows.data.rests.iter().enumerate() {
            of_group[rest.recording].extend([3 * k, 3 * k + 1, 3 * k + 2]);
        }
        let mut by_shift = Columns::zeros(rows.groups(), 3 * rows.data.rests.len(), of_group);
        for (exposure, shares) in self.rate_exposures.iter().zip(of_means.chain(of_turns)) {
            for (rest, share) in shares {
                for (i, row) in exposure.rows.clone().enumerate() {
                    for axis in 0..3 {
                        by_shift.set(row, 3 * rest + axis, share * exposure.total[(i, axis)]);
                    }
                }
            }
        }
        by_shift
    }

    /// The whitening at these levels.
    pub fn whitening(&self, levels: &[NoiseLevel]) -> Whitening {
        Whitening::new(self.white.clone(), &self.components, levels)
    }

    /// The whitening of the final fit, which what depends on the orientation has no part in.
    pub fn weighting(&self, levels: &[NoiseLevel]) -> Whitening {
        self.whitening(&weighing(levels))
    }

    /// The tests of all suspects, whose `columns` the white noise has whitened, at these levels.
    pub fn trial<'a>(
        &self,
        suspects: &'a [Suspect],
        columns: &Columns,
        levels: &[NoiseLevel],
    ) -> Trial<'a> {
        let whitened = self.whitened(&[], levels);
        let columns = whitened.whitening.finish_columns(columns.clone());
        let columns = columns.above_zeros(whitened.errors);
        Trial::new(suspects, columns, &whitened.columns, whitened.residuals)
    }

    /// The columns of all suspects, then what looks like each of them, whitened by the white noise (`m × k`).
    pub fn columns(&self, suspects: &[Suspect]) -> Columns {
        let own = suspects.iter().flat_map(|s| &s.columns);
        let alike = suspects.iter().flat_map(|s| &s.nuisance);
        self.white.sparse(&own.chain(alike).collect::<Vec<_>>())
    }

    /// The Jacobian with more columns, all whitened by white noise.
    pub(super) fn with(&self, disturbances: &[&Suspect]) -> Columns {
        let extra = disturbances.iter().flat_map(|s| &s.columns);
        let extra = self.white.sparse(&extra.collect::<Vec<_>>());
        self.jacobian.beside(&extra)
    }
}

/// A linearised problem under some levels of noise.
pub struct Whitened {
    /// The columns, with `errors` of them that rows below hold (`m + q × n + q`).
    pub columns: Columns,
    /// The residuals, and zeros below (`m + q`).
    pub residuals: Vec<f64>,
    /// Whitening of the rows (`m`).
    pub whitening: Whitening,
    /// `q`.
    pub errors: usize,
}

/// The walks of the biases, of unit density, whitened by the white noise.
pub fn walks(noise: &RowNoise, white: &White, stations: &Stations) -> Vec<Component> {
    let kinds = [
        ComponentKind::AccelerometerWalk,
        ComponentKind::GyroscopeWalk,
    ];
    let exposed = kinds.into_iter().zip(&noise.exposures);
    exposed
        .filter(|(_, exposures)| !exposures.is_empty())
        .map(|(kind, exposures)| walk(kind, &whitened(exposures, white), stations))
        .collect()
}

/// A walk of unit density that rows feel so, whitened by the white noise.
pub(super) fn walk(kind: ComponentKind, exposures: &[Exposure], stations: &Stations) -> Component {
    Component {
        kind,
        covariance: covariance(exposures, stations.rows()),
        form: Form::Passed(Chain::of_walk(stations, exposures)),
    }
}

impl Rows<'_> {
    /// The rows in the order in which the biases pass them.
    pub(crate) fn stations(&self, noise: &RowNoise) -> Stations {
        Stations::new(noise, self.first_turn_row())
    }
}

/// The exposures of rows that the white noise has whitened.
pub fn whitened(exposures: &[Exposure], white: &White) -> Vec<Exposure> {
    exposures.iter().map(|e| white.exposure(e)).collect()
}

/// The rows of every turn.
pub(super) fn turn_rows(rows: &Rows<'_>) -> Vec<Vec<usize>> {
    rows.turns().map(|(row, _)| vec![row, row + 1]).collect()
}

/// The identity of these rows (`m × m`).
pub(super) fn identity(groups: &[Vec<usize>], m: usize) -> Covariance {
    let of_group = |group: &Vec<usize>| (group.clone(), Mat::identity(group.len(), group.len()));
    Covariance::of_blocks(m, groups.iter().map(of_group).collect())
}
