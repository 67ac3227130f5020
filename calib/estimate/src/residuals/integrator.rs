//! From angular rates to the attitude at the end of a turn.

use nalgebra::Vector3;
use sensor::attitude::Attitude;
use solver::{Scalar, lit};

/// Integration method of the rate over a turn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Integrator {
    /// The exponential map of the mean of two neighbouring samples over their own time step.
    #[default]
    Exponential,
    /// `q' = q + ½ Δt q ω`, made unit length after each step.
    FirstOrderNormalized,
    /// `q' = q + ½ Δt q ω` without normalisation, as published (Liu et al. 2021, section 2.2).
    FirstOrder,
}

/// The attitude at the last sample relative to the first: `rates` at the stamps `t` (s, rad/s).
pub fn attitude_of<D: Scalar>(
    integrator: Integrator,
    t: &[f64],
    mut rate: impl FnMut(usize) -> Vector3<D>,
) -> Attitude<D> {
    let mut q = Attitude::identity();
    let Some(steps) = t.len().checked_sub(1) else {
        return q;
    };
    let mut before = rate(0);
    for k in 0..steps {
        let dt = t[k + 1] - t[k];
        let after = rate(k + 1);
        q = match integrator {
            Integrator::Exponential => {
                q.then(&Attitude::exp(&((before + after) * lit::<D>(0.5 * dt))))
            }
            Integrator::FirstOrderNormalized => first_order(&q, &before, dt).normalized(),
            Integrator::FirstOrder => first_order(&q, &before, dt),
        };
        before = after;
    }
    q
}

fn first_order<D: Scalar>(q: &Attitude<D>, rate: &Vector3<D>, dt: f64) -> Attitude<D> {
    q.then(&Attitude {
        w: lit(1.0),
        v: rate * lit::<D>(0.5 * dt),
    })
}
