//! The slowest errors after turns, which look like biases and scale factors of all static intervals but the first.

use effects::relaxation;
use sensor::Sensor;

use super::column_of;
use super::decay::Trials;
use super::way::Way;
use crate::methods::joint::{ErrorLeftOut, JointFit};

/// Errors of usual size that come again after every turn and fade slowly, as a fit leaves them out.
pub fn not_excluded(fit: &JointFit, within: &Trials<'_>) -> Vec<ErrorLeftOut> {
    let Some(usual) = relaxation(Sensor::Accelerometer).map(|effect| effect.typical()) else {
        return Vec::new();
    };
    let each = within.slowest_alike().into_iter();
    let each = each.map(|(decay, tested)| ErrorLeftOut {
        column: column_of(fit, &decay),
        size: match tested.way {
            Way::Force => usual / fit.gravity,
            _ => usual,
        },
        seen: tested.within(),
    });
    each.collect()
}
