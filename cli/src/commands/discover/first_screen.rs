//! The first screen of a discovery: what is missing, how large it is, and what could not be told.

use ::findings::{Front, Kind, Remedy, gravest_first};
use calib::Recording;
use calib::discover::{Channel, Confirmation, EffectFinding, Findings, Integrity, Says, Verdict};
use calib::gravity::GravitySource;

use super::advice::against_faults;
use super::args::Args;
use super::size;
use super::tables;
use super::words::{gaps, unit_of};
use crate::call;
use crate::commands::calibrate::limits;
use crate::commands::shared::first_screen::{Screen, Step, apply_to, lines_of_failure, wrote};
use crate::commands::shared::names::Names;
use crate::pages::session::short_names;
use crate::show;
use crate::show::command_line;

/// Names, faults and ties that are said one by one.
const MOST: usize = 3;

/// Builds the first screen.
pub fn screen(
    args: &Args,
    findings: &Findings,
    recordings: &[Recording],
    remarks: &[String],
) -> Screen {
    let names = Names::of(recordings);
    let calibration = &findings.calibration;
    let reasons = limits::reasons(calibration);
    let mut all: Vec<String> = Vec::new();
    let mut said = Vec::new();
    let read = remarks.iter().cloned().map(|remark| (false, remark));
    let fitted = gravest_first(&calibration.warnings).into_iter();
    // What would be gained by the place is among the next steps.
    let fitted = fitted.map(|finding| {
        (
            finding.kind == Kind::GRAVITY_ASSUMED || finding.kind.is_of_a_search(),
            finding.text(Front::CommandLine),
        )
    });
    for (is_said, remark) in fitted.chain(read) {
        let list = if is_said { &mut said } else { &mut all };
        if !list.contains(&remark) {
            list.push(remark);
        }
    }
    let proposed = findings.proposed.as_ref();
    let written = args.output.as_deref().into_iter();
    let written = written.chain(proposed.and(args.emit_effect.as_deref()));
    let written = written.chain(args.pictures.paths());
    let tables = [named(findings), names.short(&open(findings))];
    Screen {
        verdict: vec![brief(findings)],
        tables: tables
            .into_iter()
            .filter(|table| !table.is_empty())
            .collect(),
        next: findings.calibration.next.clone().unwrap_or_default(),
        written: wrote(written, "Nothing was written; -o findings.json keeps it."),
        said,
        remarks: names.all_short(&all),
        reserved: lines_of_failure(&reasons),
        ..Screen::default()
    }
}

/// Words of a verdict, at most.
const WORDS: usize = 30;

/// The verdict in at most thirty words: how good the calibration is and why, the names, then what else was found.
pub fn brief(findings: &Findings) -> String {
    let verdict = findings.calibration.verdict();
    let mut sentences = vec![verdict.sentence()];
    sentences.extend(spoken_against(findings));
    if findings.verdict == Verdict::Nothing {
        sentences.push("Nothing is missing that could show here.".into());
    }
    let gravest = verdict.reasons.first().map(String::as_str);
    let mut found = gravest_first(&findings.calibration.warnings);
    found.retain(|own| own.kind.is_of_a_search() && Some(own.kind.name()) != gravest);
    found.sort_by_key(|own| own.kind != Kind::EFFECT_NAMED);
    sentences.extend(found.iter().map(|own| show::capital(&own.reason()) + "."));
    if findings.proposed.is_some() {
        sentences.push("A formula is proposed for what remains.".into());
    }
    let mut said = String::new();
    for sentence in sentences {
        let longer = format!("{said} {sentence}");
        let is_new = !said.contains(&sentence);
        if is_new && (said.is_empty() || longer.split_whitespace().count() <= WORDS) {
            said = longer;
        }
    }
    said.trim().to_owned()
}

/// The names that the validation recording speaks against, in a sentence.
fn spoken_against(findings: &Findings) -> Option<String> {
    let all = findings.confirmations.iter();
    let against: Vec<&Confirmation> = all.filter(|own| own.says == Says::SpeaksAgainst).collect();
    let names: Vec<String> = against.iter().map(|own| own.effect.clone()).collect();
    let recording = against.first()?.recording.as_str();
    let recording = short_names(&[recording]).pop()?;
    Some(format!("{recording} speaks against {}.", listed(&names)))
}

/// `a, b and c`; of many the first.
fn listed(names: &[String]) -> String {
    match names {
        [] => String::new(),
        [one] => one.clone(),
        [first @ .., last] if names.len() <= MOST => format!("{} and {last}", first.join(", ")),
        many => format!(
            "{} and {} more",
            many[..MOST - 1].join(", "),
            many.len() + 1 - MOST
        ),
    }
}

/// The channel in few words.
fn short(channel: Channel) -> &'static str {
    match channel {
        Channel::StaticNorm => "norm at rest",
        Channel::StaticRate => "rate at rest",
        Channel::Direction => "turns",
        Channel::MovingForce => "force in motion",
    }
}

/// The names, their sizes, and the gap before and after.
fn named(findings: &Findings) -> String {
    let mut rows = vec![["missing", "size", "gap of", "in the fit", "left out"].map(str::to_owned)];
    let arrow = |before: f64, after: f64| gaps(before, after).join(" → ");
    for effect in &findings.effects {
        rows.push([
            effect.name.clone(),
            size::of(effect, findings.calibration.gravity),
            short(effect.channel).into(),
            arrow(effect.gap_before, effect.gap_after),
            arrow(effect.held_out_gap_before, effect.held_out_gap_after),
        ]);
    }
    if let Some(proposal) = &findings.proposed {
        rows.push([
            "a formula".into(),
            show::counted(proposal.terms.len(), "term"),
            short(proposal.channel).into(),
            String::new(),
            arrow(proposal.held_out_gap_before, proposal.held_out_gap_after),
        ]);
    }
    if rows.len() == 1 {
        return String::new();
    }
    let width = |k: usize| {
        rows.iter()
            .map(|row| row[k].chars().count())
            .max()
            .unwrap_or(0)
    };
    let widths = [0, 1, 2, 3, 4].map(width);
    let line = |row: &[String; 5]| {
        let [a, b, c, d, e] = row;
        let [wa, wb, wc, wd, we] = widths;
        format!("  {a:<wa$}  {b:>wb$}  {c:<wc$}  {d:>wd$}  {e:>we$}")
    };
    let mut lines: Vec<String> = rows.iter().map(line).collect();
    let whole = lines
        .iter()
        .map(|line| line.chars().count())
        .max()
        .unwrap_or(0);
    if whole > crate::terminal::width() {
        // A long name leaves no room for what the size of the gap is of.
        let line = |row: &[String; 5]| {
            let [a, b, _, d, e] = row;
            let [wa, wb, _, wd, we] = widths;
            format!("  {a:<wa$} {b:>wb$} {d:>wd$} {e:>we$}")
        };
        lines = rows.iter().map(line).collect();
    }
    lines.push("  A gap of 1 is explained to the noise.".into());
    lines.join("\n")
}

/// Returns the undecided questions, a line or two each.
fn open(findings: &Findings) -> String {
    let mut lines = Vec::new();
    if let Some(proposal) = &findings.proposed {
        lines.push(format!("proposed, not named: {}", proposal.equation));
    }
    let alike = |effect: &EffectFinding, others: String| {
        let name = &effect.name;
        format!("{name} or {others}: not told apart by these recordings")
    };
    let tied = |effect: &&EffectFinding| !effect.indistinguishable_from.is_empty();
    let tied = findings.effects.iter().filter(tied);
    lines.extend(tied.map(|effect| alike(effect, effect.indistinguishable_from.join(" or "))));
    let of_a_form = |effect| Some(alike(effect, effect.forms.first()?.clone()));
    lines.extend(findings.effects.iter().filter_map(of_a_form));
    lines.extend(findings.confirmations.iter().map(tables::confirmed));
    if let Some(rest) = &findings.unexplained {
        let size = rest.rms.map_or_else(String::new, |rms| {
            let (factor, unit) = unit_of(rest.channel);
            format!(" ({} {unit} rms are left)", show::figures(factor * rms, 3))
        });
        let whose = rest.recording.iter();
        let whose: String = whose.map(|name| format!("in {name} alone: ")).collect();
        lines.push(format!("unexplained: {whose}{}{size}", rest.shape()));
    }
    lines.extend(faults(&findings.integrity));
    match findings.not_observable.len() {
        0 => {}
        1 => lines.push(format!(
            "could not have shown here: {}",
            findings.not_observable[0]
        )),
        n => lines.push(format!(
            "{n} effects could not have shown here (-v names them)"
        )),
    }
    let lines = lines
        .iter()
        .map(|line| show::wrapped(&format!("  • {line}")));
    lines.collect::<Vec<_>>().join("\n")
}

/// The faults of the recordings, a line for each kind.
fn faults(integrity: &[Integrity]) -> Vec<String> {
    let mut kinds: Vec<(&str, Vec<&Integrity>)> = Vec::new();
    for fault in integrity {
        match kinds.iter_mut().find(|(name, _)| *name == fault.name) {
            Some((_, all)) => all.push(fault),
            None => kinds.push((&fault.name, vec![fault])),
        }
    }
    let recordings: Vec<&str> = integrity
        .iter()
        .map(|fault| fault.recording.as_str())
        .collect();
    let mut whole = recordings.clone();
    whole.sort_unstable();
    whole.dedup();
    let called = short_names(&whole);
    let of = |fault: &Integrity| {
        let k = whole.iter().position(|name| *name == fault.recording);
        let recording = k.map_or("", |k| called[k].as_str());
        let kind = match fault.finding.place.turn {
            Some(_) => "turn",
            None => "interval",
        };
        match fault.interval {
            Some(k) => format!(
                "{recording}, {kind} {k} ({:.0} to {:.0} s)",
                fault.t0, fault.t1
            ),
            None => recording.to_owned(),
        }
    };
    let line = |(name, all): &(&str, Vec<&Integrity>)| {
        let places: Vec<String> = all.iter().map(|fault| of(fault)).collect();
        format!("{}: {}", name.replace('_', " "), listed(&places))
    };
    kinds.iter().map(line).collect()
}

/// States the next steps in commands that repeat this call's options; every output says the same.
pub fn state_next(args: &Args, findings: &mut Findings) {
    findings.calibration.next = Some(next(args, findings));
}

/// Commands for what comes next, the most telling first.
fn next(args: &Args, findings: &Findings) -> Vec<Step> {
    let given = args.output.as_deref().map(command_line);
    let document = given.clone().unwrap_or("findings.json".into());
    let inputs = args.recordings.command_line() + &args.read.command_line();
    let place = args.place.command_line() + &args.leave_out.command_line();
    let mut steps = Vec::new();
    if given.is_none() {
        let again = call::again(None, "", false, &document);
        steps.push(Step::new("keep the findings", again));
    }
    let tied = |effect: &&EffectFinding| effect.told_apart_by.is_some();
    if findings.effects.iter().any(|effect| tied(&effect)) {
        let by_temperature = |effect: &EffectFinding| {
            matches!(
                effect.told_apart_by,
                Some(Remedy::TemperatureCycles | Remedy::WarmAndCool)
            )
        };
        let warmed = match findings.effects.iter().any(by_temperature) {
            true => " --temperature",
            false => "",
        };
        steps.push(Step::new(
            "plan what tells them apart",
            format!("stillpoint plan {document}{warmed}"),
        ));
    }
    if !findings.effects.is_empty() && findings.validation.is_empty() {
        steps.push(Step::new(
            "see the names confirmed",
            format!("stillpoint discover {inputs}{place} --validation SECOND"),
        ));
    }
    let rest = findings.unexplained.as_ref();
    if let Some(effect) = rest.and_then(|rest| rest.fitted_by.as_ref()) {
        steps.push(Step::new(
            "fit what is not named",
            format!("stillpoint calibrate {inputs}{place} --effects {effect} -o cal.json"),
        ));
    }
    if findings.unexplained.is_some() && findings.effects.is_empty() {
        steps.push(Step::words(
            "Record the device once more: what returns with the same shape belongs to it, anything else to the day.",
        ));
    }
    steps.extend(against_faults(findings).next().map(Step::words));
    let calibration = &findings.calibration;
    if calibration.failed_gates.is_empty() {
        let one = args.recordings.first() + &args.read.command_line();
        steps.push(apply_to(&one, &document));
        if calibration.gravity_source == GravitySource::Assumed {
            let again = call::again(
                None,
                "--latitude DEG --altitude M",
                given.is_some(),
                &document,
            );
            steps.push(Step::new("give the place", again));
        }
    }
    steps
}
