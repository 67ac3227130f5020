//! `--prior`: what the type gave and what the recording gave.

use calib::calibrate::Request;
use calib::calibration::effect_named;
use calib::prior::{Prior, PriorUse};

use super::limits::number;
use crate::exit::{Failure, INPUT};
use crate::show;

/// Values with a smaller standard error are shown by their powers of ten.
const SMALL: f64 = 1e-5;

/// Adds the effects of the prior to those that are fitted.
pub fn with_effects(prior: &Prior, request: &mut Request) -> Result<(), Failure> {
    for name in &prior.effects {
        let effect = effect_named(name).ok_or_else(|| {
            Failure::new(
                INPUT,
                format!("--prior: its effect {name} is not in the catalogue"),
            )
        })?;
        if !request.effects.iter().any(|own| own.name() == name) {
            request.effects.push(effect);
        }
    }
    Ok(())
}

/// Parameter by parameter: type, recording, both, and whose share of the information is how large.
pub fn text(used: &PriorUse) -> String {
    let mut table = show::table(&["parameter", "type", "recording", "both", "by the type"]);
    for p in &used.parameters {
        let pair = |value: f64, std: f64| match std < SMALL {
            true => format!("{value:.3e} ± {std:.1e}"),
            false => format!(
                "{} ± {}",
                show::value(value, Some(std)),
                show::error(Some(std))
            ),
        };
        table.add_row([
            p.name.clone(),
            pair(p.prior, p.prior_std),
            pair(p.data, p.data_std),
            pair(p.value, p.std),
            format!("{:.0} %", 100.0 * p.by_prior),
        ]);
    }
    let verdict = match (used.belongs, &used.furthest) {
        (true, _) => format!(
            "the device belongs to the type (p = {})",
            number(used.p_value)
        ),
        (false, Some((name, by))) => format!(
            "the device is NOT of the type: {name} is {by:+.1} standard deviations from its mean; the prior is not used"
        ),
        (false, None) => "the device is NOT of the type; the prior is not used".to_owned(),
    };
    format!("\nPrior of {} devices: {verdict}\n{table}\n", used.devices)
}
