//! A latitude that is wrong does to the readings what an error of the gyroscope may do.

use effects::earth_rotation;
use estimate::calibrate::LatitudeDoubt;
use estimate::methods::joint::effect_columns;
use sensor::Sensor;

use crate::score::{Score, log_tail, score};
use crate::search::{Name, VERTICAL};

findings::tuning! {
    /// Significance level for the part of an effect that another latitude does not explain.
    BY_CHANCE: f64 = 1e-3;
}

/// The doubt about `latitude` that explains one of the names as well, and that name.
pub fn instead_of_a_name(names: &[Name], latitude: f64) -> Option<(LatitudeDoubt, String)> {
    let doubt = |name: &Name| Some((instead_of(name, latitude)?, name.claim.name().to_owned()));
    names.iter().find_map(doubt)
}

/// The doubt that explains one name, up to what chance adds to its more parameters.
fn instead_of(name: &Name, latitude: f64) -> Option<LatitudeDoubt> {
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
    (doubt.is_of_the_earth() && beyond > BY_CHANCE.get().ln()).then_some(doubt)
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
        &earth,
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
    use ::findings::Kind;
    use simulate::Spec;

    use crate::{Findings, Request, discover};

    fn found(spec: &Spec, latitude: f64) -> Findings {
        let recordings = [spec.run().unwrap().recording];
        let request = Request {
            latitude: Some(latitude),
            ..Request::new(spec.gravity)
        };
        discover(&recordings, &request).unwrap().findings
    }

    #[test]
    fn a_latitude_of_the_wrong_sign_is_no_error_of_the_gyroscope_alone() {
        let mut spec = Spec::hand_held(12);
        spec.latitude = Some(50.0);
        let found = found(&spec, -50.0);
        assert_eq!(found.effects, []);
        let mut said = found.calibration.warnings.iter();
        let said = said.find(|w| w.kind == Kind::LATITUDE_DOUBTFUL).unwrap();
        assert_eq!(said.value("given"), Some(-50.0));
        assert!((said.value("seen").unwrap() - 50.0).abs() < 10.0);
    }

    #[test]
    fn without_a_latitude_the_diagonal_of_a_g_sensitivity_is_as_uncertain_as_the_vertical_rate() {
        let (mut square, mut count) = (0.0, 0.0);
        for seed in 12..16 {
            let mut spec = Spec::hand_held(seed).with_effect("gyro_g_sensitivity", 1.0);
            spec.latitude = Some(50.0);
            let session = spec.run().unwrap();
            let found = discover(&[session.recording], &Request::new(spec.gravity)).unwrap();
            let mut effects = found.findings.effects.iter();
            let named = effects.find(|e| e.name == "gyro_g_sensitivity").unwrap();
            let truth = &session.truth.gyroscope;
            let error = |name: &str| {
                let own = named.parameters.iter().find(|p| p.name == name).unwrap();
                let place = truth.index(&format!("gyro_g_sensitivity.{name}")).unwrap();
                (own.value - truth.values()[place], own.std.unwrap())
            };
            for name in ["xx", "yy", "zz"] {
                let (error, std) = error(name);
                square += (error / std).powi(2);
                count += 1.0;
            }
            assert!(error("xx").1 > 1.3 * error("xy").1, "{named:?}");
        }
        let rms = f64::sqrt(square / count);
        assert!(rms < 1.7, "{rms}");
    }

    #[test]
    fn an_error_of_the_gyroscope_does_not_cast_doubt_on_the_latitude() {
        let mut spec = Spec::hand_held(12).with_effect("gyro_g_sensitivity", 1.0);
        spec.latitude = Some(50.0);
        let found = found(&spec, 50.0);
        assert!(found.effects.iter().any(|e| e.name == "gyro_g_sensitivity"));
        assert!(!found.calibration.warnings.has(Kind::LATITUDE_DOUBTFUL));
    }
}
