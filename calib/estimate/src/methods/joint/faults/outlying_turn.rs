//! A turn that misses the direction after it.

use findings::Kind;
use sensor::Sensor;

use super::fault::{Fault, Scope, Site, Suspect, unit_columns};

/// A turn that misses the direction after it, as lost or clipped samples make it: its two direction rows are open, rad.
#[derive(Clone, Copy, Debug)]
pub struct OutlyingTurn;

impl Fault for OutlyingTurn {
    fn kind(&self) -> Kind {
        Kind::TurnMissed
    }

    fn name(&self) -> &'static str {
        "outlying_turn"
    }

    fn scope(&self) -> Scope {
        Scope::Turn
    }

    fn sensor(&self) -> Sensor {
        Sensor::Gyroscope
    }

    fn unit(&self) -> &'static str {
        "rad"
    }

    fn typical(&self) -> f64 {
        1e-2
    }

    fn suspects(&self, site: &Site<'_>) -> Vec<Suspect> {
        let first = site.rows.first_turn_row();
        let turns = 0..site.rows.data.turns.len();
        let one = |k| Suspect::new(&Self, k, unit_columns(first + 2 * k, 2));
        turns.map(one).collect()
    }
}
