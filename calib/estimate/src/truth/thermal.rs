//! Course of the temperature: its derivative, and whether it rises or falls.

use recording::Temperature;
use recording::averages::median;

use super::smooth_curve::{Reading, SmoothCurve};

findings::tuning! {
    /// Readings are taken together over this long, s: the temperature of a device does not change faster.
    BIN: f64 = 1.0;

    /// Between the knots of the curve whose derivative is taken, s; longer where readings are rarer.
    KNOTS: f64 = 4.0;

    /// Share of bins equal to the one before above which the thermometer is coarse, or its readings are held.
    REPEATED: f64 = 0.5;

    /// Weight of the first and the last bin of a coarse thermometer, relative to its steps.
    ///
    /// The temperature may be half a step from these bins, but is near half way where the reading steps. In simulated swings
    /// and warm-ups of 3 to 8 K, read to 0.25 and 0.5 K, the error of the derivative was 1.9 to 6.6 % with a tenth, 2.0 to 13.8
    /// % with 1 and 1.9 to 4.2 % with a hundredth.
    END_WEIGHT: f64 = 0.1;

    /// Bins on either side of a turning point of the readings, within which the derivative has its zero.
    REACH: usize = 12;

    /// A turning point counts where the temperature comes back from it by this, K, ...
    LEAST_RETURN: f64 = 0.2;
    /// ... and by so many times its noise.
    OF_NOISE: f64 = 6.0;
}

/// The course of the temperature of one recording.
#[derive(Clone, Debug, Default)]
pub(super) struct Thermal {
    /// Without, it is constant.
    curve: Option<SmoothCurve>,
    /// From when on it rises (1) or falls (−1).
    ways: Vec<(f64, f64)>,
}

impl Thermal {
    pub fn of(temperature: &Temperature) -> Self {
        let bins = bins(&temperature.t, &temperature.celsius);
        let (t, celsius): (Vec<f64>, Vec<f64>) = bins.iter().map(|b| (b.t, b.value)).unzip();
        let repeated = celsius.windows(2).filter(|c| is_repeated(c)).count();
        let curve = if repeated as f64 > REPEATED.get() * t.len() as f64 {
            SmoothCurve::through(&steps(temperature), knots(&t))
        } else {
            SmoothCurve::through(&bins, knots(&t))
        };
        let mut ways = ways(&t, &celsius);
        if let Some(curve) = &curve {
            for (from, _) in ways.iter_mut().skip(1) {
                *from = crossing(&t, curve, *from);
            }
        }
        Self { curve, ways }
    }

    /// The mean derivative over a stretch, K/s, and whether it rises (1) or falls (−1) in it.
    pub fn over(&self, from: f64, to: f64) -> [f64; 2] {
        let mean = |curve: &SmoothCurve| curve.mean_slope(from, to);
        let rate = self.curve.as_ref().map_or(0.0, mean);
        [rate, self.warming(from, to)]
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

/// Means over whole bins: middle of the stamps, temperature, and how many readings it is of.
fn bins(stamps: &[f64], celsius: &[f64]) -> Vec<Reading> {
    let mut bins = Vec::new();
    let mut first = 0;
    for k in 1..=stamps.len() {
        let next = stamps.get(k);
        if next.is_none_or(|&next| next - stamps[first] >= BIN.get()) {
            let count = (k - first) as f64;
            bins.push(Reading {
                t: stamps[first..k].iter().sum::<f64>() / count,
                value: celsius[first..k].iter().sum::<f64>() / count,
                weight: count,
            });
            first = k;
        }
    }
    bins
}

fn is_repeated(celsius: &[f64]) -> bool {
    (celsius[1] - celsius[0]).abs() <= 1e-9 * (1.0 + celsius[0].abs())
}

/// Lists the steps of a coarse thermometer, those within a second together, and its ends.
///
/// A step is half way between two values, in the middle between two readings. Between its steps a coarse thermometer shows
/// only that the temperature is nearer to this value than to the next.
fn steps(temperature: &Temperature) -> Vec<Reading> {
    let (t, celsius) = (&temperature.t, &temperature.celsius);
    let pairs = t.windows(2).zip(celsius.windows(2));
    let (at, half_way): (Vec<f64>, Vec<f64>) = pairs
        .filter(|(_, c)| !is_repeated(c))
        .map(|(t, c)| (0.5 * (t[0] + t[1]), 0.5 * (c[0] + c[1])))
        .unzip();
    let mut inner = bins(&at, &half_way);
    // Noise makes it step to and fro about one temperature: that says no more than one step.
    inner.iter_mut().for_each(|step| step.weight = 1.0);
    let end = |t: Option<&f64>, c: Option<&f64>| {
        t.zip(c).map(|(&t, &value)| Reading {
            t,
            value,
            weight: END_WEIGHT.get(),
        })
    };
    let first = end(t.first(), celsius.first());
    let last = end(t.last(), celsius.last());
    first.into_iter().chain(inner).chain(last).collect()
}

/// Between the knots of a curve through bins at `t`, s.
fn knots(t: &[f64]) -> f64 {
    median(t.windows(2).map(|t| t[1] - t[0])).map_or(KNOTS.get(), |apart| apart.max(KNOTS.get()))
}

/// When the temperature begins to rise or fall: at its turning points, the first way from the begin on.
fn ways(t: &[f64], celsius: &[f64]) -> Vec<(f64, f64)> {
    let least = LEAST_RETURN.get().max(OF_NOISE.get() * noise(celsius));
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

/// Finds the time at which the derivative changes its sign, nearest to the turning point `about` of the noisy readings, s.
fn crossing(t: &[f64], curve: &SmoothCurve, about: f64) -> f64 {
    let near = t.partition_point(|&s| s < about);
    let range = near.saturating_sub(REACH.get())..(near + REACH.get() + 1).min(t.len());
    let slopes: Vec<(f64, f64)> = t[range].iter().map(|&t| (t, curve.slope(t))).collect();
    slopes
        .windows(2)
        .filter(|pair| pair[0].1 * pair[1].1 < 0.0)
        .map(|pair| {
            let [(t, rate), (next, then)] = [pair[0], pair[1]];
            t + (next - t) * rate / (rate - then)
        })
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

    /// Uniform and normal noise of a fixed seed (splitmix64; twelve uniforms make a normal).
    struct Noise(u64);

    impl Noise {
        fn uniform(&mut self) -> f64 {
            self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let mut z = self.0;
            z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
        }

        fn normal(&mut self) -> f64 {
            (0..12).map(|_| self.uniform()).sum::<f64>() - 6.0
        }
    }

    /// No multiple of the time between readings: their rounding is another one in each swing.
    const PERIOD: f64 = 197.0;
    const LARGEST: f64 = 3.0 * std::f64::consts::TAU / PERIOD;

    fn swing(t: f64) -> f64 {
        25.0 + 3.0 * (std::f64::consts::TAU * t / PERIOD).sin()
    }

    fn swings(t: f64) -> f64 {
        LARGEST * (std::f64::consts::TAU * t / PERIOD).cos()
    }

    /// Size of the derivative of a swing of 3 K against the truth, less one, and root mean square error against its
    /// root mean square: of readings every `every` seconds with `noise` (K), in steps of `step` (K).
    fn errors(every: f64, noise: f64, step: f64, seed: u64) -> [f64; 2] {
        let mut random = Noise(seed);
        let t: Vec<f64> = (0..=(600.0 / every) as u32)
            .map(|k| every * f64::from(k))
            .collect();
        let mut read = |t: &f64| {
            let exact = swing(*t) + noise * random.normal();
            if step > 0.0 {
                (exact / step).round() * step
            } else {
                exact
            }
        };
        let celsius = t.iter().map(&mut read).collect();
        let found = Thermal::of(&Temperature { t, celsius });
        let times = (0..2000).map(|k| 0.3 * f64::from(k));
        let (mut along, mut off, mut own) = (0.0, 0.0, 0.0);
        for t in times {
            let [rate, truth] = [found.over(t, t)[0], swings(t)];
            along += rate * truth;
            off += (rate - truth).powi(2);
            own += truth * truth;
        }
        [along / own - 1.0, (off / own).sqrt()]
    }

    #[test]
    fn the_rate_of_a_swing_is_that_of_its_sine() {
        let found = course(swing);
        for t in [17.3, 50.0, 333.3] {
            let off = found.over(t, t)[0] - swings(t);
            assert!(off.abs() < 1e-3 * LARGEST, "{t}: {off}");
        }
        // Nothing stiffens the ends.
        for t in [0.0, 599.0] {
            let off = found.over(t, t)[0] - swings(t);
            assert!(off.abs() < 0.03 * LARGEST, "{t}: {off}");
        }
        let long = found.over(20.0, 120.0)[0];
        assert!((long - (swing(120.0) - swing(20.0)) / 100.0).abs() < 1e-3 * LARGEST);
    }

    #[test]
    fn noise_steps_and_rare_readings_leave_the_size_of_the_rate() {
        // Seconds between readings, noise and step in K; what remains of the derivative's size and of its root mean square.
        for (every, noise, step, size, rms) in [
            (1.0, 0.0, 0.0, 0.001, 0.005),
            (1.0, 0.02, 0.0, 0.003, 0.02),
            (0.01, 0.2, 0.0, 0.003, 0.02),
            (1.0, 0.02, 0.0625, 0.003, 0.03),
            (1.0, 0.02, 0.5, 0.006, 0.05),
            (0.01, 0.0, 0.5, 0.003, 0.02),
            (10.0, 0.02, 0.0, 0.003, 0.04),
            (10.0, 0.02, 0.5, 0.02, 0.09),
            (1.0, 0.2, 0.0, 0.02, 0.09),
        ] {
            let mut sizes = 0.0;
            for seed in 0..8 {
                let [one, off] = errors(every, noise, step, seed);
                assert!(off < rms, "{every} s, {noise} K, {step} K: rms {off}");
                sizes += one / 8.0;
            }
            assert!(
                sizes.abs() < size,
                "{every} s, {noise} K, {step} K: {sizes}"
            );
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
        assert!(found.over(100.0, 100.0)[0].abs() < 1e-3);
        assert_eq!(Thermal::default().over(5.0, 5.0), [0.0; 2]);
    }
}
