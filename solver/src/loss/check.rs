//! Is a loss of one's own what a loss has to be?

use serde::{Deserialize, Serialize};

use crate::loss::LossFunction;
use crate::loss::places::places;

/// Relative step of a central difference of the fourth order: small enough that `exp(−s)` passes far outside.
const STEP: f64 = 6.055_454_452_393_343e-6;

/// Rounding of a value that a difference may show.
const ROUNDING: f64 = 1e-14;

/// Value that a loss gives, and the one it should give.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LossMismatch {
    /// Squared residual over squared scale, `s = (r / σ)²`.
    pub s: f64,
    /// 0 for `ρ`, 1 for `ρ′`, 2 for `ρ″`.
    pub order: u8,
    /// The loss's own value there.
    pub value: f64,
    /// Value that it should be: 0 and 1 of `ρ(0)` and `ρ′(0)`, the central difference elsewhere, and 0 for a
    /// slope below 0.
    pub expected: f64,
}

/// Compares `ρ′` and `ρ″` of a loss with central differences of `ρ` and `ρ′`, at `s` from 1e-4 to 1e6,
/// and looks at `ρ(0) = 0`, `ρ′(0) = 1` and `ρ′ ≥ 0`. Returns what differs by more than `tolerance` of
/// itself; 1e-6 suits smooth losses. A fit refuses by itself what is wrong at 0 and where a slope is below
/// 0; of wrong derivatives it cannot know.
///
/// ```
/// use stillpoint_solver::{LossFunction, check_loss};
///
/// /// Cauchy's, with a slip: ρ″ has no square.
/// #[derive(Debug)]
/// struct Slip;
///
/// impl LossFunction for Slip {
///     fn at(&self, s: f64) -> [f64; 3] {
///         [s.ln_1p(), 1.0 / (1.0 + s), -1.0 / (1.0 + s)]
///     }
/// }
///
/// let mismatches = check_loss(&Slip, 1e-6);
/// assert!(!mismatches.is_empty() && mismatches.iter().all(|m| m.order == 2));
/// ```
pub fn check_loss(loss: &dyn LossFunction, tolerance: f64) -> Vec<LossMismatch> {
    let mut found = Vec::new();
    let mut note = |s, order, value: f64, expected: f64, room: f64| {
        let agree = (value - expected).abs() <= room;
        if !agree {
            found.push(LossMismatch {
                s,
                order,
                value,
                expected,
            });
        }
    };
    let [value, slope, _] = loss.at(0.0);
    note(0.0, 0, value, 0.0, tolerance);
    note(0.0, 1, slope, 1.0, tolerance);
    for s in places() {
        let h = STEP * s;
        let own = loss.at(s);
        let [farther, below, above, far] = [-2.0, -1.0, 1.0, 2.0].map(|k| loss.at(s + k * h));
        if own[1] < 0.0 {
            note(s, 1, own[1], 0.0, 0.0);
        }
        for order in [1, 2] {
            let near = above[order - 1] - below[order - 1];
            let wide = far[order - 1] - farther[order - 1];
            let expected = (8.0 * near - wide) / (12.0 * h);
            let size = own[order].abs().max(expected.abs());
            let rounding = ROUNDING * own[order - 1].abs() / h;
            let room = tolerance * size + rounding;
            note(s, order as u8, own[order], expected, room);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::loss::{Loss, LossScale, all};

    /// One of the crate's own losses as a user's.
    #[derive(Debug)]
    struct Known(Loss);

    impl LossFunction for Known {
        fn at(&self, s: f64) -> [f64; 3] {
            self.0.at(s)
        }
    }

    #[test]
    fn the_losses_of_the_crate_pass() {
        for loss in all(LossScale::Given(1.0)) {
            assert_eq!(check_loss(&Known(loss), 1e-6), [], "{loss:?}");
        }
    }

    /// Welsch's, which falls faster than any power: what is left of it far outside is no mismatch.
    #[derive(Debug)]
    struct Welsch;

    impl LossFunction for Welsch {
        fn at(&self, s: f64) -> [f64; 3] {
            [-(-s).exp_m1(), (-s).exp(), -(-s).exp()]
        }
    }

    #[test]
    fn a_loss_with_an_exponential_passes() {
        assert_eq!(check_loss(&Welsch, 1e-6), []);
    }

    /// `ρ = s` times a factor, plus a constant, with a slope that is too large by another factor.
    #[derive(Debug)]
    struct Wrong(f64, f64, f64);

    impl LossFunction for Wrong {
        fn at(&self, s: f64) -> [f64; 3] {
            [self.1 + self.0 * s, self.0 * self.2, 0.0]
        }
    }

    #[test]
    fn what_is_wrong_with_a_loss_is_told_by_its_order() {
        let orders = |loss| {
            let mut orders: Vec<u8> = (check_loss(&loss, 1e-6).iter().map(|m| m.order)).collect();
            orders.dedup();
            orders
        };
        assert!(orders(Wrong(1.0, 0.0, 1.0)).is_empty());
        assert_eq!(orders(Wrong(1.0, 0.5, 1.0)), [0]);
        assert_eq!(orders(Wrong(2.0, 0.0, 1.0)), [1]);
        assert_eq!(orders(Wrong(1.0, 0.0, 1.5)), [1]);
        assert_eq!(orders(Wrong(-1.0, 0.0, 1.0)), [1]);
        assert!(!check_loss(&Wrong(f64::NAN, 0.0, 1.0), 1e-6).is_empty());
    }
}
