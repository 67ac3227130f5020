//! A turn that misses the direction after it.

use findings::Kind;
use sensor::Sensor;

use super::fault::{Fault, Scope, Site, Suspect, unit_columns};

/// A turn that misses the direction after it, as lost or clipped samples make it: its two direction rows are open, rad.
pub static OUTLYING_TURN: Fault = Fault {
    kind: Kind::TURN_MISSED,
    name: "outlying_turn",
    scope: Scope::Turn,
    sensor: Sensor::Gyroscope,
    unit: "rad",
    typical: 1e-2,
    is_rate: false,
    is_imitated_by_bias: false,
    opens_force: false,
    is_over_with_interval: false,
    suspects,
    seen: |_, _, _, seen| seen,
};

fn suspects(site: &Site<'_>) -> Vec<Suspect> {
    let turns = site.rows.turns().enumerate();
    let one = |(k, (row, _))| Suspect::new(&OUTLYING_TURN, k, unit_columns(row, 2));
    turns.map(one).collect()
}
