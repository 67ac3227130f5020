//! Rows that share their stamps because the stamps are coarser than the rate: samples of one packet, or of one tick of a coarse
//! clock.

use findings::{Finding, Kind};
use nalgebra::Vector3;
use sensor::Sensor;

use super::Samples;
use crate::clock::even::{Bursts, bursts};
use crate::order_statistic::nth_smallest;

findings::tuning! {
    /// Fewer packets show no step that they have in common.
    PACKETS: usize = 8;

    /// Steps between packets differ from the usual one by no more than this, in steps between samples.
    UNEVEN: f64 = 0.5;

    /// Share of the rows from which shared stamps are those of packets.
    SHARE: f64 = 0.02;

    /// Rows with one stamp differ from each other by no more than this, in usual differences of rows as far apart as a packet is
    /// long: several devices in one table differ from row to row, and not from packet to packet.
    ALIKE: f64 = 2.0;
}

/// The rows of packets apart again, on the even clock behind their stamps (s); what is said of it. Other samples stay as they are.
pub(crate) fn apart(name: &str, sensor: Sensor, samples: &mut Samples) -> Option<Finding> {
    let (twins, others) = (samples.twins.len(), samples.other_twins().count());
    let rows = samples.t.len() + twins;
    if (twins as f64) < SHARE.get() * rows as f64 || 2 * others < twins {
        return None;
    }
    let (t, values) = samples.apart();
    if !of_one_device(&t, &values) {
        return None;
    }
    let (even, step, size) = of_equal_packets(&t).or_else(|| {
        let Bursts {
            even, step, size, ..
        } = bursts(&t)?;
        Some((even, step, size))
    })?;
    let line = samples.line(0);
    *samples = Samples::of(even, values).beginning_at(line);
    let found = Finding::of(Kind::STAMPS_COARSE)
        .in_recording(name)
        .of_sensor(sensor)
        .count("rows", rows - distinct(&t))
        .number("size", size, "1")
        .number("rate", step.recip(), "Hz");
    Some(found)
}

/// The clock of packets of one size and their stamps at even steps, with its step and that size: straight lines from the middle
/// of each packet, for nobody says whether its first or its last sample has the stamp, to that of the next.
fn of_equal_packets(t: &[f64]) -> Option<(Vec<f64>, f64, f64)> {
    let packets: Vec<&[f64]> = t.chunk_by(|a, b| a == b).collect();
    // The first and the last may be cut.
    let inner = packets.get(1..packets.len().checked_sub(1)?)?;
    let size = inner.first()?.len();
    let ends = [packets.first()?.len(), packets.last()?.len()];
    let is_whole = |packet: &&[f64]| packet.len() == size;
    if inner.len() < PACKETS.get()
        || !inner.iter().all(is_whole)
        || ends.iter().any(|end| *end > size)
    {
        return None;
    }
    let steps: Vec<f64> = inner
        .windows(2)
        .map(|pair| pair[1][0] - pair[0][0])
        .collect();
    let usual = nth_smallest(steps.iter().copied(), steps.len() / 2)?;
    let step = usual / size as f64;
    if step <= 0.0
        || steps
            .iter()
            .any(|other| (other - usual).abs() > UNEVEN.get() * step)
    {
        return None;
    }
    let middle = ends[0] as f64 + (size - 1) as f64 / 2.0;
    let clock = |k: usize| {
        let passed = (k as f64 - middle) / size as f64;
        let packet = (passed.max(0.0) as usize).min(steps.len() - 1);
        inner[packet][0] + (passed - packet as f64) * steps[packet]
    };
    Some(((0..t.len()).map(clock).collect(), step, size as f64))
}

fn distinct(t: &[f64]) -> usize {
    t.chunk_by(|a, b| a == b).count()
}

fn of_one_device(t: &[f64], values: &[Vector3<f64>]) -> bool {
    let size = (t.len() as f64 / distinct(t) as f64).round().max(2.0) as usize;
    let within = (1..t.len()).filter(|&k| t[k] == t[k - 1]);
    let within: Vec<f64> = within.map(|k| (values[k] - values[k - 1]).norm()).collect();
    let packets = values.windows(size + 1).map(|w| (w[size] - w[0]).norm());
    let middle = |n: usize| n / 2;
    let usual = nth_smallest(packets, middle(values.len().saturating_sub(size)));
    let own = nth_smallest(within.iter().copied(), middle(within.len()));
    own.zip(usual)
        .is_some_and(|(own, usual)| own <= ALIKE.get() * usual)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn samples(stamp: impl Fn(usize) -> f64, value: impl Fn(usize) -> f64) -> Samples {
        let mut samples = Samples::default();
        for k in 0..4000 {
            let noise = ((k * k * 31) % 101) as f64 * 1e-3;
            samples.push(
                stamp(k),
                Vector3::new(value(k) + noise, noise, 9.8),
                k as u64 + 2,
            );
        }
        samples
    }

    #[test]
    fn samples_of_packets_with_one_stamp_are_on_an_even_clock() {
        for size in [2, 5, 12] {
            let packets = |k: usize| (k - k % size + size - 1) as f64 * 0.01;
            let mut found = samples(packets, |k| k as f64);
            let said = apart("a.csv", Sensor::Gyroscope, &mut found).unwrap();
            let rate = said.value("rate").unwrap();
            assert!((rate - 100.0).abs() < 0.1, "{rate}");
            assert_eq!(found.t.len(), 4000);
            assert!(
                (found.values[777].x - 777.0).abs() < 0.11,
                "{}",
                found.values[777].x
            );
            let steps = found.t.windows(2).map(|w| w[1] - w[0]);
            assert!(steps.into_iter().all(|step| (step - 0.01).abs() < 2e-4));
        }
    }

    #[test]
    fn equal_packets_at_even_steps_have_the_clock_of_their_stamps() {
        // The first is cut, and stamps are rounded.
        let stamp = |k: usize| ((k + 5) / 32) as f64 * 0.64;
        let mut found = samples(|k| (1e3 * stamp(k)).round() / 1e3, |k| k as f64);
        assert!(apart("a.csv", Sensor::Gyroscope, &mut found).is_some());
        let off = (0..4000).map(|k| (found.t[k] - found.t[0] - 0.02 * k as f64).abs());
        assert!(off.fold(0.0, f64::max) < 2e-3);
    }

    #[test]
    fn stamps_rounded_to_twenty_milliseconds_are_the_same() {
        let rounded = |k: usize| (k as f64 * 0.0098 / 0.02).round() * 0.02;
        let mut found = samples(rounded, |k| k as f64);
        assert!(apart("a.csv", Sensor::Gyroscope, &mut found).is_some());
        assert_eq!(found.t.len(), 4000);
    }

    #[test]
    fn devices_that_take_turns_and_rows_written_twice_are_not_taken_for_packets() {
        let pairs = |k: usize| (k / 2) as f64 * 0.01;
        let mut two = samples(pairs, |k| if k % 2 == 0 { 0.0 } else { 5.0 });
        let before = two.clone();
        assert_eq!(apart("a.csv", Sensor::Gyroscope, &mut two), None);
        assert_eq!(two, before);
        let mut twice = Samples::default();
        for k in 0..4000_usize {
            let value = Vector3::repeat((k / 2) as f64);
            twice.push(pairs(k), value, k as u64);
        }
        assert_eq!(apart("a.csv", Sensor::Gyroscope, &mut twice), None);
    }
}
