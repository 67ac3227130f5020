//! Alternatives to a named effect, and effects that may exist in addition to it.

use calib::discover::{Beside, EffectFinding, Findings};

use crate::show;

/// Returns a sentence for each effect that cannot be distinguished from a named one.
pub fn ties(findings: &Findings) -> Vec<String> {
    let mut all = Vec::new();
    for effect in &findings.effects {
        for (tie, shared) in effect.indistinguishable_from.iter().zip(&effect.shared) {
            all.push(format!(
                "{tie} would explain {:.0} % of what {} explains: these recordings cannot tell the two apart.",
                100.0 * shared,
                effect.name
            ));
        }
        if !effect.forms.is_empty() {
            all.push(format!(
                "Forms that are not in the list of known errors explain about as much as {}: {}.",
                effect.name,
                effect.forms.join("; ")
            ));
        }
    }
    all
}

/// Returns a sentence for each effect that may exist in addition to a named one, with its influence on the
/// coefficients.
pub fn beside(findings: &Findings) -> Vec<String> {
    let all = findings.effects.iter();
    let of = |effect: &EffectFinding| {
        let others = effect.may_be_beside.iter();
        let (likely, unknown): (Vec<&Beside>, Vec<&Beside>) =
            others.partition(|other| other.is_likely());
        let likely = likely.into_iter();
        let likely: Vec<String> = likely.map(|other| likely_beside(effect, other)).collect();
        likely.into_iter().chain(unknown_beside(effect, &unknown))
    };
    all.flat_map(of).collect()
}

fn likely_beside(effect: &EffectFinding, other: &Beside) -> String {
    let (own, name) = (&effect.name, &other.name);
    format!(
        "{name} may be there beside {own}: {} in one test, too weak to be named. With it the coefficients of {own} would change by \
         up to {:.1} of their standard errors, which do not contain that. `calibrate --effects {own},{name}` fits both.",
        show::probability(other.p_value),
        other.largest_change
    )
}

fn unknown_beside(effect: &EffectFinding, unknown: &[&Beside]) -> Option<String> {
    let names: Vec<&str> = unknown.iter().map(|other| other.name.as_str()).collect();
    let factors = unknown.iter().map(|other| other.largest_factor);
    let own = &effect.name;
    (!names.is_empty()).then(|| {
        format!(
            "Whether {} is there beside {own} these recordings do not show. The standard errors of {own} hold if it is not; with both \
             they are up to {:.1} times as large.",
            names.join(" or "),
            factors.fold(1.0, f64::max)
        )
    })
}
