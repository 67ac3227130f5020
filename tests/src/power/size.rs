//! How large a hidden thing is, in the unit of the noise.

use calib::Error;
use calib::discover::{Extension, Request, Session, State};
use calib::methods::joint::{BiasNoise, Rows};
use calib::simulate::Spec;
use faer::Mat;

/// The noncentrality `λ = |L⁻¹ Nᵀ (r₁ − r₀)|²` of what tells the session `with` from the session `without`, the
/// same noise in both: the mean of the χ² that the base model cannot explain, at the true densities of the walks.
///
/// `None` where the two are cut differently.
///
/// # Errors
/// As the joint fit.
pub fn noncentrality(without: &Spec, with: &Spec, walks: [f64; 2]) -> Result<Option<f64>, Error> {
    let request = Request::new(without.gravity);
    let clean = [without.run()?.recording];
    let hidden = [with.run()?.recording];
    let session = Session::new(&clean, &request)?;
    let mut other = session.clone();
    for (pair, recording) in other.recordings.iter_mut().zip(&hidden) {
        pair.0 = std::borrow::Cow::Borrowed(recording);
    }
    let base = State::fit(&session, Extension::default())?;
    let moved = State::fit(&other, Extension::default())?;
    let rows = Rows::new(
        &moved.fit.data,
        (&base.fit.models[0], &base.fit.models[1]),
        base.fit.gravity,
        &base.fit.charts,
        (base.fit.own_force_bias, &[]),
    );
    let x = base.fit.parameters.values();
    let (r0, r1) = (
        base.fit.rows().linearize(x).residuals,
        rows.linearize(x).residuals,
    );
    if r0.len() != r1.len() {
        return Ok(None);
    }
    let difference = Mat::from_fn(r0.len(), 1, |i, _| r1[i] - r0[i]);
    let projected = base.projected.columns(base.whitened(difference).as_ref());
    let whitened = base.projected.at(BiasNoise::walks(walks));
    Ok(whitened.map(|w| w.columns(&projected).squared_norm_l2()))
}
