//! Devices far from the others.

use batch::Record;
use batch::statistics::outliers;
use nalgebra::DVector;

use super::values::ROWS;
use crate::report::{Report, ReportTable};
use crate::show;

/// Chance of calling any device of a sound batch an outlier.
const ALPHA: f64 = 0.01;

/// Devices far from the others, all parameters taken together.
pub(super) fn odd(report: Report, records: &[Record], names: &[String]) -> Report {
    let whole: Vec<(&Record, DVector<f64>)> = records
        .iter()
        .filter_map(|r| {
            let values: Option<Vec<f64>> = names.iter().map(|n| Some(r.parameter(n)?.0)).collect();
            Some((r, DVector::from_vec(values?)))
        })
        .collect();
    let sample: Vec<DVector<f64>> = whole.iter().map(|(_, v)| v.clone()).collect();
    let report = report.section("Outliers");
    if names.is_empty() || sample.len() < 3 * names.len() {
        return report.text(format!(
            "{} devices with {} parameters: too few to tell an outlier from the others (three devices per parameter).",
            sample.len(),
            names.len()
        ));
    }
    let found = outliers(&sample, ALPHA);
    let mut table = ReportTable::new([
        "device",
        "distance",
        "chance over the batch",
        "furthest in",
        "standard deviations",
    ]);
    for o in found.iter().take(ROWS) {
        table.row([
            show::name(&whole[o.index].0.id),
            format!("{:.1}", o.distance),
            format!("{:.1e}", o.p_value),
            names[o.parameter].clone(),
            format!("{:+.1}", o.deviation),
        ]);
    }
    let said = format!(
        "{} of {} devices are outliers by their robust Mahalanobis distance (orthogonalised Gnanadesikan–Kettenring; chance {ALPHA} \
         of any in a sound batch).",
        found.len(),
        sample.len()
    );
    match found.is_empty() {
        true => report.text(said),
        false => report.text(said).table(table),
    }
}
