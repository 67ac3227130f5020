//! Scatter of rests and turns that the noise is allowed where the model misses by more than the readings' own.

use sensor::Sensor;

use super::analysis::{Analysis, identity, turn_rows, walk};
use crate::methods::chance;
use crate::methods::joint::blocks::column::Column;
use crate::methods::joint::blocks::columns::Columns;
use crate::methods::joint::blocks::covariance::Covariance;
use crate::methods::joint::faults::Suspect;
use crate::methods::joint::noise::chain::Chain;
use crate::methods::joint::noise::exposure::Exposure;
use crate::methods::joint::noise::likelihood::Restricted;
use crate::methods::joint::noise::weights::{Component, ComponentKind, Form, NoiseLevel, White};
use crate::methods::joint::result::row_residuals::RowResiduals;
use crate::methods::joint::rows::{MeanRows, Rows};
use crate::methods::small_sample::LEAST_SPARE;

findings::tuning! {
    /// A fit whose quieter three quarters are off by this much, as χ² per degree of freedom, does not
    /// know its noise: the model misses, or the noise is of another kind.
    MISFIT: f64 = 2.0;

    /// The same of turns above which no single effect is taken for the cause before their scatter is allowed for.
    GROSS: f64 = 4.0;

    /// Sums of squares that exceed their expectation by fewer of their standard deviations are looked at no further.
    QUIET: f64 = 2.0;

    /// Rows that leave so much by chance only do not scatter.
    UNLIKELY: f64 = 1e-3;

    /// A walk through the whole recording is the better account of what differs between rests where the data are so many
    /// times likelier under it (log) than under scatter from rest to rest.
    WALKS: f64 = 2.0;
}

impl Analysis {
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

    /// Returns true if the quieter three quarters of the static intervals or turns are off by far more than the noise.
    pub fn is_missed(&self, rows: &Rows<'_>, known: &[&Suspect]) -> bool {
        !self.missed(rows, &self.taken(known)).is_empty()
    }

    /// The kinds of rows of which the quieter three quarters are off by far more than the noise.
    fn missed(&self, rows: &Rows<'_>, taken: &Columns) -> Vec<(ComponentKind, Vec<Vec<usize>>)> {
        let left = RowResiduals::of(taken, &self.residuals);
        let is_off = |(_, groups): &(_, Vec<Vec<usize>>)| left.quieter_ratio(groups) > MISFIT.get();
        groups(rows).into_iter().filter(is_off).collect()
    }

    /// The Jacobian beside disturbances, patterns of the orientation and what is carried.
    pub(super) fn taken(&self, known: &[&Suspect]) -> Columns {
        let own = self.orientation.iter().map(|(_, own)| own);
        let own = own.chain(&self.carried);
        own.fold(self.with(known), |taken, own| taken.beside(own))
    }

    /// The sum of squares that the turns are missed by beside disturbances.
    pub fn left_in_turns(&self, rows: &Rows<'_>, known: &[&Suspect]) -> f64 {
        let left = RowResiduals::of(&self.taken(known), &self.residuals);
        let turns = rows.first_turn_row()..rows.count();
        turns.map(|row| left.square(row)).sum()
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
        let left = RowResiduals::of(&self.with(known), &self.residuals);
        let [_, _, (_, turns)] = groups(rows);
        if left.quieter_ratio(&turns) > GROSS.get() {
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
        let whitened = self.whitened(known, levels);
        if self.is_quiet(rows, &whitened.residuals) {
            return false;
        }
        let left = RowResiduals::of(&whitened.columns, &whitened.residuals);
        for (kind, groups) in groups(rows) {
            if self.components.iter().any(|c| c.kind == kind) {
                continue;
            }
            let (mut square, mut spare) = (0.0, 0.0);
            for &i in groups.iter().flatten() {
                square += left.square(i);
                spare += left.spare(i);
            }
            if spare > 0.5 && chance::of_chi2(square, spare) < UNLIKELY.get() {
                self.allow(rows, kind, &groups);
            }
        }
        self.components.len() > before
    }

    /// Returns true if no kind of rows exceeds its expected sum of squares conspicuously, even before anything more is
    /// fitted.
    fn is_quiet(&self, rows: &Rows<'_>, r: &[f64]) -> bool {
        let [rate, turns, end] = [rows.first_rate_row(), rows.first_turn_row(), rows.count()];
        let directions = 2 * rows.data.rests.len() + 9;
        [(0, rate, directions), (rate, turns, 3), (turns, end, 9)]
            .into_iter()
            .all(|(from, to, taken)| {
                let square: f64 = r[from..to].iter().map(|v| v.powi(2)).sum();
                let spare = (to - from).saturating_sub(taken) as f64;
                square <= spare + QUIET.get() * (2.0 * spare).sqrt()
            })
    }

    fn allow(&mut self, rows: &Rows<'_>, kind: ComponentKind, groups: &[Vec<usize>]) {
        let component = match kind {
            ComponentKind::RateScatter => self.shared_by_rests(kind, &self.rate_shifts(rows)),
            ComponentKind::ForceScatter => {
                let shifts: Vec<Column> = groups.iter().flat_map(|rows| by_axis(rows)).collect();
                let shifts = self.white.sparse(&shifts.iter().collect::<Vec<_>>());
                self.shared_by_rests(kind, &shifts)
            }
            _ => self.of_each_turn(kind, rows),
        };
        self.components.push(component);
    }

    /// Scatter of what every rest shifts, `columns` of it whitened by the white noise.
    fn shared_by_rests(&self, kind: ComponentKind, columns: &Columns) -> Component {
        Component {
            kind,
            covariance: Covariance::of_columns(columns),
            form: Form::Passed(Chain::of_columns(&self.stations, columns)),
        }
    }

    /// Scatter of the turns.
    pub(super) fn of_each_turn(&self, kind: ComponentKind, rows: &Rows<'_>) -> Component {
        let covariance = self
            .white
            .both_sides(&identity(&turn_rows(rows), rows.count()));
        Component {
            form: Form::Passed(Chain::of_each(&self.stations, &covariance)),
            covariance,
            kind,
        }
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
        if rows.spare_placements() < LEAST_SPARE.get() {
            return;
        }
        let within = walk(
            ComponentKind::AccelerometerWalk,
            &exposures_within_rests(rows, &self.white),
            &self.stations,
        );
        let is_walk = |c: &Component| c.kind == ComponentKind::AccelerometerWalk;
        let Some(place) = self.components.iter().position(is_walk) else {
            return;
        };
        let through = self.likelihood_of_noise(taken);
        let whole = std::mem::replace(&mut self.components[place], within);
        if through - self.likelihood_of_noise(taken) > WALKS.get() {
            self.components[place] = whole;
        } else {
            self.walk_ends_with_rests = true;
        }
    }

    /// The highest restricted log-likelihood of walks and scatter, the columns `taken` fitted, up to a constant.
    fn likelihood_of_noise(&self, taken: &Columns) -> f64 {
        let own = self.components.iter();
        let own = own.filter(|c| c.kind.is_walk() || !c.kind.is_noise());
        let own: Vec<&Component> = own.filter(|c| !c.kind.is_of_orientation()).collect();
        Restricted::new(&self.residuals, taken, &own).highest()
    }
}

/// Computes the exposures of the accelerometer's rows to a walk of its bias that begins at zero in every static
/// interval; whitened by the white noise.
fn exposures_within_rests(rows: &Rows<'_>, white: &White) -> Vec<Exposure> {
    let exposure = |own: MeanRows<'_>| {
        let (span, path) = (own.mean.span, own.chunk.rest);
        let begin = rows.data.rests[path].span.from;
        let rows = own.row..own.row + 3;
        let of_mean = Exposure::of_mean(rows, path, (span.from, span.to), begin, -1.0);
        white.exposure(&of_mean)
    };
    rows.means(Sensor::Accelerometer).map(exposure).collect()
}

/// Builds the unit columns of a shift on each axis in a static interval's rows of the accelerometer.
fn by_axis(rows: &[usize]) -> [Column; 3] {
    [0, 1, 2].map(|axis| {
        let mut column = Column::none();
        let own = rows.iter().filter(|row| *row % 3 == axis);
        own.for_each(|&row| column.set(row, 1.0));
        column
    })
}

/// The rows of every rest, by sensor, and of every turn.
fn groups(rows: &Rows<'_>) -> [(ComponentKind, Vec<Vec<usize>>); 3] {
    let of_rests = |sensor: Sensor| {
        let mut groups = vec![Vec::new(); rows.data.rests.len()];
        for own in rows.means(sensor) {
            groups[own.chunk.rest].extend(own.row..own.row + 3);
        }
        groups
    };
    [
        (ComponentKind::ForceScatter, of_rests(Sensor::Accelerometer)),
        (ComponentKind::RateScatter, of_rests(Sensor::Gyroscope)),
        (ComponentKind::TurnScatter, turn_rows(rows)),
    ]
}
