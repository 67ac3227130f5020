//! A device that creeps while it should rest.

use findings::Kind;
use nalgebra::Vector3;
use recording::intervals::Span;
use sensor::Sensor;

use super::fault::{Fault, Scope, Seen, Site, Suspect, axis_vector};
use crate::methods::joint::blocks::column::Column;
use crate::methods::joint::data::{Chunk, Mean};
use crate::methods::joint::rows::Rows;

/// Chunks of a static interval in which a drifting bias shows.
const LONG: usize = 3;

/// A device that creeps while it should rest: a constant rate `ω` (rad/s, body frame) through a static interval, `u̇ = u × ω`. Its
/// gyroscope reads `ω`, its chunks see gravity move, and the turns beside it start and end half the angle away from its mean direction,
/// so that they miss in opposite ways.
#[derive(Clone, Copy, Debug)]
pub struct Creep;

impl Fault for Creep {
    fn kind(&self) -> Kind {
        Kind::Creep
    }

    fn name(&self) -> &'static str {
        "mount_slip"
    }

    fn scope(&self) -> Scope {
        Scope::StaticInterval
    }

    fn sensor(&self) -> Sensor {
        Sensor::Gyroscope
    }

    fn unit(&self) -> &'static str {
        "rad"
    }

    fn typical(&self) -> f64 {
        2e-4
    }

    fn suspects(&self, site: &Site<'_>) -> Vec<Suspect> {
        let data = site.rows.data;
        // A device that sways at rest creeps a little in any interval.
        let may = |k: &usize| !data.sources[data.rests[*k].recording].moves_at_rest();
        let rests = (0..data.rests.len()).filter(may);
        rests.map(|k| Self::in_interval(site, k)).collect()
    }

    fn size(&self, norm: f64, span: Span) -> f64 {
        norm * span.length()
    }

    fn seen(&self, norm: f64, span: Span, gravity: f64, _seen: Seen) -> Seen {
        Seen::Crept {
            angle: self.size(norm, span),
            slope: norm * gravity,
        }
    }
}

impl Creep {
    /// What a creep through static interval `k` adds to the rows.
    pub(crate) fn in_interval(site: &Site<'_>, k: usize) -> Suspect {
        let rows = site.rows;
        let rest = &rows.data.rests[k];
        let u = rows.direction(site.x, k);
        let (middle, half) = (
            0.5 * (rest.span.from + rest.span.to),
            0.5 * rest.span.length(),
        );
        let mut columns = vec![Column::default(); 3];
        let mut row = 0;
        for sensor in [Sensor::Accelerometer, Sensor::Gyroscope] {
            for (place, chunk) in rows.means(sensor) {
                if rest.chunks.contains(&place) {
                    of_mean(rows, sensor, chunk, (u, middle), row, &mut columns);
                }
                row += 3;
            }
        }
        for place in 0..rows.data.turns.len() {
            let row = rows.first_turn_row() + 2 * place;
            for (axis, column) in columns.iter_mut().enumerate() {
                let moved = u.cross(&axis_vector(axis)) * half;
                // The device is at u − half·u̇ when the turn before ends, and at u + half·u̇ when the next begins; the model carries u.
                let ends = site.carried(place, k, false, -moved);
                let Some(shift) = ends.or_else(|| site.carried(place, k, true, moved)) else {
                    continue;
                };
                column.set(row, shift[0]);
                column.set(row + 1, shift[1]);
            }
        }
        let means = rows.means(Sensor::Accelerometer);
        let own = means.filter(|(place, _)| rest.chunks.contains(place));
        let noise = rows.data.sources[rest.recording].accelerometer;
        let measured = own.filter_map(|(_, chunk)| Some((chunk.accelerometer?, noise?)));
        let slopes = measured.flat_map(|(mean, noise)| {
            let variance = noise.variance_in_sum() + noise.restless(&mean);
            slopes(&mean, &variance, &u, rows.gravity)
        });
        Suspect {
            nuisance: drift(rows, k),
            slopes: slopes.collect(),
            ..Suspect::new(&Self, k, columns)
        }
    }
}

/// A bias of the accelerometer that drifts evenly through static interval `k`: a long one at the begin shows the warm-up of the device, which
/// is no creep. None where the interval has fewer than [`LONG`] chunks.
fn drift(rows: &Rows<'_>, k: usize) -> Vec<Column> {
    let rest = &rows.data.rests[k];
    if rest.chunks.len() < LONG {
        return Vec::new();
    }
    let middle = 0.5 * (rest.span.from + rest.span.to);
    let mut columns = vec![Column::default(); 3];
    for (place, (chunk, of)) in rows.means(Sensor::Accelerometer).enumerate() {
        let Some(mean) = of.accelerometer.filter(|_| rest.chunks.contains(&chunk)) else {
            continue;
        };
        let since = 0.5 * (mean.span.from + mean.span.to) - middle;
        for (axis, column) in columns.iter_mut().enumerate() {
            column.set(3 * place + axis, since);
        }
    }
    columns
}

/// Rows are model less measurement: what the measurement gains, they lose.
fn of_mean(
    rows: &Rows<'_>,
    sensor: Sensor,
    chunk: &Chunk,
    (u, middle): (Vector3<f64>, f64),
    row: usize,
    columns: &mut [Column],
) {
    for (axis, column) in columns.iter_mut().enumerate() {
        let unit = axis_vector(axis);
        let change = match (sensor, chunk.accelerometer, chunk.gyroscope) {
            (Sensor::Accelerometer, Some(mean), _) => {
                let since = 0.5 * (mean.span.from + mean.span.to) - middle;
                u.cross(&unit) * (rows.gravity * since)
            }
            (Sensor::Gyroscope, _, Some(_)) => unit,
            _ => continue,
        };
        for i in 0..3 {
            column.set(row + i, -change[i]);
        }
    }
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
                .map(|axis| gravity * u.cross(&axis_vector(axis))[i] / sigma)
                .collect();
            (by, mean.slope[i] / sigma)
        })
        .collect()
}
