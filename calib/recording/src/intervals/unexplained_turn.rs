//! A mean rate within a static interval that no bias explains.
//!
//! A device that turns about the vertical looks still to an accelerometer, and a constant turn has no
//! spread either. What betrays it is that the rate points along the vertical wherever that lies in the
//! device, while a bias stays with the device's axes.

use nalgebra::{Matrix3, Vector3};

use crate::averages::median;

findings::tuning! {
    /// Turns about the vertical below this are left to bias and its drift, rad/s (0.06 °/s).
    LEAST: f64 = 1.05e-3;

    /// A rate along the vertical is no bias where it exceeds so many times what is left across it, and its
    /// own standard error.
    BEYOND: f64 = 6.0;

    /// Least share of the deviating intervals whose rate points along the vertical, for all of these to count as turns.
    MOST: f64 = 0.6;
    /// Least ratio of the rate along the vertical to that across it; below, it is a step, or a sensitivity to acceleration.
    ALONG: f64 = 2.5;

    /// A turn at more than this is one whatever else deviates, rad/s (1 °/s).
    CERTAIN: f64 = 1.7e-2;

    /// A mean rate so far from the bias of the others is a turn about whatever axis, rad/s (3 °/s): so far no bias moves.
    NO_BIAS: f64 = 0.052;
    /// Not where the force stays and more than this share of the rate is across it: the gyroscope's columns or unit are others.
    ACROSS: f64 = 0.5;

    /// The force stays where it spreads by less than this share of what the rate across it makes.
    STAYS: f64 = 0.5;
    /// More than this angle, rad, counts as this angle.
    FULL: f64 = 1.0;

    /// Directions in which the intervals' own know the bias to less than this share of the best.
    UNSEEN: f64 = 0.05;

    /// Rounds of weights.
    ROUNDS: usize = 8;
}

/// The mean rate of a static interval.
#[derive(Clone, Copy, Debug)]
pub(super) struct MeanRate {
    /// rad/s (3).
    pub mean: Vector3<f64>,
    /// Standard error of an axis, rad/s.
    pub error: f64,
    /// Direction of specific force (3), unit length.
    pub up: Vector3<f64>,
    /// Length of the interval, s.
    pub seconds: f64,
    /// Root mean square of specific force about its mean, over the mean.
    pub spread: f64,
}

impl MeanRate {
    /// Returns true if specific force varies less than a rotation at the rate `across`, rad/s, across it would make it vary.
    fn stays(&self, across: f64) -> bool {
        let angle = (across * self.seconds).min(FULL.get());
        self.spread < STAYS.get() * angle / 12f64.sqrt()
    }
}

/// The turn of each interval that turns, rad/s: about the vertical, or faster than any bias moves; `None` of the others.
pub(super) fn turning(rates: &[MeanRate]) -> Vec<Option<f64>> {
    let bias = bias(rates);
    let split = |rate: &MeanRate| {
        let deviation = rate.mean - bias;
        let along = deviation.dot(&rate.up);
        (along, (deviation - rate.up * along).norm())
    };
    let parts: Vec<(f64, f64)> = rates.iter().map(split).collect();
    let usual = median(parts.iter().map(|p| p.1)).unwrap_or(0.0);
    let limit = |rate: &MeanRate| LEAST.get().max(BEYOND.get() * usual.max(rate.error));
    let deviates =
        |(rate, &(along, across)): (&MeanRate, &(f64, f64))| along.hypot(across) > limit(rate);
    let turns = |(rate, &(along, across)): (&MeanRate, &(f64, f64))| {
        along.abs() > limit(rate) && along.abs() > ALONG.get() * across
    };
    let pairs = || rates.iter().zip(&parts);
    let deviating = pairs().filter(|&p| deviates(p)).count();
    let vertical = pairs().filter(|&p| turns(p)).count();
    let agreed = vertical as f64 >= MOST.get() * deviating as f64;
    pairs()
        .map(|p| {
            let (along, across) = *p.1;
            let about_the_vertical = turns(p) && (agreed || along.abs() > CERTAIN.get());
            let any = along.hypot(across);
            match about_the_vertical {
                true => Some(along),
                false => {
                    let is_no_rotation = across > ACROSS.get() * any && p.0.stays(across);
                    (any > NO_BIAS.get() && !is_no_rotation).then_some(any)
                }
            }
        })
        .collect()
}

/// The bias from what lies across the vertical, where no turn about it reaches; the median rate along
/// directions in which the orientations do not tell. Weights of Cauchy keep an outlier from counting.
fn bias(rates: &[MeanRate]) -> Vector3<f64> {
    let start = Vector3::from_fn(|axis, _| usual_rate(rates.iter().map(|r| r.mean[axis])));
    let across = |rate: &MeanRate| Matrix3::identity() - rate.up * rate.up.transpose();
    let mut weights = vec![1.0; rates.len()];
    let mut bias = start;
    for _ in 0..ROUNDS.get() {
        let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
        for (rate, &weight) in rates.iter().zip(&weights) {
            let across: Matrix3<f64> = across(rate) * weight;
            normal += across;
            right += across * (rate.mean - start);
        }
        let eigen = normal.symmetric_eigen();
        let least = UNSEEN.get() * eigen.eigenvalues.max();
        let mut step = Vector3::zeros();
        for (k, &value) in eigen.eigenvalues.iter().enumerate() {
            if value > least {
                let v = eigen.eigenvectors.column(k);
                step += v * (v.dot(&right) / value);
            }
        }
        bias = start + step;
        let left: Vec<f64> = rates
            .iter()
            .map(|rate| (across(rate) * (rate.mean - bias)).norm())
            .collect();
        let usual = median(left.iter().copied()).unwrap_or(0.0);
        if usual <= 0.0 {
            break;
        }
        for (weight, left) in weights.iter_mut().zip(left) {
            *weight = (1.0 + (left / usual).powi(2)).recip();
        }
    }
    bias
}

/// The median rate where half of the intervals and more have it, else the least: a rate table turns in most of them, and a bias is
/// small beside its rates.
fn usual_rate(rates: impl Iterator<Item = f64> + Clone) -> f64 {
    let middle = median(rates.clone()).unwrap_or(0.0);
    let is_near = |rate: &f64| (rate - middle).abs() < NO_BIAS.get();
    let (near, all) = (rates.clone().filter(is_near).count(), rates.clone().count());
    if 2 * near >= all {
        return middle;
    }
    let least = rates.min_by(|a, b| a.abs().total_cmp(&b.abs()));
    least.unwrap_or(middle)
}

#[cfg(test)]
mod tests {
    use super::*;

    const BIAS: Vector3<f64> = Vector3::new(0.02, -0.01, 0.005);

    /// Twelve orientations with the rate that `rate` of place and vertical adds to the bias.
    fn rates(rate: impl Fn(usize, &Vector3<f64>) -> Vector3<f64>) -> Vec<MeanRate> {
        let of = |k: usize| {
            let phase = k as f64;
            let up = Vector3::new(phase.sin(), (2.3 * phase).cos(), (3.1 * phase).sin() + 0.2);
            let up = up.normalize();
            let noise = 1e-4 * Vector3::new((7.0 * phase).sin(), (5.0 * phase).cos(), phase.cos());
            MeanRate {
                mean: BIAS + noise + rate(k, &up),
                error: 1e-4,
                up,
                seconds: 5.0,
                spread: 3e-3,
            }
        };
        (0..12).map(of).collect()
    }

    fn degrees(rate: f64) -> f64 {
        rate.to_radians()
    }

    #[test]
    fn a_turn_about_the_vertical_in_some_or_all_intervals_is_seen() {
        for size in [0.1, 1.0, 10.0, 60.0].map(degrees) {
            for share in [1, 3, 12] {
                let found = turning(&rates(
                    |k, up| if k % 12 < share { up * size } else { up * 0.0 },
                ));
                for (k, rate) in found.iter().enumerate() {
                    assert_eq!(rate.is_some(), k < share, "{size} {share} {k}");
                    assert!(rate.is_none_or(|r| (r / size - 1.0).abs() < 0.3));
                }
            }
        }
    }

    #[test]
    fn turns_of_another_rate_and_sense_in_each_interval_are_seen() {
        let found = turning(&rates(|k, up| {
            let sense = if k % 2 == 0 { 3.0 } else { -0.4 };
            up * degrees(sense * (k + 1) as f64)
        }));
        assert!(found.iter().all(Option::is_some));
    }

    #[test]
    fn a_bias_a_step_and_a_sensitivity_to_acceleration_are_no_turns() {
        let constant = Vector3::new(0.3, 0.2, -0.1);
        let step = Vector3::new(0.004, 0.0, 0.0);
        let matrix = Matrix3::new(2e-3, -1e-3, 5e-4, 1e-3, -1e-3, 2e-3, 0.0, 1e-3, 1.5e-3);
        let none = |rates: &[MeanRate]| turning(rates).iter().all(Option::is_none);
        assert!(none(&rates(|_, _| constant)));
        assert!(none(&rates(|k, _| step * f64::from(u8::from(k > 6)))));
        assert!(none(&rates(|_, up| matrix * up)));
        assert!(none(&rates(|_, _| Vector3::zeros())));
    }

    #[test]
    fn one_orientation_leaves_everything_to_the_bias() {
        let mut all = rates(|_, _| Vector3::new(0.5, 0.0, 0.0));
        all.iter_mut().for_each(|rate| rate.up = Vector3::x());
        assert!(turning(&all).iter().all(Option::is_none));
    }

    #[test]
    fn a_rate_table_turns_where_its_rate_is_not_the_least() {
        let profile = [0.0, 10.0, 20.0, 40.0, -15.0, -30.0].map(degrees);
        let of = |rate: &f64| MeanRate {
            mean: Vector3::new(0.004, -0.002, 0.003 + rate),
            error: 1e-4,
            up: Vector3::z(),
            seconds: 5.0,
            spread: 3e-3,
        };
        let all: Vec<MeanRate> = profile.iter().map(of).collect();
        let turns = turning(&all)
            .iter()
            .map(Option::is_some)
            .collect::<Vec<_>>();
        assert_eq!(turns, [false, true, true, true, true, true]);
    }

    #[test]
    fn a_rate_that_no_bias_reaches_is_a_turn_about_whatever_axis() {
        let mut all = rates(|k, _| match k {
            4 => Vector3::new(0.5, -0.3, 0.2),
            7 => Vector3::new(0.0, 0.09, 0.0),
            _ => Vector3::zeros(),
        });
        all[4].spread = 0.6;
        all[7].spread = 0.1;
        for (k, rate) in turning(&all).iter().enumerate() {
            assert_eq!(rate.is_some(), [4, 7].contains(&k), "{k}");
        }
    }

    #[test]
    fn a_rate_across_a_force_that_stays_is_no_turn() {
        let across = |k: usize, up: &Vector3<f64>| match k {
            8.. => up.cross(&Vector3::x()).normalize() * degrees(5.0),
            _ => Vector3::zeros(),
        };
        let all = rates(across);
        assert!(turning(&all).iter().all(Option::is_none));
        let mut tumbling = all;
        tumbling[8..].iter_mut().for_each(|rate| rate.spread = 0.13);
        assert!(turning(&tumbling)[8..].iter().all(Option::is_some));
    }
}
