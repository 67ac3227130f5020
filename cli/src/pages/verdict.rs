//! Is the calibration good, and what next: in sentences.

use ::findings::Front;
use calib::Calibration;
use calib::gravity::GravitySource;

use super::coverage::Coverage;
use super::disturbed::Disturbed;
use super::parameters;
use super::session::Session;
use crate::commands::calibrate::limits;
use crate::report::{Figure, Level};
use crate::show::{self, capital};

/// What warnings speak of, the gravest first, and what to do then.
const CAUSES: [(&[&str], &str); 7] = [
    (
        &["wrong time base", "unit rather than", "unit or"],
        "Check the unit and the sampling rate of the sensor named in the verdict: give --gyro-unit, --accel-unit or --rate, \
         then calibrate again.",
    ),
    (
        &["readings look like"],
        "Do not go by the pictures below: readings in a wrong unit fit as well as those in the right one.",
    ),
    (
        &["saturat", "cut off at the end of its range"],
        "Record again with a larger range of the sensor, or turn more slowly.",
    ),
    (
        &["touched", "pushed", "disturbed", "fit neither", "outl"],
        "Record again: let nothing touch or shake the device while it is still, and do not knock it while it turns.",
    ),
    (
        &["misfit of the"],
        "Let the program look for the effect in this recording: stillpoint discover RECORDING -o findings.json --report \
         findings.html",
    ),
    (
        &["placements", "orientations", "spare"],
        "Record more placements: see the directions that are missing below.",
    ),
    (
        &["no static interval", "quiet stretch"],
        "Lay the device down where nothing moves or turns, for at least three seconds each time.",
    ),
];

/// The places of a wrong unit, of a disturbance, of a misfit and of placements among the causes.
const UNIT: usize = 1;
const DISTURBED: usize = 3;
const MISFIT: usize = 4;
const PLACEMENTS: usize = 5;

/// The level, the sentence under it, and what to do.
#[derive(Clone, Debug, PartialEq)]
pub struct Judged {
    /// How good it is.
    pub level: Level,
    /// Why, in one sentence.
    pub sentence: String,
    /// What to do next.
    pub next: Vec<String>,
}

/// Judges a calibration by its gates and warnings.
pub fn judged(
    calibration: &Calibration,
    session: Option<&Session<'_>>,
    coverage: Option<&Coverage>,
) -> Judged {
    // A recording's name may be any word, and of one recording everybody knows it.
    let body = |message: &String| {
        session
            .map_or(message.as_str(), |s| s.body(message))
            .to_owned()
    };
    let said = calibration.warnings.texts(Front::CommandLine);
    let warnings: Vec<String> = said.iter().map(body).collect();
    let gravest_warning = gravest(&warnings);
    let cause = gravest_warning.map(|(cause, _)| cause);
    let mut next = Vec::new();
    let reasons = limits::reasons(calibration);
    let only = session.is_none_or(|s| s.parts.len() == 1);
    let sentence_of = |message: &String| match only {
        true => sentence_of(&body(message)),
        false => sentence_of(message),
    };
    let leave_out = |cause: Option<usize>, messages: &[String]| {
        let (causes, again) = CAUSES[DISTURBED];
        let session = session.filter(|_| cause == Some(DISTURBED))?;
        Some(Disturbed::in_session(session, messages, causes)?.advice(again))
    };
    let (level, mut sentence) = if let Some(gate) = reasons.first() {
        let by_gate = gravest(&[body(gate)]).map(|(cause, _)| cause).or(cause);
        let usual = || by_gate.map(|k| CAUSES[k].1.to_owned());
        let advice = leave_out(by_gate, &reasons).or_else(usual);
        let advice = advice.or_else(|| advice_in(gate));
        next.push(advice.unwrap_or("Record again, as the verdict says.".into()));
        (
            Level::Bad,
            format!("Do not use this calibration: {}", sentence_of(gate)),
        )
    } else if let Some((k, at)) = gravest_warning {
        let warning = &said[at];
        let disturbed = leave_out(cause, &said);
        next.push(disturbed.unwrap_or_else(|| advice(k, warning)));
        // A wrong unit or rate is in every figure of the sensor.
        if k <= UNIT {
            (
                Level::Bad,
                format!(
                    "Do not use this calibration yet: {}",
                    meaning(k, &sentence_of(warning))
                ),
            )
        } else {
            (
                Level::Care,
                format!("Usable with care: {}", meaning(k, &sentence_of(warning))),
            )
        }
    } else if let Some(warning) = said.iter().find(|w| !is_of_gravity(w)) {
        (
            Level::Care,
            format!("Usable with care: {}", sentence_of(warning)),
        )
    } else {
        let what = "The model explains the recording to within its measured noise";
        (Level::Good, format!("{what}; the calibration can be used."))
    };
    // Of another cause than a misfit the verdict names the intervals itself.
    let flagged = session.filter(|_| level == Level::Care && cause == Some(MISFIT));
    let flagged = flagged.map_or(Vec::new(), flagged_in);
    if !flagged.is_empty() {
        sentence = format!("{} Flagged: {}.", sentence, flagged.join("; "));
        next.insert(
            0,
            format!(
                "Look at {} in the pictures below. What was touched or moved there is to be left out: add --leave-out with \
                 an instant within it (s) to the command that made this page.",
                if flagged.len() == 1 { "the flagged static interval" } else { "the flagged static intervals" }
            ),
        );
    }
    if let Some(advice) = coverage.and_then(Coverage::advice) {
        next.push(advice);
    }
    let apply =
        "Correct recordings with the calibration: stillpoint apply cal.json OTHER -o corrected.csv";
    if level != Level::Bad && calibration.gravity_source == GravitySource::Assumed {
        next.push(
            "For better scale factors of the accelerometer calibrate again with the local gravity (--gravity) or the place \
             (--latitude, --altitude): gravity was assumed, and its error is in each of them."
                .into(),
        );
    }
    if level == Level::Care && cause == Some(MISFIT) {
        next.push(
            "Where it names an effect, findings.json takes the place of cal.json: stillpoint apply findings.json OTHER -o \
             corrected.csv. Where it names none, cal.json is the best that this model gives."
                .into(),
        );
    } else if level != Level::Bad {
        next.push(apply.into());
    }
    if level != Level::Bad {
        next.push(
            "To check it, record a second session in the same way: stillpoint evaluate SECOND --calibration cal=cal.json"
                .into(),
        );
    }
    Judged {
        level,
        sentence,
        next,
    }
}

/// A static interval that leaves so many times the median of all is flagged.
const STANDS_OUT: f64 = 4.0;
/// At most so many are named.
const NAMED: usize = 3;

/// Static intervals whose norm stands out from the others', the largest first, in words.
fn flagged_in(session: &Session<'_>) -> Vec<String> {
    let rests = session.rests.iter();
    let mut left: Vec<(f64, &str)> = rests
        .filter_map(|r| Some((r.left?, r.key.as_str())))
        .collect();
    left.sort_by(|a, b| b.0.abs().total_cmp(&a.0.abs()));
    let Some((median, _)) = left.get(left.len() / 2).copied() else {
        return Vec::new();
    };
    let out = left
        .iter()
        .take_while(|(v, _)| v.abs() > STANDS_OUT * median.abs());
    let words = out.map(|(v, key)| {
        format!(
            "static interval {key} ({v:+.1} mm/s² where the median is {:.1})",
            median.abs()
        )
    });
    words.take(NAMED).collect()
}

/// Raw to calibrated residual, weakest parameter, coverage.
pub fn figures(
    calibration: &Calibration,
    session: &Session<'_>,
    coverage: Option<&Coverage>,
) -> Vec<Figure> {
    let mut all = vec![residual(session)];
    all.extend(parameters::weakest(calibration));
    all.extend(coverage.map(|c| Figure::new("Directions covered", c.value(), c.note())));
    all
}

/// What is left of the raw readings' misfit.
pub fn residual(session: &Session<'_>) -> Figure {
    let rms = |all: Vec<f64>| {
        let squares: f64 = all.iter().map(|v| v * v).sum();
        (!all.is_empty()).then(|| (squares / all.len() as f64).sqrt())
    };
    let (rests, turns) = (&session.rests, &session.turns);
    let norm = [
        rms(rests.iter().filter_map(|r| r.raw).collect()),
        rms(rests.iter().filter_map(|r| r.left).collect()),
    ];
    let direction = [
        rms(turns.iter().filter_map(|t| t.raw).collect()),
        rms(turns.iter().filter_map(|t| t.left).collect()),
    ];
    let arrow = |[raw, left]: [Option<f64>; 2], unit: &str| match (raw, left) {
        (Some(raw), Some(left)) => Some(format!(
            "{} → {}{unit}",
            show::figures(raw, 3),
            show::figures(left, 3)
        )),
        (None, Some(one)) => Some(format!("{}{unit}", show::figures(one, 3))),
        (Some(one), None) => Some(format!("raw {}{unit}", show::figures(one, 3))),
        (None, None) => None,
    };
    let used = turns.iter().filter(|t| t.raw.or(t.left).is_some()).count();
    let through =
        arrow(direction, "°").map(|text| format!("; direction through {used} turns {text}"));
    match arrow(norm, " mm/s²") {
        Some(value) => {
            let note = format!(
                "norm of {} static intervals{}",
                rests.len(),
                through.unwrap_or_default()
            );
            Figure::new("Residual, raw → calibrated", value, note)
        }
        None => {
            let value = arrow(direction, "°").unwrap_or("none".into());
            Figure::new(
                "Residual, raw → calibrated",
                value,
                format!("direction through {used} turns"),
            )
        }
    }
}

/// What to do about a cause: of placements what the warning itself says, where it does.
fn advice(cause: usize, warning: &str) -> String {
    let usual = CAUSES[cause].1;
    match cause {
        UNIT => format!(
            "Add {} to the command that made this page, and take the calibration that this gives. {usual}",
            unit_option(warning)
        ),
        PLACEMENTS => {
            let own =
                advice_in(warning).filter(|own| own.starts_with("Use ") || own.starts_with("Add "));
            own.unwrap_or(usual.into())
        }
        _ => usual.into(),
    }
}

/// The option that says the unit which a warning about readings names.
fn unit_option(warning: &str) -> &'static str {
    let looks = warning.split("look like ").nth(1).unwrap_or("");
    match (warning.contains("gyroscope"), looks) {
        (true, looks) if looks.starts_with("rad") => "--gyro-unit rad/s",
        (true, _) => "--gyro-unit deg/s",
        (false, looks) if looks.starts_with("m/s") => "--accel-unit m/s^2",
        (false, _) => "--accel-unit g",
    }
}

/// What a cause means, and its figures: the warning's first sentence.
fn meaning(cause: usize, sentence: &str) -> String {
    match cause {
        MISFIT => {
            let size = sentence
                .split_once(": ")
                .and_then(|(_, more)| more.split(" rms").next());
            let size = size.unwrap_or("as much");
            format!(
                "an effect is missing in the model. {} Corrected readings may be off by {size} and more.",
                capital(sentence)
            )
        }
        UNIT => {
            let looks = sentence.split(": ").next().unwrap_or(sentence);
            format!("the unit is wrong or not stated, as {looks}.")
        }
        _ => sentence.to_owned(),
    }
}

/// The gravest cause that warnings speak of, and the place of the first that does.
fn gravest(warnings: &[String]) -> Option<(usize, usize)> {
    CAUSES.iter().enumerate().find_map(|(k, (words, _))| {
        let speaks = |w: &String| !is_of_gravity(w) && words.iter().any(|word| w.contains(word));
        Some((k, warnings.iter().position(speaks)?))
    })
}

/// Whether a warning only says that gravity was assumed.
fn is_of_gravity(warning: &str) -> bool {
    warning.starts_with("gravity") || warning.contains("--gravity")
}

/// The advice after the semicolon of a message.
pub fn advice_in(message: &str) -> Option<String> {
    let (_, advice) = message.rsplit_once("; ")?;
    let advice = advice.trim().trim_end_matches('.');
    Some(format!("{}.", capital(advice)))
}

/// The first sentence of a message without its heading and without odds, which the warnings have in full.
fn sentence_of(message: &str) -> String {
    let end = message.find(". ").unwrap_or(message.len());
    let mut short = String::new();
    let mut remaining = message[..end].trim_end_matches('.');
    while let Some((before, inside, after)) = brackets(remaining) {
        short.push_str(before);
        let has_odds = ["p = ", "p < ", "by chance"]
            .iter()
            .any(|odds| inside.contains(odds));
        if !has_odds {
            short.push_str(&format!(" ({inside})"));
        }
        remaining = after;
    }
    short.push_str(remaining);
    let is_closed = short.ends_with('?');
    short + if is_closed { "" } else { "." }
}

/// What comes before the first brackets, what is in them, and what comes after.
fn brackets(text: &str) -> Option<(&str, &str, &str)> {
    let (before, more) = text.split_once(" (")?;
    let (inside, after) = more.split_once(')')?;
    Some((before, inside, after))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_gravest_warning_is_named_and_gravity_is_none() {
        let warnings = [
            "--gravity was not given".to_owned(),
            "misfit of the norm: 3".to_owned(),
            "the scale is 0.49: a wrong time base or unit".to_owned(),
        ];
        assert_eq!(gravest(&warnings), Some((0, 2)));
        assert_eq!(gravest(&warnings[..2]), Some((MISFIT, 1)));
        assert_eq!(gravest(&warnings[..1]), None);
    }

    #[test]
    fn the_unit_that_readings_look_like_is_the_one_to_state() {
        for (warning, option) in [
            (
                "the accelerometer's readings look like units of g: T",
                "--accel-unit g",
            ),
            (
                "the accelerometer's readings look like m/s² that were read as units of g",
                "--accel-unit m/s^2",
            ),
            (
                "the gyroscope's readings look like degrees per second: T",
                "--gyro-unit deg/s",
            ),
            (
                "the gyroscope's readings look like rad/s that were read as degrees per second",
                "--gyro-unit rad/s",
            ),
        ] {
            assert_eq!(unit_option(warning), option);
        }
    }

    #[test]
    fn the_verdict_has_the_figures_of_a_message_and_not_its_odds() {
        assert_eq!(
            sentence_of(
                "static interval 10 (t = 1 to 2 s) disagrees by 61 mm/s² (by chance in 2e-16 of recordings): \
                 was it touched?"
            ),
            "static interval 10 (t = 1 to 2 s) disagrees by 61 mm/s²: was it touched?"
        );
        assert_eq!(
            sentence_of("misfit of the norm: 3 mm/s² (5 times the noise, p = 2e-9). It depends on"),
            "misfit of the norm: 3 mm/s²."
        );
    }

    #[test]
    fn advice_is_what_follows_the_semicolon() {
        assert_eq!(
            advice_in("too few; add placements").unwrap(),
            "Add placements."
        );
        assert_eq!(advice_in("too few"), None);
    }
}
