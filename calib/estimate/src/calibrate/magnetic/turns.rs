//! The heading from one placement to the next, by the gyroscope.

use nalgebra::{Matrix3, Vector3};
use recording::intervals::Turn;
use sensor::attitude::Attitude;
use sensor::{Base, Sensor};

use super::source::{Collected, Source};
use crate::methods::magnetic::{HeadingChange, Placement};

impl Source<'_> {
    /// The rotation about the vertical in a turn from one placement to the next.
    pub(super) fn change(
        &self,
        turn: &Turn,
        from: usize,
        before: &Placement,
        after: &Placement,
    ) -> Option<HeadingChange> {
        let stream = self.recording.gyroscope.as_ref()?;
        let sensing = self.models.gyroscope.as_ref()?;
        let (rest_before, rest_after) = (before.rate?, after.rate?);
        let (t, raw) = (
            &stream.t[turn.samples.clone()],
            &stream.values[turn.samples.clone()],
        );
        let still = self.still(turn)?;
        let offset = 0.5 * (rest_before.mean + rest_after.mean);
        let rates: Vec<Vector3<f64>> = self
            .truth
            .along(t, raw)
            .iter()
            .map(|known| known.angular_rate - offset)
            .collect();
        let mut attitude = Attitude::identity();
        let (mut by_rate, mut sums) = (Vector3::zeros(), Matrix3::zeros());
        let mut squares = 0.0;
        for k in 0..t.len().checked_sub(1)? {
            let step = t[k + 1] - t[k];
            let up = attitude.into_body(&before.up);
            attitude = attitude.then(&Attitude::exp(&(0.5 * step * (rates[k] + rates[k + 1]))));
            let up = 0.5 * (up + attitude.into_body(&before.up)) * step;
            by_rate += up;
            sums += up * (0.5 * (raw[k] + raw[k + 1]) - still).transpose();
            squares += step * step;
        }
        let scale = Base::from_parameters(&sensing.parameters).scale();
        let white = scale * self.sample_noise(turn)?;
        Some(HeadingChange {
            from,
            angle: turned(&attitude, before, after)?,
            by_rate,
            by_error: self.inertial.by_difference(Sensor::Gyroscope, &sums),
            noise: (white * white * squares * self.misfit)
                .sqrt()
                .max(f64::MIN_POSITIVE),
        })
    }

    /// Raw mean of the rests on both sides.
    fn still(&self, turn: &Turn) -> Option<Vector3<f64>> {
        let rest = |k: usize| Some(self.segmentation.statics.get(k)?.gyroscope?.mean);
        Some(0.5 * (rest(turn.from)? + rest(turn.from + 1)?))
    }

    /// Standard deviation of an axis of a raw sample, with what its colour adds over a turn.
    fn sample_noise(&self, turn: &Turn) -> Option<f64> {
        let rest = |k: usize| {
            Some(
                self.segmentation
                    .statics
                    .get(k)?
                    .gyroscope?
                    .covariance
                    .trace(),
            )
        };
        let variance = (rest(turn.from)? + rest(turn.from + 1)?) / 6.0;
        Some(variance.sqrt() * self.colour)
    }
}

/// From the reference of one placement to that of the other, about the vertical, rad.
///
/// What the gyroscope misses of gravity's direction is taken off by the shortest rotation: it turns nothing about the
/// vertical.
fn turned(attitude: &Attitude<f64>, before: &Placement, after: &Placement) -> Option<f64> {
    let [from, to] = [before, after].map(Placement::reference);
    let predicted = attitude.into_body(&before.up);
    let axis = attitude.into_body(&from.column(0).into_owned());
    let back = nalgebra::Rotation3::rotation_between(&predicted, &after.up)?;
    let axis = back * axis;
    let (x, y) = (to.column(0), to.column(1));
    // The other's x axis as seen from the carried one: counter-clockwise about up.
    Some((-axis.dot(&y)).atan2(axis.dot(&x)))
}

/// The walk of the rate offsets that their noise does not explain, by moments, rad/s/√s.
pub(super) fn walk_of(collected: &Collected) -> f64 {
    let (mut square, mut time) = (0.0, 0.0);
    for change in &collected.changes {
        let pair = [change.from, change.from + 1].map(|k| &collected.placements[k]);
        let (Some(before), Some(after)) = (pair[0].rate, pair[1].rate) else {
            continue;
        };
        let moved = (after.mean - before.mean).norm_squared() / 3.0;
        square += moved - before.noise.powi(2) - after.noise.powi(2);
        let middle = |p: &Placement| 0.5 * (p.span.from + p.span.to);
        time += middle(pair[1]) - middle(pair[0]);
    }
    if time > 0.0 {
        (square / time).max(0.0).sqrt()
    } else {
        0.0
    }
}
