//! Use of the temperature: in all recordings, or in none where one lacks it.

use sensor::Kinematics;

use super::Data;
use crate::truth::unneeded;

impl Data {
    /// The recordings without a temperature, where others have one: effects of the temperature would have to suppose theirs.
    pub fn without_thermometer(&self) -> Vec<&str> {
        let all = self.sources.iter();
        let without: Vec<&str> = all
            .filter(|source| !source.has_thermometer)
            .map(|source| source.name.as_str())
            .collect();
        if without.len() < self.sources.len() {
            without
        } else {
            Vec::new()
        }
    }

    /// Takes the temperature for unknown in all recordings, where it is in some.
    pub(in crate::methods::joint) fn forget_what_some_know(&mut self) {
        if self.without_thermometer().is_empty() {
            return;
        }
        for chunk in &mut self.chunks {
            (chunk.temperature, chunk.thermal) = (None, [0.0; 2]);
        }
        let rests = self.rests.iter_mut().map(|rest| &mut rest.known);
        let turns = self.turns.iter_mut().flat_map(|turn| &mut turn.known);
        rests.chain(turns).for_each(forget);
    }
}

fn forget(known: &mut Kinematics<f64>) {
    let unknown = unneeded();
    known.temperature = unknown.temperature;
    known.temperature_rate = unknown.temperature_rate;
    known.warming = unknown.warming;
}
