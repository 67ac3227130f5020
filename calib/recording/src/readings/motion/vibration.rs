//! Static intervals that are far noisier than the others.

use crate::readings::of_sensor::OfSensor;
use crate::readings::symptom::Symptom;

findings::tuning! {
    /// An interval is noisier where its spread is so many times that of the quiet quarter.
    RATIO: f64 = 1.6;

    /// Fewest intervals that show what is usual.
    FEWEST: usize = 4;

    /// Fewest intervals on one side of a change.
    FEWEST_BESIDE: usize = 3;
    /// Ratio up to which their spreads are equal.
    EQUAL: f64 = 1.6;
}

/// Returns true if the noisy places are one part at an end of the recording and equally noisy: something was changed there.
fn is_a_change(places: &[usize], spread: &[f64]) -> bool {
    let (Some(&first), Some(&last)) = (places.first(), places.last()) else {
        return false;
    };
    let is_one_part =
        last + 1 - first == places.len() && (first == 0) != (last + 1 == spread.len());
    let least = places
        .iter()
        .map(|&k| spread[k])
        .fold(f64::INFINITY, f64::min);
    let most = places.iter().map(|&k| spread[k]).fold(0.0, f64::max);
    is_one_part && places.len() >= FEWEST_BESIDE.get() && most < EQUAL.get() * least
}

/// The intervals with several times the usual spread.
pub(in crate::readings) fn found(of: &OfSensor<'_>) -> Option<Symptom> {
    let spread: Vec<f64> = of.moments.iter().map(|(_, m)| m.std().norm()).collect();
    let mut sorted = spread.clone();
    sorted.sort_by(f64::total_cmp);
    let usual = sorted.get(sorted.len() / 4).copied();
    let usual = usual.filter(|&usual| usual > 0.0)?;
    let loud = |&k: &usize| spread[k] > RATIO.get() * usual;
    let places: Vec<usize> = (0..spread.len()).filter(loud).collect();
    let largest = spread.iter().fold(0.0, |a: f64, &b| a.max(b));
    (spread.len() >= FEWEST.get() && !places.is_empty()).then(|| Symptom::Vibration {
        sensor: of.sensor,
        intervals: places.iter().map(|&k| of.moments[k].0 + 1).collect(),
        ratio: largest / usual,
        from_here_on: is_a_change(&places, &spread),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_that_is_equally_noisy_to_the_end_was_changed_and_single_intervals_were_not() {
        let spread = [1.0, 1.1, 0.9, 1.0, 8.0, 8.3, 7.9, 8.1];
        assert!(is_a_change(&[4, 5, 6, 7], &spread));
        assert!(!is_a_change(&[4, 6, 7], &spread));
        assert!(!is_a_change(&[7], &spread));
        assert!(!is_a_change(&[0, 1, 2], &[2.0, 9.0, 4.0, 1.0, 1.0]));
    }
}
