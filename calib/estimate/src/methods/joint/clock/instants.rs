//! Recordings whose turns can tell samples at instants from means over windows.

use nalgebra::{Matrix2, Vector2};

use crate::methods::joint::minimum::{Point, Run};

findings::tuning! {
    /// Distance from which on the two are told apart, in standard deviations of the white noise of the turns' rows: below, the one explains
    /// the turns better than the other by less than half its square, 2 units of log-likelihood, and no parameter is off by more than that
    /// many standard errors.
    APART: f64 = 2.0;
}

impl Run<'_> {
    /// The recordings whose turns differ visibly between samples at instants and means over windows, at `point` or at the first values.
    ///
    /// By a window of length `h` the sum of the rates is another by `h²/12 ∫ ω × ω̇ dt`, whatever the rate of sampling: a slow
    /// gyroscope in a slow hand tells them no better than a fast and quiet one in a quick hand.
    pub(super) fn tell_instants(&self, point: Option<&Point>) -> Vec<usize> {
        let rows = self.rows(&[]);
        let x = self.values_near(&rows, point);
        let noise = rows.noise(&x);
        let mut squares = vec![0.0; self.data.sources.len()];
        for (row, turn) in rows.turns() {
            let (of, with) = (&noise.variance, noise.with_before[row + 1]);
            let covariance = Matrix2::new(of[row], with, with, of[row + 1]);
            squares[turn.recording] += square(&rows.by_instants(&x, turn), &covariance);
        }
        let visible = |k: &usize| squares[*k] > APART.get() * APART.get();
        (0..squares.len()).filter(visible).collect()
    }
}

/// `dᵀ C⁻¹ d`; zero where `C` has no inverse.
fn square(d: &Vector2<f64>, covariance: &Matrix2<f64>) -> f64 {
    let inverse = covariance.try_inverse();
    inverse.map_or(0.0, |inverse| d.dot(&(inverse * d)))
}
