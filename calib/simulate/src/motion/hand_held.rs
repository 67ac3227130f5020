//! A hand-held calibration session: many placements in mixed order.

use serde::{Deserialize, Serialize};

use super::orientation::{Orientation, lattice};
use super::path::Path;
use super::placements::{Placement, Surroundings, path_through};
use super::turn::Hand;
use crate::random::{Purpose, Random};

/// A long rest, then placements of a few seconds with turns by hand between them.
///
/// Faces, edges, corners and random orientations in mixed order; the last placement repeats the first.
/// What is `None` is drawn at random from the range named.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "snake_case")]
pub struct HandHeld {
    /// Number of placements; 26 to 40.
    pub placements: Option<usize>,
    /// Length of the first, s; 50 to 120.
    pub initial_rest: Option<f64>,
    /// Shortest and longest of the others, s.
    pub rest: [f64; 2],
    /// Shortest and longest turn, s.
    pub turn: [f64; 2],
    /// Deviation of a placement from its face, edge or corner, rad (standard deviation per axis).
    pub scatter: f64,
    /// Height by which the hand lifts the device, m.
    pub lift: f64,
    /// Tremor of the hand: 1 is 0.3 m/s² and 0.1 rad/s at 6 to 10 Hz.
    pub tremor: f64,
    /// Peak acceleration when the device touches the table, m/s²; 0 for none.
    pub shock: f64,
    /// Short knocks in each turn, the last at touch-down: they turn the device by nothing in the end, and
    /// a sensor without a filter cannot follow them.
    pub knocks: usize,
    /// Peak angular rate of a knock, rad/s; half to one and a half of it.
    pub knock_rate: f64,
    /// Only orientations whose up direction lies in one plane of the body: such a session does not
    /// determine all parameters.
    pub coplanar: bool,
}

impl Default for HandHeld {
    fn default() -> Self {
        Self {
            placements: None,
            initial_rest: None,
            rest: [6.0, 8.0],
            turn: [2.0, 4.0],
            scatter: 0.05,
            lift: 0.12,
            tremor: 1.0,
            shock: 0.0,
            knocks: 0,
            knock_rate: 2.0,
            coplanar: false,
        }
    }
}

impl HandHeld {
    pub(crate) fn path(&self, around: &Surroundings) -> Path {
        let mut random = Random::new(around.seed, Purpose::Motion);
        let count = self.placements.unwrap_or(26 + random.below(15));
        let first_rest = self.initial_rest.unwrap_or(random.uniform(50.0..120.0));
        let placements: Vec<Placement> = self
            .orientations(count, &mut random)
            .into_iter()
            .enumerate()
            .map(|(k, orientation)| Placement {
                attitude: orientation.attitude(self.scatter, &mut random),
                label: orientation.label,
                rest: match k {
                    0 => first_rest,
                    _ => random.uniform(self.rest[0]..self.rest[1]),
                },
                turn: random.uniform(self.turn[0]..self.turn[1]),
            })
            .collect();
        let hand = Hand {
            lift: self.lift,
            tremor: self.tremor,
            shock: self.shock,
            knocks: self.knocks,
            knock_rate: self.knock_rate,
        };
        path_through(&placements, &hand, around, &mut random)
    }

    /// All faces, then edges, corners and random directions as far as they go, shuffled; the first
    /// again at the end.
    fn orientations(&self, count: usize, random: &mut Random) -> Vec<Orientation> {
        let mut chosen = lattice(1);
        let mut others: Vec<_> = [lattice(2), lattice(3)].concat();
        let without_name = (count / 6).max((count + 1).saturating_sub(27));
        others.extend((0..without_name).map(|_| Orientation::random(random)));
        if self.coplanar {
            chosen.retain(|o| o.up.z == 0.0);
            others = (0..count).map(|_| Orientation::in_plane(random)).collect();
        }
        random.shuffle(&mut others);
        chosen.extend(others);
        chosen.truncate(count.saturating_sub(1));
        random.shuffle(&mut chosen);
        chosen.extend(chosen.first().cloned());
        chosen
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn orientations(placements: usize) -> Vec<Orientation> {
        HandHeld::default().orientations(placements, &mut Random::new(3, Purpose::Motion))
    }

    #[test]
    fn the_first_orientation_comes_back_at_the_end_and_all_faces_occur() {
        for count in [26, 33, 40] {
            let all = orientations(count);
            assert_eq!(all.len(), count);
            assert_eq!(all[0].label, all[count - 1].label);
            let faces = all[1..]
                .iter()
                .filter(|o| o.label.starts_with("face"))
                .count();
            assert_eq!(faces, 6);
        }
    }
}
