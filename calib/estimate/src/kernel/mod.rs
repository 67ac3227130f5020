//! Propagated gravity and its Jacobian, several turns side by side in a vector register.
//!
//! The residual of a turn is `u_N − u_a` with `u_{k+1} = R(φ_k)ᵀ u_k` and the step's rotation vector
//! `φ_k = ½ Δt (ω_k + ω_{k+1})`. A small change `δφ_k` turns the frame before the turn by
//! `v = Σ Q_k J_l(φ_k) δφ_k`, with `Q_k` the attitude at step `k` and `J_l` the left Jacobian of the
//! rotation group, and gravity after the turn moves by `Q_Nᵀ (u₀ × v)`. Only the part of `v` across
//! `u₀` counts: with `e₁, e₂, u₀/|u₀|` a right-handed frame,
//!
//! ```text
//! gᵢ = eᵢ · ∂v/∂p = Σ bᵢ · ∂φ/∂p,   bᵢ = J_l(φ)ᵀ aᵢ,   aᵢ = Qᵀ eᵢ
//! ∂u_N/∂p = |u₀| (g₁ a₂ − g₂ a₁)
//! ```
//!
//! so that two vectors carried along with the turn, and sums over its steps, give the derivative by
//! any number of parameters in one pass and without a tape. This is exact; nothing is dropped.
//!
//! ```text
//! PropagatedGravity ──► TurnProblem ─┬─ Tier::Affine    ω = T (x − b) − F p: sums over the steps
//!  (the plain residual)              ├─ Tier::General   any model: dual numbers per sample
//!                                    └─ Tier::Straight  dual numbers through everything: the oracle
//! packed   turns of similar length, laid side by side
//! rotate   one step of a turn          series  its functions of the angle
//! affine   the loops over the steps    adjoint the same, with `b` of each step kept
//! curvature    second derivatives along a direction
//! sensitivity  the derivative of the sensor at a sample
//! slopes   from sums to rows           problem the solver's view
//! ```
//!
//! The instructions are chosen when the program runs (`pulp`): a binary for any x86-64 uses AVX2 and
//! FMA where there are, and Neon on aarch64. A machine without fused multiply-add rounds differently
//! in the last digits.

mod adjoint;
mod affine;
mod curvature;
mod features;
mod general;
mod groups;
mod lanes;
mod packed;
mod problem;
mod rotate;
mod sensitivity;
mod series;
mod slopes;

#[cfg(test)]
mod oracle;

pub use problem::{Tier, TurnProblem};
