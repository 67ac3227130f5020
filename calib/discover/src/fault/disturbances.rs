//! The disturbances that a model holds: their evidence and their sizes.

use std::ops::Range;

use estimate::methods::joint::{Basis, Known};
use faer::Mat;

use crate::score::log_tail;
use crate::state::State;

impl State {
    /// Lists the disturbances of the model in the order of the findings, with the places of their parameters.
    fn held(&self) -> impl Iterator<Item = (Known, Range<usize>)> + '_ {
        let mut next = self.fit.parameters.values().len() - self.fit.disturbance_columns.len();
        let suspects = self.suspects.iter();
        suspects.filter_map(move |s| {
            let known = self.known(s.fault, s.place)?;
            let own = next..next + s.columns.len();
            next = own.end;
            Some((known, own))
        })
    }

    /// Returns `ln p` of `βᵀ C⁻¹ β` for each disturbance of the model, `β` its parameters and `C` their covariance.
    pub fn disturbances(&self) -> Vec<(Known, f64)> {
        let all = self.held();
        all.map(|(known, own)| (known, self.log_p_of_nothing(own)))
            .collect()
    }

    /// Length of what each disturbance of the model comes to, in the order of the findings: rad/s of a creep and of a rate,
    /// m/s² of a force, rad of a turn and of a slip at once.
    pub fn disturbed_sizes(&self) -> Vec<(Known, f64)> {
        let values = self.fit.parameters.values();
        self.held()
            .map(|(known, own)| (known, known.fault.length(&values[own])))
            .collect()
    }

    /// `ln p` that some parameters are nothing.
    fn log_p_of_nothing(&self, places: Range<usize>) -> f64 {
        let is_own = |k: &usize| places.contains(&self.fit.free[*k]);
        let columns: Vec<usize> = (0..self.fit.free.len()).filter(is_own).collect();
        let jacobian = &self.fit.jacobian;
        let others: Vec<usize> = (0..jacobian.ncols())
            .filter(|k| !columns.contains(k))
            .collect();
        let taken = Basis::of(&jacobian.select(&others));
        let own = taken.without(&jacobian.select(&columns)).to_dense();
        let values = &self.fit.parameters.values()[places];
        let explained = own * Mat::from_fn(values.len(), 1, |k, _| values[k]);
        log_tail(explained.squared_norm_l2(), values.len() as f64)
    }
}
