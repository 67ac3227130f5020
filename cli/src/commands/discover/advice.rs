//! Advice on the next recordings.

use ::findings::{Front, Remedy};
use calib::discover::{Findings, Integrity};

/// Recordings in which effects can show, each with parts of the effects' names.
const TO_SHOW: [(&[&str], &str); 7] = [
    (
        &["_step"],
        "two rests or more before the change and two after it, in one recording",
    ),
    (
        &["temperature_rate", "thermal_hysteresis"],
        "a recording with a temperature column during which the device warms and cools",
    ),
    (
        &["temperature"],
        "a recording with a temperature column during which the device warms by ten degrees or more",
    ),
    (
        &["vibration"],
        "some rests on a table that vibrates, others on one that does not",
    ),
    (
        &["hysteresis"],
        "the same placements reached from different sides",
    ),
    (
        &["gyro_"],
        "turns of very different speed, both ways about every axis, between rests in twenty orientations",
    ),
    (
        &["accel_"],
        "more orientations, edges and corners among them (an error that motion alone shows stays hidden: the accelerometer is judged at rest)",
    ),
];

/// The effects that did not show here, by what a recording must have for them to show; `whole` with all names.
pub fn to_show(not_observable: &[String], whole: bool) -> Vec<String> {
    let shown_by = |name: &str| {
        let is_part = |(parts, _): &&(&[&str], &str)| parts.iter().any(|part| name.contains(part));
        TO_SHOW
            .iter()
            .find(is_part)
            .map(|(_, recording)| *recording)
    };
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
pub fn remedy_of(fault: &Integrity) -> Option<String> {
    let again = [Remedy::RecordAgain, Remedy::LeaveOut];
    let remedies = &fault.finding.remedies;
    let more = remedies.iter().any(|remedy| !again.contains(remedy));
    more.then(|| fault.finding.advice(Front::CommandLine))?
}

/// Returns the recordings to make next, the most informative first.
pub fn next_recordings(findings: &Findings) -> Vec<String> {
    let mut next: Vec<String> = Vec::new();
    let mut add = |text: String| {
        if !next.contains(&text) {
            next.push(text);
        }
    };
    for effect in &findings.effects {
        if let Some(recording) = &effect.told_apart_by {
            let plan = match effect.rivals.is_empty() {
                true => "",
                false => {
                    " `stillpoint plan findings.json`, with the file that -o writes, says which placements and turns."
                }
            };
            add(format!(
                "To tell {} from {}: {}.{plan}",
                effect.name,
                effect.indistinguishable_from.join(" and "),
                recording.text(Front::CommandLine)
            ));
        }
    }
    for fault in &findings.integrity {
        if let Some(remedy) = remedy_of(fault) {
            add(format!("Against {}: {remedy}.", fault.name));
        }
    }
    if findings
        .integrity
        .iter()
        .any(|fault| fault.interval.is_some())
    {
        add(
            "The calibration does not use what is at fault. To be sure of it, record those intervals again.".into(),
        );
    }
    if findings.unexplained.is_some() && findings.calibration.provenance.inputs.len() < 2 {
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
    if !findings.effects.is_empty() && findings.validation.is_empty() {
        let what = match findings.effects.len() {
            1 => "the name",
            _ => "the names",
        };
        add(format!(
            "To see {what} confirmed: another recording of the device, given as --validation. The gap must close there too."
        ));
    }
    next
}
