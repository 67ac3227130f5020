//! Attitudes through a recording: level by the accelerometer at rest, the heading carried by the gyroscope.

use nalgebra::Vector3;
use recording::Recording;
use recording::intervals::{Segmentation, Span, Turn};
use sensor::attitude::Attitude;

use super::rests::KnownRest;
use super::sensing::Models;

/// Attitudes (body to a level frame, `z` up). The heading of the first static interval is zero.
#[derive(Clone, Debug)]
pub(super) struct Path {
    /// In the static intervals.
    pub rests: Vec<Attitude<f64>>,
    spans: Vec<Span>,
    /// Turns that could be integrated: the interval before each, the stamps (s) and the attitudes at them.
    turns: Vec<(usize, Vec<f64>, Vec<Attitude<f64>>)>,
}

impl Path {
    /// Level in every interval by its mean force, the heading carried through the turns between. Over a turn that cannot
    /// be followed the device is taken to turn the shortest way.
    pub fn of(
        recording: &Recording,
        segmentation: &Segmentation,
        models: &Models,
        known: &[KnownRest],
    ) -> Self {
        let mut path = Self {
            rests: Vec::with_capacity(known.len()),
            spans: known.iter().map(|rest| rest.span).collect(),
            turns: Vec::new(),
        };
        for (k, rest) in known.iter().enumerate() {
            let mut carried = path
                .rests
                .last()
                .copied()
                .unwrap_or_else(Attitude::identity);
            let turn = segmentation.turns.iter().find(|turn| turn.from + 1 == k);
            let turn = turn.filter(|turn| turn.fault.is_none());
            if let Some((t, own)) =
                turn.and_then(|turn| followed(recording, segmentation, models, turn, carried))
            {
                carried = own.last().copied().unwrap_or(carried);
                path.turns.push((k - 1, t, own));
            }
            path.rests
                .push(levelled(&carried, &rest.known.specific_force));
        }
        path
    }

    /// At time `t`, s; before the first interval that of the first.
    pub fn at(&self, t: f64) -> Attitude<f64> {
        let k = self.spans.partition_point(|span| span.from <= t);
        let k = k.saturating_sub(1);
        let at_rest = self.rests.get(k).copied();
        let at_rest = at_rest.unwrap_or_else(Attitude::identity);
        let moving = self.spans.get(k).is_some_and(|span| t >= span.to);
        let Ok(place) = self.turns.binary_search_by_key(&k, |(from, ..)| *from) else {
            return at_rest;
        };
        let (_, stamps, attitudes) = &self.turns[place];
        if moving {
            between(stamps, attitudes, t).unwrap_or(at_rest)
        } else {
            at_rest
        }
    }
}

/// The attitude at `t`, along the chord between those of the neighbouring samples: a sample's turn is small. That of the
/// first or last sample outside.
///
/// The times of samples by the clock that a fit chose lie on either side of their stamps: taking the attitude of a sample
/// would be off by half a step on average.
fn between(stamps: &[f64], attitudes: &[Attitude<f64>], t: f64) -> Option<Attitude<f64>> {
    let after = stamps.partition_point(|&s| s < t);
    let (Some(before), Some(next)) = (after.checked_sub(1), attitudes.get(after)) else {
        return attitudes
            .get(after.min(attitudes.len().checked_sub(1)?))
            .copied();
    };
    let (a, b) = (attitudes[before], *next);
    let step = stamps[after] - stamps[before];
    let share = if step > 0.0 {
        ((t - stamps[before]) / step).clamp(0.0, 1.0)
    } else {
        1.0
    };
    Some(
        Attitude {
            w: a.w + (b.w - a.w) * share,
            v: a.v + (b.v - a.v) * share,
        }
        .normalized(),
    )
}

/// Stamps and attitudes of the samples of a turn. What the sensor shows in the rests beside it is taken off as bias.
fn followed(
    recording: &Recording,
    segmentation: &Segmentation,
    models: &Models,
    turn: &Turn,
    before: Attitude<f64>,
) -> Option<(Vec<f64>, Vec<Attitude<f64>>)> {
    let (stream, sensing) = (recording.gyroscope.as_ref()?, models.gyroscope.as_ref()?);
    let ends = segmentation.statics.get(turn.from..turn.from + 2)?;
    let bias = 0.5 * (ends[0].gyroscope?.mean + ends[1].gyroscope?.mean);
    let t = stream.t[turn.samples.clone()].to_vec();
    let rates = stream.values[turn.samples.clone()]
        .iter()
        .map(|raw| sensing.slope(&(raw - bias)));
    let rates: Vec<Vector3<f64>> = rates.collect();
    let mut attitude = before;
    let mut path = Vec::with_capacity(t.len());
    path.push(attitude);
    for (pair, rates) in t.windows(2).zip(rates.windows(2)) {
        let angle = (rates[0] + rates[1]) * (0.5 * (pair[1] - pair[0]));
        attitude = attitude.then(&Attitude::exp(&angle)).normalized();
        path.push(attitude);
    }
    (!t.is_empty()).then_some((t, path))
}

/// The attitude nearest to `attitude` in which `up` (body frame, any length) points up; the same without a direction.
pub(crate) fn levelled(attitude: &Attitude<f64>, up: &Vector3<f64>) -> Attitude<f64> {
    match up
        .try_normalize(0.0)
        .filter(|u| u.iter().all(|v| v.is_finite()))
    {
        Some(up) => shortest(&attitude.into_reference(&up))
            .then(attitude)
            .normalized(),
        None => *attitude,
    }
}

/// The rotation about a horizontal axis that carries the unit vector `from` to `z`.
fn shortest(from: &Vector3<f64>) -> Attitude<f64> {
    let w = 1.0 + from.z;
    if w < 1e-9 {
        return Attitude::exp(&(Vector3::x() * std::f64::consts::PI));
    }
    Attitude {
        w,
        v: from.cross(&Vector3::z()),
    }
    .normalized()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn between_two_samples_the_attitude_is_between() {
        let turned = |angle: f64| Attitude::exp(&Vector3::new(0.0, 0.0, angle));
        let attitudes = [turned(0.3), turned(0.34)];
        for (t, angle) in [
            (1.0, 0.3),
            (1.0025, 0.31),
            (1.005, 0.32),
            (1.01, 0.34),
            (1.2, 0.34),
        ] {
            let found = between(&[1.0, 1.01], &attitudes, t).unwrap();
            // The chord is off by less than the cube of the step.
            assert!((found.v.z - turned(angle).v.z).abs() < 1e-6, "{t}");
        }
    }

    #[test]
    fn levelling_keeps_a_level_attitude_and_rights_a_tilted_one() {
        let heading = Attitude::exp(&Vector3::new(0.0, 0.0, 1.2));
        let same = levelled(&heading, &Vector3::z());
        let forward = |a: &Attitude<f64>| a.into_reference(&Vector3::x());
        assert!((forward(&same) - forward(&heading)).norm() < 1e-14);
        let up = Vector3::new(6.0, 0.0, -8.0);
        let righted = levelled(&heading, &up);
        assert!((righted.into_reference(&up) - Vector3::z() * 10.0).norm() < 1e-13);
    }
}
