//! Static intervals that are far noisier than the others.

use super::finding::Finding;
use super::of_sensor::OfSensor;

/// An interval is noisier where its spread is so many times that of the quiet quarter.
const RATIO: f64 = 1.6;

/// Fewest intervals that show what is usual.
const FEWEST: usize = 4;

/// The intervals with several times the usual spread.
pub(super) fn found(of: &OfSensor<'_>) -> Option<Finding> {
    let spread: Vec<f64> = of.moments.iter().map(|(_, m)| m.std().norm()).collect();
    let mut sorted = spread.clone();
    sorted.sort_by(f64::total_cmp);
    let usual = sorted.get(sorted.len() / 4).copied();
    let usual = usual.filter(|&usual| usual > 0.0)?;
    let loud = |&k: &usize| spread[k] > RATIO * usual;
    let places: Vec<usize> = (0..spread.len()).filter(loud).collect();
    let largest = spread.iter().fold(0.0, |a: f64, &b| a.max(b));
    (spread.len() >= FEWEST && !places.is_empty()).then(|| Finding::Vibration {
        sensor: of.sensor,
        intervals: places.iter().map(|&k| of.moments[k].0 + 1).collect(),
        ratio: largest / usual,
    })
}
