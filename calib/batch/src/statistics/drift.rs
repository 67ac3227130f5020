//! Parameters against time and station.

use calib::methods::chance;

use super::robust::{median, spread};

/// Values further from the median than this many spreads do not judge a line.
const FAR: f64 = 5.0;

/// A parameter that changes over time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeDrift {
    /// Change from the first to the last device.
    pub change: f64,
    /// Its standard error.
    pub std: f64,
    /// Chance of so much by the spread alone.
    pub p_value: f64,
}

/// A parameter that differs by station.
#[derive(Clone, Debug, PartialEq)]
pub struct StationShift {
    /// Station, devices, mean.
    pub means: Vec<(String, usize, f64)>,
    /// Chance of so much by the spread alone.
    pub p_value: f64,
}

/// A time as seconds: a number as it is, `YYYY-MM-DD` with or without `THH:MM:SS`.
pub fn seconds(time: &str) -> Option<f64> {
    if let Ok(number) = time.parse::<f64>() {
        return number.is_finite().then_some(number);
    }
    let part = |from: usize, to: usize| time.get(from..to)?.parse::<i64>().ok();
    let (year, month, day) = (part(0, 4)?, part(5, 7)?, part(8, 10)?);
    // Days of the civil calendar (Hinnant, chrono-Compatible Low-Level Date Algorithms).
    let year = if month <= 2 { year - 1 } else { year };
    let era = year.div_euclid(400);
    let of_era = year - 400 * era;
    let of_year = (153 * ((month + 9) % 12) + 2) / 5 + day - 1;
    let days = era * 146_097 + of_era * 365 + of_era / 4 - of_era / 100 + of_year - 719_468;
    let clock = match time.get(10..) {
        Some("") | None => 0,
        Some(_) => 3600 * part(11, 13)? + 60 * part(14, 16)? + part(17, 19).unwrap_or(0),
    };
    Some((86_400 * days + clock) as f64)
}

/// Regression of `(time, value)`, outliers left out; none of fewer than five or of one time.
pub fn over_time(points: &[(f64, f64)]) -> Option<TimeDrift> {
    let values: Vec<f64> = points.iter().map(|p| p.1).collect();
    let (centre, width) = (median(&values), spread(&values));
    let near: Vec<&(f64, f64)> = points
        .iter()
        .filter(|p| (p.1 - centre).abs() <= FAR * width)
        .collect();
    let n = near.len() as f64;
    let t = near.iter().map(|p| p.0).sum::<f64>() / n;
    let v = near.iter().map(|p| p.1).sum::<f64>() / n;
    let tt: f64 = near.iter().map(|p| (p.0 - t).powi(2)).sum();
    let tv: f64 = near.iter().map(|p| (p.0 - t) * (p.1 - v)).sum();
    if n < 5.0 || tt <= 0.0 {
        return None;
    }
    let slope = tv / tt;
    let left: f64 = near
        .iter()
        .map(|p| (p.1 - v - slope * (p.0 - t)).powi(2))
        .sum();
    let std = (left / (n - 2.0) / tt).sqrt();
    let times = near.iter().map(|p| p.0);
    let length =
        times.clone().fold(f64::NEG_INFINITY, f64::max) - times.fold(f64::INFINITY, f64::min);
    Some(TimeDrift {
        change: slope * length,
        std: std * length,
        p_value: chance::of_t(slope / std, n - 2.0),
    })
}

/// Analysis of variance by station, outliers left out; none of fewer than two stations with two devices.
pub fn by_station(points: &[(String, f64)]) -> Option<StationShift> {
    let values: Vec<f64> = points.iter().map(|p| p.1).collect();
    let (centre, width) = (median(&values), spread(&values));
    let mut stations: Vec<(String, Vec<f64>)> = Vec::new();
    for (name, value) in points
        .iter()
        .filter(|p| (p.1 - centre).abs() <= FAR * width)
    {
        match stations.iter_mut().find(|(own, _)| own == name) {
            Some((_, all)) => all.push(*value),
            None => stations.push((name.clone(), vec![*value])),
        }
    }
    stations.retain(|(_, all)| all.len() > 1);
    stations.sort_by(|a, b| a.0.cmp(&b.0));
    let mean = |all: &[f64]| all.iter().sum::<f64>() / all.len() as f64;
    let count: f64 = stations.iter().map(|(_, all)| all.len() as f64).sum();
    let (groups, whole) = (
        stations.len() as f64,
        stations.iter().flat_map(|(_, all)| all).sum::<f64>() / count,
    );
    if groups < 2.0 {
        return None;
    }
    let between: f64 = stations
        .iter()
        .map(|(_, all)| all.len() as f64 * (mean(all) - whole).powi(2))
        .sum();
    let within: f64 = stations
        .iter()
        .map(|(_, all)| all.iter().map(|v| (v - mean(all)).powi(2)).sum::<f64>())
        .sum();
    let ratio = (between / (groups - 1.0)) / (within / (count - groups));
    Some(StationShift {
        means: stations
            .iter()
            .map(|(name, all)| (name.clone(), all.len(), mean(all)))
            .collect(),
        p_value: chance::of_f(ratio, [groups - 1.0, count - groups]),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_are_days_of_the_calendar() {
        assert_eq!(seconds("1970-01-01"), Some(0.0));
        // date -u -d 2026-03-01T12:30:15 +%s
        assert_eq!(seconds("2026-03-01T12:30:15"), Some(1_772_368_215.0));
        assert_eq!(seconds("17.5"), Some(17.5));
        assert_eq!(seconds("yesterday"), None);
    }

    #[test]
    fn a_drift_and_a_station_are_told_from_spread() {
        let noise = |k: usize| (k * 7 % 11) as f64 / 11.0 - 0.45;
        let drifting: Vec<(f64, f64)> = (0..50)
            .map(|k| (k as f64, 0.1 * k as f64 + noise(k)))
            .collect();
        let found = over_time(&drifting).unwrap();
        assert!(
            (found.change - 4.9).abs() < 4.0 * found.std && found.p_value < 1e-6,
            "{found:?}"
        );
        let flat: Vec<(f64, f64)> = (0..50).map(|k| (k as f64, noise(k))).collect();
        assert!(over_time(&flat).unwrap().p_value > 0.01);
        let of = |shift: f64| -> Vec<(String, f64)> {
            let station = |k: usize| if k.is_multiple_of(2) { "a" } else { "b" };
            (0..40)
                .map(|k| (station(k).to_owned(), noise(k) + shift * (k % 2) as f64))
                .collect()
        };
        assert!(by_station(&of(1.0)).unwrap().p_value < 1e-6);
        assert!(by_station(&of(0.0)).unwrap().p_value > 0.01);
    }
}
