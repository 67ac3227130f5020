//! A device that moves at once between two parts of a static interval.

use findings::Kind;
use nalgebra::Vector3;
use sensor::Sensor;

use super::fault::{Fault, Scope, Seen, Site, Suspect};
use crate::methods::joint::blocks::column::Column;

/// A device that moves at once between two parts of a long static interval: a rotation by `δ` (rad, body frame) before one of its chunks,
/// `u` becomes `u + u × δ`. What comes after, the turn that begins there among it, sees the new direction.
pub static SUDDEN_SLIP: Fault = Fault {
    kind: Kind::MOUNT_SLIP,
    name: "mount_slip",
    scope: Scope::Chunk,
    sensor: Sensor::Accelerometer,
    unit: "rad",
    typical: 1e-3,
    is_rate: false,
    is_imitated_by_bias: true,
    opens_force: false,
    is_over_with_interval: false,
    suspects,
    seen: |norm, _, _, _| Seen::Slipped(norm),
};

fn suspects(site: &Site<'_>) -> Vec<Suspect> {
    let rests = site.rows.data.rests.iter().enumerate();
    let places = rests.flat_map(|(k, rest)| rest.chunks.clone().skip(1).map(move |c| (k, c)));
    let one = |(k, chunk)| Suspect::new(&SUDDEN_SLIP, chunk, columns(site, k, chunk));
    places.map(one).collect()
}

/// The columns of a rotation before chunk `chunk` of static interval `k`.
fn columns(site: &Site<'_>, k: usize, chunk: usize) -> Vec<Column> {
    let rows = site.rows;
    let u = rows.direction(site.x, k);
    let mut columns = vec![Column::default(); 3];
    for (axis, column) in columns.iter_mut().enumerate() {
        let moved = u.cross(&Vector3::ith(axis, 1.0));
        for own in site.means(Sensor::Accelerometer, k) {
            if own.place >= chunk {
                (0..3).for_each(|i| column.set(own.row + i, -rows.gravity * moved[i]));
            }
        }
        site.set_carried(column, k, true, moved);
    }
    columns
}
