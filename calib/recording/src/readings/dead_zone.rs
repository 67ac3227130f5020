//! Small signals that read as exactly zero.

use std::ops::Range;

use nalgebra::Vector3;
use sensor::Sensor;

use super::of_sensor::{OfSensor, least_beside_zero, least_step};
use super::symptom::Symptom;
use crate::recording::Stream;

findings::tuning! {
    /// Share of zeros in static intervals that a working sensor of any noise does not give.
    SHARE: f64 = 0.3;

    /// The smallest reading beside zero is that of a dead zone where it is so many least steps wide.
    WIDE: f64 = 3.0;

    /// Steps finer than this part of the largest reading resolve any sensor's noise: zeros between them are
    /// made.
    FINE: f64 = 1e-6;

    /// Zeros of an axis, at rest or while it turns, that are no chance ...
    FEW: usize = 20;
    /// ... where so many readings lie within once the width of the zone beyond its edge: turns sweep over them. Beside the
    /// smallest reading of any other axis there are one or two.
    SWEPT: usize = 10;

    /// A zone is narrower than this part of the largest reading.
    NARROW: f64 = 0.2;
}

/// The axes of a gyroscope that read zero at rest though their steps are finer than what lies around zero.
pub(super) fn found(of: &OfSensor<'_>) -> Option<Symptom> {
    if of.sensor != Sensor::Gyroscope {
        return None;
    }
    let zones = [0, 1, 2].map(|axis| {
        let at_rest = of.samples().map(move |value| value[axis]);
        DeadZone::of(at_rest, &of.stream.values, axis)
    });
    let dead = || {
        let zones = zones.iter().enumerate();
        zones.filter_map(|(axis, zone)| zone.map(|zone| (axis, zone)))
    };
    let (_, widest) = dead().max_by(|a, b| a.1.share.total_cmp(&b.1.share))?;
    Some(Symptom::DeadZone {
        sensor: of.sensor,
        axes: dead().map(|(axis, _)| axis).collect(),
        share: widest.share,
        least: widest.edge,
    })
}

/// The dead zone of each axis of a gyroscope as it reads, from its samples in stretches of rest; none where an axis has
/// none.
///
/// A zone that one axis shows is one of the sensor: where another axis reads zero now and then, its bias lies near the
/// edge and its mean is off by what those readings left out.
pub fn dead_zones(stream: &Stream, rests: &[Range<usize>]) -> [Option<DeadZone>; 3] {
    let at_rest = |axis: usize| {
        let rests = rests.iter().flat_map(|rest| &stream.values[rest.clone()]);
        rests.map(move |v| v[axis])
    };
    let shown = [0, 1, 2].map(|axis| DeadZone::of(at_rest(axis), &stream.values, axis));
    let widest = shown
        .iter()
        .flatten()
        .map(|zone| zone.edge)
        .reduce(f64::max);
    std::array::from_fn(|axis| {
        shown[axis].or_else(|| {
            let share = share_of_zeros(at_rest(axis));
            widest
                .filter(|_| share > 0.0)
                .map(|edge| DeadZone { share, edge })
        })
    })
}

/// Dead zone of an axis, in which readings are zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeadZone {
    /// Share of readings in static intervals that are zero.
    share: f64,
    /// The smallest reading beside zero: half the width of the zone.
    pub edge: f64,
}

impl DeadZone {
    fn of(
        at_rest: impl Iterator<Item = f64>,
        values: &[Vector3<f64>],
        axis: usize,
    ) -> Option<Self> {
        let share = share_of_zeros(at_rest);
        let gap = Gap::of(values, axis)?;
        let is_wide = gap.is_wide() || gap.step < FINE.get() * gap.largest;
        let is_shown = share >= SHARE.get() && is_wide || gap.is_swept(values, axis);
        is_shown.then_some(Self {
            share,
            edge: gap.edge,
        })
    }

    /// Returns true if so many readings in static intervals are zero that they do not show the bias.
    pub fn hides_the_bias(&self) -> bool {
        self.share >= SHARE.get()
    }

    /// Standard error of the mean of any number of readings at rest, in the unit of the zone: a bias within the zone lies
    /// anywhere in it; one at its edge is off by the readings that are zero instead of nearly the edge.
    pub fn error_of_mean(&self) -> f64 {
        (self.share * self.edge).min(self.edge / 3f64.sqrt())
    }
}

/// Returns true if an axis reads zero, static or not, and nothing between zero and an edge that turns sweep over.
pub(super) fn is_left_out(values: &[Vector3<f64>], axis: usize) -> bool {
    Gap::of(values, axis).is_some_and(|gap| gap.is_swept(values, axis))
}

/// Gap between zero and the other readings of an axis.
struct Gap {
    /// The smallest reading beside zero.
    edge: f64,
    /// The smallest step.
    step: f64,
    /// The largest reading.
    largest: f64,
}

impl Gap {
    fn of(values: &[Vector3<f64>], axis: usize) -> Option<Self> {
        Some(Self {
            edge: least_beside_zero(values, axis)?,
            step: least_step(values, axis)?,
            largest: values.iter().map(|v| v[axis].abs()).fold(0.0, f64::max),
        })
    }

    fn is_wide(&self) -> bool {
        self.edge > WIDE.get() * self.step
    }

    /// Returns true if the axis often reads zero and turns sweep over the edge.
    fn is_swept(&self, values: &[Vector3<f64>], axis: usize) -> bool {
        let zeros = values.iter().filter(|v| v[axis] == 0.0).count();
        let near = |v: &&Vector3<f64>| v[axis] != 0.0 && v[axis].abs() < 2.0 * self.edge;
        let is_a_zone = self.is_wide() && self.edge < NARROW.get() * self.largest;
        zeros >= FEW.get() && is_a_zone && values.iter().filter(near).count() >= SWEPT.get()
    }
}

fn share_of_zeros(values: impl Iterator<Item = f64>) -> f64 {
    let (mut all, mut zeros) = (0usize, 0usize);
    for value in values {
        all += 1;
        zeros += usize::from(value == 0.0);
    }
    zeros as f64 / all.max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;
    use rand_distr::{Distribution, Normal};

    #[test]
    fn a_zone_beside_the_bias_shows_in_turns_and_what_is_filled_with_zeros_has_none() {
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(4);
        let noise = Normal::new(0.0, 1e-3).unwrap();
        let rate = |k: usize| match k < 6_000 {
            true => 0.0,
            false => 0.05 * (0.01 * k as f64).sin(),
        };
        let mut read = |k: usize| Vector3::repeat(0.01 + rate(k) + noise.sample(&mut random));
        let whole: Vec<Vector3<f64>> = (0..8_000).map(&mut read).collect();
        let t = (0..8_000).map(|k| 0.01 * f64::from(k)).collect();
        let rest = 0..6_000;
        let zones = |values: Vec<Vector3<f64>>, t: &Vec<f64>| {
            let stream = Stream {
                t: t.clone(),
                values,
            };
            dead_zones(&stream, std::slice::from_ref(&rest))
        };
        let dead = |v: f64| if v.abs() < 0.004 { 0.0 } else { v };
        let [x, ..] = zones(whole.iter().map(|v| v.map(dead)).collect(), &t);
        let x = x.unwrap();
        assert!(
            !x.hides_the_bias() && (x.edge / 0.004 - 1.0).abs() < 0.1,
            "{x:?}"
        );
        assert_eq!(zones(whole.clone(), &t), [None; 3]);
        let filled = whole.iter().enumerate();
        let filled = filled.map(|(k, v)| if k % 50 == 0 { Vector3::zeros() } else { *v });
        assert_eq!(zones(filled.collect(), &t), [None; 3]);
        // Steps of 2 mrad/s: zero is one of them.
        let coarse = whole.iter().map(|v| v.map(|x| (x / 2e-3).round() * 2e-3));
        assert_eq!(zones(coarse.collect(), &t), [None; 3]);
    }

    #[test]
    fn a_bias_at_the_edge_of_the_zone_is_as_uncertain_as_its_mean_is_off() {
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(3);
        let biases = Vector3::new(0.005, 0.021, 0.04);
        let noise = Normal::new(0.0, 1e-3).unwrap();
        let dead = |v: f64| if v.abs() < 0.02 { 0.0 } else { v };
        let values: Vec<Vector3<f64>> = (0..20_000)
            .map(|k| {
                // The last quarter turns.
                let rate = if k < 15_000 {
                    0.0
                } else {
                    (0.01 * f64::from(k)).sin()
                };
                biases.map(|b| dead(b + rate + noise.sample(&mut random)))
            })
            .collect();
        let t = (0..20_000).map(|k| 0.01 * f64::from(k)).collect();
        let stream = Stream { t, values };
        let rest = 0..15_000;
        let [x, y, z] = dead_zones(&stream, std::slice::from_ref(&rest));
        let x = x.unwrap();
        assert!(
            x.hides_the_bias() && (x.edge / 0.02 - 1.0).abs() < 5e-3,
            "{x:?}"
        );
        // Uniform in ±.02.
        assert!((x.error_of_mean() / 0.02 * 3f64.sqrt() - 1.0).abs() < 5e-3);
        let y = y.unwrap();
        let mean = stream.values[rest].iter().map(|v| v.y).sum::<f64>() / 15_000.0;
        let off = (mean - biases.y).abs();
        assert!(
            !y.hides_the_bias() && (y.error_of_mean() / off - 1.0).abs() < 0.15,
            "{y:?} {off}"
        );
        // Its bias is beyond the zone.
        assert_eq!(z.unwrap().error_of_mean(), 0.0);
    }
}
