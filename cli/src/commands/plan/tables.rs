//! A plan in the terminal.

use std::fmt::Write as _;

use plan::{Plan, Prediction, Step, Words, parameter_names};

use super::known::Input;
use super::rivals::Row;
use super::units::unit_of;
use crate::show;

/// Columns that text is wrapped at.
const WIDTH: usize = 78;

/// The plan.
pub fn text(
    plan: &Plan,
    input: Option<&Input>,
    ties: &[Row],
    notes: &[String],
    force_only: bool,
) -> String {
    let mut text = String::new();
    let mut open: &[&str] = &[];
    if let Some(found) = input.and_then(|input| input.coverage.as_ref()) {
        open = &found.unknown;
        let unknown = match found.unknown.as_slice() {
            [] => "every parameter of the accelerometer is determined".into(),
            names => format!("not known: {}", names.join(", ")),
        };
        push(&mut text, "", &format!("{}; {unknown}.", found.found()));
        text.push('\n');
    }
    // What the words mean comes before them.
    if let Some(legend) = notes.first() {
        push(&mut text, "", legend);
        text.push('\n');
    }
    for (k, step) in plan.steps.iter().enumerate() {
        push(
            &mut text,
            &format!("{:>3}. ", k + 1),
            &instruction(step, force_only),
        );
    }
    let _ = writeln!(
        text,
        "\n{} in all.\n",
        show::counted((plan.duration / 60.0).ceil() as usize, "minute")
    );
    if ties.is_empty() {
        let _ = writeln!(text, "{}\n", errors(plan, open, force_only));
    } else {
        let _ = writeln!(text, "{}\n", separations(ties));
    }
    for note in notes.iter().skip(1) {
        push(&mut text, "", note);
    }
    text
}

/// One placement as a sentence, in the order in which it is done: the turn, then what it comes to.
pub fn instruction(step: &Step, force_only: bool) -> String {
    let turn = step.turn_words.as_ref().filter(|_| !force_only);
    let Some(turn) = turn else {
        return format!("{} ({}).", show::capital(&step.words), step.axes);
    };
    // Faces have names that everybody knows; a tilt is said by the turn and its axes.
    let parts: Vec<f64> = step
        .up
        .into_iter()
        .map(f64::abs)
        .filter(|c| *c > 1e-6)
        .collect();
    let alike = parts.iter().all(|c| (c - parts[0]).abs() < 1e-6);
    let there = match (parts.len(), alike) {
        (2 | 3, true) => step.axes.clone(),
        _ => format!("{} ({})", step.words, step.axes),
    };
    format!("{}: {there}.", show::capital(turn))
}

/// Explains the words of a plan and the static times.
pub fn legend(plan: &Plan, force_only: bool, words: Words) -> Vec<String> {
    let mut rests: Vec<String> = plan
        .steps
        .iter()
        .map(|s| format!("{:.0}\u{a0}s", s.rest))
        .collect();
    rests.dedup();
    let wait = match rests.as_slice() {
        [first, later, ..] => {
            format!(
                "Let go of it, and leave it {first} in the first placement, {later} in each other."
            )
        }
        [one] => format!("Let go of it, and leave it {one} in each placement."),
        [] => return Vec::new(),
    };
    let mut all = vec![wait];
    if words == Words::Phone {
        all.push("x points to the right of the screen, y to its top, z out of it.".into());
    }
    let said = |what: &str| {
        let turns = plan.steps.iter().filter_map(|s| s.turn_words.as_ref());
        !force_only && turns.into_iter().any(|words| words.contains(what))
    };
    if said("half up") || said("half down") {
        all.push("Half up is 45°: lean it against something.".into());
    }
    if said("corner") || said("shortest way") {
        all.push("Where several axes are named, each is as far up or down as the others.".into());
    }
    if said("spin it") {
        all.push("Spin it: turn it on the spot, about the vertical.".into());
    }
    vec![all.join(" ")]
}

/// Adds words wrapped, lines after the first indented like it.
fn push(text: &mut String, begin: &str, words: &str) {
    let indent = " ".repeat(begin.chars().count());
    let mut line = begin.to_owned();
    // Not at a space that keeps a number and its unit together.
    for word in words.split([' ', '\n']).filter(|word| !word.is_empty()) {
        if line.chars().count() + 1 + word.chars().count() > WIDTH
            && line.trim().len() > begin.trim().len()
        {
            let _ = writeln!(text, "{}", line.trim_end());
            line.clone_from(&indent);
        }
        line.push_str(word);
        line.push(' ');
    }
    let _ = writeln!(text, "{}", line.trim_end());
}

/// Builds the table of the separation of tied effects before and after the plan.
fn separations(ties: &[Row]) -> comfy_table::Table {
    let mut table = show::table(&["named", "tied to", "before", "after", "told apart"]);
    let figure = |v: f64| {
        if v < 1000.0 {
            format!("{v:.1}")
        } else {
            "> 1000".into()
        }
    };
    for tie in ties {
        table.add_row([
            tie.named.clone(),
            tie.tied_to.clone(),
            figure(tie.before),
            figure(tie.after),
            tie.told_apart.words().into(),
        ]);
    }
    table
}

/// The standard errors before and after, those before that are `open` without a number.
fn errors(plan: &Plan, open: &[&str], force_only: bool) -> comfy_table::Table {
    let mut table = show::table(&["standard error", "unit", "before", "after"]);
    let number = |v: Option<&f64>, factor: f64| {
        v.filter(|v| v.is_finite())
            .map_or("open".into(), |v| show::rounded(v * factor, 3))
    };
    for (k, name) in parameter_names().iter().enumerate() {
        if force_only && name.starts_with("gyro") {
            continue;
        }
        let (factor, unit) = unit_of(name);
        let of = |p: &Prediction| number(p.standard_errors.get(k), factor);
        let before = match open.contains(&name.as_str()) {
            true => "open".into(),
            false => of(&plan.before),
        };
        table.add_row([name.clone(), unit.into(), before, of(&plan.after)]);
    }
    let of = |v: f64, factor: f64| number(Some(&v), factor);
    let reading = "a reading of 1 g, rms".to_owned();
    table.add_row([
        reading,
        "mm/s²".into(),
        of(plan.before.force_error, 1e3),
        of(plan.after.force_error, 1e3),
    ]);
    if !force_only {
        let reading = "a reading of 1 rad/s, rms".to_owned();
        table.add_row([
            reading,
            "mrad/s".into(),
            of(plan.before.rate_error, 1e3),
            of(plan.after.rate_error, 1e3),
        ]);
    }
    table
}
