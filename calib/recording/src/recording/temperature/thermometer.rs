//! Temperatures with stamps of their own: read between them, left out where they are of another clock.

use findings::{Finding, Kind};

use crate::Error;
use crate::header::look::Look;
use crate::recording::options::{ColumnMap, Role};
use crate::recording::{Recording, Stream};
use crate::rows::table::Table;
use crate::source::place::in_file;

findings::tuning! {
    /// Share of a recording over which the temperature has to be known; beyond its stamps it is taken as constant.
    KNOWN: f64 = 0.5;

    /// Steps between readings of the temperature that the first and last may miss of the recording.
    MISSED: f64 = 3.0;
}

/// The columns of a file of a thermometer, by number.
pub(crate) fn columns(look: &Look) -> Option<ColumnMap> {
    let roles = [Role::Time, Role::Temperature].into_iter();
    let columns = roles.map(|role| Some((role, look.column(role)?)));
    columns.collect::<Option<_>>().map(ColumnMap)
}

/// Gives the temperature of a table without sensors to the first one with.
///
/// # Errors
/// [`Error::Input`] where no table has a sensor.
pub(crate) fn join(tables: &mut Vec<Table>) -> Result<(), Error> {
    let alone = tables.iter().position(|table| !table.has_sensor());
    let Some(mut table) = alone.map(|at| tables.remove(at)) else {
        return Ok(());
    };
    let Some(first) = tables.iter_mut().find(|table| table.has_sensor()) else {
        return Err(in_file(&table.name, Finding::of(Kind::ONLY_TEMPERATURE)));
    };
    first.warnings.append(&mut table.warnings);
    first.temperature_t = table.temperature_t;
    first.temperature = table.temperature;
    first.stated.temperature = table.stated.temperature;
    Ok(())
}

/// Leaves out a temperature whose stamps are of another clock, and says where one begins late or ends early.
pub(crate) fn check_clock(recording: &mut Recording) {
    let Some(found) = misfit(recording) else {
        return;
    };
    if found.kind == Kind::TEMPERATURE_OF_ANOTHER_CLOCK {
        recording.temperature = None;
    }
    recording.warnings.push(found);
}

/// Returns a finding if the temperature's stamps do not cover the sensors' samples.
fn misfit(recording: &Recording) -> Option<Finding> {
    let readings = recording.temperature.as_ref()?;
    let (first, last) = (*readings.t.first()?, *readings.t.last()?);
    let (from, to) = span(recording)?;
    if readings.t.len() == 1 && (from..=to).contains(&first) {
        return None;
    }
    let step = (last - first) / (readings.t.len() - 1).max(1) as f64;
    if first <= from + MISSED.get() * step && last >= to - MISSED.get() * step {
        return None;
    }
    let common = (last.min(to) - first.max(from)) / (to - from);
    let kind = match common >= KNOWN.get() {
        true => Kind::TEMPERATURE_PARTLY_KNOWN,
        false => Kind::TEMPERATURE_OF_ANOTHER_CLOCK,
    };
    let found = Finding::of(kind)
        .in_recording(&recording.name)
        .number("from", first, "s")
        .number("to", last, "s")
        .number("sensors_from", from, "s")
        .number("sensors_to", to, "s");
    Some(found)
}

/// First and last stamp of the sensors.
fn span(recording: &Recording) -> Option<(f64, f64)> {
    let streams = [&recording.accelerometer, &recording.gyroscope];
    let spans = streams.into_iter().flatten().filter_map(Stream::span);
    spans.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
}
