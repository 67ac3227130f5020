//! `discover --units`: what several units of one type share.

use std::fmt::Write as _;
use std::path::Path;

use calib::Recording;
use calib::discover::{
    Agreement, Request, SharedEffect, UnitAlone, UnitFindings, Verdict, discover_units,
};

use super::held_out::refuse_twins;
use super::tables::last_part;
use super::words::gaps;
use crate::commands::calibrate::limits::gate_for;
use crate::commands::shared::first_screen::{Screen, Step, wrote};
use crate::commands::shared::inputs::spinner;
use crate::exit::Failure;
use crate::show;

/// Chance below which sizes are said to differ.
const DIFFER: f64 = 0.01;

/// Units whose sizes stand side by side; of more only what they have in common is printed.
const BESIDE: usize = 3;

/// Looks for what the units share.
pub fn look(recordings: &[Recording], request: &Request) -> Result<UnitFindings, Failure> {
    refuse_twins(recordings)?;
    let spinner = spinner("looking for what the units share");
    let findings = discover_units(recordings, request)?;
    spinner.finish_and_clear();
    Ok(findings)
}

/// Returns the warnings of the units' calibrations, each with the name of the unit.
pub fn warnings(findings: &UnitFindings) -> Vec<String> {
    let of = |unit: &UnitAlone| {
        let name = last_part(&unit.recording);
        let own = unit.warnings.clone().into_iter();
        own.map(move |warning| match warning.contains(&name) {
            true => warning,
            false => format!("{name}: {warning}"),
        })
        .collect::<Vec<_>>()
    };
    findings.units.iter().flat_map(of).collect()
}

/// Status 1 with the reasons where a unit's calibration is not to be used as it is.
///
/// # Errors
/// The gates that failed, unit by unit.
pub fn gate(findings: &UnitFindings) -> Result<(), Failure> {
    let of = |unit: &UnitAlone| {
        let name = last_part(&unit.recording);
        let gates = unit.failed_gates.clone().into_iter();
        gates
            .map(move |gate| format!("{name}: {gate}"))
            .collect::<Vec<_>>()
    };
    let reasons: Vec<String> = findings.units.iter().flat_map(of).collect();
    gate_for(&reasons)
}

/// The findings for people.
pub fn text(findings: &UnitFindings) -> String {
    let mut text = format!("{}\n", verdict(findings));
    let mut units = show::texts(&["unit", "alone it says"]);
    for unit in &findings.units {
        units.add_row([last_part(&unit.recording), alone(unit)]);
    }
    let _ = writeln!(text, "\n{units}");
    for effect in &findings.shared {
        let _ = writeln!(text, "\n{}\n\n{}", in_each(effect), sizes(effect));
    }
    for line in next(findings) {
        let _ = writeln!(text, "{line}");
    }
    text
}

/// The first screen: what the units share, and in how many it is.
pub fn screen(output: Option<&Path>, findings: &UnitFindings, remarks: Vec<String>) -> Screen {
    let mut rows = Vec::new();
    for effect in &findings.shared {
        let showing = effect.sizes.iter().filter(|size| size.p_value.is_some());
        let widest = effect
            .sizes
            .iter()
            .max_by(|a, b| a.gap_before.total_cmp(&b.gap_before));
        let gap = widest.map_or_else(String::new, |size| {
            let gaps = gaps(size.gap_before, size.gap_after).join(" → ");
            format!("{gaps} in {}", last_part(&size.unit))
        });
        rows.push(format!(
            "  {}: shown by {} of {} units, widest gap {gap}",
            effect.name,
            showing.count(),
            effect.sizes.len()
        ));
    }
    let reasons: Vec<&String> = findings
        .units
        .iter()
        .flat_map(|unit| &unit.failed_gates)
        .collect();
    let next = next(findings).pop();
    let command = next.as_deref().and_then(|words| words.split('`').nth(1));
    let step = command.map(|command| Step::new("calibrate every unit", command));
    Screen {
        verdict: vec![show::without_odds(&verdict(findings))],
        tables: vec![show::wrapped(&rows.join("\n"))],
        next: step.into_iter().collect(),
        written: wrote(output, "Nothing was written; -o findings.json keeps it."),
        remarks,
        reserved: 2 * reasons.len(),
        ..Screen::default()
    }
}

/// The verdict in sentences.
pub fn verdict(findings: &UnitFindings) -> String {
    let counted = findings.units.iter().filter(|unit| unit.left_out.is_none());
    let count = counted.count();
    let mut sentences = Vec::new();
    for effect in &findings.shared {
        let ties = match effect.indistinguishable_from.as_slice() {
            [] => String::new(),
            ties => format!(" (or {})", ties.join(" or ")),
        };
        sentences.push(format!(
            "The type lacks {}{ties}, by the evidence of {} together ({} over the whole catalogue). {}",
            effect.name,
            of_units(effect, count),
            show::probability(effect.adjusted_p_value),
            agreement(effect.agreement.as_ref()),
        ));
    }
    for own in &findings.own {
        let others = match own.others_would_show_it {
            true => {
                "others would show it, had they as much of it, and do not: it is that unit's, not the type's"
            }
            false => {
                "the others neither bear it out nor refute it: whether the type has it is open"
            }
        };
        sentences.push(format!(
            "{} alone shows {}; {others}.",
            last_part(&own.size.unit),
            own.name
        ));
    }
    if sentences.is_empty() {
        if count < 2 {
            return "Fewer than two units can be compared: each for itself is below.".into();
        }
        return format!(
            "Nothing that the {count} units share is missing: the base models explain them to within their noise, but for what each \
             says of its own recording."
        );
    }
    sentences.join(" ")
}

fn of_units(effect: &SharedEffect, count: usize) -> String {
    let showing = effect
        .sizes
        .iter()
        .filter(|size| size.p_value.is_some())
        .count();
    match showing == count {
        true => format!("all {count} units"),
        false => format!("{showing} of {count} units"),
    }
}

fn agreement(agreement: Option<&Agreement>) -> String {
    let Some(found) = agreement else {
        return "Its size is another one in every recording, so that sizes are not compared."
            .into();
    };
    let of = format!(
        "chi² {:.1} of {:.0} degrees of freedom, {}",
        found.chi2,
        found.dof,
        show::probability(found.p_value)
    );
    match found.p_value < DIFFER {
        true => format!("Its size differs from unit to unit ({of}): every unit needs its own."),
        false => format!("Its sizes agree ({of})."),
    }
}

fn alone(unit: &UnitAlone) -> String {
    let mut parts = unit.effects.clone();
    parts.extend(unit.integrity.iter().map(|fault| format!("fault: {fault}")));
    parts.extend(
        unit.unexplained
            .iter()
            .map(|rest| format!("unexplained: {rest}")),
    );
    let says = match unit.verdict {
        Verdict::Nothing => "nothing is missing".into(),
        _ => parts.join("; "),
    };
    match &unit.left_out {
        Some(why) => format!("not counted for the type: {why}; {says}"),
        None => says,
    }
}

/// Builds the table of an effect in each unit.
fn in_each(effect: &SharedEffect) -> String {
    let mut table = show::table(&[&effect.name, "p, alone", "gap before", "after", "of the"]);
    for size in &effect.sizes {
        let [before, after] = gaps(size.gap_before, size.gap_after);
        table.add_row([
            last_part(&size.unit),
            size.p_value
                .map_or_else(|| "not shown".into(), show::chance),
            before,
            after,
            size.channel.words().into(),
        ]);
    }
    table.to_string()
}

/// Its parameters, unit by unit where they are few, and what they have in common.
fn sizes(effect: &SharedEffect) -> String {
    let beside = effect.sizes.len() <= BESIDE;
    let units = effect
        .sizes
        .iter()
        .filter(|size| beside && !size.parameters.is_empty());
    let units: Vec<_> = units.collect();
    let mut header: Vec<String> = vec!["parameter".into()];
    header.extend(units.iter().map(|size| last_part(&size.unit)));
    let mean = effect.agreement.as_ref().map(|a| &a.mean);
    header.extend(mean.map(|_| "weighted mean".to_owned()));
    header.push("unit".into());
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    let mut table = show::table(&header);
    let Some(first) = effect.sizes.iter().find(|size| !size.parameters.is_empty()) else {
        return String::new();
    };
    let written = |p: &calib::calibration::EffectParameter| {
        let std = p
            .std
            .map_or_else(String::new, |std| format!(" ± {std:.1e}"));
        format!("{:.2e}{std}", p.value)
    };
    for (k, parameter) in first.parameters.iter().enumerate() {
        let mut row = vec![parameter.name.clone()];
        row.extend(
            units
                .iter()
                .map(|s| s.parameters.get(k).map_or_else(String::new, written)),
        );
        if let Some(mean) = mean {
            let own = mean.iter().find(|p| p.name == parameter.name);
            row.push(own.map_or_else(String::new, written));
        }
        row.push(parameter.unit.clone());
        table.add_row(row);
    }
    table.to_string()
}

/// Returns the next steps.
fn next(findings: &UnitFindings) -> Vec<String> {
    if findings.shared.is_empty() {
        return Vec::new();
    }
    let names: Vec<&str> = findings
        .shared
        .iter()
        .map(|effect| effect.name.as_str())
        .collect();
    vec![format!(
        "Calibrate every unit with it: `stillpoint calibrate UNIT --method joint --effects {} -o cal.json`.",
        names.join(",")
    )]
}
