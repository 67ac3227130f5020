//! The rows of the study.

mod clocks;
mod condition;
mod devices;
mod faults;
mod motions;
mod noises;

pub use condition::{Bound, Condition};

/// All rows.
pub static CONDITIONS: &[&[Condition]] = &[
    devices::ROWS,
    clocks::ROWS,
    noises::ROWS,
    motions::ROWS,
    faults::ROWS,
];

/// The row of this name.
pub fn condition(name: &str) -> Option<&'static Condition> {
    CONDITIONS
        .iter()
        .copied()
        .flatten()
        .find(|c| c.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_row_can_be_simulated_and_has_a_name_of_its_own() {
        let all: Vec<&Condition> = CONDITIONS.iter().copied().flatten().collect();
        for (k, condition) in all.iter().enumerate() {
            let first = all.iter().position(|c| c.name == condition.name);
            assert_eq!(first, Some(k), "{}", condition.name);
            if let Err(error) = calib::simulate::Simulation::new(&condition.spec(3)) {
                panic!("{}: {error}", condition.name);
            }
        }
    }
}
