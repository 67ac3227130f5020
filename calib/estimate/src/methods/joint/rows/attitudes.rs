//! Attitudes at a fit: what the earth's rotation does to the rows.

use sensor::Sensor;
use sensor::attitude::Attitude;

use super::turn::MARGIN;
use crate::methods::joint::rows::Rows;
use crate::truth::levelled;

/// Attitudes (body to a level frame, `z` up) of the rests and of the samples of the turns.
#[derive(Clone, Debug)]
pub struct Attitudes {
    rests: Vec<Attitude<f64>>,
    turns: Vec<Vec<Attitude<f64>>>,
}

impl Attitudes {
    /// In a rest.
    pub fn at_rest(&self, rest: usize) -> &Attitude<f64> {
        &self.rests[rest]
    }

    /// At the samples of a turn.
    pub fn in_turn(&self, turn: usize) -> &[Attitude<f64>] {
        &self.turns[turn]
    }
}

impl Rows<'_> {
    /// The chain of attitudes at `x`: level at every rest by its direction, heading carried through the turns
    /// by the corrected rate. The heading of the first rest of a recording is zero; over a turn that is not
    /// usable the device is taken to turn the shortest way.
    pub fn attitudes(&self, x: &[f64]) -> Attitudes {
        let mut rests: Vec<Attitude<f64>> = Vec::with_capacity(self.data.rests.len());
        let mut turns = vec![Vec::new(); self.data.turns.len()];
        for (k, rest) in self.data.rests.iter().enumerate() {
            let up = self.direction(x, k);
            let before = rests.last().copied();
            let from = k
                .checked_sub(1)
                .filter(|&j| self.data.rests[j].recording == rest.recording);
            let carried = match (before, from) {
                (Some(before), Some(from)) => {
                    let turn = self.data.turns.iter().position(|t| t.from == from);
                    match turn {
                        Some(turn) => {
                            let (path, end) = self.path(x, turn, before);
                            turns[turn] = path;
                            end
                        }
                        None => before,
                    }
                }
                _ => Attitude::identity(),
            };
            rests.push(levelled(&carried, &up));
        }
        Attitudes { rests, turns }
    }

    /// The attitudes at the middles of the samples of a turn, and at its end.
    fn path(
        &self,
        x: &[f64],
        turn: usize,
        before: Attitude<f64>,
    ) -> (Vec<Attitude<f64>>, Attitude<f64>) {
        let samples = &self.data.turns[turn];
        let p = self.local(x, Sensor::Gyroscope, samples.from);
        let rates = self.rates(samples, &p);
        let count = rates.len();
        let mut attitude = before;
        let mut path = Vec::with_capacity(count);
        for (k, (rate, length)) in rates.iter().zip(&samples.lengths).enumerate() {
            if k < MARGIN || k + MARGIN >= count {
                path.push(attitude);
                continue;
            }
            let half = Attitude::exp(&(rate * (0.5 * length)));
            let middle = attitude.then(&half);
            path.push(middle);
            attitude = middle.then(&half).normalized();
        }
        (path, attitude)
    }
}
