//! Rows that repeat the reading before them, in a sensor that never reads the same for so long.

use std::ops::Range;

use findings::{Finding, Kind};
use nalgebra::Vector3;
use sensor::Sensor;

use crate::intervals::Span;
use crate::order_statistic::nth_smallest;
use crate::recording::stream::least_steps;
use crate::recording::{Frozen, Recording, Stream};

findings::tuning! {
    /// Fewer equal readings in a row are left to chance and to the clock.
    SHORTEST: usize = 4;

    /// Runs of equal readings on either side of one that show what is usual there ...
    AROUND: usize = 400;
    /// ... and the fewest that show anything.
    FEWEST_AROUND: usize = 60;

    /// A slower sensor holds its value for the length of most runs: of nine in ten no longer than this.
    HELD_SHARE: f64 = 0.9;
    /// Values that are held for longer than so many rows are those of no slower sensor.
    LONGEST_HELD: usize = 20;

    /// Runs that chance makes in fewer recordings than this are no chance.
    CHANCE: f64 = 0.01;

    /// The reading leaves the repeated one by more than so many of its least steps: where it changes by one, it repeats because
    /// nothing moves.
    LEAP: f64 = 1.5;

    /// Repeated readings that are more of the recording than this are how the sensor reads.
    MOST: f64 = 0.2;
    /// Not where its noise passes more than so many of its least steps: then no reading repeats for long.
    FINE: f64 = 2.0;
}

/// The median of the square of a standard normal number, and the largest of its squares that count.
const MEDIAN: f64 = 0.455;

findings::tuning! {
    /// Largest square of a standard normal number that counts.
    MANY: f64 = 20.0;

    /// Third differences of white noise go against their neighbours by 3/4; those of a smooth motion go with them.
    OF_NOISE: f64 = -0.5;

    /// Most places with rows and times in a finding.
    PLACES: usize = 3;
}

/// Finds the runs in which a sensor repeats one reading for longer than chance, its resolution or a slower clock explains.
pub(crate) fn frozen(sensor: Sensor, stream: &Stream) -> Vec<Frozen> {
    let of = |run: Range<usize>| Frozen {
        sensor,
        first_row: run.start + 1 + crate::readings::of_sensor::FIRST_ROW,
        rows: run.len() - 1,
        span: Span {
            from: stream.t[run.start],
            to: stream.t[run.end],
        },
    };
    frozen_runs(&stream.values).into_iter().map(of).collect()
}

/// The stream without the repetitions.
pub(crate) fn without_frozen(stream: Stream, frozen: &[Frozen]) -> Stream {
    if frozen.is_empty() {
        return stream;
    }
    // The spans are in order and apart.
    let is_repeated = |t: f64| {
        let next = frozen.partition_point(|f| f.span.to <= t);
        frozen.get(next).is_some_and(|f| f.repeats(t))
    };
    let samples = stream.t.into_iter().zip(stream.values);
    let (t, values) = samples.filter(|(t, _)| !is_repeated(*t)).unzip();
    Stream { t, values }
}

/// The finding about repetitions that were left out of a recording; `None` if there are none.
pub(crate) fn frozen_finding(recording: &Recording) -> Option<Finding> {
    let frozen = &recording.frozen;
    let mut sensors: Vec<&str> = frozen.iter().map(|f| f.sensor.name()).collect();
    sensors.dedup();
    let rows = |f: &Frozen| (f.first_row, f.first_row + f.rows - 1);
    let mut places: Vec<_> = frozen.iter().map(|f| (rows(f), f.span)).collect();
    places.sort_by_key(|place| place.0);
    // Both sensors of one table are in the same rows, or nearly.
    places.dedup_by(|(next, span), (last, whole)| {
        let same = next.0 <= last.1;
        if same {
            last.1 = last.1.max(next.1);
            whole.to = whole.to.max(span.to);
        }
        same
    });
    let rows = places.iter().map(|((first, last), _)| last + 1 - first);
    let found = Finding::of(Kind::FROZEN)
        .count("rows", rows.sum())
        .count("places", places.len())
        .detail("sensors", sensors.join(" and the "))
        .detail("listed", in_words(&places))
        .in_recording(&recording.name);
    (!places.is_empty()).then_some(found)
}

/// `rows 4 to 9, t = 0.20 to 0.45 s; and 2 more`.
fn in_words(places: &[((usize, usize), Span)]) -> String {
    let one = |((first, last), span): &((usize, usize), Span)| {
        let Span { from, to } = span;
        format!("rows {first} to {last}, t = {from:.2} to {to:.2} s")
    };
    let shown: Vec<String> = places.iter().take(PLACES.get()).map(one).collect();
    match places.len().saturating_sub(PLACES.get()) {
        0 => shown.join("; "),
        more => format!("{}; and {more} more", shown.join("; ")),
    }
}

/// The runs, each from the reading that is repeated to its last repetition.
fn frozen_runs(values: &[Vector3<f64>]) -> Vec<Range<usize>> {
    let mut begin = 0;
    let runs: Vec<Range<usize>> = values
        .chunk_by(|a, b| a == b)
        .map(|run| {
            begin += run.len();
            begin - run.len()..begin
        })
        .collect();
    let Some(usual) = Usual::of(&runs) else {
        return Vec::new();
    };
    let least = least_steps(values);
    let leaps = |from: usize, to: usize| {
        let step = values[to] - values[from];
        (0..3).any(|axis| step[axis].abs() > LEAP.get() * least[axis])
    };
    let begins = |run: &Range<usize>| run.start > 0 && leaps(run.start - 1, run.start);
    let ends = |run: &Range<usize>| run.end < values.len() && leaps(run.end - 1, run.end);
    let (low, high) = extremes(values);
    // A dead zone reads zero on all axes, a sensor at its range an extreme.
    let is_excluded = |v: &Vector3<f64>| {
        *v == Vector3::zeros() || (0..3).all(|axis| v[axis] == low[axis] || v[axis] == high[axis])
    };
    let found: Vec<Range<usize>> = runs
        .iter()
        .enumerate()
        .filter(|(k, run)| {
            run.len() >= SHORTEST.get()
                && begins(run)
                && ends(run)
                && usual.is_no_chance(*k, run.len())
        })
        .filter(|(_, run)| !is_excluded(&values[run.start]))
        .map(|(_, run)| run.clone())
        .collect();
    let repeated: usize = found.iter().map(|run| run.len() - 1).sum();
    if repeated as f64 > MOST.get() * values.len() as f64 && !is_fine(values, &least) {
        return Vec::new();
    }
    found
}

/// Returns true if the noise of every axis, where readings change, is wider than [`FINE`] least steps: by third differences, whose variance
/// is `20 σ²`.
fn is_fine(values: &[Vector3<f64>], least: &[f64; 3]) -> bool {
    let changes = |w: &[Vector3<f64>]| w.windows(2).all(|pair| pair[0] != pair[1]);
    let third = |w: &[Vector3<f64>]| w[3] - 3.0 * w[2] + 3.0 * w[1] - w[0];
    let windows = values.windows(5).filter(|w| changes(w));
    let pairs: Vec<_> = windows.map(|w| (third(&w[..4]), third(&w[1..]))).collect();
    (0..3).all(|axis| {
        let squares = pairs.iter().map(|(a, _)| a[axis] * a[axis]);
        let middle = nth_smallest(squares, pairs.len() / 2).unwrap_or(0.0);
        let quiet = || {
            pairs
                .iter()
                .filter(|(a, b)| a[axis].powi(2).max(b[axis].powi(2)) <= MANY.get() * middle)
        };
        let products: f64 = quiet().map(|(a, b)| a[axis] * b[axis]).sum();
        let squares: f64 = quiet()
            .map(|(a, b)| 0.5 * (a[axis].powi(2) + b[axis].powi(2)))
            .sum();
        let is_noise = products < OF_NOISE.get() * squares;
        is_noise && (middle / MEDIAN / 20.0).sqrt() > FINE.get() * least[axis]
    })
}

/// Usual length of runs of equal readings.
struct Usual {
    /// Rows for which a slower sensor holds its value; 1 of one that is read once.
    held: usize,
    /// Number of the runs before each that are longer.
    longer: Vec<usize>,
}

impl Usual {
    /// Computes it from runs; `None` if values are held for longer than a slower sensor does.
    fn of(runs: &[Range<usize>]) -> Option<Self> {
        let rank = (HELD_SHARE.get() * runs.len().saturating_sub(1) as f64) as usize;
        let lengths = runs.iter().map(|run| run.len() as f64);
        let held = nth_smallest(lengths, rank)? as usize;
        let mut longer = vec![0; runs.len() + 1];
        for (k, run) in runs.iter().enumerate() {
            longer[k + 1] = longer[k] + usize::from(run.len() > held);
        }
        (held <= LONGEST_HELD.get()).then_some(Self { held, longer })
    }

    /// Returns true if chance does not explain a run of this length among the runs around it. A share `s` of those is longer than
    /// usual, and of `n` runs `n s^(m−1)` last `m` times as long.
    fn is_no_chance(&self, k: usize, length: usize) -> bool {
        let runs = self.longer.len() - 1;
        let share = |from: usize, to: usize| {
            let longer = self.longer[to] - self.longer[from];
            (to - from >= FEWEST_AROUND.get()).then(|| (longer + 1) as f64 / (to - from + 2) as f64)
        };
        let before = share(k.saturating_sub(AROUND.get()), k);
        let after = share(k + 1, (k + 1 + AROUND.get()).min(runs));
        let Some(share) = before.into_iter().chain(after).reduce(f64::max) else {
            return false;
        };
        let times = length as f64 / self.held as f64;
        times >= 2.0 && runs as f64 * share.powf(times - 1.0) < CHANCE.get()
    }
}

/// The smallest and the largest reading of each axis.
fn extremes(values: &[Vector3<f64>]) -> (Vector3<f64>, Vector3<f64>) {
    let whole = (
        Vector3::repeat(f64::INFINITY),
        Vector3::repeat(f64::NEG_INFINITY),
    );
    values
        .iter()
        .fold(whole, |(low, high), v| (low.inf(v), high.sup(v)))
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;

    const ROWS: usize = 12_000;

    /// Ten rests and turns at 100 Hz, read in steps of so many standard deviations of the noise.
    fn readings(seed: u64, step: f64) -> Vec<Vector3<f64>> {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut noise = move || (0..12).map(|_| random.random::<f64>() - 0.5).sum::<f64>();
        let value = |k: usize| {
            let phase = (k % 1200) as f64;
            let turn = if phase < 300.0 {
                50.0 * (phase * std::f64::consts::PI / 300.0).sin()
            } else {
                0.0
            };
            let mut axis = |size: f64| ((3.7 + size * turn + noise()) / step).round() * step;
            Vector3::new(axis(1.0), axis(-0.6), axis(0.3))
        };
        (0..ROWS).map(value).collect()
    }

    fn freeze(values: &mut [Vector3<f64>], run: Range<usize>) {
        let first = values[run.start];
        values[run].fill(first);
    }

    #[test]
    fn rows_that_repeat_are_found_one_by_one_whatever_their_length() {
        for (seed, length) in [(1, 4), (2, 10), (3, 30), (4, 200)] {
            let mut values = readings(seed, 0.1);
            let runs: Vec<Range<usize>> = (0..9)
                .map(|k| 500 + 1130 * k..500 + 1130 * k + length)
                .collect();
            runs.iter().for_each(|run| freeze(&mut values, run.clone()));
            assert_eq!(frozen_runs(&values), runs);
        }
    }

    #[test]
    fn a_single_one_is_found() {
        let mut values = readings(5, 0.1);
        freeze(&mut values, 3650..3660);
        assert_eq!(frozen_runs(&values).first(), Some(&(3650..3660)));
        assert_eq!(frozen_runs(&values).len(), 1);
    }

    #[test]
    fn readings_in_any_steps_repeat_at_rest_by_themselves() {
        for (k, step) in [1e-6, 0.01, 0.1, 0.3, 1.0, 1.5, 2.0, 3.0, 5.0, 10.0, 20.0]
            .into_iter()
            .enumerate()
        {
            for seed in 0..5 {
                let found = frozen_runs(&readings(100 * k as u64 + seed, step));
                assert!(found.is_empty(), "{step}: {found:?}");
            }
        }
    }

    #[test]
    fn a_slower_sensor_holds_its_values() {
        let fine = readings(7, 0.1);
        for held in [2.0, 2.5, 3.3, 5.0] {
            let mut values: Vec<_> = (0..ROWS)
                .map(|k| fine[(k as f64 / held) as usize])
                .collect();
            assert!(frozen_runs(&values).is_empty(), "{held}");
            // And may freeze itself, for longer than it holds them.
            let run = 5100..5160;
            freeze(&mut values, run.clone());
            let [found] = &frozen_runs(&values)[..] else {
                panic!("{held}")
            };
            assert!(found.start <= run.start && found.end >= run.end);
        }
    }

    #[test]
    fn readings_at_the_range_of_all_axes_are_cut_off_and_not_frozen() {
        let values: Vec<_> = readings(9, 0.1)
            .iter()
            .map(|v| (v - Vector3::repeat(3.7)).map(|x| x.clamp(-8.0, 8.0)))
            .collect();
        assert!(frozen_runs(&values).is_empty());
    }

    #[test]
    fn a_hub_that_repeats_the_last_reading_at_rest_is_found() {
        let mut values = readings(10, 0.01);
        let rests: Vec<Range<usize>> = (0..10).map(|k| 1200 * k + 500..1200 * k + 1150).collect();
        rests
            .iter()
            .for_each(|run| freeze(&mut values, run.clone()));
        assert_eq!(frozen_runs(&values), rests);
    }

    #[test]
    fn repetitions_are_left_out_of_the_stream() {
        let mut values = readings(8, 0.1);
        freeze(&mut values, 3650..3660);
        let t = (0..ROWS).map(|k| 0.01 * k as f64).collect();
        let stream = Stream { t, values };
        let found = frozen(Sensor::Gyroscope, &stream);
        let left = without_frozen(stream, &found);
        assert_eq!(left.len(), ROWS - 9);
        assert_eq!(left.t[3651], 0.01 * 3660.0);
        assert_eq!((found[0].first_row, found[0].rows), (3653, 9));
    }
}
