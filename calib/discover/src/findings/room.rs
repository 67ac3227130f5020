//! A rotation about a horizontal direction of the room: the earth's near the equator, or a field's.

use ::findings::{Finding, Kind};
use effects::{earth_rotation, room_field};
use sensor::Sensor;

use super::EffectFinding;
use crate::remainder::unexplained::Unexplained;
use crate::search::Search;

/// The finding of a rotation that the earth or a field of the room may make.
fn of_a_room() -> Finding {
    Finding::of(Kind::ROOM_OR_EARTH).of_sensor(Sensor::Gyroscope)
}

/// Describes a rotation that may be either in place of naming it: the model has it, and what is named beside it stays. Whether there
/// was one comes with what remains.
pub fn described(
    effects: &mut Vec<EffectFinding>,
    search: &mut Search,
    rest: Option<Unexplained>,
) -> (Option<Unexplained>, bool) {
    let field = room_field(Sensor::Gyroscope);
    let field = field.map(|field| field.name().to_owned());
    let is_either = |effect: &EffectFinding| {
        let mut ties = effect.indistinguishable_from.iter();
        effect.name == earth_rotation().name() && ties.any(|tie| Some(tie) == field.as_ref())
    };
    let Some(place) = effects.iter().position(is_either) else {
        return (rest, false);
    };
    let found = effects.remove(place);
    search.names.retain(|name| name.claim.name() != found.name);
    let rest = match rest {
        // What is left beside it says the same.
        Some(rest) if rest.fitted_by == field => rest,
        Some(rest) => Unexplained {
            finding: rest.finding.because(of_a_room()),
            ..rest
        },
        None => Unexplained {
            channel: found.channel,
            size: found.gap_before,
            rms: found.rms_before,
            p_value: found.adjusted_p_value,
            statistic: found.statistic,
            dof: found.dof,
            finding: of_a_room(),
            recording: None,
            period: None,
            fitted_by: field,
            instead_of: Vec::new(),
            columns: None,
            wandering: None,
        },
    };
    (Some(rest), true)
}
