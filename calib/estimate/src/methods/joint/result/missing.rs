//! An effect that the rows speak for, by a score test.

use effects::catalogue_of;
use faer::{ColRef, Mat};
use nalgebra::Vector3;
use recording::Recording;
use sensor::{EffectRef, Kinematics, Quantity, Role, Sensor};

use crate::methods::chance;
use crate::methods::joint::blocks::basis::Basis;
use crate::methods::joint::blocks::columns::Columns;
use crate::methods::joint::fit::JointFit;
use crate::methods::joint::noise::weights::Whitening;
use crate::methods::joint::result::marginal::orthonormal;
use crate::methods::joint::rows::error_columns::effect_columns;
use crate::methods::joint::rows::sensitivity::{Sensitivities, TurnSensitivity};

/// An effect that the model lacks.
#[derive(Clone, Debug)]
pub struct Missing {
    /// The likeliest of those tried.
    pub effect: EffectRef,
    /// `|P_E r|²`: what its columns explain of the whitened residual beside the model's parameters.
    pub statistic: f64,
    /// Degrees of freedom.
    pub dof: usize,
    /// Probability that any of those tried explains so much where nothing is missing.
    pub p_value: f64,
    /// What the model leaves of the whitened residuals beyond their noise: `|r|²` less its degrees of freedom.
    pub excess: f64,
}

findings::tuning! {
    /// An effect is what is missing where it explains more than this share of the excess.
    MOST: f64 = 0.6;

    /// Components of readings at rest, at most, of which the scatter by itself is looked at: it takes the cube of their number.
    MOST_READINGS: usize = 400;
}

impl Missing {
    /// Returns true if the effect explains most of what the model leaves; otherwise something else is missing.
    pub fn explains_most(&self) -> bool {
        self.statistic - self.dof as f64 > MOST.get() * self.excess
    }
}

/// Evidence of the rows on an error: `e` is what the parameters leave of its column, and `r` the residual, both whitened.
#[derive(Clone, Copy, Debug, Default)]
pub struct Evidence {
    /// `eᵀr`.
    pub product: f64,
    /// `eᵀe`.
    pub square: f64,
    /// `|P r|²`, `P` onto all that errors of the accelerometer at rest could be, and its degrees of freedom; of many intervals `|r|²`.
    pub all: (f64, usize),
}

impl Evidence {
    /// The multiple of the error that the rows ask for.
    pub fn factor(&self) -> f64 {
        match self.square > 0.0 {
            true => -self.product / self.square,
            false => 0.0,
        }
    }

    /// The variance of that by what the multiple leaves of all that such errors could be: whatever the noise is, the error is not in it. With its
    /// degrees of freedom; `None` where the rows say nothing.
    pub fn variance(&self) -> Option<(f64, f64)> {
        let spare = self.all.1.checked_sub(1)? as f64;
        let left = self.all.0 - 2.0 * self.most();
        (self.square > 0.0 && spare > 0.0 && left > 0.0)
            .then(|| (left / spare / self.square, spare))
    }

    /// The log-likelihood that the error gains over none: `−eᵀr − ½eᵀe`.
    pub fn gain(&self) -> f64 {
        -self.product - 0.5 * self.square
    }

    /// The most that a multiple of it gains: `½(eᵀr)²/eᵀe`.
    pub fn most(&self) -> f64 {
        -0.5 * self.product * self.factor()
    }
}

impl JointFit {
    /// The effect for which all rows together speak most: of those that the model lacks and that go by the sensor's own signal or the
    /// motion, alone or with time or temperature. What goes by time alone is a bias that walks. Against the noise that was measured, walks of the biases
    /// among it; `recordings` are those of the fit.
    ///
    /// A score test (Rao 1948) needs no fit with the effect: `r` whitened residual, `J` its Jacobian, `E = ∂r/∂c` at `c = 0`;
    /// under the model `|P r|²`, `P` onto what `J` leaves of `E`, is `χ²` of the rank of that. It looks at the turns too, which
    /// see most of what changes a direction and not a norm. Errors of the accelerometer show at rest: for them turns scatter as
    /// they do, for what spoils the turns is none of theirs.
    pub fn missing(&self, recordings: &[&Recording]) -> Option<Missing> {
        let own = |effect: &EffectRef| {
            let mut own = self.models.iter().flat_map(|model| model.effects());
            own.any(|other| other.name() == effect.name())
        };
        let is_told = recordings.iter().all(|r| r.temperature.is_some());
        let all = catalogue_of(Sensor::Accelerometer).chain(catalogue_of(Sensor::Gyroscope));
        let is_tried = |effect: &EffectRef| goes_by_motion(effect, is_told) && !own(effect);
        let tried: Vec<_> = all.filter(is_tried).collect();
        let by_noise = Beside::of(self, self.noise_whitening());
        let by_scatter = Beside::of(self, self.noise_whitening_with_scatter());
        let rows = self.white_residuals.len();
        let sensitivities = self.sensitivities_with_covariates(recordings);
        let found = tried.iter().filter_map(|effect| {
            let p: Vec<f64> = effect.params().iter().map(|p| p.nominal).collect();
            let wanted: Vec<usize> = (0..p.len()).collect();
            let columns = effect_columns(&sensitivities, rows, effect, &p, &wanted);
            let beside = match effect.sensor() {
                Sensor::Accelerometer => &by_scatter,
                _ => &by_noise,
            };
            let (statistic, dof, is_negative) = beside.score(columns);
            (dof > 0 && !(effect.is_positive() && is_negative)).then(|| Missing {
                effect: effect.clone(),
                statistic,
                dof,
                p_value: (chance::of_chi2(statistic, dof as f64) * tried.len() as f64).min(1.0),
                excess: beside.excess(),
            })
        });
        found.min_by(|a, b| a.p_value.total_cmp(&b.p_value))
    }

    /// Returns true if an error of the accelerometer that the catalogue knows gains more than this log-likelihood.
    pub(crate) fn lacks_what_gains_more(&self, recordings: &[&Recording], gain: f64) -> bool {
        self.missing(recordings).is_some_and(|rival| {
            rival.effect.sensor() == Sensor::Accelerometer && 0.5 * rival.statistic > gain
        })
    }

    /// Evidence of the rows on errors of the accelerometer at rest, each by its column of the rows (`m × k`); where they misfit, they scatter as
    /// they do.
    pub(crate) fn evidence_for(&self, columns: Mat<f64>) -> Vec<Evidence> {
        let beside = Beside::of(self, self.noise_whitening_with_scatter());
        let all = match self.columns_of_rests() {
            Some(columns) => {
                let (square, dof, _) = beside.score(columns);
                (square, dof)
            }
            None => beside.all(),
        };
        let left = beside.left(columns);
        let residuals = ColRef::from_slice(&beside.residuals);
        let of = |k: usize| Evidence {
            product: left.col(k).transpose() * residuals,
            square: left.col(k).squared_norm_l2(),
            all,
        };
        (0..left.ncols()).map(of).collect()
    }

    /// A column of the rows for every reading of the accelerometer at rest; `None` of so many that all rows together tell their noise.
    fn columns_of_rests(&self) -> Option<Mat<f64>> {
        let means = self.sensitivities().means.into_iter();
        let own = means.filter(|own| own.sensor == Sensor::Accelerometer);
        let rows: Vec<usize> = own.flat_map(|own| own.row..own.row + 3).collect();
        if rows.len() > MOST_READINGS.get() {
            return None;
        }
        let mut columns = Mat::zeros(self.residuals.len(), rows.len());
        for (k, row) in rows.into_iter().enumerate() {
            columns[(row, k)] = 1.0;
        }
        Some(columns)
    }

    /// The sensitivities with the time and the temperature of every mean and sample, and the motion through every turn.
    fn sensitivities_with_covariates(&self, recordings: &[&Recording]) -> Sensitivities {
        let mut all = self.sensitivities();
        let set = |truth: &mut Kinematics<f64>, recording: usize, t: f64| {
            let Some(own) = recordings.get(recording) else {
                return;
            };
            truth.time = t - own.start();
            let celsius = own.temperature.as_ref().and_then(|own| own.at(t));
            truth.temperature = celsius.unwrap_or(truth.temperature);
        };
        for mean in &mut all.means {
            let chunk = &self.data.chunks[mean.chunk];
            let rest = &self.data.rests[chunk.rest];
            let span = chunk.mean(mean.sensor).map_or(rest.span, |own| own.span);
            set(&mut mean.truth, rest.recording, 0.5 * (span.from + span.to));
        }
        let attitudes = self.rows().attitudes(self.parameters.values());
        for turn in &mut all.turns {
            let recording = self.data.turns[turn.turn].recording;
            let samples = turn.truth.iter_mut().zip(&turn.t);
            for ((truth, t), attitude) in samples.zip(attitudes.in_turn(turn.turn)) {
                set(truth, recording, *t);
                truth.specific_force = attitude.into_body(&Vector3::z()) * self.gravity;
            }
            set_acceleration(turn);
        }
        all
    }
}

/// Sets the angular acceleration at every sample, by the rates of its neighbours.
fn set_acceleration(turn: &mut TurnSensitivity) {
    let rates: Vec<Vector3<f64>> = turn.truth.iter().map(|truth| truth.angular_rate).collect();
    for (k, truth) in turn.truth.iter_mut().enumerate() {
        let (before, after) = (k.saturating_sub(1), (k + 1).min(rates.len() - 1));
        let length = turn.t[after] - turn.t[before];
        if length > 0.0 {
            truth.angular_acceleration = (rates[after] - rates[before]) / length;
        }
    }
}

/// The whitened residuals beside the parameters of the model.
struct Beside {
    whitening: Whitening,
    model: Basis,
    residuals: Vec<f64>,
}

impl Beside {
    fn of(fit: &JointFit, whitening: Whitening) -> Self {
        Self {
            model: Basis::of(&whitening.finish_columns(fit.white_jacobian.clone())),
            residuals: whitening.finish_column(&fit.white_residuals),
            whitening,
        }
    }

    /// `|r|²` and its degrees of freedom.
    fn all(&self) -> (f64, usize) {
        let square = self.residuals.iter().map(|r| r * r).sum();
        let spare = self.residuals.len().saturating_sub(self.model.rank());
        (square, spare)
    }

    /// `|r|²` less its degrees of freedom.
    fn excess(&self) -> f64 {
        let (square, spare) = self.all();
        square - spare as f64
    }

    /// `|P_E r|²` of columns (`m × k`), its degrees of freedom, and whether the first coefficient would be negative: `Eᵀ r > 0`.
    fn score(&self, columns: Mat<f64>) -> (f64, usize, bool) {
        let left = self.left(columns);
        let residuals = ColRef::from_slice(&self.residuals);
        let is_negative = left.col(0).transpose() * residuals > 0.0;
        let basis = orthonormal(&left);
        let explained = basis.transpose() * residuals;
        (explained.squared_norm_l2(), basis.ncols(), is_negative)
    }

    /// The part of columns (`m × k`) that no parameter explains, whitened.
    fn left(&self, mut columns: Mat<f64>) -> Mat<f64> {
        self.whitening.white.apply(columns.as_mut());
        let columns = Columns::cut(&columns, self.whitening.groups());
        let left = self.model.without(&self.whitening.finish_columns(columns));
        left.to_dense()
    }
}

/// Returns true if an effect goes by the signal of its sensor or, of a gyroscope, by specific force and angular acceleration or, of an
/// accelerometer, by the last change of that, alone or with time or, where that `is_told`, temperature, and is linear in its parameters.
fn goes_by_motion(effect: &EffectRef, is_told: bool) -> bool {
    let (needs, signal) = (effect.needs(), Quantity::signal_of(effect.sensor()));
    let moves = |need: &Quantity| match need {
        Quantity::SpecificForce | Quantity::AngularAcceleration => signal == Quantity::AngularRate,
        Quantity::LastChange => signal == Quantity::SpecificForce,
        _ => false,
    };
    let is_signal = |need: &Quantity| *need == signal || moves(need);
    let may = |need: &Quantity| match need {
        Quantity::Time => true,
        Quantity::Temperature => is_told,
        other => is_signal(other),
    };
    needs.iter().any(is_signal)
        && needs.iter().all(may)
        && effect.params().iter().all(|p| p.role == Role::Coefficient)
}

#[cfg(test)]
mod tests {
    use recording::intervals::{Detector, segment};
    use simulate::Spec;

    use super::*;
    use crate::methods::joint::{JointRequest, fit_joint};

    fn found(spec: &Spec) -> Missing {
        let recording = spec.run().unwrap().recording;
        let segmentation = segment(&recording, &Detector::default()).unwrap();
        let request = JointRequest::new(vec![(&recording, &segmentation)], spec.gravity);
        let fit = fit_joint(&request).unwrap();
        fit.missing(&[&recording]).unwrap()
    }

    #[test]
    fn a_difference_between_upwards_and_downwards_speaks_for_itself() {
        let mut spec = Spec::hand_held(3);
        let off = spec.effects.entry("accel_asymmetry".into()).or_default();
        off.extend([("x", 3e-4), ("y", -3e-4), ("z", 3e-4)].map(|(a, v)| (a.to_owned(), v)));
        let missing = found(&spec);
        assert!(missing.p_value < 1e-6, "{missing:?}");
        assert_eq!(missing.dof, 3);
    }

    #[test]
    fn a_hysteresis_speaks_for_itself() {
        let mut spec = Spec::hand_held(3);
        let off = spec.effects.entry("accel_hysteresis".into()).or_default();
        off.extend(["x", "y", "z"].map(|axis| (axis.to_owned(), 3e-3)));
        let missing = found(&spec);
        assert!(missing.p_value < 1e-3, "{missing:?}");
        assert_eq!(missing.effect.name(), "accel_hysteresis");
    }

    #[test]
    fn a_scale_that_drifts_speaks_for_itself() {
        let mut spec = Spec::hand_held(3);
        let off = spec.effects.entry("gyro_scale_drift".into()).or_default();
        off.extend([("x", 2e-5), ("y", -2e-5), ("z", 2e-5)].map(|(a, v)| (a.to_owned(), v)));
        let missing = found(&spec);
        assert!(missing.p_value < 1e-6, "{missing:?}");
        assert_eq!(missing.effect.name(), "gyro_scale_drift");
    }

    #[test]
    fn of_a_device_that_lacks_nothing_nothing_speaks() {
        for seed in 0..8 {
            let missing = found(&Spec::hand_held(seed));
            assert!(missing.p_value > 5e-3, "{seed}: {missing:?}");
        }
    }
}
