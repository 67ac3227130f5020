//! A latitude that is wrong does to the readings what an error of the gyroscope may do.

use effects::earth_rotation;
use estimate::calibrate::LatitudeDoubt;
use estimate::methods::joint::effect_columns;
use sensor::Sensor;

use crate::score::{Score, log_tail, score};
use crate::search::{Name, VERTICAL};

/// Significance level for the part of an effect that another latitude does not explain.
const BY_CHANCE: f64 = 0.01;

/// The doubt about `latitude` that explains a name as well, up to what chance adds to its more parameters.
pub fn instead_of(name: &Name, latitude: f64) -> Option<LatitudeDoubt> {
    if name.claim.effect()?.sensor() != Sensor::Gyroscope {
        return None;
    }
    let (own, named) = (vertical(name)?, &name.ranked.score);
    // `change` is what the rows have too much.
    let std = own.covariance[(0, 0)].sqrt();
    let doubt = LatitudeDoubt::by((-own.change[0], std), latitude)?;
    let beyond = log_tail(
        named.statistic - own.statistic,
        named.dof as f64 - own.dof as f64,
    );
    (doubt.is_of_the_earth() && beyond > BY_CHANCE.ln()).then_some(doubt)
}

/// Scores the vertical part of the earth's rotation against the model without the named effect, at the noise of the model
/// with it.
fn vertical(name: &Name) -> Option<Score> {
    let state = &name.without;
    let earth = earth_rotation();
    let nominal: Vec<f64> = earth.params().iter().map(|p| p.nominal).collect();
    let column = effect_columns(
        &state.sensitivities,
        state.rows(),
        earth,
        &nominal,
        &[VERTICAL],
    );
    let column = state.projected.columns(state.whitened(column).as_ref());
    let whitened = state
        .projected
        .at_share(name.ranked.noise, name.ranked.scatter)?;
    Some(score(whitened.columns(&column).as_ref(), &whitened.z))
}

#[cfg(test)]
mod tests {
    use simulate::Spec;

    use crate::{EffectFinding, Request, discover};

    fn found(spec: &Spec, latitude: f64) -> Vec<EffectFinding> {
        let recordings = [spec.run().unwrap().recording];
        let request = Request {
            latitude: Some(latitude),
            ..Request::new(spec.gravity)
        };
        discover(&recordings, &request).unwrap().findings.effects
    }

    #[test]
    fn a_latitude_of_the_wrong_sign_is_no_error_of_the_gyroscope_alone() {
        let mut spec = Spec::hand_held(12);
        spec.latitude = Some(50.0);
        let found = found(&spec, -50.0);
        assert!(!found.is_empty());
        for effect in &found {
            let said = effect.latitude_in_doubt.as_ref();
            let said = said.and_then(|doubt| doubt.value("given"));
            assert_eq!(said, Some(-50.0), "{effect:?}");
        }
    }

    #[test]
    fn an_error_of_the_gyroscope_does_not_cast_doubt_on_the_latitude() {
        let mut spec = Spec::hand_held(12).with_effect("gyro_g_sensitivity", 1.0);
        spec.latitude = Some(50.0);
        let found = found(&spec, 50.0);
        assert!(found.iter().any(|e| e.name == "gyro_g_sensitivity"));
        for effect in &found {
            assert_eq!(effect.latitude_in_doubt, None);
        }
    }
}
