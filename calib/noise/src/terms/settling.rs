//! Static time needed to determine a bias as well as possible.

use super::identify::NoiseTerms;

findings::tuning! {
    /// The deviation counts as flat within this factor of its minimum.
    FLAT: f64 = 1.1;

    /// Averaging times tried per octave.
    PER_OCTAVE: f64 = 16.0;
}

/// The averaging time from which on the fitted Allan deviation is flat, s: within ten per cent of
/// its smallest value.
///
/// That is the initial static time to record: less leaves white noise in the gyroscope's bias, more
/// gains nothing (Liu et al. 2021, section 3.1). `None` where the deviation still falls at the
/// longest averaging time: the recording is too short to tell.
pub fn settling_time(terms: &NoiseTerms, shortest_tau: f64) -> Option<f64> {
    if !terms.is_known {
        return None;
    }
    // A memory makes the deviation smaller at times that no term was fitted to.
    let shortest_tau = shortest_tau.max(terms.shortest_tau);
    let octaves = (terms.longest_tau / shortest_tau).log2().max(0.0);
    let steps = (octaves * PER_OCTAVE.get()) as u32;
    let curve: Vec<(f64, f64)> = (0..=steps)
        .map(|k| shortest_tau * (f64::from(k) / PER_OCTAVE.get()).exp2())
        .map(|tau| (tau, terms.deviation(tau)))
        .collect();
    let &(last_tau, last) = curve.last()?;
    let lowest = curve.iter().map(|&(_, d)| d).fold(f64::INFINITY, f64::min);
    let &(tau, _) = curve.iter().find(|&&(_, d)| d <= FLAT.get() * lowest)?;
    // White noise alone is still ten per cent above its end at 83 % of the longest time.
    let flat_for_an_octave = 2.0 * tau <= last_tau || last > lowest;
    flat_for_an_octave.then_some(tau)
}
