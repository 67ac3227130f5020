//! A part of a static interval whose specific force is not gravity's.

use findings::Kind;
use sensor::Sensor;

use super::creep::creep_in_interval;
use super::fault::{Fault, Scope, Seen, Site, Suspect, unit_columns};
use crate::methods::joint::disturbance::shake::Shake;
use crate::methods::small_sample::LEAST_SPARE;

/// A part of a static interval whose specific force is not gravity's, as while a hand pushes: its mean is open, m/s².
pub static DISTURBED_INTERVAL: Fault = Fault {
    kind: Kind::DISTURBED_INTERVAL,
    name: "disturbed_interval",
    scope: Scope::Chunk,
    sensor: Sensor::Accelerometer,
    unit: "m/s^2",
    typical: 2e-2,
    is_rate: false,
    is_imitated_by_bias: false,
    opens_force: true,
    is_over_with_interval: true,
    suspects,
    seen: |norm, _, _, seen| match seen {
        Seen::Nothing => Seen::Off(norm),
        other => other,
    },
};

fn suspects(site: &Site<'_>) -> Vec<Suspect> {
    // Without placements to spare any of them, or a part of it, would make the others agree.
    if site.rows.spare_placements() <= LEAST_SPARE.get() {
        return Vec::new();
    }
    let means = site.rows.means(Sensor::Accelerometer);
    means.map(|own| pushed(own.place, own.row)).collect()
}

fn pushed(chunk: usize, row: usize) -> Suspect {
    Suspect::new(&DISTURBED_INTERVAL, chunk, unit_columns(row, 3))
}

/// A chunk that was seen to shake: any force, and a creep of its static interval.
pub(crate) fn shaken(site: &Site<'_>, (chunk, shake): (usize, &Shake)) -> Option<Suspect> {
    let mut means = site.rows.means(Sensor::Accelerometer);
    let mut suspect = pushed(chunk, means.find(|own| own.place == chunk)?.row);
    let creep = creep_in_interval(site, site.rows.data.chunks[chunk].rest);
    suspect.columns.extend(creep.columns);
    suspect.seen = Seen::Shaken {
        time: shake.time,
        ratio: shake.ratio,
    };
    Some(suspect)
}
