//! Moré, Garbow and Hillstrom, "Testing unconstrained optimization software", ACM Transactions on
//! Mathematical Software 7(1), 1981; numbers as there. Minima with more digits than published are
//! the published ones computed to convergence.

mod bounded;
mod fixed;
mod scalable;

pub use bounded::bounded;
pub use fixed::nineteen;
pub use scalable::scalable;
