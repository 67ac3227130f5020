//! Stamps of which nobody says what they count, and whose rate is one that sensors are set to if they count 1/1024 s.

/// Rates that sensors are set to, Hz.
const NOMINAL: [f64; 24] = [
    10.0, 20.0, 25.0, 30.0, 32.0, 40.0, 50.0, 52.0, 60.0, 64.0, 80.0, 100.0, 104.0, 120.0, 125.0,
    128.0, 200.0, 208.0, 250.0, 256.0, 400.0, 416.0, 500.0, 1000.0,
];

findings::tuning! {
    /// A rate on the clock of the stamps is as near to its nominal one as this ...
    SAME: f64 = 2e-4;
    /// ... and a sensor's own clock is off by as much.
    NEAR: f64 = 4e-3;

    /// Fewest stamps that tell a rate.
    FEWEST: usize = 500;
}

/// Ticks in a second of the crystal of a watch, by 32.
const TICKS: f64 = 1024.0;

/// Returns the nominal rate of stamps in whole numbers if they count 1/1024 s, Hz; `None` where the rate in milliseconds is as usual.
pub(super) fn ticked(stamps: &[f64]) -> Option<f64> {
    let (first, last) = (stamps.first()?, stamps.last()?);
    let count = (stamps.len() - 1) as f64;
    let step = (last - first) / count;
    // Steps that differ by more than one are those of a clock that scatters, or of lost samples.
    let is_even = |pair: &[f64]| (pair[1] - pair[0] - step).abs() < 1.0;
    if stamps.len() < FEWEST.get() || !stamps.windows(2).all(is_even) {
        return None;
    }
    let is_near = |rate: f64, within: f64| {
        let near = |nominal: &&f64| (rate / **nominal - 1.0).abs() < within;
        NOMINAL.iter().find(near).copied()
    };
    is_near(TICKS / step, SAME.get()).filter(|_| is_near(1e3 / step, NEAR.get()).is_none())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_told_from_milliseconds_by_their_rates() {
        let stamps = |per_second: f64, rate: f64| -> Vec<f64> {
            let stamp = |k: u32| (f64::from(k) * per_second / rate).round();
            (0..3000).map(stamp).collect()
        };
        for rate in [50.0, 100.0, 104.0] {
            assert_eq!(ticked(&stamps(1024.0, rate)), Some(rate));
            assert_eq!(ticked(&stamps(1000.0, rate)), None);
            // A sensor's own clock beside that of the stamps.
            assert_eq!(ticked(&stamps(1000.0, rate * 1.013)), None);
        }
        // Of 51.2 Hz in ticks every step is 20, as of 50 Hz in milliseconds.
        assert_eq!(ticked(&stamps(1024.0, 51.2)), None);
    }
}
