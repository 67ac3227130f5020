//! How the temperature moves: its derivative, and whether it rises or falls.

use nalgebra::{Matrix3, Vector3};
use recording::Temperature;

/// Readings are taken together over this long, s: the temperature of a device does not change faster.
const BIN: f64 = 1.0;

/// Bins on either side that the derivative is taken from, and the fewest that a parabola through them needs.
const REACH: usize = 12;
const FEWEST: usize = 5;

/// A turning point counts where the temperature comes back from it by this, K, and by so many times its noise.
const LEAST_RETURN: f64 = 0.2;
const OF_NOISE: f64 = 6.0;

/// The course of the temperature of one recording.
#[derive(Clone, Debug, Default)]
pub(super) struct Thermal {
    /// Middle of each bin, s.
    t: Vec<f64>,
    /// Derivative there, K/s.
    rate: Vec<f64>,
    /// From when on it rises (1) or falls (−1).
    ways: Vec<(f64, f64)>,
}

impl Thermal {
    pub fn of(temperature: &Temperature) -> Self {
        let (t, celsius) = bins(temperature);
        let rate: Vec<f64> = (0..t.len()).map(|k| rate_at(&t, &celsius, k)).collect();
        let mut ways = ways(&t, &celsius);
        for (from, _) in ways.iter_mut().skip(1) {
            *from = crossing(&t, &rate, *from);
        }
        Self { t, rate, ways }
    }

    /// The derivative in the middle of a stretch, K/s, and whether it rises (1) or falls (−1) in it.
    pub fn over(&self, from: f64, to: f64) -> [f64; 2] {
        [self.rate(0.5 * (from + to)), self.warming(from, to)]
    }

    /// The derivative at time `t`, K/s: linear between bins, constant outside.
    pub fn rate(&self, t: f64) -> f64 {
        let after = self.t.partition_point(|&s| s < t);
        let at = |k: usize| self.rate.get(k).copied();
        match (after.checked_sub(1), self.t.get(after)) {
            (Some(before), Some(&next)) => {
                let part = (t - self.t[before]) / (next - self.t[before]);
                self.rate[before] * (1.0 - part) + self.rate[after] * part
            }
            (None, _) => at(0).unwrap_or(0.0),
            (Some(last), None) => at(last).unwrap_or(0.0),
        }
    }

    /// 1 where it rises from one time to another, −1 where it falls, the mean where it turns in between; 0 where it does
    /// neither in the whole recording. From and to may be the same.
    pub fn warming(&self, from: f64, to: f64) -> f64 {
        let begun = self.ways.partition_point(|(t, _)| *t <= from).max(1) - 1;
        let Some((_, mut way)) = self.ways.get(begun).copied() else {
            return 0.0;
        };
        let (mut sum, mut last) = (0.0, from);
        for (t, next) in self
            .ways
            .iter()
            .skip(begun + 1)
            .take_while(|(t, _)| *t < to)
        {
            sum += way * (t - last);
            (way, last) = (*next, *t);
        }
        if last > from {
            (sum + way * (to - last)) / (to - from)
        } else {
            way
        }
    }
}

/// Means over whole bins: middle of the stamps, and temperature.
fn bins(temperature: &Temperature) -> (Vec<f64>, Vec<f64>) {
    let (mut t, mut celsius) = (Vec::new(), Vec::new());
    let mut first = 0;
    for k in 1..=temperature.t.len() {
        let ends = temperature
            .t
            .get(k)
            .is_none_or(|&next| next - temperature.t[first] >= BIN);
        if ends {
            let count = (k - first) as f64;
            t.push(temperature.t[first..k].iter().sum::<f64>() / count);
            celsius.push(temperature.celsius[first..k].iter().sum::<f64>() / count);
            first = k;
        }
    }
    (t, celsius)
}

/// The slope at bin `k` of the parabola through the bins about it, least squares; 0 of too few.
fn rate_at(t: &[f64], celsius: &[f64], k: usize) -> f64 {
    let range = k.saturating_sub(REACH)..(k + REACH + 1).min(t.len());
    if range.len() < FEWEST {
        return 0.0;
    }
    let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for (&at, &c) in t[range.clone()].iter().zip(&celsius[range]) {
        let x = (at - t[k]) / BIN;
        let row = Vector3::new(1.0, x, x * x);
        normal += row * row.transpose();
        right += row * (c - celsius[k]);
    }
    normal
        .try_inverse()
        .map_or(0.0, |inverse| (inverse * right)[1] / BIN)
}

/// When the temperature begins to rise or fall: at its turning points, the first way from the begin on.
fn ways(t: &[f64], celsius: &[f64]) -> Vec<(f64, f64)> {
    let least = LEAST_RETURN.max(OF_NOISE * noise(celsius));
    let mut ways: Vec<(f64, f64)> = Vec::new();
    let (mut low, mut high) = (0, 0);
    for (k, &c) in celsius.iter().enumerate() {
        if c < celsius[low] {
            low = k;
        }
        if c > celsius[high] {
            high = k;
        }
        let way = ways.last().map(|(_, way)| *way);
        let (turned, from) = match way {
            Some(w) if w > 0.0 => (celsius[high] - c > least, high),
            Some(_) => (c - celsius[low] > least, low),
            None if c - celsius[low] > least => (true, 0),
            None => (celsius[high] - c > least, 0),
        };
        if turned {
            let rises = match way {
                Some(w) => w < 0.0,
                None => c - celsius[low] > least,
            };
            ways.push((t[from], if rises { 1.0 } else { -1.0 }));
            (low, high) = (k, k);
        }
    }
    ways
}

/// Where the derivative changes its sign, nearest to the turning point that the noisy readings show.
fn crossing(t: &[f64], rate: &[f64], about: f64) -> f64 {
    let near = t.partition_point(|&s| s < about);
    let range = near.saturating_sub(REACH)..(near + REACH).min(t.len().saturating_sub(1));
    range
        .filter(|&k| rate[k] * rate[k + 1] < 0.0)
        .map(|k| t[k] + (t[k + 1] - t[k]) * rate[k] / (rate[k] - rate[k + 1]))
        .min_by(|a, b| (a - about).abs().total_cmp(&(b - about).abs()))
        .unwrap_or(about)
}

/// Standard deviation of a bin, from second differences: `√(Σ d²/(6 n))`.
fn noise(celsius: &[f64]) -> f64 {
    let squares = celsius
        .windows(3)
        .map(|c| (c[0] - 2.0 * c[1] + c[2]).powi(2));
    let count = celsius.len().saturating_sub(2).max(1) as f64;
    (squares.sum::<f64>() / (6.0 * count)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn course(of: impl Fn(f64) -> f64) -> Thermal {
        let t: Vec<f64> = (0..600).map(f64::from).collect();
        let celsius = t.iter().map(|t| of(*t)).collect();
        Thermal::of(&Temperature { t, celsius })
    }

    #[test]
    fn the_rate_of_a_swing_is_that_of_its_sine() {
        let (size, period) = (3.0, 200.0);
        let angle = |t: f64| std::f64::consts::TAU * t / period;
        let found = course(|t| 25.0 + size * angle(t).sin());
        let largest = size * std::f64::consts::TAU / period;
        for t in [0.0, 17.3, 50.0, 333.3, 599.0] {
            let off = found.rate(t) - largest * angle(t).cos();
            assert!(off.abs() < 0.03 * largest, "{t}: {off}");
        }
    }

    #[test]
    fn it_turns_where_the_temperature_does_and_not_with_its_noise() {
        let angle = |t: f64| std::f64::consts::TAU * t / 200.0;
        let shaken = |t: f64| 0.02 * (7.7 * t).sin();
        let found = course(|t| 25.0 + 3.0 * angle(t).sin() + shaken(t));
        assert_eq!(found.ways.len(), 7, "{:?}", found.ways);
        for (k, (from, way)) in found.ways.iter().enumerate().skip(1) {
            let own = 50.0 + 100.0 * (k as f64 - 1.0);
            assert!((from - own).abs() < 1.0, "{from} {own}");
            assert_eq!(*way, if k % 2 == 0 { 1.0 } else { -1.0 });
        }
        let at = |t| found.warming(t, t);
        assert_eq!((at(0.0), at(70.0)), (1.0, -1.0));
        assert!(found.warming(40.0, 60.0).abs() < 0.1);
    }

    #[test]
    fn a_constant_temperature_neither_rises_nor_falls() {
        let found = course(|t| 30.0 + 0.01 * (5.3 * t).sin());
        assert_eq!(found.warming(10.0, 599.0), 0.0);
        assert!(found.rate(100.0).abs() < 1e-3);
        assert_eq!(Thermal::default().rate(5.0), 0.0);
    }
}
