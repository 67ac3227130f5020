//! Instructions in words.

use live::{Direction, Errors, Event, Instruction, PROMISE, Shortfall, Verdict, View};

use crate::show;

/// Returns the instruction in a few words, and additional advice.
pub(super) fn instruction(instruction: &Instruction) -> [String; 2] {
    let two = |a: &str, b: &str| [a.to_owned(), b.to_owned()];
    match instruction {
        Instruction::Wait => two("Waiting for samples", ""),
        Instruction::LayDown => two(
            "Lay it down and let go",
            "Any face will do for the first placement.",
        ),
        Instruction::Hold { remaining } => [
            format!("Hold still … {} s", remaining.ceil()),
            "Do not touch it.".to_owned(),
        ],
        Instruction::Turn { to, last } => [
            format!("{}: turn it, {}", verdict(*last), axes(to)),
            hint(to),
        ],
        Instruction::LetGo { .. } => two(
            "Let go of it",
            "It wavers as in a hand: lay it down, or lean it against something.",
        ),
        Instruction::Shaken => two(
            "Shaking",
            "What it lies on vibrates: lay it on something firm.",
        ),
        Instruction::TooFast { axis, .. } => [
            "Too fast".to_owned(),
            format!(
                "The gyroscope is at the end of its range about {}: turn more slowly.",
                name(*axis)
            ),
        ],
        Instruction::Paused => two("Paused", "Start the measurement on the phone again."),
        Instruction::Reconnecting => two(
            "No answer",
            "Trying again. Keep the phone's screen on and stay in the network.",
        ),
        Instruction::Enough => [
            "Enough: you can pick it up".to_owned(),
            format!("Both sensors are known as promised: {}.", promise()),
        ],
        Instruction::Short { of } => [
            "Ended, and less is known than promised".to_owned(),
            short(of),
        ],
        other => [format!("{other:?}"), String::new()],
    }
}

fn verdict(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Good => "Good",
        Verdict::GoodToo => "Good too",
        Verdict::Repeated => "Worth little",
    }
}

/// Returns the promised accuracy, in words.
pub(super) fn promise() -> String {
    format!(
        "scale to {} %, misalignment to {} mrad ({:.1}°)",
        show::figures(PROMISE.scale * 1e2, 1),
        show::figures(PROMISE.misalignment * 1e3, 1),
        PROMISE.misalignment.to_degrees()
    )
}

/// Returns the shortfall from the promise and the advice, in words.
fn short(of: &Shortfall) -> String {
    let sensor = if of.gyroscope {
        "gyroscope"
    } else {
        "accelerometer"
    };
    let (what, factor, unit) = match of.misalignment {
        true => ("misalignment", 1e3, "mrad"),
        false => ("scale", 1e2, "%"),
    };
    let helps = match of.gyroscope {
        true => "Record again with larger turns about each of its axes.",
        false => "Record again with each face up once, and tilts between them.",
    };
    format!(
        "The {what} of the {sensor} is known to {} {unit}, not to {} {unit}. {helps}",
        show::figures(of.error * factor, 2),
        show::figures(of.promised * factor, 1)
    )
}

fn name(axis: usize) -> &'static str {
    ["x", "y", "z"].get(axis).copied().unwrap_or("an axis")
}

/// `z up`, `x up and z down`.
pub(super) fn axes(direction: &Direction) -> String {
    plan::axes_up(&direction.unit())
}

/// The same for a phone, whose x points right, y to its top and z out of its screen.
pub(super) fn hint(direction: &Direction) -> String {
    const RESTS_ON: [[&str; 2]; 3] = [
        ["its right long edge", "its left long edge"],
        ["its top edge", "its bottom edge"],
        ["its screen", "its back"],
    ];
    let part = |(k, sign): (usize, &i8)| (*sign != 0).then(|| RESTS_ON[k][usize::from(*sign > 0)]);
    let parts: Vec<&str> = direction
        .signs
        .iter()
        .enumerate()
        .filter_map(part)
        .collect();
    match parts.as_slice() {
        [one] => format!("A phone: on {one}."),
        [one, two] => format!("A phone: leant halfway between {one} and {two}."),
        [one, two, three] => {
            format!("A phone: leant on the corner between {one}, {two} and {three}.")
        }
        _ => String::new(),
    }
}

/// `scale 120 ppm, misalignment 0.31 mrad, bias 1.2 mg`.
pub(super) fn errors(errors: &Errors, gyroscope: bool) -> String {
    let bias = match gyroscope {
        true => format!(
            "{} °/h",
            show::figures(errors.bias.to_degrees() * 3600.0, 2)
        ),
        false => format!("{} mg", show::figures(errors.bias / 9.80665 * 1e3, 2)),
    };
    format!(
        "scale {} ppm, misalignment {} mrad, bias {bias}",
        show::figures(errors.scale * 1e6, 2),
        show::figures(errors.misalignment * 1e3, 2)
    )
}

/// Returns the current standard errors, a line for each sensor.
pub(super) fn known(view: &View) -> [String; 2] {
    let line = |which: &Option<Errors>, gyroscope| match which {
        Some(e) => format!("± {}", errors(e, gyroscope)),
        None => "not determined yet".to_owned(),
    };
    [
        line(&view.estimate.accelerometer, false),
        line(&view.estimate.gyroscope, true),
    ]
}

/// Returns the event of the source in words; `None` if the instruction states it.
pub(super) fn event(event: &Event) -> Option<String> {
    match event {
        Event::Connected { name } => Some(format!("connected: {name}")),
        Event::Resumed { seconds } => Some(format!(
            "measuring again after {seconds:.1} s; the turn in the pause is not used"
        )),
        Event::Reconnecting { attempts: 1, cause } => Some(format!("no answer ({cause})")),
        Event::Reconnected => {
            Some("it answers again; nothing is lost that the phone has kept".to_owned())
        }
        Event::Restarted => Some(
            "the phone's data were cleared: beginning anew; what came before is kept".to_owned(),
        ),
        Event::NotUnderstood { reason } => Some(format!(
            "not understood yet: {reason}; go on turning it and laying it down"
        )),
        Event::Ended => Some("nothing comes any more".to_owned()),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_are_named_by_axes_and_for_a_phone() {
        let face = Direction { signs: [0, 1, 0] };
        let edge = Direction { signs: [1, 0, -1] };
        assert_eq!(
            (axes(&face).as_str(), axes(&edge).as_str()),
            ("y up", "x up and z down")
        );
        assert_eq!(hint(&face), "A phone: on its bottom edge.");
        assert_eq!(
            hint(&edge),
            "A phone: leant halfway between its left long edge and its screen."
        );
        for direction in Direction::all() {
            let said = instruction(&Instruction::Turn {
                to: direction,
                last: Verdict::Repeated,
            });
            assert!(
                said.iter().all(|line| line.chars().count() <= 110),
                "{said:?}"
            );
        }
    }

    #[test]
    fn what_adds_little_is_worth_little_and_what_is_short_is_said_with_the_promise() {
        let to = Direction { signs: [0, 1, 0] };
        let last = Verdict::Repeated;
        let said = instruction(&Instruction::Turn { to, last });
        assert_eq!(said[0], "Worth little: turn it, y up");
        let of = Shortfall {
            gyroscope: true,
            misalignment: true,
            error: 0.041,
            promised: PROMISE.misalignment,
        };
        let said = instruction(&Instruction::Short { of });
        assert!(
            said[1].starts_with(
                "The misalignment of the gyroscope is known to 41 mrad, not to 5 mrad."
            ),
            "{said:?}"
        );
        assert_eq!(promise(), "scale to 0.5 %, misalignment to 5 mrad (0.3°)");
    }

    #[test]
    fn errors_have_two_figures_in_the_units_of_people() {
        let e = Errors {
            scale: 1.234e-4,
            misalignment: 3.14e-4,
            bias: 1.2e-3,
        };
        assert_eq!(
            errors(&e, false),
            "scale 123 ppm, misalignment 0.31 mrad, bias 0.12 mg"
        );
        assert_eq!(
            errors(&e, true),
            "scale 123 ppm, misalignment 0.31 mrad, bias 248 °/h"
        );
    }
}
