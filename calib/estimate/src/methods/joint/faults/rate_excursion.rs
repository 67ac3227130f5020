//! A static interval whose mean rate is off.

use findings::Kind;
use sensor::Sensor;

use super::fault::{Fault, Scope, Site, Suspect};
use crate::methods::joint::blocks::column::Column;

/// A static interval whose mean rate is off and that of its neighbours is not: the rate is open, rad/s.
#[derive(Clone, Copy, Debug)]
pub struct RateExcursion;

impl Fault for RateExcursion {
    fn kind(&self) -> Kind {
        Kind::RateExcursion
    }

    fn name(&self) -> &'static str {
        "disturbed_interval"
    }

    fn scope(&self) -> Scope {
        Scope::StaticInterval
    }

    fn sensor(&self) -> Sensor {
        Sensor::Gyroscope
    }

    fn unit(&self) -> &'static str {
        "rad/s"
    }

    fn typical(&self) -> f64 {
        2e-4
    }

    fn suspects(&self, site: &Site<'_>) -> Vec<Suspect> {
        let one = |k: usize| {
            let mut columns = vec![Column::default(); 3];
            for own in site.means(Sensor::Gyroscope, k) {
                for (axis, column) in columns.iter_mut().enumerate() {
                    column.set(own.row + axis, -1.0);
                }
            }
            Suspect::new(&Self, k, columns)
        };
        (0..site.rows.data.rests.len()).map(one).collect()
    }

    fn is_imitated_by_bias(&self) -> bool {
        true
    }
}
