//! Findings in sentences.

use calib::discover::{
    Channel, EffectFinding, Findings, Integrity, Proposal, Size, Unexplained, Verdict,
};

use crate::show;

/// The verdict in one sentence.
pub fn verdict(findings: &Findings) -> String {
    let mut parts: Vec<(f64, String)> = Vec::new();
    let gaps = findings.effects.iter().map(|e| e.gap_before);
    let by_effects = gaps.fold(1.0, f64::max);
    if !findings.effects.is_empty() {
        parts.push((by_effects, named(&findings.effects)));
    }
    if !findings.integrity.is_empty() {
        // What is at one place is told after what is everywhere.
        let sizes = findings
            .integrity
            .iter()
            .filter_map(|fault| fault.size?.gap);
        parts.push((sizes.fold(by_effects, f64::max), faults(findings)));
    }
    if let Some(rest) = &findings.unexplained {
        parts.push((rest.size, unexplained(rest, findings.proposed.is_some())));
    }
    if findings.verdict == Verdict::Nothing {
        let hidden = match findings.not_observable.len() {
            0 => String::new(),
            1 => "; one effect of the catalogue could not have shown".into(),
            n => format!("; {n} effects of the catalogue could not have shown"),
        };
        return format!(
            "Nothing is missing that could show here: the base models explain the data to within its noise{}{hidden}.",
            between_samples(findings)
        );
    }
    // The largest misfit comes first.
    parts.sort_by(|a, b| b.0.total_cmp(&a.0));
    let parts: Vec<String> = parts.into_iter().map(|(_, words)| words).collect();
    let whole = parts.join("; ");
    let mut letters = whole.chars();
    let first = letters.next().map(|c| c.to_uppercase().to_string());
    format!("{}{}.", first.unwrap_or_default(), letters.as_str())
}

/// What the noise contains that is not the sensor's.
fn between_samples(findings: &Findings) -> String {
    let clocks = findings.calibration.clocks.iter();
    let missing = clocks.filter_map(|clock| clock.between_samples.as_ref());
    let most = missing.map(|missing| missing.degrees).fold(0.0, f64::max);
    match most > 0.0 {
        true => format!(
            ", in which turns miss {}° rms that may have been lost between samples",
            show::figures(most, 2)
        ),
        false => String::new(),
    }
}

fn named(effects: &[EffectFinding]) -> String {
    let names: Vec<String> = effects.iter().map(with_ties).collect();
    let mut channels: Vec<(Channel, Vec<&EffectFinding>)> = Vec::new();
    for effect in effects {
        match channels.iter_mut().find(|(own, _)| *own == effect.channel) {
            Some((_, all)) => all.push(effect),
            None => channels.push((effect.channel, vec![effect])),
        }
    }
    let gaps: Vec<String> = channels
        .iter()
        .map(|(channel, own)| match own.as_slice() {
            [one] if effects.len() == 1 => taken_by("it", one),
            [one] => taken_by(&one.name, one),
            all => taken_together(*channel, all),
        })
        .collect();
    let gaps = gaps.join("; ");
    format!("the base models lack {}; {gaps}", names.join(" and "))
}

/// What one effect does to the gap of its channel.
fn taken_by(what: &str, effect: &EffectFinding) -> String {
    format!(
        "{what} takes the gap of the {} from {} ({}left out: {})",
        effect.channel.words(),
        gaps(effect.gap_before, effect.gap_after).join(" to "),
        in_units(effect),
        gaps(effect.held_out_gap_before, effect.held_out_gap_after).join(" to "),
    )
}

/// What several effects of one channel do to its gap: with all of them, and without each.
fn taken_together(channel: Channel, effects: &[&EffectFinding]) -> String {
    let size = |gap: f64, rms: Option<f64>| {
        let (factor, unit) = unit_of(channel);
        let rms = rms.map_or_else(String::new, |rms| {
            format!(" ({} {unit} rms)", show::figures(factor * rms, 3))
        });
        format!("{gap:.2}{rms}")
    };
    let with = effects
        .first()
        .map_or_else(String::new, |e| size(e.gap_after, e.rms_after));
    let without = effects
        .iter()
        .map(|e| format!("{} without {}", size(e.gap_before, e.rms_before), e.name));
    let without: Vec<String> = without.collect();
    format!(
        "the gap of the {} is {with} with them, {}",
        channel.words(),
        without.join(", ")
    )
}

/// What a gap of 1 means, and which gaps chance makes in the channels of the names.
pub fn by_chance(effects: &[EffectFinding]) -> String {
    let mut all: Vec<String> = Vec::new();
    for effect in effects {
        if let Some([low, high]) = effect.gap_by_chance {
            let words = format!("{low:.2} to {high:.2} of the {}", effect.channel.words());
            if !all.contains(&words) {
                all.push(words);
            }
        }
    }
    let chance = match all.is_empty() {
        true => String::new(),
        false => format!(
            "; chance alone makes {} (nine recordings of ten)",
            all.join(", ")
        ),
    };
    format!(
        "A gap of 1 is explained to the noise{chance}. It weighs every comparison by its noise; rms counts all alike. “Left out” \
         are intervals that the fit did not see."
    )
}

/// `2.61 to 0.80 mm/s² rms, `: what the channel of an effect leaves before and after; nothing where that is not known.
fn in_units(effect: &EffectFinding) -> String {
    if let (Channel::MovingForce, [late]) = (effect.channel, effect.parameters.as_slice()) {
        let error = late
            .std
            .map_or_else(String::new, |std| format!(" ± {:.2}", 1e3 * std));
        let (size, how) = (
            1e3 * late.value.abs(),
            if late.value < 0.0 { "early" } else { "late" },
        );
        return format!("stamps of the accelerometer {size:.2}{error} ms {how}, ");
    }
    let pair = effect.rms_before.zip(effect.rms_after);
    pair.map_or_else(String::new, |(before, after)| {
        let (factor, unit) = unit_of(effect.channel);
        let [before, after] = [before, after].map(|rms| show::figures(factor * rms, 3));
        format!("{before} to {after} {unit} rms, ")
    })
}

/// The unit that people read a channel in, and what makes it of SI.
pub fn unit_of(channel: Channel) -> (f64, &'static str) {
    match channel {
        Channel::StaticNorm | Channel::MovingForce => (1e3, "mm/s²"),
        Channel::StaticRate => (1f64.to_degrees() * 3600.0, "°/h"),
        Channel::Direction => (1f64.to_degrees(), "°"),
    }
}

/// Noise of the biases in the final model, in a sentence.
pub fn bias_noise(findings: &Findings) -> String {
    let calibration = &findings.calibration;
    let sensors = [
        (
            "accelerometer",
            calibration.accelerometer.is_some(),
            Channel::StaticNorm,
            "m/s²/√s",
        ),
        (
            "gyroscope",
            calibration.gyroscope.is_some(),
            Channel::StaticRate,
            "rad/s/√s",
        ),
    ];
    let figures = sensors
        .into_iter()
        .zip(findings.walks)
        .zip(findings.bias_instability);
    let words = figures.filter_map(|(((sensor, is_there, channel, unit), walk), flicker)| {
        let (factor, of_flicker) = unit_of(channel);
        let walk = match walk > 0.0 {
            true => format!("random walk {walk:.1e} {unit}"),
            false => "no random walk".into(),
        };
        let flicker = match flicker.iter().any(|b| *b > 0.0) {
            true => {
                let axes = flicker.map(|b| format!("{:.2}", factor * b));
                format!(
                    ", bias instability {} {of_flicker} (x, y, z)",
                    axes.join(", ")
                )
            }
            false => ", no bias instability".into(),
        };
        is_there.then(|| format!("{sensor} {walk}{flicker}"))
    });
    format!(
        "Noise of the biases: {}.",
        words.collect::<Vec<_>>().join("; ")
    )
}

fn with_ties(effect: &EffectFinding) -> String {
    or(&effect.name, &effect.indistinguishable_from)
}

/// `a (or b)`: what cannot be told from a name here.
pub fn or<T: AsRef<str>>(name: &str, ties: &[T]) -> String {
    if ties.is_empty() {
        return name.to_owned();
    }
    let ties: Vec<&str> = ties.iter().map(AsRef::as_ref).collect();
    format!("{name} (or {})", ties.join(" or "))
}

fn faults(findings: &Findings) -> String {
    let mut kinds: Vec<(String, Vec<&Integrity>)> = Vec::new();
    for fault in &findings.integrity {
        let called = or(fault.name, &fault.indistinguishable_from);
        match kinds.iter_mut().find(|(name, _)| *name == called) {
            Some((_, all)) => all.push(fault),
            None => kinds.push((called, vec![fault])),
        }
    }
    let words = kinds.iter().map(|(name, all)| {
        let largest = all.iter().filter_map(|fault| fault.size);
        let largest = largest.max_by(|a, b| a.value.total_cmp(&b.value));
        let mut notes = Vec::new();
        if all.len() > 1 {
            notes.push(format!("{} times", all.len()));
        }
        notes.extend(largest.map(|size| match (size.gap, all.len()) {
            (Some(gap), _) => format!(
                "turns miss gravity by {} rms, {gap:.1} times what the noise of the readings makes of them",
                of_fault(size)
            ),
            (None, 1) => of_fault(size),
            (None, _) => format!("up to {}", of_fault(size)),
        }));
        match notes.as_slice() {
            [] => name.clone(),
            notes => format!("{name} ({})", notes.join(", ")),
        }
    });
    format!(
        "the recording itself is at fault: {}",
        words.collect::<Vec<_>>().join(", ")
    )
}

/// The size of a fault in the unit that people read it in.
fn of_fault(size: Size) -> String {
    let (factor, unit) = match size.unit {
        "rad" => unit_of(Channel::Direction),
        "rad/s" => unit_of(Channel::StaticRate),
        _ => unit_of(Channel::StaticNorm),
    };
    let value = factor * size.value;
    let space = if unit == "°" { "" } else { " " };
    format!("{}{space}{unit}", show::figures(value, 2))
}

/// What remains; `is_explained` by a formula.
fn unexplained(rest: &Unexplained, is_explained: bool) -> String {
    let by = match is_explained {
        true => ", though the formula below does",
        false => "",
    };
    format!(
        "something remains that no effect of the catalogue explains{by}: {}",
        remains(rest)
    )
}

/// What remains, with its size: `accelerometer: fine pattern over orientation (gap 1.03 …)`.
pub fn remains(rest: &Unexplained) -> String {
    // A shape in a few rows shows where the channel as a whole is within its noise.
    let gap = if rest.size > 1.0 {
        let (factor, unit) = unit_of(rest.channel);
        let rms = rest.rms.map_or_else(String::new, |rms| {
            format!(", {} {unit} rms", show::figures(factor * rms, 3))
        });
        format!(
            "gap {:.2} of the {}{rms}, ",
            rest.size,
            rest.channel.words()
        )
    } else {
        String::new()
    };
    let degrees = match rest.dof.max(1.0).round() as usize {
        1 => "one degree of freedom".to_owned(),
        dof => format!("{dof} degrees of freedom"),
    };
    let chi2 = format!("chi² {:.0} of {degrees}", rest.statistic);
    let p = show::probability(rest.p_value);
    format!("{} ({gap}{chi2}, {p})", rest.shape)
}

/// What is proposed, in sentences.
pub fn proposed(proposal: &Proposal) -> String {
    let instead = match proposal.alternatives.as_slice() {
        [] => "another formula may do as well".to_owned(),
        [one] => format!("these recordings cannot tell it from {one}"),
        [one, two] => format!("these recordings cannot tell it from {one} or {two}"),
        [one, two, others @ ..] => format!(
            "these recordings cannot tell it from {one} or {two}, nor from {} more",
            others.len()
        ),
    };
    format!(
        "Proposed: {} takes the gap of the {} on intervals left out from {} ({} among all formulas of \
         as many terms; selected by {:.0} % of the halves of the recording). It is no name: {instead}.",
        proposal.equation,
        proposal.channel.words(),
        gaps(proposal.held_out_gap_before, proposal.held_out_gap_after).join(" to "),
        show::probability(proposal.adjusted_p_value),
        100.0 * proposal.stability
    )
}

/// Two gaps with two decimals, or as many as tell them apart, five at most.
pub fn gaps(before: f64, after: f64) -> [String; 2] {
    let written = |decimals: usize| [before, after].map(|gap| format!("{gap:.decimals$}"));
    let differ = |pair: &[String; 2]| pair[0] != pair[1];
    (2..5)
        .map(written)
        .find(differ)
        .unwrap_or_else(|| written(5))
}

/// What a recording must have for effects to show whose names contain one of the first.
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
        "more orientations, edges and corners among them",
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

/// What to record next, the most telling first.
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
                "To tell {} from {}: {recording}.{plan}",
                effect.name,
                effect.indistinguishable_from.join(" and ")
            ));
        }
    }
    for fault in &findings.integrity {
        if let Some(remedy) = fault.remedy {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_gaps_have_the_decimals_that_tell_them_apart() {
        assert_eq!(gaps(1.28, 0.96), ["1.28", "0.96"]);
        assert_eq!(gaps(1.0021, 1.0004), ["1.002", "1.000"]);
        assert_eq!(gaps(1.0, 1.0), ["1.00000", "1.00000"]);
    }

    #[test]
    fn a_fault_is_said_in_the_unit_that_people_read() {
        let size = |value, unit| Size {
            value,
            unit,
            gap: None,
        };
        assert_eq!(of_fault(size(0.0187, "rad")), "1.1°");
        assert_eq!(of_fault(size(0.0213, "m/s^2")), "21 mm/s²");
    }
}
