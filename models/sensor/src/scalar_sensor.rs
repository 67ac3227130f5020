//! A sensor of one dimension: what it is called, what it measures, and what it reads.

use std::fmt;
use std::ops::Deref;
use std::sync::Arc;

use solver::scalar::{derivatives, variable};
use solver::{Jet, Scalar, lit};

use crate::kinematics::Kinematics;
use crate::param::Param;
use crate::quantity::Quantity;

/// Steps at most to the signal behind a reading: a reading that goes evenly with the signal takes one.
const MOST_STEPS: usize = 50;

/// The signal is found when a step changes it by less than this share of itself or of the reading.
const FOUND: f64 = 1e-14;

/// A sensor with one reading at an instant, such as a barometer: `raw = h(signal, truth, p)`.
///
/// One type in any crate: its descriptor in constants, and what it reads. It is calibrated on means over static intervals where the true
/// signal is known, beside the accelerometer and the gyroscope, which say how the device lay.
///
/// # Examples
/// ```
/// use solver::Scalar;
/// use stillpoint_sensor::{Kinematics, Param, ScalarSensor, params};
///
/// /// A barometer whose zero goes with the force along z: `P = p + b + k f_z`.
/// struct Barometer;
///
/// impl ScalarSensor for Barometer {
///     const NAME: &'static str = "barometer";
///     const UNIT: &'static str = "Pa";
///     const EQUATION: &'static str = "P = p + b + k f_z";
///     const PARAMS: &'static [Param] = &[Param::new("b", "Pa", 0.0), Param::new("k", "Pa/(m/s²)", 0.0)];
///
///     fn reading<D: Scalar>(&self, signal: D, truth: &Kinematics<f64>, p: &[D]) -> D {
///         signal + p[0] + p[1] * truth.specific_force.z
///     }
/// }
///
/// let truth = Kinematics::at_rest(nalgebra::Vector3::new(0.0, 0.0, 10.0));
/// assert_eq!(Barometer.reading(101_300.0, &truth, &[50.0, 0.5]), 101_355.0);
/// ```
pub trait ScalarSensor: Send + Sync + 'static {
    /// Unique name in snake case; the readings in a recording have it too.
    const NAME: &'static str;
    /// Unit of the true signal.
    const UNIT: &'static str;
    /// The equation as users read it.
    const EQUATION: &'static str;
    /// Names, units and nominal values.
    const PARAMS: &'static [Param];
    /// Quantities of the truth that the reading depends on; a recording in which one cannot be known is refused.
    const NEEDS: &'static [Quantity] = &[];

    /// The reading of a true `signal` at `truth`, for parameters `p` in the order of `PARAMS`. It goes up or down with the signal everywhere,
    /// also a little beyond the range, where noise takes it: a correction solves it for the signal.
    fn reading<D: Scalar>(&self, signal: D, truth: &Kinematics<f64>, p: &[D]) -> D;
}

/// A [`ScalarSensor`] behind a pointer; derived for every one.
pub trait AnyScalarSensor: Send + Sync {
    /// Unique name in snake case.
    fn name(&self) -> &str;
    /// Unit of the true signal.
    fn unit(&self) -> &str;
    /// The equation as users read it.
    fn equation(&self) -> &str;
    /// Names, units and nominal values.
    fn params(&self) -> &[Param];
    /// Quantities of the truth that the reading depends on.
    fn needs(&self) -> &[Quantity];
    /// [`ScalarSensor::reading`] with first derivatives.
    fn reading_jet(&self, signal: Jet, truth: &Kinematics<f64>, p: &[Jet]) -> Jet;
}

impl<S: ScalarSensor> AnyScalarSensor for S {
    fn name(&self) -> &str {
        S::NAME
    }
    fn unit(&self) -> &str {
        S::UNIT
    }
    fn equation(&self) -> &str {
        S::EQUATION
    }
    fn params(&self) -> &[Param] {
        S::PARAMS
    }
    fn needs(&self) -> &[Quantity] {
        S::NEEDS
    }
    fn reading_jet(&self, signal: Jet, truth: &Kinematics<f64>, p: &[Jet]) -> Jet {
        self.reading(signal, truth, p)
    }
}

/// A sensor of one dimension of one's own; cloning it shares it. Two are equal where their names are.
#[derive(Clone)]
pub struct ScalarSensorRef(Arc<dyn AnyScalarSensor>);

impl ScalarSensorRef {
    /// The signal behind a reading at `truth`: `h(signal, truth, p) = raw` by Newton's method from the reading itself; `None` where it is
    /// not found.
    ///
    /// # Examples
    /// ```
    /// use std::sync::Arc;
    /// use solver::Scalar;
    /// use stillpoint_sensor::{Kinematics, Param, ScalarSensor, ScalarSensorRef};
    ///
    /// /// `R = s v`.
    /// struct Speedometer;
    /// impl ScalarSensor for Speedometer {
    ///     const NAME: &'static str = "speedometer";
    ///     const UNIT: &'static str = "m/s";
    ///     const EQUATION: &'static str = "R = s v";
    ///     const PARAMS: &'static [Param] = &[Param::new("s", "", 1.0)];
    ///     fn reading<D: Scalar>(&self, signal: D, _: &Kinematics<f64>, p: &[D]) -> D {
    ///         signal * p[0]
    ///     }
    /// }
    ///
    /// let sensor = ScalarSensorRef::from(Arc::new(Speedometer) as Arc<_>);
    /// let still = Kinematics::at_rest(nalgebra::Vector3::zeros());
    /// assert_eq!(sensor.signal(3.0, &still, &[1.5]), Some(2.0));
    /// assert_eq!(sensor.signal(3.0, &still, &[0.0]), None); // it reads 0 of any speed
    /// ```
    pub fn signal(&self, raw: f64, truth: &Kinematics<f64>, p: &[f64]) -> Option<f64> {
        let p: Vec<Jet> = p.iter().map(|&value| lit(value)).collect();
        let mut signal = raw;
        for _ in 0..MOST_STEPS {
            let read = self.reading_jet(variable(signal, 0), truth, &p);
            let step = (raw - read.re) / derivatives(&read)[0];
            if !step.is_finite() {
                return None;
            }
            signal += step;
            if step.abs() <= FOUND * signal.abs().max(raw.abs()) {
                return Some(signal);
            }
        }
        None
    }
}

impl Deref for ScalarSensorRef {
    type Target = dyn AnyScalarSensor;

    fn deref(&self) -> &Self::Target {
        &*self.0
    }
}

impl From<Arc<dyn AnyScalarSensor>> for ScalarSensorRef {
    fn from(sensor: Arc<dyn AnyScalarSensor>) -> Self {
        Self(sensor)
    }
}

impl PartialEq for ScalarSensorRef {
    fn eq(&self, other: &Self) -> bool {
        self.name() == other.name()
    }
}

impl fmt::Debug for ScalarSensorRef {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
