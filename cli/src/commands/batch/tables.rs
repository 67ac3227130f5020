//! A batch as tables for people.

use batch::Record;
use batch::statistics::{Cause, cared, pareto, yields};
use serde_json::{Value, json};

use crate::{show, terminal};

/// Devices that are listed one by one.
const LISTED: usize = 40;
/// So many on the first screen.
const FIRST: usize = 16;
/// Characters of a reason in a table.
const REASON: usize = 52;

/// The devices of a run: those that failed first, then those to be used with care, all where they are few.
pub fn of_run(records: &[Record]) -> String {
    let mut table = show::table(&["device", "status", "exit", "reason"]);
    if let Some(column) = table.column_mut(3) {
        column.set_cell_alignment(comfy_table::CellAlignment::Left);
    }
    let mut shown: Vec<&Record> = records.iter().collect();
    shown.sort_by_key(|r| (r.exit == 0, r.care().is_none(), r.index));
    let most = if terminal::is_verbose() {
        LISTED
    } else {
        FIRST
    };
    for r in shown.iter().take(most) {
        let reason = match r.care() {
            Some(why) => format!("with care: {why}"),
            None => r.reasons.first().cloned().unwrap_or_default(),
        };
        table.add_row([
            short(&r.id, 12),
            r.status.name().into(),
            r.exit.to_string(),
            short(&reason, 37),
        ]);
    }
    let more = match records.len().saturating_sub(most) {
        0 => String::new(),
        n => format!("… and {n} more (-v lists {LISTED})\n"),
    };
    if terminal::is_quiet() {
        return summary(records);
    }
    format!("{}\n\n{table}\n{more}", summary(records))
}

/// Yield and reasons.
pub fn of_all(records: &[Record]) -> String {
    let mut causes = pareto(records);
    causes.extend(cared(records).into_iter().map(|cause| Cause {
        words: format!("with care: {}", cause.words),
        ..cause
    }));
    if causes.is_empty() {
        return summary(records);
    }
    let mut table = show::table(&["devices", "share", "reason", "example"]);
    for column in [2, 3] {
        if let Some(column) = table.column_mut(column) {
            column.set_cell_alignment(comfy_table::CellAlignment::Left);
        }
    }
    let most = if terminal::is_verbose() {
        LISTED
    } else {
        FIRST
    };
    for cause in causes.iter().take(most) {
        let share = 100.0 * cause.count as f64 / records.len() as f64;
        let words = short(&cause.words, REASON - 12);
        table.add_row([
            cause.count.to_string(),
            format!("{share:.1} %"),
            words,
            short(&cause.example, 12),
        ]);
    }
    format!("{}\n\n{table}", summary(records))
}

/// `1,234 of 1,300 devices pass (94.9 %)`, and how the others ended.
pub fn summary(records: &[Record]) -> String {
    let found = yields(records);
    let share = 100.0 * found.passed as f64 / found.devices.max(1) as f64;
    let others = found
        .by_status
        .iter()
        .filter(|(status, _)| status.exit() != 0);
    let others: Vec<String> = others
        .map(|(status, n)| format!("{} {n}", status.name()))
        .collect();
    let others = match others.is_empty() {
        true => String::new(),
        false => format!("; {}", others.join(", ")),
    };
    let with_care = match found.with_care {
        0 => String::new(),
        n => format!(", {n} of them with care"),
    };
    format!(
        "{} of {} devices pass ({share:.1} %){with_care}{others}",
        found.passed, found.devices
    )
}

/// The same for programs.
pub fn document(records: &[Record]) -> Value {
    let found = yields(records);
    let status = found
        .by_status
        .iter()
        .map(|(status, n)| (status.name().to_owned(), json!(n)));
    let listed = |causes: Vec<Cause>| -> Vec<Value> {
        let one = |c: Cause| json!({"reason": c.words, "devices": c.count, "example": c.example});
        causes.into_iter().map(one).collect()
    };
    json!({
        "devices": found.devices,
        "passed": found.passed,
        "with_care": found.with_care,
        "by_status": status.collect::<serde_json::Map<_, _>>(),
        "reasons": listed(pareto(records)),
        "care": listed(cared(records)),
    })
}

/// The first characters of a text, in one line.
pub fn short(text: &str, most: usize) -> String {
    let line = show::name(text);
    match line.char_indices().nth(most) {
        Some((end, _)) => format!("{}…", &line[..end]),
        None => line,
    }
}
