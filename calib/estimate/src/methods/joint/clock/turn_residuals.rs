//! Residuals of the turns after a fit, and their dependence on the shares of clocks and samples.

use nalgebra::{DMatrix, DVector, Matrix2, Vector2};

use super::sampling::{Evidence, Levels};
use crate::methods::joint::blocks::basis::Basis;
use crate::methods::joint::data::{Data, Source};
use crate::methods::joint::minimum::{Point, Run};
use crate::methods::joint::noise::weights::White;

/// The median of `χ²` of two degrees of freedom.
const MEDIAN_OF_TWO: f64 = 1.386_294_361_119_890_6;

/// And of one.
const MEDIAN_OF_ONE: f64 = 0.454_936_423_119_572_3;

/// Residuals of the turns after a fit, and their dependence on the shares.
pub(super) struct TurnResiduals {
    turns: Vec<Evidence>,
    /// Whitened residuals of all rows after the fit (`m`).
    residuals: Vec<f64>,
    /// Derivative of these residuals by the clock's share, for each open recording (`m`).
    by_share: Vec<Vec<f64>>,
    /// First row of the turns.
    first: usize,
    /// Restricted log-likelihood of all rows, up to a constant, turns that something else is wrong with apart.
    pub likelihood: f64,
}

impl TurnResiduals {
    /// Builds the residuals after a fit; `open` are the recordings whose clock's share is fitted.
    ///
    /// `by_share_of_one`, the covariance that a share of one adds to every turn, must be the one in the weights. If it
    /// differed by a thousandth, taking away a share that makes up all but a thousandth of the noise would leave a
    /// negative variance.
    pub fn of_fit(
        run: &Run<'_>,
        point: &Point,
        (white, by_share_of_one): (&White, &[Matrix2<f64>]),
        open: &[usize],
    ) -> Self {
        let rows = run.rows(&[]);
        let (x, free) = (point.plain_values(), point.mask.free_indices());
        let (r, jacobian) = point.linear.whitened_by(&free, white);
        let first = rows.first_turn_row();
        let mut by_share = vec![vec![0.0; r.len()]; open.len()];
        for (row, turn) in rows.turns() {
            if let Some(place) = open.iter().position(|&o| o == turn.recording) {
                let moved = rows.by_clock(x, turn);
                by_share[place][row] = moved[0];
                by_share[place][row + 1] = moved[1];
            }
        }
        let basis = Basis::of(&jacobian);
        let residuals = basis.without_column(&r);
        let of_share = |column: &Vec<f64>| basis.without_column(&white.whiten(column));
        let by_share = by_share.iter().map(of_share).collect();
        let turns = by_share_of_one.iter().enumerate().map(|(k, by_share)| {
            let row = first + 2 * k;
            let hat = Matrix2::from_fn(|i, j| basis.row_product(row + i, row + j));
            let [share, floor] =
                [by_share, &Matrix2::identity()].map(|c| both_sides(white, row, c));
            let left = Vector2::new(residuals[row], residuals[row + 1]);
            Evidence::new(&left, &hat, &share, &floor)
        });
        let turns: Vec<Evidence> = turns.collect();
        let before_turns: f64 = residuals.iter().take(first).map(|r| r * r).sum();
        let likelihood = turns.iter().map(Evidence::score).sum::<f64>()
            - 0.5 * before_turns
            - white.log_determinant()
            - basis.log_volume();
        Self {
            turns,
            likelihood,
            residuals,
            by_share,
            first,
        }
    }

    /// Returns the evidence of the turns of a recording.
    pub fn of(&self, data: &Data, recording: usize) -> Vec<Evidence> {
        let turns = data.turns.iter().zip(&self.turns);
        turns
            .filter(|(turn, _)| turn.recording == recording)
            .map(|(_, evidence)| *evidence)
            .collect()
    }

    /// By how much the turns miss usually, as `χ²` per degree of freedom: its median, so that turns that something
    /// else is wrong with do not count.
    pub fn misfit(&self, data: &Data, recording: usize) -> f64 {
        self.usual(data, recording, |_| 1.0)
    }

    /// The same over the noise without the scatter that was allowed for.
    pub fn whole_misfit(&self, data: &Data, recording: usize) -> f64 {
        let now = data.sources[recording].levels();
        self.usual(data, recording, |turn| (1.0 - turn.of_floor(now)).max(1e-4))
    }

    fn usual(&self, data: &Data, recording: usize, noise: impl Fn(&Evidence) -> f64) -> f64 {
        let turns = self.of(data, recording);
        let known = turns.iter().filter(|turn| turn.spare > 0.0);
        let mut ratios: Vec<f64> = known
            .map(|turn| {
                let usual = if turn.spare > 1.0 {
                    MEDIAN_OF_TWO
                } else {
                    MEDIAN_OF_ONE
                };
                turn.left.norm_squared() / usual / noise(turn)
            })
            .collect();
        ratios.sort_by(f64::total_cmp);
        ratios.get(ratios.len() / 2).copied().unwrap_or(1.0)
    }

    /// The Gauss–Newton steps of the clocks' shares and their standard errors, turns that something else is wrong with
    /// apart; `None` where a share moves nothing.
    pub fn steps(&self, data: &Data) -> Option<(Vec<f64>, Vec<f64>)> {
        let count = self.by_share.len();
        if count == 0 {
            return None;
        }
        let misfits: Vec<f64> = (0..data.sources.len())
            .map(|k| self.misfit(data, k).max(1.0))
            .collect();
        let mut weights = vec![1.0; self.residuals.len()];
        for (k, (turn, evidence)) in data.turns.iter().zip(&self.turns).enumerate() {
            let misfit = misfits[turn.recording];
            let weight = evidence.sound(misfit) / misfit;
            weights[self.first + 2 * k] = weight;
            weights[self.first + 2 * k + 1] = weight;
        }
        let product = |a: &[f64], b: &[f64]| -> f64 {
            let terms = a.iter().zip(b).zip(&weights);
            terms.map(|((a, b), w)| a * b * w).sum()
        };
        let normal = DMatrix::from_fn(count, count, |i, j| {
            product(&self.by_share[i], &self.by_share[j])
        });
        let right = DVector::from_fn(count, |i, _| -product(&self.by_share[i], &self.residuals));
        let inverse = normal.try_inverse()?;
        let steps = &inverse * right;
        let errors = (0..count).map(|k| inverse[(k, k)].max(0.0).sqrt());
        Some((steps.iter().copied().collect(), errors.collect()))
    }
}

impl Source {
    /// The levels that are in the noise of its turns.
    pub(super) fn levels(&self) -> Levels {
        Levels {
            share: self.clock.sampling.value,
            floor: self.clock.floor,
        }
    }
}

/// `L⁻¹ C L⁻ᵀ` of the two rows from `row` on.
fn both_sides(white: &White, row: usize, c: &Matrix2<f64>) -> Matrix2<f64> {
    let mut half = DMatrix::from_fn(2, 2, |i, j| c[(i, j)]);
    white.apply_block(row, &mut half);
    half.transpose_mut();
    white.apply_block(row, &mut half);
    Matrix2::from_fn(|i, j| half[(i, j)])
}
