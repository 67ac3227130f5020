//! Size of the next step, and whether the last one is taken: one file per way.

mod damping;
mod line_search;
mod trust_radius;

pub use damping::Damping;
pub(crate) use damping::Lambda;
pub(crate) use line_search::LineSearch;
pub(crate) use trust_radius::TrustRadius;

/// Outcome of a step.
#[derive(Clone, Copy, Debug)]
pub struct Trial {
    /// Fall of the cost over the fall promised by the linearised problem; not a number or negative
    /// where the cost rose.
    pub ratio: f64,
    /// Length of the step, `‖D p‖`.
    pub length: f64,
}

/// A rule for the size given to the descent; see [`OwnVariant`](crate::OwnVariant) for an example.
pub trait Search {
    /// The size of the next step: a damping, a radius or a fraction.
    fn size(&self) -> f64;

    /// Learns that the step was taken.
    fn accepted(&mut self, trial: Trial);

    /// Learns that the step was not taken, or that there was none.
    fn rejected(&mut self, trial: Trial);

    /// True where no smaller step makes sense.
    fn exhausted(&self) -> bool;
}
