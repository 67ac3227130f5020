//! Effects that were found in many devices.

use batch::statistics::{median, shared_effects, spread};
use batch::{Record, Status};

use super::values::{ROWS, values};
use crate::commands::batch::tables::short;
use crate::commands::calibrate::limits::number;
use crate::report::{Report, ReportTable};

/// Adds the section on the effects found in many devices.
pub(super) fn shared(report: Report, records: &[Record]) -> Report {
    let found = shared_effects(records);
    let unexplained = records
        .iter()
        .filter(|r| {
            r.verdict
                .as_deref()
                .is_some_and(|v| v.contains("unexplained"))
        })
        .count();
    let report = report.section("Effects shared by the type");
    if records.iter().all(|r| r.verdict.is_none()) {
        let failed = records.iter().filter(|r| r.status != Status::Pass).count();
        return report.text(format!(
            "Nothing was looked for ({} devices, {failed} failed): run the batch with --discover.",
            records.len()
        ));
    }
    if found.is_empty() {
        return report.text(format!(
            "No effect was named; {unexplained} devices are unexplained."
        ));
    }
    let mut table = ReportTable::new(["effect", "devices", "share", "typical parameters"]);
    for effect in found.iter().take(ROWS) {
        let prefix = format!("{}.", effect.name);
        let mut own: Vec<String> = Vec::new();
        for parameter in records
            .iter()
            .flat_map(|r| &r.parameters)
            .filter(|p| p.name.starts_with(&prefix))
        {
            if !own.contains(&parameter.name) {
                own.push(parameter.name.clone());
            }
        }
        let words = own.iter().map(|name| {
            let all = values(records, name);
            format!(
                "{} {} ± {}",
                name.trim_start_matches(&prefix),
                number(median(&all)),
                number(spread(&all))
            )
        });
        table.row([
            effect.name.clone(),
            effect.named.to_string(),
            format!(
                "{:.0} %",
                100.0 * effect.named as f64 / effect.of.max(1) as f64
            ),
            short(&words.collect::<Vec<_>>().join(", "), 160),
        ]);
    }
    report
        .text(format!("{unexplained} devices are unexplained."))
        .table(table)
}
