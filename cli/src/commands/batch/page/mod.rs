//! The report of a batch.

mod charts;
mod distributions;
mod drifts;
mod outliers;
mod reasons;
mod shared;
mod values;

use batch::Record;

use super::tables::summary;
use crate::exit::Failure;
use crate::report::{Level, Report};

/// The page.
pub fn page(records: &[Record]) -> Result<Report, Failure> {
    let failed = records.iter().any(|r| r.exit != 0);
    let with_care = records.iter().any(|r| r.care().is_some());
    let (level, next) = match (failed, with_care) {
        (true, _) => (
            Level::Care,
            "Cure the commonest reason in the table below, then run the batch again with --resume: devices that passed are kept.",
        ),
        (false, true) => (
            Level::Care,
            "Look at the devices to be used with care in the table below; correct the recordings of each device with its own file: stillpoint \
             apply OUT/devices/ID/cal.json RECORDING -o corrected.csv",
        ),
        (false, false) => (
            Level::Good,
            "Correct the recordings of each device with its own file: stillpoint apply OUT/devices/ID/cal.json RECORDING -o \
             corrected.csv",
        ),
    };
    let mut report = Report::new("Batch")
        .verdict(level, format!("{}.", summary(records).replace('_', " ")))
        .next(&[next.to_owned()]);
    report = reasons::reasons(report, records)?;
    let names = names(records);
    report = distributions::distributions(report, records, &names)?;
    report = outliers::odd(report, records, &names);
    report = drifts::drifts(report, records, &names);
    report = charts::charts(report, records, &names)?;
    Ok(shared::shared(report, records))
}

/// Names of the parameters that most calibrated devices have.
fn names(records: &[Record]) -> Vec<String> {
    let calibrated = records.iter().filter(|r| !r.parameters.is_empty()).count();
    let mut names: Vec<(String, usize)> = Vec::new();
    for parameter in records.iter().flat_map(|r| &r.parameters) {
        match names.iter_mut().find(|(name, _)| *name == parameter.name) {
            Some((_, count)) => *count += 1,
            None => names.push((parameter.name.clone(), 1)),
        }
    }
    names.retain(|(_, count)| 2 * count > calibrated);
    names.into_iter().map(|(name, _)| name).collect()
}
