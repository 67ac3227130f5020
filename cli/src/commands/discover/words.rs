//! Words that the tables, the verdict and the page share.

use calib::discover::{Channel, EffectFinding, Findings, Proposal};

use crate::show;

/// Explains a gap of 1, and the gaps by chance in the channels of the named effects.
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

/// `a (or b)`: what cannot be told from a name here.
pub fn or<T: AsRef<str>>(name: &str, ties: &[T]) -> String {
    if ties.is_empty() {
        return name.to_owned();
    }
    let ties: Vec<&str> = ties.iter().map(AsRef::as_ref).collect();
    format!("{name} (or {})", ties.join(" or "))
}

/// Describes the proposed formula, in sentences.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_gaps_have_the_decimals_that_tell_them_apart() {
        assert_eq!(gaps(1.28, 0.96), ["1.28", "0.96"]);
        assert_eq!(gaps(1.0021, 1.0004), ["1.002", "1.000"]);
        assert_eq!(gaps(1.0, 1.0), ["1.00000", "1.00000"]);
    }
}
