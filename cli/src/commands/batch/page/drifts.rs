//! Parameters that change over time or differ by station.

use batch::Record;
use batch::statistics::{by_station, over_time, seconds};

use crate::commands::calibrate::limits::number;
use crate::report::{Report, ReportTable};
use crate::show;

/// A change or a difference between stations that chance makes less often than this is said, over all parameters.
const SHOWN: f64 = 0.01;

/// Parameters that change over time or differ by station.
pub(super) fn drifts(report: Report, records: &[Record], names: &[String]) -> Report {
    let mut report = report.section("Drift");
    let mut table = ReportTable::new(["parameter", "change", "std error", "chance"]);
    let (mut drifting, mut looked) = (0, false);
    for name in names {
        let point = |r: &Record| Some((seconds(r.time.as_ref()?)?, r.parameter(name)?.0));
        let Some(drift) = over_time(&records.iter().filter_map(point).collect::<Vec<_>>()) else {
            continue;
        };
        looked = true;
        if drift.p_value < SHOWN / names.len() as f64 {
            drifting += 1;
            table.row([
                name.clone(),
                number(drift.change),
                number(drift.std),
                format!("{:.1e}", drift.p_value),
            ]);
        }
    }
    report = match (looked, drifting) {
        (false, _) => report.text("Over time: the manifest has no time for five devices or more."),
        (true, 0) => {
            report.text("Over time: no parameter changes from the first to the last device.")
        }
        _ => report
            .text("Over time, from the first to the last device:")
            .table(table),
    };
    let mut table = ReportTable::new(["parameter", "mean by station (devices)", "chance"]);
    let (mut differing, mut looked) = (0, false);
    for name in names {
        let point = |r: &Record| Some((r.station.clone()?, r.parameter(name)?.0));
        let Some(shift) = by_station(&records.iter().filter_map(point).collect::<Vec<_>>()) else {
            continue;
        };
        looked = true;
        if shift.p_value < SHOWN / names.len() as f64 {
            differing += 1;
            let means = shift
                .means
                .iter()
                .map(|(s, n, v)| format!("{} {} ({n})", show::name(s), number(*v)));
            table.row([
                name.clone(),
                means.collect::<Vec<_>>().join(", "),
                format!("{:.1e}", shift.p_value),
            ]);
        }
    }
    match (looked, differing) {
        (false, _) => report.text("By station: the manifest names fewer than two stations."),
        (true, 0) => report.text("By station: no parameter differs."),
        _ => report.text("By station:").table(table),
    }
}
