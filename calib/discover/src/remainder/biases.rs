//! Information of the data on the bias of each axis in every chunk of a static interval.

use estimate::methods::joint::{BiasNoise, Column, columns};
use faer::Mat;
use nalgebra::{DMatrix, DVector};
use sensor::Sensor;

use crate::noise::level::Level;
use crate::noise::projected_columns::ProjectedColumns;
use crate::state::State;

/// The chunks of a sensor.
pub(super) struct OfSensor {
    /// The sensor.
    pub sensor: Sensor,
    /// The recording and the time of every chunk, s.
    pub times: Vec<(usize, f64)>,
    /// The first row of every chunk, that of axis x.
    pub rows: Vec<usize>,
    /// The chunks of every recording, or of several that share noise.
    pub together: Vec<Vec<usize>>,
    /// Normal equations of the biases, for each axis at each setting of the densities.
    pub axes: [Vec<AtLevel>; 3],
}

/// One setting of the densities.
pub(super) struct AtLevel {
    /// The noise of the biases there.
    pub noise: BiasNoise,
    /// Its log-likelihood over that of the likeliest setting.
    pub gained: f64,
    /// Normal equations of the biases there.
    pub biases: Biases,
}

/// `BᵀB = diag(G_p) − Sᵀ S` and `Bᵀz`, `B` the whitened columns of the biases.
pub(super) struct Biases {
    /// Recording by recording.
    pub parts: Vec<Own>,
    /// Rows of `S`.
    pub shared: usize,
}

/// The chunks of one recording.
pub(super) struct Own {
    /// `G_p` (`n × n`).
    pub gram: Mat<f64>,
    /// Their part of `Bᵀ z` (`n × 1`).
    pub right: Mat<f64>,
    /// Their part of `S` (`s × n`): what recordings share.
    pub taken: Mat<f64>,
}

/// Computes the normal equations of the biases of every sensor with static means, at these settings of the densities.
pub(super) fn biases(state: &State, levels: &[Level]) -> Vec<OfSensor> {
    let sensors = [Sensor::Accelerometer, Sensor::Gyroscope].into_iter();
    sensors
        .filter_map(|sensor| of_sensor(state, levels, sensor))
        .collect()
}

fn of_sensor(state: &State, levels: &[Level], sensor: Sensor) -> Option<OfSensor> {
    let nothing = levels.first()?.whitened.log_likelihood();
    let means = state.sensitivities.means.iter();
    let means: Vec<_> = means.filter(|m| m.sensor == sensor).collect();
    if means.is_empty() {
        return None;
    }
    let data = &state.fit.data;
    let recording = |chunk: usize| data.rests[data.chunks[chunk].rest].recording;
    let projected = [0, 1, 2].map(|axis| {
        let biases = means.iter().map(|m| Column::unit(m.row + axis));
        let biases: Vec<Column> = biases.collect();
        let biases = state.sparse(&biases.iter().collect::<Vec<_>>());
        state.projected.by_recording(&biases)
    });
    let together = projected[0].parts().iter();
    let together = together.map(|part| part.columns.clone()).collect();
    let at = |level: &Level, axis: usize| {
        let seen = level.whitened.by_recording(projected[axis].clone());
        AtLevel {
            noise: level.noise,
            gained: level.whitened.log_likelihood() - nothing,
            biases: Biases::of(&seen, &level.whitened.z),
        }
    };
    let own = levels.iter().filter(|l| l.is_of(sensor));
    let own: Vec<&Level> = own.collect();
    Some(OfSensor {
        sensor,
        times: means
            .iter()
            .map(|m| (recording(m.chunk), m.truth.time))
            .collect(),
        rows: means.iter().map(|m| m.row).collect(),
        together,
        axes: [0, 1, 2].map(|axis| own.iter().map(|level| at(level, axis)).collect()),
    })
}

impl Biases {
    fn of(seen: &ProjectedColumns, z: &Mat<f64>) -> Self {
        let own = seen.inside.parts().iter().map(|part| {
            let first = part.rows.first().copied().unwrap_or(0);
            let z = z.as_ref().subrows(first, part.rows.len());
            Own {
                gram: part.values.transpose() * &part.values,
                right: part.values.transpose() * z,
                taken: columns(&seen.taken, &part.columns),
            }
        });
        Self {
            parts: own.collect(),
            shared: seen.taken.nrows(),
        }
    }

    /// `BᵀB` (`n × n`) and `Bᵀz` (`n`) over some of the recordings' chunks, `groups` the sums of them that are asked for: the group
    /// of every chunk of every part.
    pub fn normal(&self, groups: &[Vec<usize>], n: usize) -> (DMatrix<f64>, DVector<f64>) {
        let (mut gram, mut right) = (DMatrix::zeros(n, n), DVector::zeros(n));
        let mut taken = DMatrix::<f64>::zeros(self.shared, n);
        for (own, groups) in self.parts.iter().zip(groups) {
            for (i, &to) in groups.iter().enumerate() {
                right[to] += own.right[(i, 0)];
                for (k, &other) in groups.iter().enumerate() {
                    gram[(to, other)] += own.gram[(i, k)];
                }
                for s in 0..self.shared {
                    taken[(s, to)] += own.taken[(s, i)];
                }
            }
        }
        gram -= taken.transpose() * taken;
        (gram, right)
    }
}
