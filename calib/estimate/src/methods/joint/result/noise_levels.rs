//! Levels of walks, scatter and flicker by restricted likelihood, without a refit.

use super::analysis::Analysis;
use crate::methods::joint::blocks::column::Column;
use crate::methods::joint::blocks::columns::Columns;
use crate::methods::joint::blocks::covariance::Covariance;
use crate::methods::joint::faults::Suspect;
use crate::methods::joint::fit::JointFit;
use crate::methods::joint::noise::bias::{Within, within};
use crate::methods::joint::noise::likelihood::Restricted;
use crate::methods::joint::noise::walks::{NO_WALK, Walks, expected_square};
use crate::methods::joint::noise::weights::{Component, ComponentKind, NoiseLevel};
use crate::methods::joint::result::row_residuals::RowResiduals;
use crate::methods::joint::rows::Rows;

findings::tuning! {
    /// Prior chance of no doubt of turns at all, over that of any.
    NO_DOUBT: f64 = 1.0;

    /// Usual limit of a walk: its standard deviation in the row that feels it most, in standard deviations of a chunk's
    /// mean.
    USUAL: f64 = 3.0;

    /// The same of what turns scatter by without any recording showing it, in standard deviations of the best turn.
    USUAL_OF_TURNS: f64 = 1.0;
}

impl Analysis {
    /// The kinds of noise that are estimated together where the biases may flicker.
    pub fn estimated_kinds(&self) -> Vec<ComponentKind> {
        estimated_kinds(&self.components)
    }

    /// The levels of the components by restricted likelihood, with the disturbances' columns among the
    /// free ones: scatter at its likeliest, walks as their expectation, which none at all may be; walks and flicker
    /// together at their likeliest, given what the readings `within` static intervals say of them. Walks begin at what they were
    /// `before`, where that is known.
    pub fn levels(
        &self,
        disturbances: &[&Suspect],
        within: &[Within],
        before: &[NoiseLevel],
    ) -> Vec<NoiseLevel> {
        let jacobian = self.with(disturbances);
        let of = |wanted: fn(ComponentKind) -> bool| -> Vec<&Component> {
            self.components.iter().filter(|c| wanted(c.kind)).collect()
        };
        if !of(ComponentKind::is_flicker).is_empty() {
            return likeliest(&self.residuals, &jacobian, &self.components, within);
        }
        let (walks, scatter) = (of(ComponentKind::is_walk), of(|kind| !kind.is_noise()));
        let scatter = self.scatter(&jacobian, &walks, &scatter, before);
        let known = self.components.iter();
        let known: Vec<(&Component, f64)> = known
            .filter_map(|c| Some((c, c.kind.known_variance()?)))
            .collect();
        let fixed: Vec<(&Component, f64)> = scatter.iter().chain(&known).copied().collect();
        let usual = walks
            .iter()
            .map(|walk| usual_size(&walk.covariance, USUAL.get()));
        let usual: Vec<f64> = usual.collect();
        let from = variances_of(&walks, before);
        let expected = Walks::new(&self.residuals, &jacobian, &walks, &fixed).expected(
            &usual,
            NO_WALK.get(),
            &from,
        );
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

    /// The likeliest variances of the scatter, walks beside it.
    fn scatter<'a>(
        &self,
        jacobian: &Columns,
        walks: &[&Component],
        scatter: &[&'a Component],
        before: &[NoiseLevel],
    ) -> Vec<(&'a Component, f64)> {
        if scatter.is_empty() {
            return Vec::new();
        }
        let all: Vec<&Component> = walks.iter().chain(scatter).copied().collect();
        let kept: Vec<bool> = (0..all.len()).map(|c| c < walks.len()).collect();
        let from = variances_of(&all, before);
        let variances = Restricted::new(&self.residuals, jacobian, &all).variances(&kept, &from);
        let own = variances.into_iter().skip(walks.len());
        scatter.iter().copied().zip(own).collect()
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
        let kind = ComponentKind::TurnDoubt;
        let component = self.of_each_turn(kind, rows);
        let whitened = self.whitened(known, levels);
        let by_turn = whitened.whitening.finish_columns(by_turn);
        let by_scatter = row_squares(&by_turn);
        let left = RowResiduals::of(&whitened.columns, &whitened.residuals);
        let of_row = |i: usize| (left.square(i), left.spare(i), by_scatter[i]);
        let turns: Vec<(f64, f64, f64)> = (first..count).map(of_row).collect();
        let log_likelihood = |size: f64| {
            let of_turn = |(square, spare, by_scatter): &(f64, f64, f64)| {
                let v = 1.0 + by_scatter * size * size;
                -0.5 * (spare * v.ln() + square / v)
            };
            turns.iter().map(of_turn).sum()
        };
        let usual = usual_size(&component.covariance, USUAL_OF_TURNS.get());
        let size = expected_square((usual, NO_DOUBT.get()), log_likelihood).sqrt();
        self.components.push(component);
        levels.push(NoiseLevel { kind, size });
    }
}

impl JointFit {
    /// The noise of the rows if the biases flicker as well as walk, all of it at its likeliest: the components, whitened by
    /// the white noise, and how much there is of each.
    ///
    /// The parameters stay: the restricted likelihood takes out of the rows whatever they explain.
    pub fn flickering(&self) -> (Vec<Component>, Vec<NoiseLevel>) {
        let rows = self.plain_rows();
        let x = &self.parameters.values()[..rows.layout.disturbance(0)];
        let own = self.components.iter().filter(|c| !c.kind.is_flicker());
        let stations = rows.stations(&rows.noise(x));
        let flicker = rows.flicker(x, &self.whitening.white, &stations);
        let components: Vec<Component> = own.cloned().chain(flicker).collect();
        let within = within(&self.data, &estimated_kinds(&components));
        let (residuals, jacobian) = (&self.white_residuals, &self.white_jacobian);
        let levels = likeliest(residuals, jacobian, &components, &within);
        (components, levels)
    }
}

fn estimated_kinds(components: &[Component]) -> Vec<ComponentKind> {
    let kinds = components.iter().map(|c| c.kind);
    let estimated =
        |k: &ComponentKind| k.is_walk() || k.is_flicker() || *k == ComponentKind::TurnScatter;
    kinds.filter(estimated).collect()
}

/// Walks, flicker and the scatter of turns at their likeliest, what is known beside them.
fn likeliest(
    residuals: &[f64],
    jacobian: &Columns,
    components: &[Component],
    within: &[Within],
) -> Vec<NoiseLevel> {
    let kinds = estimated_kinds(components);
    let own = components.iter().filter(|c| kinds.contains(&c.kind));
    let own: Vec<&Component> = own.collect();
    let mut restricted = Restricted::new(residuals, jacobian, &own);
    restricted.within = within.to_vec();
    let kept: Vec<bool> = kinds.iter().map(|kind| kind.is_noise()).collect();
    let variances = restricted.variances(&kept, &vec![0.0; kept.len()]);
    let known = components.iter();
    let known = known.filter_map(|c| Some((c.kind, c.kind.known_variance()?)));
    let levels = kinds.iter().copied().zip(variances).chain(known);
    let level = |(kind, variance): (ComponentKind, f64)| NoiseLevel {
        kind,
        size: variance.sqrt(),
    };
    levels.map(level).collect()
}

/// The variances of components at these levels, zero where there is none.
fn variances_of(components: &[&Component], levels: &[NoiseLevel]) -> Vec<f64> {
    let of = |component: &&Component| {
        let known = levels.iter().find(|level| level.kind == component.kind);
        known.map_or(0.0, |level| level.size * level.size)
    };
    components.iter().map(of).collect()
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
