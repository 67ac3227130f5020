//! A device that still settles after it was laid down.

use findings::Kind;
use nalgebra::Vector3;
use recording::intervals::Span;
use sensor::Sensor;

use super::fault::{Fault, Scope, Seen, Site, Suspect};
use crate::methods::joint::blocks::column::Column;

/// Time constants whose sum describes a surface that gives way within seconds, s.
const TIME_CONSTANTS: [f64; 2] = [2.5, 10.0];

findings::tuning! {
    /// Chunks of a static interval within which an attitude that settles shows.
    FEWEST_CHUNKS: usize = 2;
}

/// A device that settles after it was laid down, as on a cushion: at the begin of a long static interval its attitude is off by `δ`
/// (rad, body frame), and that fades, `u(t) = u + u × Σ δ_τ e^(−t/τ)`. Both sensors see it, and the turn before ends there.
pub static SETTLING: Fault = Fault {
    kind: Kind::SETTLING,
    name: "mount_slip",
    scope: Scope::StaticInterval,
    sensor: Sensor::Accelerometer,
    unit: "rad",
    typical: 1e-3,
    is_rate: false,
    is_imitated_by_bias: false,
    opens_force: false,
    is_over_with_interval: true,
    suspects,
    seen: |norm, _, _, _| Seen::Slipped(norm),
};

fn suspects(site: &Site<'_>) -> Vec<Suspect> {
    let data = site.rows.data;
    let may = |k: &usize| {
        let rest = &data.rests[*k];
        rest.chunks.len() >= FEWEST_CHUNKS.get() && !data.sources[rest.recording].moves_at_rest()
    };
    let rests = (0..data.rests.len()).filter(may);
    rests
        .map(|k| Suspect::new(&SETTLING, k, columns(site, k)))
        .collect()
}

/// The columns of three axes for every time constant.
fn columns(site: &Site<'_>, k: usize) -> Vec<Column> {
    let each = TIME_CONSTANTS.iter().map(|tau| fading(site, k, *tau));
    each.flatten().collect()
}

/// The columns of a rotation about each axis that fades in static interval `k`. Rows are model less measurement: what the measurement
/// gains, they lose.
fn fading(site: &Site<'_>, k: usize, tau: f64) -> Vec<Column> {
    let rows = site.rows;
    let (rest, u) = (&rows.data.rests[k], rows.direction(site.x, k));
    let left = |t: f64| (-(t - rest.span.from) / tau).exp();
    // Means of e^(−t/τ), and of its change, over a chunk.
    let mean = |span: &Span| tau * (left(span.from) - left(span.to)) / span.length();
    let change = |span: &Span| (left(span.to) - left(span.from)) / span.length();
    let mut columns = vec![Column::default(); 3];
    for (axis, column) in columns.iter_mut().enumerate() {
        let moved = u.cross(&Vector3::ith(axis, 1.0));
        for own in site.means(Sensor::Accelerometer, k) {
            let shift = moved * -rows.gravity * mean(&own.mean.span);
            (0..3).for_each(|i| column.set(own.row + i, shift[i]));
        }
        for own in site.means(Sensor::Gyroscope, k) {
            column.set(own.row + axis, -change(&own.mean.span));
        }
        site.set_carried(column, k, false, moved);
    }
    columns
}

#[cfg(test)]
mod tests {
    use recording::intervals::{Detector, segment};
    use simulate::Spec;

    use super::*;
    use crate::methods::joint::{JointRequest, fit_joint};

    #[test]
    fn a_device_that_settles_for_five_seconds_is_found_in_the_interval_where_it_does() {
        let spec = Spec::hand_held(5);
        let mut recording = spec.run().unwrap().recording;
        let segmentation = segment(&recording, &Detector::default()).unwrap();
        let span = segmentation.statics[0].span;
        // 0.2° about an axis across the first reading, that fade with 5 s; its rate is what fades.
        let force = recording.accelerometer.as_mut().unwrap();
        let first = force.values[force.between(span.from, span.from + 1.0)][0];
        let across = first.cross(&Vector3::x()).normalize();
        let left = |t: f64| 3.5e-3 * (-(t - span.from) / 5.0).exp();
        for (t, value) in force.t.iter().zip(&mut force.values) {
            if *t < span.to {
                *value += first.cross(&across) * left(*t);
            }
        }
        let rate = recording.gyroscope.as_mut().unwrap();
        for (t, value) in rate.t.iter().zip(&mut rate.values) {
            if *t < span.to {
                *value -= across * (left(*t) / 5.0);
            }
        }
        let request = JointRequest::new(vec![(&recording, &segmentation)], spec.gravity);
        let fit = fit_joint(&request).unwrap();
        let flagged: Vec<_> = fit
            .flagged
            .iter()
            .map(|a| (a.fault.kind, a.interval))
            .collect();
        assert_eq!(flagged, [(Kind::SETTLING, 0)]);
    }
}
