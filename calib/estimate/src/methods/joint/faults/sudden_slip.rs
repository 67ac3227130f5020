//! A device that moves at once between two parts of a static interval.

use findings::Kind;
use recording::intervals::Span;
use sensor::Sensor;

use super::fault::{Fault, Scope, Seen, Site, Suspect, axis_vector};
use crate::methods::joint::blocks::column::Column;

/// A device that moves at once between two parts of a long static interval: a rotation by `δ` (rad, body frame) before one of its chunks,
/// `u` becomes `u + u × δ`. What comes after, the turn that begins there among it, sees the new direction.
#[derive(Clone, Copy, Debug)]
pub struct SuddenSlip;

impl Fault for SuddenSlip {
    fn kind(&self) -> Kind {
        Kind::MountSlip
    }

    fn name(&self) -> &'static str {
        "mount_slip"
    }

    fn scope(&self) -> Scope {
        Scope::Chunk
    }

    fn sensor(&self) -> Sensor {
        Sensor::Accelerometer
    }

    fn unit(&self) -> &'static str {
        "rad"
    }

    fn typical(&self) -> f64 {
        1e-3
    }

    fn suspects(&self, site: &Site<'_>) -> Vec<Suspect> {
        let rests = site.rows.data.rests.iter().enumerate();
        let places = rests.flat_map(|(k, rest)| rest.chunks.clone().skip(1).map(move |c| (k, c)));
        let one = |(k, chunk)| Suspect::new(&Self, chunk, columns(site, k, chunk));
        places.map(one).collect()
    }

    fn is_imitated_by_bias(&self) -> bool {
        true
    }

    fn is_over_with_interval(&self) -> bool {
        false
    }

    fn seen(&self, norm: f64, _span: Span, _gravity: f64, _seen: Seen) -> Seen {
        Seen::Slipped(norm)
    }
}

/// The columns of a rotation before chunk `chunk` of static interval `k`.
fn columns(site: &Site<'_>, k: usize, chunk: usize) -> Vec<Column> {
    let rows = site.rows;
    let u = rows.direction(site.x, k);
    let mut columns = vec![Column::default(); 3];
    for (axis, column) in columns.iter_mut().enumerate() {
        let moved = u.cross(&axis_vector(axis));
        for own in site.means(Sensor::Accelerometer, k) {
            if own.place >= chunk {
                (0..3).for_each(|i| column.set(own.row + i, -rows.gravity * moved[i]));
            }
        }
        site.set_carried(column, k, true, moved);
    }
    columns
}
