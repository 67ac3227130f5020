//! The last steps and the result.

use recording::Error;
use solver::Termination;

use super::approach::{Weighted, approach};
use super::data::budget::Steps;
use super::faults::{DISTURBED_INTERVAL, Flagged, Reason, Seen, Suspect};
use super::fit::JointFit;
use super::graph::{Ended, solve_rows};
use super::minimum::{Point, Run};
use crate::methods::joint::blocks::basis::Basis;
use crate::methods::joint::blocks::columns::Columns;
use crate::methods::joint::disturbance::belief::Weights;
use crate::methods::joint::noise::centred::centred;
use crate::methods::joint::noise::weights::{Whitening, weighing};
use crate::methods::joint::result::marginal::reduced;

findings::tuning! {
    /// A minimum nearer than this, in standard errors, is reached.
    NEAR: f64 = 0.01;

    /// One of many models that are compared has settled where its last step moved the rows by less than a thousandth of a standard
    /// deviation of all together, in square.
    SETTLED: f64 = 1e-6;
}

impl Run<'_> {
    /// The same weights for biases that are means over the rests.
    fn about_the_means(&self, point: &Point, weights: Weights) -> Weights {
        let rows = self.rows(&[]);
        let white = &weights.whitening.white;
        let noise = rows.noise(point.plain_values());
        let walks = (&weights.components[..], weights.walk_ends_with_rests);
        let components = centred(&rows, &noise, white, walks);
        let levels = weighing(&weights.levels);
        Weights {
            whitening: Whitening::new(white.clone(), &components, &levels),
            components,
            ..weights
        }
    }

    /// The last steps, to what double precision allows.
    pub(crate) fn finish(&self, point: &Point, weights: Weights) -> Result<JointFit, Error> {
        let weights = self.about_the_means(point, weights);
        let columns = weights.columns();
        let rows = self.rows(&columns);
        let weighted = Weighted {
            rows: &rows,
            whitening: &weights.whitening,
        };
        let free = point.mask.free_indices();
        let mut parameters = point.parameters.clone();
        let mut settled = None;
        if let Some(near) = approach(&weighted, parameters.values(), &free) {
            self.start.steps.took(near.taken);
            let (x, left) = near.settled(&weighted, &free);
            parameters.values_mut().copy_from_slice(&x);
            let is_enough = self.request.compared && left < SETTLED.get();
            settled = is_enough.then(|| Ended::settled(x, near.taken));
        }
        let ended = match settled {
            Some(ended) => ended,
            None => {
                let most = Steps::at_the_end(self.data.cost_of_a_step());
                solve_rows(&weighted, parameters.values(), &free, most)?
            }
        };
        self.start.steps.took(ended.linearisations);
        parameters.values_mut().copy_from_slice(&ended.x);
        let (x, mut ending) = (&ended.x, ended.ending);
        let linear = rows.linearize(x);
        let white = &weights.whitening.white;
        let (white_residuals, white_jacobian) = linear.whitened_by(&free, white);
        let jacobian = weights.whitening.finish_columns(white_jacobian.clone());
        let reduced = reduced(&jacobian, &free, rows.layout.shared());
        let carried = weights.whitening.finish_columns(weights.carried);
        let of_place = weights.whitening.finish_columns(weights.of_place);
        let without_end = [Termination::Stalled, Termination::IterationLimit];
        let residuals = weights.whitening.finish_column(&white_residuals);
        if without_end.contains(&ending.termination) && is_near(&residuals, &jacobian) {
            ending.termination = Termination::Cost;
        }
        let broken = self.broken();
        Ok(JointFit {
            models: [
                self.request.accelerometer.clone(),
                self.request.gyroscope.clone(),
            ],
            chords: rows.chords(x),
            norms: rows.norms(x),
            parameters,
            shared: rows.layout.shared(),
            first_rows: [rows.first_rate_row(), rows.first_turn_row()],
            rest_of_row: rows.rest_of_row(),
            residuals,
            jacobian,
            reduced,
            carried,
            of_place,
            white_residuals,
            white_jacobian,
            flagged: self
                .in_words(&weights.flagged, &x[point.plain..])
                .chain(broken)
                .collect(),
            shown: weights.shown,
            own_force_bias: self.start.own_force_bias,
            force_unit: self.start.force_unit,
            rate_unit: self.start.rate_unit,
            gravity: self.request.gravity,
            chords_before: match self.request.minimum_before() {
                Some(before) => before.chords_before.clone(),
                None => rows.chords(self.first_values(&rows).values()),
            },
            data: self.data.clone(),
            charts: self.charts.clone(),
            disturbance_columns: columns.clone(),
            whitening: weights.whitening,
            components: weights.components,
            levels: weights.levels,
            work: self.start.steps.work(self.data.cost_of_a_step()),
            free,
            ending,
        })
    }

    /// The touches that broke rests: nothing of them is in the means, and the turn carries on.
    fn broken(&self) -> impl Iterator<Item = Flagged> + '_ {
        self.data
            .broken
            .iter()
            .map(|&(recording, interval, span)| Flagged {
                fault: &DISTURBED_INTERVAL,
                reason: Reason::Disturbed,
                recording,
                interval,
                span,
                size: 0.0,
                shook: true,
                seen: Seen::Cut,
            })
    }

    /// Converts suspects to flagged disturbances; `sizes` are their fitted parameters, one suspect after the other.
    fn in_words<'b>(
        &'b self,
        suspects: &'b [Suspect],
        sizes: &'b [f64],
    ) -> impl Iterator<Item = Flagged> + 'b {
        suspects.iter().scan(sizes, |left, suspect| {
            let (own, others) = left.split_at_checked(suspect.columns.len())?;
            *left = others;
            Some(self.one_in_words(suspect, own))
        })
    }

    fn one_in_words(&self, suspect: &Suspect, fitted: &[f64]) -> Flagged {
        let fault = suspect.fault;
        let (recording, interval, span) = fault.scope.when(&self.data, suspect.place);
        let norm = fault.length(fitted);
        Flagged {
            fault,
            reason: suspect.reason,
            recording,
            interval,
            span,
            size: fault.size(norm, span),
            shook: suspect.seen != Seen::Nothing,
            seen: (fault.seen)(norm, span, self.request.gravity, suspect.seen),
        }
    }
}

/// Returns true if the minimum is nearer than a hundredth of the standard errors: the part of the whitened residuals
/// that the Jacobian's columns still explain is below that share of its expectation by chance (Bates & Watts 1981). A
/// combination that is hardly observable can stop the cost from falling further, by rounding.
fn is_near(residuals: &[f64], jacobian: &Columns) -> bool {
    let basis = Basis::of(jacobian);
    let left = basis.without_column(residuals);
    let square = |r: &[f64]| r.iter().map(|v| v * v).sum::<f64>();
    let explained = residuals.iter().zip(&left).map(|(r, l)| r - l);
    square(&explained.collect::<Vec<_>>()) < NEAR.get().powi(2) * basis.rank() as f64
}
