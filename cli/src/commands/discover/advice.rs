//! Advice on the next recordings.

use ::findings::{Front, Remedy};
use calib::calibration::effect_named;
use calib::discover::{Findings, Integrity};
use sensor::{Quantity, Sensor};

/// The recording in which an effect can show, by what it depends on; `None` of one that the catalogue does not have.
fn shown_by(name: &str) -> Option<&'static str> {
    let effect = effect_named(name)?;
    let needs = effect.needs();
    let has = |quantity: Quantity| needs.contains(&quantity);
    Some(if effect.instant().is_some() {
        "two rests or more before the change and two after it, in one recording"
    } else if has(Quantity::TemperatureRate) || has(Quantity::Warming) {
        "a recording with a temperature column during which the device warms and cools"
    } else if has(Quantity::Temperature) {
        "a recording with a temperature column during which the device warms by ten degrees or more"
    } else if has(Quantity::Vibration) {
        "some rests on a table that vibrates, others on one that does not"
    } else if has(Quantity::LastChange) {
        "the same placements reached from different sides"
    } else if has(Quantity::Time) {
        "a longer recording, with rests from its first minute to its last"
    } else if effect.sensor() == Sensor::Gyroscope {
        "turns of very different speed, both ways about every axis, between rests in twenty orientations"
    } else {
        "more orientations, edges and corners among them (an error that motion alone shows stays hidden: the accelerometer is judged at rest)"
    })
}

/// The effects that did not show here, by what a recording must have for them to show; `whole` with all names.
pub fn to_show(not_observable: &[String], whole: bool) -> Vec<String> {
    let mut all: Vec<(Option<&str>, Vec<&str>)> = Vec::new();
    for name in not_observable {
        let by = shown_by(name);
        match all.iter_mut().find(|(own, _)| *own == by) {
            Some((_, names)) => names.push(name),
            None => all.push((by, vec![name])),
        }
    }
    let line = |(by, names): (Option<&str>, Vec<&str>)| {
        let by = by.map_or_else(String::new, |recording| format!(": {recording}"));
        match names.as_slice() {
            [first, _, others @ ..] if !whole && !others.is_empty() => {
                format!("{first} and {} more{by}", others.len() + 1)
            }
            names => format!("{}{by}", names.join(", ")),
        }
    };
    all.into_iter().map(line).collect()
}

/// Returns the remedy for a fault; `None` if the only remedy is to record the interval again or leave it out.
fn remedy_of(fault: &Integrity) -> Option<String> {
    let again = [Remedy::RecordAgain, Remedy::LeaveOut];
    let remedies = &fault.finding.remedies;
    let more = remedies.iter().any(|remedy| !again.contains(remedy));
    more.then(|| fault.finding.advice(Front::CommandLine))?
}

/// Steps against each fault that has a remedy.
pub fn against_faults(findings: &Findings) -> impl Iterator<Item = String> {
    let of = |fault: &Integrity| {
        let remedy = remedy_of(fault)?;
        Some(format!(
            "Against {}: {remedy}.",
            fault.name.replace('_', " ")
        ))
    };
    findings.integrity.iter().filter_map(of)
}

/// Returns the recordings to make beside the next steps of the first screen, the most informative first.
pub fn next_recordings(findings: &Findings) -> Vec<String> {
    let mut next: Vec<String> = Vec::new();
    let mut add = |text: String| {
        if !next.contains(&text) {
            next.push(text);
        }
    };
    for effect in &findings.effects {
        if let Some(recording) = &effect.told_apart_by {
            add(format!(
                "To tell {} from {}: {}.",
                effect.name,
                effect.indistinguishable_from.join(" and "),
                recording.text(Front::CommandLine)
            ));
        }
    }
    against_faults(findings).skip(1).for_each(&mut add);
    if findings
        .integrity
        .iter()
        .any(|fault| fault.interval.is_some())
    {
        add(
            "The calibration does not use what is at fault. To be sure of it, record those intervals again.".into(),
        );
    }
    if findings.unexplained.is_some()
        && !findings.effects.is_empty()
        && findings.calibration.provenance.inputs.len() < 2
    {
        add(
            "To learn whether what remains belongs to the device or to the day: a second recording of the same \
             kind. What returns with the same shape belongs to the device."
                .into(),
        );
    }
    if findings.proposed.is_some() {
        add(
            "To see the proposed formula confirmed: another recording of the device, given as --validation, or with the \
             formula defined in a file given as --effect-file. The gap must close there, or the formula be named."
                .into(),
        );
    }
    next
}
