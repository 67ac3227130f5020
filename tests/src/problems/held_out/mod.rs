//! Sixty-two problems that no other collection here holds; the least costs known are those of scipy's
//! `least_squares` from the same start and of this solver, the lower of them (`benches/peers/held_out.py`).

mod chains;
mod curves;
mod equations;
mod least;

pub use chains::chains;
pub use curves::curves;
pub use equations::equations;
pub use least::LEAST;

use super::Case;

/// All of them, without their minima.
pub fn all() -> Vec<Case> {
    let mut all = chains();
    all.extend(curves());
    all.extend(equations());
    all
}
