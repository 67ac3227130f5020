//! The problem linearised at a solution: levels of noise and disturbances, without a refit.

use faer::Mat;
use sensor::Sensor;

use crate::methods::joint::blocks::column::Column;
use crate::methods::joint::blocks::columns::Columns;
use crate::methods::joint::blocks::covariance::{Covariance, combined};
use crate::methods::joint::data::Chunk;
use crate::methods::joint::disturbance::Suspect;
use crate::methods::joint::disturbance::trial::Trial;
use crate::methods::joint::noise::bias::Within;
use crate::methods::joint::noise::exposure::{Exposure, covariance};
use crate::methods::joint::noise::likelihood::Restricted;
use crate::methods::joint::noise::rows::RowNoise;
use crate::methods::joint::noise::walks::{Walks, expected_square};
use crate::methods::joint::noise::weights::{
    Component, ComponentKind, NoiseLevel, White, Whitening, weighing,
};
use crate::methods::joint::result::left::Left;
use crate::methods::joint::rows::{Linear, Rows};
use crate::methods::small_sample::{LEAST_SPARE, by_chance};

/// A fit whose quieter three quarters are off by this much, as χ² per degree of freedom, does not
/// know its noise: the model misses, or the noise is of another kind.
const MISFIT: f64 = 2.0;

/// The same of turns above which no single effect is taken for the cause before their scatter is allowed for.
const GROSS: f64 = 4.0;

/// Sums of squares that exceed their expectation by fewer of their standard deviations are looked at no further.
const QUIET: f64 = 2.0;

/// Rows that leave so much by chance only do not scatter.
const UNLIKELY: f64 = 1e-3;

/// A walk through the whole recording is the better account of what differs between rests where the data are so many
/// times likelier under it (log) than under scatter from rest to rest.
const WALKS: f64 = 2.0;

/// Prior chance of no walk at all, over that of any.
const NONE: f64 = 1.0;

/// How far usual walks go, in standard deviations of a chunk's mean.
const USUAL: f64 = 3.0;

/// The same of what turns scatter by without any recording showing it, in standard deviations of the best turn.
const USUAL_OF_TURNS: f64 = 1.0;

/// Residuals and Jacobian (free columns), whitened by the white noise alone.
#[derive(Clone, Debug)]
pub struct Analysis {
    /// Residuals (`m`).
    pub residuals: Vec<f64>,
    /// Jacobian (`m × n`).
    pub jacobian: Columns,
    /// Whitening by the white noise.
    pub white: White,
    /// What else the noise may have.
    pub components: Vec<Component>,
    /// What depends on the orientation, of unit size, whitened by the white noise (`m × q` each).
    orientation: Vec<(ComponentKind, Columns)>,
    /// What is known to be in the noise by unit sizes, whitened by the white noise (`m × q` each).
    carried: Vec<Columns>,
    /// How the gyroscope's means, then the turns, feel its bias.
    rate_exposures: Vec<Exposure>,
    /// Whether the walk of the accelerometer's bias begins anew in every rest.
    pub walk_ends_with_rests: bool,
}

impl Analysis {
    /// Of a linearised problem and its noise.
    pub fn new(rows: &Rows<'_>, linear: &Linear, noise: &RowNoise, free: &[usize]) -> Self {
        let white = White::new(noise, rows.first_turn_row());
        let (residuals, jacobian) = linear.whitened_by(free, &white);
        Self {
            residuals,
            jacobian,
            orientation: Vec::new(),
            carried: Vec::new(),
            components: walks(noise, &white),
            rate_exposures: whitened(&noise.exposures[1], &white),
            walk_ends_with_rests: false,
            white,
        }
    }

    /// Adds scatter between rests and turns to what the noise may have, where the quieter three
    /// quarters of them are off by far more than the noise; whether any are.
    pub fn allow_scatter_where_misfit(&mut self, rows: &Rows<'_>, known: &[&Suspect]) -> bool {
        let before = self.components.len();
        let taken = self.taken(known);
        for (kind, groups) in self.missed(rows, &taken) {
            self.allow(rows, kind, &groups);
            if kind == ComponentKind::ForceScatter {
                self.end_walk_with_rests(rows, &taken);
            }
        }
        self.components.len() > before
    }

    /// Whether the quieter three quarters of rests or turns are off by far more than the noise.
    pub fn is_missed(&self, rows: &Rows<'_>, known: &[&Suspect]) -> bool {
        !self.missed(rows, &self.taken(known)).is_empty()
    }

    /// The kinds of rows of which the quieter three quarters are off by far more than the noise.
    fn missed(&self, rows: &Rows<'_>, taken: &Columns) -> Vec<(ComponentKind, Vec<Vec<usize>>)> {
        let left = Left::of(taken, &self.residuals);
        let is_off = |(_, groups): &(_, Vec<Vec<usize>>)| left.quieter_ratio(groups) > MISFIT;
        groups(rows).into_iter().filter(is_off).collect()
    }

    /// The Jacobian beside disturbances, patterns of the orientation and what is carried.
    fn taken(&self, known: &[&Suspect]) -> Columns {
        let own = self.orientation.iter().map(|(_, own)| own);
        let own = own.chain(&self.carried);
        own.fold(self.with(known), |taken, own| taken.beside(own))
    }

    /// Adds scatter of the turns to what the noise may have.
    pub fn allow_scatter_of_turns(&mut self, rows: &Rows<'_>) {
        let is_known = |c: &Component| c.kind == ComponentKind::TurnScatter;
        if !self.components.iter().any(is_known) {
            let [_, _, (kind, turns)] = groups(rows);
            self.allow(rows, kind, &turns);
        }
    }

    /// The same where the quieter three quarters of them are off by so much more than the noise that whatever can be fitted
    /// to turns would pass for their cause: an effect has to be likelier than turns that scatter.
    pub fn allow_scatter_of_gross_turns(&mut self, rows: &Rows<'_>, known: &[&Suspect]) {
        let left = Left::of(&self.with(known), &self.residuals);
        let [_, _, (_, turns)] = groups(rows);
        if left.quieter_ratio(&turns) > GROSS {
            self.allow_scatter_of_turns(rows);
        }
    }

    /// Adds scatter of the kinds of rows that noise and walks of these levels leave by more than chance does; whether
    /// any do.
    pub fn allow_scatter_beyond(
        &mut self,
        rows: &Rows<'_>,
        known: &[&Suspect],
        levels: &[NoiseLevel],
    ) -> bool {
        let before = self.components.len();
        let (jacobian, r) = self.whitened(known, &self.whitening(levels));
        if self.is_quiet(rows, &r) {
            return false;
        }
        let left = Left::of(&jacobian, &r);
        for (kind, groups) in groups(rows) {
            if self.components.iter().any(|c| c.kind == kind) {
                continue;
            }
            let (mut square, mut spare) = (0.0, 0.0);
            for &i in groups.iter().flatten() {
                square += left.square(i);
                spare += left.spare(i);
            }
            if spare > 0.5 && by_chance(square, spare) < UNLIKELY {
                self.allow(rows, kind, &groups);
            }
        }
        self.components.len() > before
    }

    /// Adds to the noise, and to the `levels` of its components, what the turns are expected to scatter by beyond them where
    /// that was not estimated.
    ///
    /// Rates are known at samples only, and stamps are not the times of the samples: turns miss by more than the noise of
    /// their readings says. A few dozen turns show a quarter more of it in one recording of ten; stated errors that take
    /// it for none in all of them are too small.
    pub fn doubt_turns(
        &mut self,
        rows: &Rows<'_>,
        known: &[&Suspect],
        levels: &mut Vec<NoiseLevel>,
    ) {
        let scatters = |c: &Component| c.kind == ComponentKind::TurnScatter;
        let (first, count) = (rows.first_turn_row(), rows.count());
        if first == count || self.components.iter().any(scatters) {
            return;
        }
        let units: Vec<Column> = (first..count).map(Column::unit).collect();
        let by_turn = self.white.sparse(&units.iter().collect::<Vec<_>>());
        let covariance =
            self.white
                .both_sides(&shared(&turn_rows(rows), ComponentKind::TurnScatter, count));
        let whitening = self.whitening(levels);
        let by_turn = whitening.finish_columns(by_turn);
        let by_scatter = row_squares(&by_turn);
        let (jacobian, r) = self.whitened(known, &whitening);
        let left = Left::of(&jacobian, &r);
        let of_row = |i: usize| (left.square(i), left.spare(i), by_scatter[i]);
        let turns: Vec<(f64, f64, f64)> = (first..count).map(of_row).collect();
        let log_likelihood = |size: f64| {
            let of_turn = |(square, spare, by_scatter): &(f64, f64, f64)| {
                let v = 1.0 + by_scatter * size * size;
                -0.5 * (spare * v.ln() + square / v)
            };
            turns.iter().map(of_turn).sum()
        };
        let usual = usual_size(&covariance, USUAL_OF_TURNS);
        let size = expected_square((usual, NONE), log_likelihood).sqrt();
        let kind = ComponentKind::TurnDoubt;
        self.components.push(Component { kind, covariance });
        levels.push(NoiseLevel { kind, size });
    }

    /// The columns with those of the disturbances, and the residuals, whitened.
    fn whitened(&self, known: &[&Suspect], whitening: &Whitening) -> (Columns, Vec<f64>) {
        let jacobian = whitening.finish_columns(self.with(known));
        (jacobian, whitening.finish_column(&self.residuals))
    }

    /// Whether no kind of rows is conspicuous even by what the residuals are before anything more is fitted.
    fn is_quiet(&self, rows: &Rows<'_>, r: &[f64]) -> bool {
        let [rate, turns, end] = [rows.first_rate_row(), rows.first_turn_row(), rows.count()];
        let directions = 2 * rows.data.rests.len() + 9;
        [(0, rate, directions), (rate, turns, 3), (turns, end, 9)]
            .into_iter()
            .all(|(from, to, taken)| {
                let square: f64 = r[from..to].iter().map(|v| v.powi(2)).sum();
                let spare = (to - from).saturating_sub(taken) as f64;
                square <= spare + QUIET * (2.0 * spare).sqrt()
            })
    }

    fn allow(&mut self, rows: &Rows<'_>, kind: ComponentKind, groups: &[Vec<usize>]) {
        let covariance = if kind == ComponentKind::RateScatter {
            Covariance::of_columns(&self.rate_shifts(rows))
        } else {
            self.white.both_sides(&shared(groups, kind, rows.count()))
        };
        self.components.push(Component { kind, covariance });
    }

    /// Adds what depends on the orientation to what the noise may have: `errors` (3 × q for every rest) of unit size
    /// in the readings of a sensor.
    pub fn allow_orientation(
        &mut self,
        rows: &Rows<'_>,
        sensor: Sensor,
        errors: &[nalgebra::DMatrix<f64>],
    ) {
        let count = errors.first().map_or(0, |e| e.ncols());
        let (kind, columns) = match sensor {
            Sensor::Accelerometer => {
                let mut columns = Mat::zeros(rows.count(), count);
                for (k, (_, chunk)) in rows.means(sensor).enumerate() {
                    for i in 0..3 {
                        for c in 0..count {
                            columns[(3 * k + i, c)] = errors[chunk.rest][(i, c)];
                        }
                    }
                }
                self.white.apply(columns.as_mut());
                (ComponentKind::ForceOfOrientation, columns)
            }
            Sensor::Gyroscope | Sensor::Magnetometer => {
                let shifts = self.rate_shifts(rows);
                let mut columns = Mat::zeros(rows.count(), count);
                for c in 0..count {
                    let errors = errors.iter().flat_map(|e| (0..3).map(move |i| e[(i, c)]));
                    let moved = shifts.times(&errors.collect::<Vec<_>>());
                    columns
                        .col_mut(c)
                        .iter_mut()
                        .zip(moved)
                        .for_each(|(v, m)| *v = m);
                }
                (ComponentKind::RateOfOrientation, columns)
            }
        };
        let columns = Columns::cut(&columns, rows.groups());
        self.components.push(Component {
            kind,
            covariance: Covariance::of_columns(&columns),
        });
        self.orientation.push((kind, columns));
    }

    /// Adds to the noise what `columns` (`m × q`, not whitened) do to the rows by unit sizes.
    pub fn carry(&mut self, kind: ComponentKind, columns: &Columns) {
        let mut whitened = columns.clone();
        whitened.apply(|rows, a| self.white.apply_rows(rows, a));
        self.components.push(Component {
            kind,
            covariance: Covariance::of_columns(&whitened),
        });
        self.carried.push(whitened);
    }

    /// What the vertical part of the earth's rotation, of which `earth` has three columns for every recording, does to the
    /// rows of each, of the size that it may have, whitened by the white noise (`m × recordings`).
    pub fn of_place(&self, earth: Option<&Columns>) -> Columns {
        let Some(earth) = earth else {
            return Columns::none(self.white.groups());
        };
        let vertical: Vec<usize> = (0..earth.ncols()).step_by(3).collect();
        let mut columns = earth.select(&vertical);
        let variance = ComponentKind::EarthRotation.known_variance();
        columns.scale(variance.unwrap_or(0.0).sqrt());
        columns.apply(|rows, a| self.white.apply_rows(rows, a));
        columns
    }

    /// Lets the walk of the accelerometer's bias begin anew in every rest, unless the rows, whose columns `taken` are
    /// fitted, are likelier with a walk through the whole recording.
    ///
    /// What the model misses from rest to rest depends on the orientation, and orientations are
    /// recorded in some order: a walk through the whole recording would take it for its own, and
    /// believe neighbouring rests too little and those near the reference time too much. What differs between
    /// rests is then left to their scatter, and the walk to what is seen within them. A bias that does drift
    /// leaves the same misfit, but neighbouring rests agree: as scatter it would count as independent in every
    /// rest, and the mean bias would pass for known far better than it is. Without placements to spare neither is told from
    /// the other, and the walk goes on.
    fn end_walk_with_rests(&mut self, rows: &Rows<'_>, taken: &Columns) {
        if rows.spare_placements() < LEAST_SPARE {
            return;
        }
        let within = Component {
            kind: ComponentKind::AccelerometerWalk,
            covariance: walk_within_rests(rows, &self.white),
        };
        let is_walk = |c: &Component| c.kind == ComponentKind::AccelerometerWalk;
        let Some(place) = self.components.iter().position(is_walk) else {
            return;
        };
        let through = self.likelihood_of_noise(taken);
        let whole = std::mem::replace(&mut self.components[place], within);
        if through - self.likelihood_of_noise(taken) > WALKS {
            self.components[place] = whole;
        } else {
            self.walk_ends_with_rests = true;
        }
    }

    /// The highest restricted log-likelihood of walks and scatter, the columns `taken` fitted, up to a constant.
    fn likelihood_of_noise(&self, taken: &Columns) -> f64 {
        let own = self.components.iter();
        let own = own.filter(|c| c.kind.is_walk() || !c.kind.is_noise());
        let own: Vec<&Covariance> = own
            .filter(|c| !c.kind.is_of_orientation())
            .map(|c| &c.covariance)
            .collect();
        Restricted::new(&self.residuals, taken, &own).highest()
    }

    /// What a shift of the gyroscope's reading in every rest does to the rows (`m × 3 rests`), whitened: what shifts it
    /// in a rest shifts it by half in the turns on either side, as far as anybody can know.
    fn rate_shifts(&self, rows: &Rows<'_>) -> Columns {
        let means = rows.means(Sensor::Gyroscope);
        let of_means = means.map(|(_, chunk)| vec![(chunk.rest, 1.0)]);
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

    /// The kinds of noise that are estimated together where the biases may flicker.
    pub fn estimated_kinds(&self) -> Vec<ComponentKind> {
        let kinds = self.components.iter().map(|c| c.kind);
        let estimated =
            |k: &ComponentKind| k.is_walk() || k.is_flicker() || *k == ComponentKind::TurnScatter;
        kinds.filter(estimated).collect()
    }

    /// The levels of the components by restricted likelihood, with the disturbances' columns among the
    /// free ones: scatter at its likeliest, walks as their expectation, which none at all may be; walks and flicker
    /// together at their likeliest, given what the readings `within` static intervals say of them.
    pub fn levels(&self, disturbances: &[&Suspect], within: &[Within]) -> Vec<NoiseLevel> {
        let jacobian = self.with(disturbances);
        let of = |wanted: fn(ComponentKind) -> bool| -> Vec<&Component> {
            self.components.iter().filter(|c| wanted(c.kind)).collect()
        };
        if !of(ComponentKind::is_flicker).is_empty() {
            return self.likeliest(&jacobian, within);
        }
        let (walks, scatter) = (of(ComponentKind::is_walk), of(|kind| !kind.is_noise()));
        let scatter = self.scatter(&jacobian, &walks, &scatter);
        let known = self.components.iter();
        let known: Vec<(&Component, f64)> = known
            .filter_map(|c| Some((c, c.kind.known_variance()?)))
            .collect();
        let fixed = scatter.iter().chain(&known);
        let fixed: Vec<(f64, &Covariance)> = fixed.map(|(c, v)| (*v, &c.covariance)).collect();
        let fixed = combined(self.residuals.len(), 0.0, &fixed);
        let covariances: Vec<&Covariance> = walks.iter().map(|c| &c.covariance).collect();
        let usual: Vec<f64> = covariances.iter().map(|c| usual_size(c, USUAL)).collect();
        let expected = Walks::new(&self.residuals, &jacobian, &covariances, fixed.as_ref())
            .expected(&usual, NONE);
        walks
            .into_iter()
            .zip(expected)
            .chain(scatter)
            .chain(known)
            .map(|(component, variance)| NoiseLevel {
                kind: component.kind,
                size: variance.sqrt(),
            })
            .collect()
    }

    /// Walks, flicker and the scatter of turns at their likeliest, what is known beside them.
    fn likeliest(&self, jacobian: &Columns, within: &[Within]) -> Vec<NoiseLevel> {
        let kinds = self.estimated_kinds();
        let own = self.components.iter().filter(|c| kinds.contains(&c.kind));
        let covariances: Vec<&Covariance> = own.map(|c| &c.covariance).collect();
        let mut restricted = Restricted::new(&self.residuals, jacobian, &covariances);
        restricted.within = within.to_vec();
        let kept: Vec<bool> = kinds.iter().map(|kind| kind.is_noise()).collect();
        let variances = restricted.variances(&kept);
        let known = self.components.iter();
        let known = known.filter_map(|c| Some((c.kind, c.kind.known_variance()?)));
        let levels = kinds.iter().copied().zip(variances).chain(known);
        let level = |(kind, variance): (ComponentKind, f64)| NoiseLevel {
            kind,
            size: variance.sqrt(),
        };
        levels.map(level).collect()
    }

    /// The likeliest variances of the scatter, walks beside it.
    fn scatter<'a>(
        &self,
        jacobian: &Columns,
        walks: &[&Component],
        scatter: &[&'a Component],
    ) -> Vec<(&'a Component, f64)> {
        if scatter.is_empty() {
            return Vec::new();
        }
        let all: Vec<&Covariance> = walks.iter().chain(scatter).map(|c| &c.covariance).collect();
        let kept: Vec<bool> = (0..all.len()).map(|c| c < walks.len()).collect();
        let variances = Restricted::new(&self.residuals, jacobian, &all).variances(&kept);
        let own = variances.into_iter().skip(walks.len());
        scatter.iter().copied().zip(own).collect()
    }

    /// The whitening at these levels.
    pub fn whitening(&self, levels: &[NoiseLevel]) -> Whitening {
        Whitening::new(self.white.clone(), &self.components, levels)
    }

    /// The whitening of the final fit, which what depends on the orientation has no part in.
    pub fn weighting(&self, levels: &[NoiseLevel]) -> Whitening {
        self.whitening(&weighing(levels))
    }

    /// What depends on the orientation at these levels, whitened by the white noise (`m × q`).
    pub fn carried(&self, levels: &[NoiseLevel]) -> Columns {
        let none = Columns::none(self.white.groups());
        self.orientation.iter().fold(none, |sum, (kind, columns)| {
            let level = levels.iter().find(|level| level.kind == *kind);
            let mut columns = columns.clone();
            columns.scale(level.map_or(0.0, |level| level.size));
            sum.beside(&columns)
        })
    }

    /// The tests of all suspects, whose `columns` the white noise has whitened, at these levels.
    pub fn trial<'a>(
        &self,
        suspects: &'a [Suspect],
        columns: &Columns,
        levels: &[NoiseLevel],
    ) -> Trial<'a> {
        let (columns, jacobian) = (columns.clone(), self.jacobian.clone());
        let whitening = self.whitening(levels);
        Trial::new(suspects, columns, jacobian, &self.residuals, &whitening)
    }

    /// The columns of all suspects, then what looks like each of them, whitened by the white noise (`m × k`).
    pub fn columns(&self, suspects: &[Suspect]) -> Columns {
        let own = suspects.iter().flat_map(|s| &s.columns);
        let alike = suspects.iter().flat_map(|s| &s.nuisance);
        self.white.sparse(&own.chain(alike).collect::<Vec<_>>())
    }

    /// The Jacobian with more columns, all whitened by white noise.
    fn with(&self, disturbances: &[&Suspect]) -> Columns {
        let extra = disturbances.iter().flat_map(|s| &s.columns);
        let extra = self.white.sparse(&extra.collect::<Vec<_>>());
        self.jacobian.beside(&extra)
    }
}

/// The sum of squares of every row.
fn row_squares(a: &Columns) -> Vec<f64> {
    let mut squares = vec![0.0; a.nrows()];
    for part in a.parts() {
        for (i, &row) in part.rows.iter().enumerate() {
            squares[row] = part.values.row(i).iter().map(|v| v * v).sum();
        }
    }
    squares
}

/// The walks of the biases, of unit density, whitened by the white noise.
pub fn walks(noise: &RowNoise, white: &White) -> Vec<Component> {
    let kinds = [
        ComponentKind::AccelerometerWalk,
        ComponentKind::GyroscopeWalk,
    ];
    let exposed = kinds.into_iter().zip(&noise.exposures);
    exposed
        .filter(|(_, exposures)| !exposures.is_empty())
        .map(|(kind, exposures)| Component {
            kind,
            covariance: covariance(&whitened(exposures, white), noise.variance.len()),
        })
        .collect()
}

/// The exposures of rows that the white noise has whitened.
pub fn whitened(exposures: &[Exposure], white: &White) -> Vec<Exposure> {
    exposures.iter().map(|e| white.exposure(e)).collect()
}

/// The covariance of a walk of the accelerometer's bias, of unit density, that is none at the begin of every
/// rest; whitened by the white noise.
fn walk_within_rests(rows: &Rows<'_>, white: &White) -> Covariance {
    let exposure = |(k, (_, chunk)): (usize, (usize, &Chunk))| {
        let span = chunk.accelerometer?.span;
        let begin = rows.data.rests[chunk.rest].span.from;
        let rows = 3 * k..3 * k + 3;
        let (path, sign) = (chunk.rest, -1.0);
        let of_mean = Exposure::of_mean(rows, path, (span.from, span.to), begin, sign);
        Some(white.exposure(&of_mean))
    };
    let means = rows.means(Sensor::Accelerometer).enumerate();
    let exposures: Vec<Exposure> = means.filter_map(exposure).collect();
    covariance(&exposures, rows.count())
}

/// The size up to which noise of this covariance is common: where a row feels it most, whose white noise has the variance
/// one, it has this standard deviation.
fn usual_size(covariance: &Covariance, deviations: f64) -> f64 {
    let farthest = covariance.diagonal().fold(0.0, f64::max);
    if farthest > 0.0 {
        deviations / farthest.sqrt()
    } else {
        1.0
    }
}

/// The rows of every turn.
fn turn_rows(rows: &Rows<'_>) -> Vec<Vec<usize>> {
    let of_turn = |k: usize| {
        let first = rows.first_turn_row() + 2 * k;
        vec![first, first + 1]
    };
    (0..rows.data.turns.len()).map(of_turn).collect()
}

/// The rows of every rest, by sensor, and of every turn.
fn groups(rows: &Rows<'_>) -> [(ComponentKind, Vec<Vec<usize>>); 3] {
    let of_rests = |sensor: Sensor, first: usize| {
        let mut groups = vec![Vec::new(); rows.data.rests.len()];
        for (k, (_, chunk)) in rows.means(sensor).enumerate() {
            groups[chunk.rest].extend(first + 3 * k..first + 3 * k + 3);
        }
        groups
    };
    [
        (
            ComponentKind::ForceScatter,
            of_rests(Sensor::Accelerometer, 0),
        ),
        (
            ComponentKind::RateScatter,
            of_rests(Sensor::Gyroscope, rows.first_rate_row()),
        ),
        (ComponentKind::TurnScatter, turn_rows(rows)),
    ]
}

/// Covariance of a scatter that the chunks of a rest share, axis by axis; the rows of a turn share none.
fn shared(groups: &[Vec<usize>], kind: ComponentKind, m: usize) -> Covariance {
    let alone = kind == ComponentKind::TurnScatter;
    let of_group = |group: &Vec<usize>| {
        let same = |a: usize, b: usize| if alone { a == b } else { a % 3 == b % 3 };
        let value = |a: usize, b: usize| f64::from(u8::from(same(a, b)));
        (group.clone(), Mat::from_fn(group.len(), group.len(), value))
    };
    Covariance::of_blocks(m, groups.iter().map(of_group).collect())
}
