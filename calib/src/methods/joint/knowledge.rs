//! What effects ask for beyond the two signals, worked out from the recordings.

use nalgebra::Vector3;
use sensor::attitude::Attitude;
use sensor::{Kinematics, Model, Sensor};

use super::data::{Cut, Data};
use super::problem::Rows;
use super::turn::MARGIN;
use crate::covariates::{last_changes, slope_at, vibrations};
use crate::intervals::Moments;
use crate::methods::known_of;
use crate::recording::Stream;

/// Time, temperature, history and vibration of every rest.
pub fn known_at_rests(cut: &Cut<'_>) -> Vec<Kinematics<f64>> {
    let statics = &cut.segmentation.statics;
    let moments: Vec<Option<Moments>> = statics.iter().map(|rest| rest.accelerometer).collect();
    let of = |f: &dyn Fn(&Moments) -> Vector3<f64>, missing: f64| -> Vec<Vector3<f64>> {
        let value = |m: &Option<Moments>| m.as_ref().map_or(Vector3::repeat(missing), f);
        moments.iter().map(value).collect()
    };
    let scale = cut.force_unit.scale.powi(2);
    let changes = last_changes(&of(&|m| cut.force_unit.to_si(&m.mean), 0.0));
    let shaking = vibrations(&of(&|m| m.covariance.diagonal() * scale, f64::INFINITY));
    statics
        .iter()
        .zip(changes.into_iter().zip(shaking))
        .map(|(rest, (last_change, vibration))| Kinematics {
            last_change,
            vibration: vibration.map(|v| if v.is_finite() { v } else { 0.0 }),
            ..known_of(cut.recording, rest, Vector3::zeros())
        })
        .collect()
}

impl Data {
    /// Fills in what effects of the gyroscope ask for at the samples of the turns: time and temperature, the
    /// specific force by `force` (raw reading near SI units and what else is known to m/s²), how both
    /// signals change, the history of the rest before.
    pub fn know_turns(&mut self, recording: usize, cut: &Cut<'_>, force: &Model, p: &[f64]) {
        let start = cut.recording.start();
        let accelerometer = cut.recording.accelerometer.as_ref();
        for turn in self.turns.iter_mut().filter(|t| t.recording == recording) {
            let before = self.rests[turn.from].known;
            turn.known = turn
                .t
                .iter()
                .enumerate()
                .map(|(k, &t)| {
                    let mut known = Kinematics {
                        time: t - start,
                        last_change: before.last_change,
                        angular_acceleration: slope_at(&turn.t, &turn.readings, k),
                        ..Kinematics::at_rest(Vector3::zeros())
                    };
                    let celsius = cut.recording.temperature.as_ref();
                    known.temperature = celsius.and_then(|c| c.at(t)).unwrap_or(known.temperature);
                    if let Some((raw, slope)) = accelerometer.and_then(|s| moving(s, t)) {
                        known.specific_force_rate = slope * cut.force_unit.scale;
                        let raw = cut.force_unit.to_si(&raw);
                        known.specific_force = force.correct(&raw, &known, p);
                    }
                    known
                })
                .collect();
        }
    }
}

/// Reading and slope at `t`.
fn moving(stream: &Stream, t: f64) -> Option<(Vector3<f64>, Vector3<f64>)> {
    let near = stream
        .t
        .partition_point(|&s| s < t)
        .min(stream.len().checked_sub(1)?);
    let range = near.saturating_sub(2)..(near + 3).min(stream.len());
    let slope = slope_at(
        &stream.t[range.clone()],
        &stream.values[range.clone()],
        near - range.start,
    );
    Some((stream.at(t)?, slope))
}

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
        let p = self.local(x, Sensor::Gyroscope, samples.recording);
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

impl Data {
    /// Writes the attitudes down where effects look for them.
    pub fn know_attitudes(&mut self, attitudes: &Attitudes) {
        for (rest, attitude) in self.rests.iter_mut().zip(&attitudes.rests) {
            rest.known.attitude = *attitude;
        }
        for (turn, path) in self.turns.iter_mut().zip(&attitudes.turns) {
            for (known, attitude) in turn.known.iter_mut().zip(path) {
                known.attitude = *attitude;
            }
        }
    }
}

/// The attitude nearest to `attitude` in which `up` (body frame) points up.
fn levelled(attitude: &Attitude<f64>, up: &Vector3<f64>) -> Attitude<f64> {
    let seen = attitude.into_reference(up);
    shortest(&seen).then(attitude).normalized()
}

/// The rotation about a horizontal axis that carries the unit vector `from` to `z`.
fn shortest(from: &Vector3<f64>) -> Attitude<f64> {
    let axis = from.cross(&Vector3::z());
    let w = 1.0 + from.z;
    if w < 1e-9 {
        return Attitude::exp(&(Vector3::x() * std::f64::consts::PI));
    }
    Attitude { w, v: axis }.normalized()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levelling_keeps_a_level_attitude_and_rights_a_tilted_one() {
        let heading = Attitude::exp(&Vector3::new(0.0, 0.0, 1.2));
        let same = levelled(&heading, &Vector3::z());
        let forward = |a: &Attitude<f64>| a.into_reference(&Vector3::x());
        assert!((forward(&same) - forward(&heading)).norm() < 1e-14);
        let up = Vector3::new(0.6, 0.0, -0.8);
        let righted = levelled(&heading, &up);
        assert!((righted.into_reference(&up) - Vector3::z()).norm() < 1e-14);
    }
}
