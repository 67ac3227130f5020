//! Collections of least-squares problems with known minima, a file per collection.

pub mod accelerometer;
mod case;
pub mod cutest;
pub mod dennis_schnabel;
pub mod held_out;
pub mod luksan_vlcek;
pub mod mgh;
pub mod nist;
pub mod schittkowski;

pub use case::Case;

/// Every problem without constraints, from all collections but NIST's.
pub fn unconstrained() -> Vec<Case> {
    let mut all = mgh::nineteen();
    all.extend(mgh::scalable());
    all.extend(dennis_schnabel::all());
    all.extend(schittkowski::unconstrained());
    all.extend(cutest::unconstrained());
    all.extend(luksan_vlcek::all());
    all
}

/// Every problem with bounds only.
pub fn bounded() -> Vec<Case> {
    let mut all = mgh::bounded();
    all.extend(schittkowski::bounded());
    all.extend(cutest::bounded());
    all
}

/// Every problem with linear constraints.
pub fn linearly_constrained() -> Vec<Case> {
    schittkowski::linear()
}
