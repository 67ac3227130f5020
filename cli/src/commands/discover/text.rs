//! Findings for the terminal: the verdict, the tables and what to do next.

use ::findings::Front;
use std::fmt::Write as _;

use calib::discover::Discovery;
use comfy_table::CellAlignment;

use super::advice::next_recordings;
use super::alternatives::{beside, ties};
use super::tables::{
    Rows, disagreement, evidence, faults, gaps, never_visible, not_observable, of_the_earth,
    parameters, proposed_terms, ranking, reference, validated,
};
use super::verdict::verdict;
use super::words::{self, proposed};
use crate::commands::calibrate::clocks;
use crate::commands::shared::names::Names;
use crate::{show, terminal};

/// Why a chance is not that of the likelihood ratio.
const P_OF_WALKS: &str = "p averages over what the random walk of the biases may be, the likelihood ratio takes the likeliest. The last \
                          column allows for the effects and places that were tried.\n";

/// Explanation of the criterion for naming an effect.
const NAMED_WHERE: &str = "Each on its own. An effect is named where p stays below --alpha beside all else that is named, and neither a \
                           shape of the remainder nor a bias that flickers explains as much.\n";

/// The tables for people.
pub fn text(discovery: &Discovery, names: &Names) -> String {
    let findings = &discovery.findings;
    let gates = findings.calibration.failed_gates.iter();
    let gates = gates.map(|gate| {
        format!(
            "Not to be used as it is: {}.\n\n",
            gate.text(Front::CommandLine)
        )
    });
    let mut text: String = gates.collect();
    let _ = writeln!(text, "{}", names.short(&verdict(findings)));
    push(&mut text, shortened(gaps(findings), names), 3);
    if !findings.effects.is_empty() {
        let _ = writeln!(text, "{}", words::by_chance(&findings.effects));
    }
    lines(&mut text, names.all_short(&validated(findings)));
    push(&mut text, evidence(findings), 1);
    if !findings.effects.is_empty() {
        text.push_str(P_OF_WALKS);
    }
    for effect in &findings.effects {
        let header = [effect.name.as_str(), "value", "std error", "unit"];
        let table = show::table_of(&header, parameters(effect));
        let _ = writeln!(text, "\n{table}");
        let more = reference(effect).or_else(|| of_the_earth(effect));
        text.extend(more.map(|line| format!("{line}\n")));
    }
    if let Some(proposal) = &findings.proposed {
        let header = ["proposed", "value", "std error", "unit"];
        let table = show::table_of(&header, proposed_terms(proposal));
        let _ = writeln!(text, "\n{}\n\n{table}", proposed(proposal));
    }
    push(&mut text, faults(findings), 4);
    push(&mut text, shortened(disagreement(findings), names), 1);
    if findings.effects.is_empty() {
        push(&mut text, ranking(findings), 1);
        text.push_str(NAMED_WHERE);
    }
    lines(&mut text, ties(findings));
    lines(&mut text, beside(findings));
    let _ = writeln!(text, "\n{}", words::bias_noise(findings));
    text.push_str(&names.short(&clocks::text(&findings.calibration)));
    lines(&mut text, next_recordings(findings));
    lines(&mut text, not_observable(findings, terminal::is_verbose()));
    lines(&mut text, never_visible(findings));
    text
}

/// Rows in which recordings have their short names.
fn shortened<const N: usize>((header, rows): Rows<N>, names: &Names) -> Rows<N> {
    let rows = rows
        .into_iter()
        .map(|row| row.map(|cell| names.short(&cell)));
    (header, rows.collect())
}

/// Appends lines after an empty one; nothing where there are none.
fn lines(text: &mut String, all: impl IntoIterator<Item = String>) {
    for (k, line) in all.into_iter().enumerate() {
        let above = if k == 0 { "\n" } else { "" };
        let _ = writeln!(text, "{above}{line}");
    }
}

/// Appends a table, its first `left` columns aligned left; nothing where it has no rows.
fn push<const N: usize>(text: &mut String, (header, rows): Rows<N>, left: usize) {
    if rows.is_empty() {
        return;
    }
    let mut table = show::table(&header);
    for column in table.column_iter_mut().take(left) {
        column.set_cell_alignment(CellAlignment::Left);
    }
    let names = rows.iter().map(|row| row[0].as_str());
    show::keep_names_whole(&mut table, names);
    table.add_rows(rows);
    let _ = writeln!(text, "\n{table}");
}
