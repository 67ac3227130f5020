//! The disagreement by channel: where in the data it is, channel after channel.

use estimate::methods::joint::{Basis, BiasNoise, Columns, Whitening};
use faer::Mat;
use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::channel::Channel;
use crate::state::State;

/// `χ²` and its degrees of freedom.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Misfit {
    /// Sum of squares of whitened residuals.
    pub chi2: f64,
    /// Its expectation where nothing is missing.
    pub dof: f64,
}

impl Misfit {
    /// `√(χ²/dof)`: 1 is explained to the noise; 1 without degrees of freedom.
    pub fn gap(&self) -> f64 {
        if self.dof > 0.0 {
            (self.chi2 / self.dof).sqrt()
        } else {
            1.0
        }
    }

    /// Between which nine gaps of ten lie where nothing is missing; `None` without degrees of freedom.
    pub fn gap_by_chance(&self) -> Option<[f64; 2]> {
        let law = ChiSquared::new(self.dof).ok()?;
        Some([0.05, 0.95].map(|p| (law.inverse_cdf(p) / self.dof).sqrt()))
    }

    /// Adds another.
    pub fn add(&mut self, other: Self) {
        self.chi2 += other.chi2;
        self.dof += other.dof;
    }
}

/// The rows of a state, whitened by everything at given densities.
#[derive(Clone, Debug)]
pub struct Sequence {
    /// For each channel a basis of the columns of its rows and all before.
    bases: [Basis; 3],
    /// First rows of the channels and the end.
    ends: [usize; 3],
    whitening: Whitening,
}

impl Sequence {
    /// At this noise of the biases.
    ///
    /// Rows are in the order force, rate, turns, and a Cholesky factor mixes a row with those before it
    /// only: what the parameters leave of the first rows, of the first two kinds, and of all, differ by
    /// sums of squares that are independent. That of the rows of force is the norm, the direction of a rest
    /// being free there.
    pub fn of(state: &State, noise: BiasNoise) -> Self {
        let fit = &state.fit;
        let whitening = whitening_at(state, noise);
        let ends = [fit.first_rows[0], fit.first_rows[1], state.rows()];
        Self::under(whitening, fit.white_jacobian.clone(), ends)
    }

    /// Builds it for rows whose kinds end at `ends`, under any whitening; `jacobian` (`m × n`) is that of the free
    /// parameters, white-whitened.
    pub fn under(whitening: Whitening, jacobian: Columns, ends: [usize; 3]) -> Self {
        let jacobian = whitening.finish_columns(jacobian);
        let bases = ends.map(|end| Basis::of(&jacobian.first_rows(end)));
        Self {
            bases,
            ends,
            whitening,
        }
    }

    /// Computes the misfit of each channel from the residuals of the fit.
    pub fn misfits(&self, state: &State) -> [Misfit; 3] {
        let r = &state.fit.white_residuals;
        self.of_column(r)
    }

    /// The channel that shows most of a white-whitened column (`m × 1`).
    pub fn channel_of(&self, column: &Mat<f64>) -> Channel {
        channel_of(&self.of_column(column.col_as_slice(0)))
    }

    /// The part of a white-whitened column (`m`) that no parameter explains, whitened.
    pub fn left_of(&self, column: &[f64]) -> Vec<f64> {
        let [.., whole] = &self.bases;
        whole.without_column(&self.whitening.finish_column(column))
    }

    /// Computes the part of any white-whitened column (`m`) that shows in each channel.
    pub fn of_column(&self, column: &[f64]) -> [Misfit; 3] {
        let column = self.whitening.finish_column(column);
        let mut before = Misfit::default();
        let mut misfits = [Misfit::default(); 3];
        for (k, basis) in self.bases.iter().enumerate() {
            let left = basis.without_column(&column[..self.ends[k]]);
            let upto = Misfit {
                chi2: left.iter().map(|v| v * v).sum(),
                dof: (self.ends[k] - basis.rank()) as f64,
            };
            misfits[k] = Misfit {
                chi2: (upto.chi2 - before.chi2).max(0.0),
                dof: upto.dof - before.dof,
            };
            before = upto;
        }
        misfits
    }
}

/// The whitening of a state's rows by white noise and this noise of the biases.
pub(crate) fn whitening_at(state: &State, noise: BiasNoise) -> Whitening {
    let fit = &state.fit;
    let levels = noise.levels();
    Whitening::new(fit.whitening.white.clone(), &fit.components, &levels)
}

/// The channel with the largest part of a column.
pub fn channel_of(parts: &[Misfit; 3]) -> Channel {
    let mut best = 0;
    for k in 1..3 {
        if parts[k].chi2 > parts[best].chi2 {
            best = k;
        }
    }
    Channel::ALL[best]
}

#[cfg(test)]
mod tests {
    use simulate::Spec;

    use super::*;
    use crate::{Extension, Request, Session};

    #[test]
    fn the_channels_add_up_to_the_whole_disagreement() {
        let mut spec = Spec::hand_held(5);
        spec.gyroscope.random_walk = 5e-6;
        let recordings = [spec.run().unwrap().recording];
        let session = Session::new(&recordings, &Request::new(spec.gravity)).unwrap();
        let state = State::fit(&session, Extension::default()).unwrap();
        let noise = BiasNoise {
            walk: [2e-5, 5e-6],
            flicker: [[1e-4; 3], [1e-5; 3]],
        };
        let misfits = Sequence::of(&state, noise).misfits(&state);
        let whole = state.projected.at(noise).unwrap();
        let sum: f64 = misfits.iter().map(|m| m.chi2).sum();
        let dof: f64 = misfits.iter().map(|m| m.dof).sum();
        assert!(
            (sum / whole.square - 1.0).abs() < 1e-6,
            "{sum} {}",
            whole.square
        );
        assert_eq!(dof, state.projected.dof() as f64);
    }
}
