//! A part of a static interval whose specific force is not gravity's.

use findings::Kind;
use recording::intervals::Span;
use sensor::Sensor;

use super::creep::Creep;
use super::fault::{Fault, Scope, Seen, Site, Suspect, unit_columns};
use crate::methods::joint::disturbance::shake::Shake;
use crate::methods::small_sample::LEAST_SPARE;

/// A part of a static interval whose specific force is not gravity's, as while a hand pushes: its mean is open, m/s².
#[derive(Clone, Copy, Debug)]
pub struct DisturbedInterval;

impl Fault for DisturbedInterval {
    fn kind(&self) -> Kind {
        Kind::DisturbedInterval
    }

    fn name(&self) -> &'static str {
        "disturbed_interval"
    }

    fn scope(&self) -> Scope {
        Scope::Chunk
    }

    fn sensor(&self) -> Sensor {
        Sensor::Accelerometer
    }

    fn unit(&self) -> &'static str {
        "m/s^2"
    }

    fn typical(&self) -> f64 {
        2e-2
    }

    fn suspects(&self, site: &Site<'_>) -> Vec<Suspect> {
        // Without placements to spare any of them, or a part of it, would make the others agree.
        if site.rows.spare_placements() <= LEAST_SPARE {
            return Vec::new();
        }
        let means = site.rows.means(Sensor::Accelerometer);
        means.map(|own| pushed(own.place, own.row)).collect()
    }

    fn opens_force(&self) -> bool {
        true
    }

    fn seen(&self, norm: f64, _span: Span, _gravity: f64, seen: Seen) -> Seen {
        match seen {
            Seen::Nothing => Seen::Off(norm),
            other => other,
        }
    }
}

fn pushed(chunk: usize, row: usize) -> Suspect {
    Suspect::new(&DisturbedInterval, chunk, unit_columns(row, 3))
}

/// A chunk that was seen to shake: any force, and a creep of its static interval.
pub(crate) fn shaken(site: &Site<'_>, (chunk, shake): (usize, &Shake)) -> Option<Suspect> {
    let mut means = site.rows.means(Sensor::Accelerometer);
    let mut suspect = pushed(chunk, means.find(|own| own.place == chunk)?.row);
    let creep = Creep::in_interval(site, site.rows.data.chunks[chunk].rest);
    suspect.columns.extend(creep.columns);
    suspect.seen = Seen::Shaken {
        time: shake.time,
        ratio: shake.ratio,
    };
    Some(suspect)
}
