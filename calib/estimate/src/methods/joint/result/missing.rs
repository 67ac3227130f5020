//! An effect of the accelerometer that the rows speak for, by a score test.

use faer::ColRef;
use sensor::{AnyEffect, Quantity, Role};

use crate::methods::joint::blocks::basis::Basis;
use crate::methods::joint::blocks::columns::Columns;
use crate::methods::joint::fit::JointFit;
use crate::methods::joint::result::marginal::orthonormal;
use crate::methods::joint::rows::error_columns::effect_columns;
use crate::methods::small_sample::by_chance;

/// An effect that the model lacks.
#[derive(Clone, Copy, Debug)]
pub struct Missing {
    /// The likeliest of those tried.
    pub effect: &'static dyn AnyEffect,
    /// `|P_E r|²`: what its columns explain of the whitened residual beside the model's parameters.
    pub statistic: f64,
    /// Degrees of freedom.
    pub dof: usize,
    /// Probability that any of those tried explains so much where nothing is missing.
    pub p_value: f64,
}

impl JointFit {
    /// The effect of the accelerometer for which all rows together speak most: of those that go by the specific force alone
    /// and that the model lacks. Against the noise that was measured, walks of the biases among it.
    ///
    /// A score test (Rao 1948) needs no fit with the effect: `r` whitened residual, `J` its Jacobian, `E = ∂r/∂c` at `c = 0`;
    /// under the model `|P r|²`, `P` onto what `J` leaves of `E`, is `χ²` of the rank of that. It looks at the turns too, which
    /// see most of what changes a direction and not a norm.
    pub fn missing(&self) -> Option<Missing> {
        let own = self.models[0].effects();
        let is_new =
            |effect: &&'static dyn AnyEffect| own.iter().all(|other| other.name() != effect.name());
        let all = accelerometer::EFFECTS.iter().copied();
        let tried: Vec<_> = all.filter(by_force_alone).filter(is_new).collect();
        let whitening = self.noise_whitening();
        let model = Basis::of(&whitening.finish_columns(self.white_jacobian.clone()));
        let residuals = whitening.finish_column(&self.white_residuals);
        let residuals = ColRef::from_slice(&residuals);
        let sensitivities = self.rows().force_sensitivities(self.parameters.values());
        let found = tried.iter().filter_map(|&effect| {
            let p: Vec<f64> = effect.params().iter().map(|p| p.nominal).collect();
            let wanted: Vec<usize> = (0..p.len()).collect();
            let mut columns =
                effect_columns(&sensitivities, residuals.nrows(), effect, &p, &wanted);
            whitening.white.apply(columns.as_mut());
            let columns = Columns::cut(&columns, whitening.groups());
            let left = model.without(&whitening.finish_columns(columns));
            let basis = orthonormal(&left.to_dense());
            let statistic = (basis.transpose() * residuals).squared_norm_l2();
            let dof = basis.ncols();
            (dof > 0).then(|| Missing {
                effect,
                statistic,
                dof,
                p_value: (by_chance(statistic, dof as f64) * tried.len() as f64).min(1.0),
            })
        });
        found.min_by(|a, b| a.p_value.total_cmp(&b.p_value))
    }
}

/// Returns true if an effect depends on the specific force alone and is linear in its parameters.
fn by_force_alone(effect: &&'static dyn AnyEffect) -> bool {
    let needs = effect.needs();
    needs.iter().all(|need| *need == Quantity::SpecificForce)
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
        fit_joint(&request).unwrap().missing().unwrap()
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
    fn of_a_device_that_lacks_nothing_nothing_speaks() {
        for seed in 0..8 {
            let missing = found(&Spec::hand_held(seed));
            assert!(missing.p_value > 5e-3, "{seed}: {missing:?}");
        }
    }
}
