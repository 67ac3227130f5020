//! A device that creeps while it should rest.

use findings::Kind;
use nalgebra::Vector3;
use sensor::Sensor;

use super::fault::{Fault, Scope, Seen, Site, Suspect};
use crate::methods::joint::blocks::column::Column;
use crate::methods::joint::data::Mean;

findings::tuning! {
    /// Chunks of a static interval in which a drifting bias shows.
    LONG: usize = 3;
}

/// A device that creeps while it should rest: a constant rate `ω` (rad/s, body frame) through a static interval, `u̇ = u × ω`. Its
/// gyroscope reads `ω`, its chunks see gravity move, and the turns beside it start and end half the angle away from its mean direction,
/// so that they miss in opposite ways.
pub static CREEP: Fault = Fault {
    kind: Kind::CREEP,
    name: "mount_slip",
    scope: Scope::StaticInterval,
    sensor: Sensor::Gyroscope,
    unit: "rad",
    typical: 2e-4,
    is_rate: true,
    is_imitated_by_bias: false,
    opens_force: false,
    is_over_with_interval: true,
    suspects,
    seen: |norm, span, gravity, _| Seen::Crept {
        angle: CREEP.size(norm, span),
        slope: norm * gravity,
    },
};

fn suspects(site: &Site<'_>) -> Vec<Suspect> {
    let data = site.rows.data;
    // A device that sways at rest creeps a little in any interval.
    let may = |k: &usize| !data.sources[data.rests[*k].recording].moves_at_rest();
    let rests = (0..data.rests.len()).filter(may);
    rests.map(|k| creep_in_interval(site, k)).collect()
}

/// The column that a creep through static interval `k` adds to the rows.
pub(super) fn creep_in_interval(site: &Site<'_>, k: usize) -> Suspect {
    let rows = site.rows;
    let rest = &rows.data.rests[k];
    let u = rows.direction(site.x, k);
    let (middle, half) = (
        0.5 * (rest.span.from + rest.span.to),
        0.5 * rest.span.length(),
    );
    let mut columns = vec![Column::default(); 3];
    // Rows are model less measurement: what the measurement gains, they lose.
    for (axis, column) in columns.iter_mut().enumerate() {
        let slope = u.cross(&Vector3::ith(axis, 1.0));
        for own in site.means(Sensor::Accelerometer, k) {
            let since = 0.5 * (own.mean.span.from + own.mean.span.to) - middle;
            let change = slope * (rows.gravity * since);
            (0..3).for_each(|i| column.set(own.row + i, -change[i]));
        }
        for own in site.means(Sensor::Gyroscope, k) {
            column.set(own.row + axis, -1.0);
        }
        // The device is at u − half·u̇ when the turn before ends, and at u + half·u̇ when the next begins; the model carries u.
        site.set_carried(column, k, false, slope * -half);
        site.set_carried(column, k, true, slope * half);
    }
    let means = site.means(Sensor::Accelerometer, k);
    let noise = rows.data.sources[rest.recording].accelerometer;
    let measured = means.filter_map(|own| Some((own.mean, noise?)));
    let slopes = measured.flat_map(|(mean, noise)| {
        let variance = noise.variance_in_sum() + noise.restless(&mean);
        slopes(&mean, &variance, &u, rows.gravity)
    });
    Suspect {
        nuisance: drift(site, k),
        slopes: slopes.collect(),
        ..Suspect::new(&CREEP, k, columns)
    }
}

/// A bias of the accelerometer that drifts evenly through static interval `k`: a long one at the begin shows the warm-up of the device, which
/// is no creep. None where the interval has fewer than [`LONG`] chunks.
fn drift(site: &Site<'_>, k: usize) -> Vec<Column> {
    let rest = &site.rows.data.rests[k];
    if rest.chunks.len() < LONG.get() {
        return Vec::new();
    }
    let middle = 0.5 * (rest.span.from + rest.span.to);
    let mut columns = vec![Column::default(); 3];
    for own in site.means(Sensor::Accelerometer, k) {
        let since = 0.5 * (own.mean.span.from + own.mean.span.to) - middle;
        for (axis, column) in columns.iter_mut().enumerate() {
            column.set(own.row + axis, since);
        }
    }
    columns
}

/// The slope of specific force within a chunk, `g u × ω`, over its standard deviation.
fn slopes(
    mean: &Mean,
    variance: &Vector3<f64>,
    u: &Vector3<f64>,
    gravity: f64,
) -> Vec<(Vec<f64>, f64)> {
    (0..3)
        .map(|i| {
            let sigma = (variance[i] / mean.spread).sqrt();
            let by = (0..3)
                .map(|axis| gravity * u.cross(&Vector3::ith(axis, 1.0))[i] / sigma)
                .collect();
            (by, mean.slope[i] / sigma)
        })
        .collect()
}
