//! Findings as tables and sentences, for the terminal and for the page.

use std::collections::BTreeSet;
use std::path::Path;

use calib::calibration::{EffectParameter, effect_named};
use calib::discover::{Confirmation, EffectFinding, Findings, Proposal, Says, Validation};
use sensor::Nature;

use super::advice::to_show;
use super::words;
use crate::show;

/// A gap that is above this share of what it was has not shrunk.
const SHRUNK: f64 = 0.9;

/// Values that are read without a power of ten.
const PLAIN: std::ops::Range<f64> = 0.01..1e5;

/// In place of the error of a parameter that the search has chosen among some values.
const CHOSEN: &str = "chosen";

/// Ranked claims that are shown whatever their chance, and the chance up to which others are.
const AT_LEAST: usize = 3;
const WORTH_A_ROW: f64 = 0.5;

/// Header and rows.
pub type Rows<const N: usize> = ([&'static str; N], Vec<[String; N]>);

/// The gap before and after, in the fit, on intervals left out and on the validation recording.
pub fn gaps(findings: &Findings) -> Rows<5> {
    let header = match findings.effects.is_empty() {
        true => ["gap", "of the", "where", "before", "after"],
        false => ["gap", "of the", "where", "without it", "with all"],
    };
    let mut rows = Vec::new();
    for effect in &findings.effects {
        for (place, before, after) in places(findings, effect) {
            let [before, after] = words::gaps(before, after);
            rows.push([
                effect.name.clone(),
                effect.channel.words().into(),
                place,
                before,
                after,
            ]);
        }
    }
    if findings.effects.is_empty() {
        rows.extend(findings.validation.iter().map(|v| {
            let [before, after] = words::gaps(v.gap_before, v.gap_after);
            [
                "base models".into(),
                v.channel.words().into(),
                show::name(&v.recording),
                before,
                after,
            ]
        }));
    }
    (header, rows)
}

/// Returns the places where the gap of an effect was measured, each with the gap before and after.
pub fn places(findings: &Findings, effect: &EffectFinding) -> Vec<(String, f64, f64)> {
    let mut places = vec![
        ("in the fit".into(), effect.gap_before, effect.gap_after),
        (
            "left out".into(),
            effect.held_out_gap_before,
            effect.held_out_gap_after,
        ),
    ];
    let own = findings.validation.iter();
    places.extend(
        own.filter(|v| v.channel == effect.channel)
            .map(|v| (show::name(&v.recording), v.gap_before, v.gap_after)),
    );
    places
}

/// The parameters of a named effect.
pub fn parameters(effect: &EffectFinding) -> Vec<[String; 4]> {
    let known = effect_named(&effect.name);
    let instant = known.and_then(|known| Some(known.params()[known.instant()?].name.to_string()));
    let row = |p: &EffectParameter| {
        let mut row = parameter(p);
        if instant.as_ref() == Some(&p.name) {
            row[0].push_str(", from the start");
        }
        row
    };
    effect.parameters.iter().map(row).collect()
}

/// Returns a note on the coefficient that is 0 by convention; `None` for most effects.
pub fn reference(effect: &EffectFinding) -> Option<String> {
    let reference = effect_named(&effect.name)?.reference()?;
    Some(format!(
        "The coefficients of {} are relative to {reference}, which is 0 by convention.",
        effect.name
    ))
}

/// Returns a note on the rate of the rotation that is taken for the earth's; `None` for other effects.
pub fn of_the_earth(effect: &EffectFinding) -> Option<String> {
    if effect_named(&effect.name)?.nature() != Nature::EarthRotation {
        return None;
    }
    let square: f64 = effect.parameters.iter().map(|p| p.value.powi(2)).sum();
    Some(format!(
        "In the level frame of the recording, z up. Its length is {:.2e} rad/s; the earth turns at 7.29e-5 rad/s.",
        square.sqrt()
    ))
}

fn parameter(p: &EffectParameter) -> [String; 4] {
    let unit = if p.unit.is_empty() { "1" } else { &p.unit };
    let [value, std] = match p.std {
        Some(std) if PLAIN.contains(&p.value.abs()) => {
            [show::value(p.value, Some(std)), show::error(Some(std))]
        }
        Some(std) => [p.value, std].map(|v| format!("{v:.3e}")),
        None if PLAIN.contains(&p.value.abs()) => [show::figures(p.value, 4), CHOSEN.into()],
        None => [format!("{:.3e}", p.value), CHOSEN.into()],
    };
    [p.name.clone(), value, std, unit.into()]
}

/// The coefficients of the proposed formula.
pub fn proposed_terms(proposal: &Proposal) -> Vec<[String; 4]> {
    proposal.terms.iter().map(parameter).collect()
}

/// The evidence for what is named, everything else named being in the model.
pub fn evidence(findings: &Findings) -> Rows<5> {
    let header = [
        "named",
        "likelihood ratio",
        "dof",
        "p, one test",
        "p, whole catalogue",
    ];
    let row = |e: &EffectFinding| {
        [
            e.name.clone(),
            format!("{:.1}", e.statistic),
            format!("{:.0}", e.dof),
            show::chance(e.p_value),
            show::chance(e.adjusted_p_value),
        ]
    };
    (header, findings.effects.iter().map(row).collect())
}

/// The best of the catalogue against the base models.
pub fn ranking(findings: &Findings) -> Rows<4> {
    let header = [
        "against the base models",
        "likelihood ratio",
        "dof",
        "p, whole catalogue",
    ];
    // A fault at rest may be one of the force or of the rate: the more evident of the two stands for both.
    let mut seen = BTreeSet::new();
    let claims = findings.ranking.iter();
    let claims = claims.filter(|claim| seen.insert(claim.name.as_str()));
    let claims = claims.enumerate();
    let worth = claims.filter(|(k, c)| *k < AT_LEAST || c.adjusted_p_value < WORTH_A_ROW);
    let rows = worth.map(|(_, claim)| {
        [
            claim.name.clone(),
            format!("{:.1}", claim.statistic),
            format!("{:.0}", claim.dof),
            show::chance(claim.adjusted_p_value),
        ]
    });
    (header, rows.collect())
}

/// Returns the table of disagreements between the base models and the data.
pub fn disagreement(findings: &Findings) -> Rows<5> {
    let header = [
        "base models disagree in",
        "gap",
        "rms",
        "most in",
        "goes with",
    ];
    let rows = findings.disagreement.iter().map(|d| {
        [
            d.channel.words().into(),
            show::figures(d.size, 3),
            d.rms.map_or_else(String::new, |rms| {
                let (factor, unit) = words::unit_of(d.channel);
                format!("{} {unit}", show::figures(factor * rms, 2))
            }),
            show::name(&d.place),
            d.covariate.clone(),
        ]
    });
    (header, rows.collect())
}

/// Faults of the recordings; which of several recordings stands before the interval.
pub fn faults(findings: &Findings) -> Rows<4> {
    let header = ["fault", "interval", "time, s", "what"];
    let first = findings.integrity.first().map(|fault| &fault.recording);
    let several = findings.calibration.provenance.inputs.len() > 1
        || findings
            .integrity
            .iter()
            .any(|f| Some(&f.recording) != first);
    let rows = findings.integrity.iter().map(|fault| {
        let kind = match fault.finding.place.turn {
            Some(_) => "turn ",
            None => "",
        };
        let interval = fault
            .interval
            .map_or("all".into(), |k| format!("{kind}{k}"));
        [
            words::or(&fault.name, &fault.indistinguishable_from),
            match several {
                true => format!("{}: {interval}", last_part(&fault.recording)),
                false => interval,
            },
            format!("{:.2} to {:.2}", fault.t0, fault.t1),
            fault.finding.what(),
        ]
    });
    (header, rows.collect())
}

/// A recording by the last part of its path.
pub fn last_part(recording: &str) -> String {
    let last = Path::new(recording).file_name();
    last.map_or_else(
        || show::name(recording),
        |last| show::name(&last.to_string_lossy()),
    )
}

/// Returns a sentence per channel on the named effects or the proposed formula in the validation recordings.
pub fn validated(findings: &Findings) -> Vec<String> {
    let of = |v: &Validation| {
        // Of a complete model chi² per degree of freedom is 1 within two of these.
        let spread = 2.0 * (2.0 / v.dof.max(1.0)).sqrt();
        let (name, channel) = (show::name(&v.recording), v.channel.words());
        let explained = |gap: f64| gap.powi(2) <= 1.0 + spread;
        if let Some(with) = v.gap_with_formula {
            let [without, with_it] = words::gaps(v.gap_after, with);
            let says = match (explained(with), with > SHRUNK * v.gap_after) {
                (true, _) if explained(v.gap_after) => "that recording cannot confirm it",
                (true, _) => "it is confirmed there",
                (false, true) => "it is not confirmed there",
                (false, false) => "it holds there too, but something is left",
            };
            return format!(
                "On {name} the gap of the {channel} is {without} without and {with_it} with the proposed formula: {says}."
            );
        }
        if explained(v.gap_after) {
            format!("On {name} the {channel} is explained to the noise.")
        } else if findings.effects.is_empty() {
            format!(
                "On {name} the {channel} is not explained: something is missing that did not show here."
            )
        } else {
            let [before, after] = words::gaps(v.gap_before, v.gap_after);
            format!(
                "On {name} the gap of the {channel} is {before} without and {after} with what was named."
            )
        }
    };
    let own = findings.confirmations.iter();
    let own = own.map(|own| format!("{}.", confirmed(own)));
    own.chain(findings.validation.iter().map(of)).collect()
}

/// The verdict of the validation recording on an effect.
pub fn confirmed(own: &Confirmation) -> String {
    let name = last_part(&own.recording);
    let effect = &own.effect;
    let says = match own.says {
        Says::Confirms => format!("confirms {effect}"),
        Says::SpeaksAgainst => format!("speaks against {effect}"),
        Says::CannotTell => format!("cannot tell whether {effect} is there"),
    };
    format!(
        "{name} {says}: it shows {:.2} ± {:.2} of its size",
        own.share, own.std
    )
}

/// Returns the effects that these recordings cannot show, in sentences.
pub fn not_seen(findings: &Findings) -> Vec<String> {
    let mut all = not_observable(findings, true);
    if !findings.never_visible.is_empty() {
        all.push("Never visible in recordings made by hand:".into());
        let words = findings.never_visible.iter();
        all.extend(words.map(|found| format!("• {}", found.what())));
    }
    all
}

/// Returns the effects that were not observable, grouped by the recording that would show them; `whole` with all names.
pub fn not_observable(findings: &Findings, whole: bool) -> Vec<String> {
    let lines = to_show(&findings.not_observable, whole);
    if lines.is_empty() {
        return Vec::new();
    }
    let first = "Not observable in these recordings, not even at ten times the typical size, and what \
                 would show it:";
    let lines = lines.into_iter().map(|line| format!("• {line}"));
    std::iter::once(first.into()).chain(lines).collect()
}

/// Returns the effects that no recording by hand can show, without the reasons.
pub fn never_visible(findings: &Findings) -> Option<String> {
    let all = findings.never_visible.iter();
    let short: Vec<String> = all.map(|found| found.reason()).collect();
    (!short.is_empty()).then(|| {
        format!(
            "Never visible in recordings made by hand: {}.",
            short.join("; ")
        )
    })
}
