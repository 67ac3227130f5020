//! Unevenness of the field from place to place.

use recording::Error;

use super::problem::{Minimum, Problem};
use super::start::Start;

findings::tuning! {
    /// Steps of the search: each narrows the interval by the golden section, to a thousandth of it in all.
    STEPS: usize = 15;

    /// The search begins at this share of the noise of a mean, and below it the field counts as even.
    LEAST: f64 = 0.1;

    /// And ends at this share of the field: the first fit is at it, where the start is good enough.
    MOST: f64 = 0.2;
}

/// The golden section.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// The standard deviation per axis of the likeliest differences of the field from place to place, with the minimum there.
///
/// By restricted likelihood (Patterson & Thompson 1971): the smallest `χ² + Σ ln σ² + ln det H`, where `H` is the normal
/// matrix of all unknowns. A plain likelihood would take the freedom of thirteen parameters and the headings for evenness.
///
/// # Errors
/// As [`Problem::minimum`].
pub fn unevenness(problem: &Problem<'_>, start: &Start) -> Result<(f64, Minimum), Error> {
    let used = || problem.placements.iter().filter(|p| p.is_used);
    let noise = used().map(|p| p.noise).sum::<f64>() / used().count() as f64;
    let widest = (MOST.get() * problem.strength).max(10.0 * noise);
    let uneven = problem.minimum(start, widest, None)?;
    let at = |logarithm: f64, from: &Minimum| {
        let uneven = logarithm.exp();
        let minimum = problem.minimum(start, uneven, Some(&from.report.values))?;
        Ok::<_, Error>((criterion(problem, &minimum), uneven, minimum))
    };
    let (mut low, mut high) = ((LEAST.get() * noise).ln(), widest.ln());
    let mut second = at(low + GOLDEN * (high - low), &uneven)?;
    let mut first = at(high - GOLDEN * (high - low), &second.2)?;
    for _ in 0..STEPS.get() {
        if first.0 < second.0 {
            high = second.1.ln();
            second = first;
            first = at(high - GOLDEN * (high - low), &second.2)?;
        } else {
            low = first.1.ln();
            first = second;
            second = at(low + GOLDEN * (high - low), &first.2)?;
        }
    }
    let best = if first.0 < second.0 { first } else { second };
    // Where the field is anything but even a fit that takes it for even need not end.
    let even = problem.minimum(start, 0.0, Some(&best.2.report.values));
    Ok(match even {
        Ok(even) if criterion(problem, &even) <= best.0 => (0.0, even),
        _ => (best.1, best.2),
    })
}

/// Twice the negative logarithm of the restricted likelihood, but for constants.
fn criterion(problem: &Problem<'_>, minimum: &Minimum) -> f64 {
    let all = problem.placements.iter().zip(&minimum.variances);
    let used = all.filter(|(placement, _)| placement.is_used);
    let widths: f64 = used.map(|(_, v)| 3.0 * v.ln()).sum();
    2.0 * minimum.report.cost + widths + minimum.log_determinant
}
