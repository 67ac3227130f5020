//! Places of the parameters among the columns.

use sensor::Sensor;
use solver::Parameters;

use crate::methods::joint::data::Data;

/// Place of the bias among the parameters of a model.
const BIAS: std::ops::Range<usize> = 9..12;

/// The columns: accelerometer's model, gyroscope's model, own biases of all recordings but the last,
/// then two coordinates for the direction of every rest, what depends on the heading in every stretch with one of its own but the
/// first, then disturbances.
///
/// All recordings share scale factors, misalignments and effects; each has its own bias of the
/// gyroscope, and of the accelerometer where the data refute a common one.
#[derive(Clone, Debug)]
pub struct Layout {
    /// Number of parameters of the accelerometer's model.
    pub accelerometer: usize,
    /// Number of parameters of the gyroscope's model; 0 without one.
    pub gyroscope: usize,
    /// True if the accelerometer has a bias of its own in every recording; the gyroscope always has.
    pub own_force_bias: bool,
    /// Number of recordings.
    pub recordings: usize,
    /// Number of rests.
    pub rests: usize,
    /// Places of the parameters that depend on the heading in the models of accelerometer and gyroscope.
    pub of_heading: [Vec<usize>; 2],
    /// Number of stretches through which the heading can be followed.
    pub headings: usize,
    /// Number of disturbance parameters.
    pub disturbances: usize,
}

impl Layout {
    /// Parameters of the models and biases: everything but directions and disturbances.
    pub fn shared(&self) -> usize {
        self.models() + self.own_biases() * (self.recordings.max(1) - 1)
    }

    /// All of them.
    pub fn count(&self) -> usize {
        self.disturbance(0) + self.disturbances
    }

    /// First coordinate of the direction of a rest.
    pub fn direction(&self, rest: usize) -> usize {
        self.shared() + 2 * rest
    }

    /// Parameters that depend on the heading, of both sensors.
    fn by_heading(&self) -> usize {
        self.of_heading.iter().map(Vec::len).sum()
    }

    /// A disturbance parameter.
    pub fn disturbance(&self, k: usize) -> usize {
        self.direction(self.rests) + self.by_heading() * (self.headings.max(1) - 1) + k
    }

    fn models(&self) -> usize {
        self.accelerometer + self.gyroscope
    }

    /// Own biases per recording.
    fn own_biases(&self) -> usize {
        self.own_force() + if self.gyroscope > 0 { 3 } else { 0 }
    }

    fn own_force(&self) -> usize {
        if self.own_force_bias { 3 } else { 0 }
    }

    /// Columns of a model's parameters for a stretch of one recording, in the model's order.
    pub fn columns(&self, sensor: Sensor, (recording, heading): (usize, usize)) -> Vec<usize> {
        let (first, count, own) = match sensor {
            Sensor::Accelerometer => (0, self.accelerometer, self.own_force_bias.then_some(0)),
            Sensor::Gyroscope | Sensor::Magnetometer => {
                (self.accelerometer, self.gyroscope, Some(self.own_force()))
            }
        };
        let mut columns: Vec<usize> = (first..first + count).collect();
        if let Some(own) = own.filter(|_| recording + 1 < self.recordings && count > 0) {
            let from = self.models() + self.own_biases() * recording + own;
            for (k, place) in BIAS.enumerate() {
                columns[place] = from + k;
            }
        }
        if heading > 0 {
            let [of_force, of_rate] = &self.of_heading;
            let (own, before) = match sensor {
                Sensor::Accelerometer => (of_force, 0),
                Sensor::Gyroscope | Sensor::Magnetometer => (of_rate, of_force.len()),
            };
            let from = self.direction(self.rests) + self.by_heading() * (heading - 1) + before;
            for (k, &place) in own.iter().enumerate() {
                columns[place] = from + k;
            }
        }
        columns
    }

    /// The parameters with their names, all directions at the reference of their chart.
    pub fn parameters(
        &self,
        accelerometer: &Parameters,
        gyroscope: Option<&Parameters>,
        data: &Data,
    ) -> Parameters {
        let mut all = accelerometer.clone();
        let models = [self.own_force_bias.then_some(accelerometer), gyroscope];
        if let Some(model) = gyroscope {
            for (k, name) in model.names().iter().enumerate() {
                all.push(name.clone(), model.units()[k].clone(), model.values()[k]);
            }
        }
        for source in data.sources.iter().take(self.recordings.max(1) - 1) {
            for model in models.into_iter().flatten() {
                for k in BIAS {
                    let name = format!("{}[{}]", model.names()[k], source.name);
                    all.push(name, model.units()[k].clone(), model.values()[k]);
                }
            }
        }
        for rest in 0..self.rests {
            for axis in ["a", "b"] {
                all.push(format!("direction[{}].{axis}", rest + 1), "rad", 0.0);
            }
        }
        for heading in 1..self.headings {
            let models = [Some(accelerometer), gyroscope].into_iter();
            for (model, own) in models.zip(&self.of_heading) {
                let Some(model) = model else { continue };
                for &k in own {
                    let name = format!("{}[heading {}]", model.names()[k], heading + 1);
                    all.push(name, model.units()[k].clone(), model.values()[k]);
                }
            }
        }
        for k in 0..self.disturbances {
            all.push(format!("disturbance[{}]", k + 1), "", 0.0);
        }
        all
    }
}
