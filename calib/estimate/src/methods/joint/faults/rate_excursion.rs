//! A static interval whose mean rate is off.

use findings::Kind;
use sensor::Sensor;

use super::fault::{Fault, Scope, Site, Suspect};
use crate::methods::joint::blocks::column::Column;

/// A static interval whose mean rate is off and that of its neighbours is not: the rate is open, rad/s.
pub static RATE_EXCURSION: Fault = Fault {
    kind: Kind::RATE_EXCURSION,
    name: "disturbed_interval",
    scope: Scope::StaticInterval,
    sensor: Sensor::Gyroscope,
    unit: "rad/s",
    typical: 2e-4,
    is_rate: false,
    is_imitated_by_bias: true,
    opens_force: false,
    is_over_with_interval: true,
    suspects,
    seen: |_, _, _, seen| seen,
};

fn suspects(site: &Site<'_>) -> Vec<Suspect> {
    let one = |k: usize| {
        let mut columns = vec![Column::default(); 3];
        for own in site.means(Sensor::Gyroscope, k) {
            for (axis, column) in columns.iter_mut().enumerate() {
                column.set(own.row + axis, -1.0);
            }
        }
        Suspect::new(&RATE_EXCURSION, k, columns)
    };
    (0..site.rows.data.rests.len()).map(one).collect()
}
