//! The verdict, the largest misfit first.

use calib::discover::{Channel, EffectFinding, Findings, Integrity, Size, Unexplained, Verdict};

use super::words::{gaps, or, unit_of};
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

/// Returns a clause on the largest angle that turns may have lost between samples, ° rms; empty if there is none.
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
    let names: Vec<String> = effects
        .iter()
        .map(|effect| or(&effect.name, &effect.indistinguishable_from))
        .collect();
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

/// Returns the gap of the channel without one effect and with it, in words.
fn taken_by(what: &str, effect: &EffectFinding) -> String {
    format!(
        "{what} takes the gap of the {} from {} ({}left out: {})",
        effect.channel.words(),
        gaps(effect.gap_before, effect.gap_after).join(" to "),
        in_units(effect),
        gaps(effect.held_out_gap_before, effect.held_out_gap_after).join(" to "),
    )
}

/// Returns the gap of a channel with all of its effects, and without each of them, in words.
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

fn faults(findings: &Findings) -> String {
    let mut kinds: Vec<(String, Vec<&Integrity>)> = Vec::new();
    for fault in &findings.integrity {
        let called = or(&fault.name, &fault.indistinguishable_from);
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
        "s" => (1e3, "ms"),
        "rad" => unit_of(Channel::Direction),
        "rad/s" => unit_of(Channel::StaticRate),
        _ => unit_of(Channel::StaticNorm),
    };
    let value = factor * size.value;
    let space = if unit == "°" { "" } else { " " };
    format!("{}{space}{unit}", show::figures(value, 2))
}

/// Returns the verdict on an unexplained remainder; `is_explained` if a formula explains it.
fn unexplained(rest: &Unexplained, is_explained: bool) -> String {
    let by = match is_explained {
        true => ", though the formula below does",
        false => "",
    };
    if let Some(recording) = &rest.recording {
        return format!(
            "something remains that {} shows alone{by}: {}; `discover` with that recording only may name it",
            show::name(recording),
            remains(rest)
        );
    }
    match &rest.fitted_by {
        Some(effect) => format!(
            "something remains that is described and not named{by}: {}; `calibrate --effects {effect}` fits it",
            remains(rest)
        ),
        None => format!(
            "something remains that no effect of the catalogue explains{by}: {}",
            remains(rest)
        ),
    }
}

/// Returns the remainder with its size: `accelerometer: fine pattern over orientation (gap 1.03 …)`.
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
    format!("{} ({gap}{chi2}, {p})", rest.shape())
}

#[cfg(test)]
mod tests {
    use super::*;

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
