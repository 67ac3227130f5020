//! Selection of one device's rows from a table of several: by a column of labels, asked for if unclear, never averaged.
//!
//! ```text
//! rows ──► labels ──► evidence ──► choose ──► the rows of one device
//!          columns    do labels    ask, or
//!          of few     take turns?  --instance
//!          values     do readings
//!                     go with them?
//! ```

mod evidence;
pub(crate) mod labels;
pub(crate) mod mixed;
mod names;
#[cfg(test)]
mod tests;

use evidence::{Order, Rows};
pub(crate) use labels::ALL;
use labels::{Labelled, Labels};
use names::Class;

use findings::{Finding, Kind, OptionName, Remedy, Setting};

use crate::Error;
use crate::header::suggest::quoted;
use crate::recording::options::ReadOptions;
use crate::recording::samples::Samples;
use crate::rows::table::Table;
use crate::shown::{shown, shown_cell};

/// Rows below which a value is no device's but a fault of the file.
const FEWEST: usize = 20;
/// Readings of rows of two labels that are so much further apart than those of one are those of two devices.
const DIFFERENT: f64 = 2.0;
/// The same for columns whose names say that they are something else's.
const VERY_DIFFERENT: f64 = 4.0;
/// Means at rest of two devices, in units of what one scatters by.
const OTHER_BIAS: f64 = 5.0;
/// Values listed in a message.
const LISTED: usize = 8;

/// Leaves the rows of one device in `table`: the only one there is, or the one that was asked for.
///
/// # Errors
/// [`Error::Usage`] with the devices where there are several and none, or another, was asked for.
pub(crate) fn choose(table: &mut Table, options: &ReadOptions) -> Result<(), Error> {
    let mut labels = std::mem::take(&mut table.labels);
    labels.finish();
    let wanted = options.wanted_device();
    if wanted.as_deref() == Some(ALL) {
        return Ok(());
    }
    let Some(devices) = Devices::find(table, &labels) else {
        return match wanted {
            Some(wanted) => alone(table, &labels, &wanted),
            None => Ok(()),
        };
    };
    let Some(wanted) = wanted else {
        return Err(Error::usage(devices.asked(table)));
    };
    let is_it = |(value, _): &&(usize, usize)| devices.column.is(*value, &wanted);
    let Some(&(value, _)) = devices.values.iter().find(is_it) else {
        let missing = devices.found(Kind::DEVICE_MISSING, table);
        return Err(Error::usage(missing.detail("wanted", quoted(&wanted))));
    };
    let label = |line: u64| devices.column.of_rows.get(labels.row(line));
    let is_of_it = |line: u64| label(line).is_some_and(|label| usize::from(*label) == value);
    table.keep_lines(is_of_it);
    if let Some(rate) = options.rate {
        table.count_rows(rate);
    }
    Ok(())
}

/// Accepts the only device of a table by its name.
fn alone(table: &Table, labels: &Labels, wanted: &str) -> Result<(), Error> {
    let named = labels.columns.iter();
    let mut named = named.filter(|column| column.class <= Class::Unknown);
    if named.any(|column| column.values.len() == 1 && column.is(0, wanted)) {
        return Ok(());
    }
    Err(Error::usage(
        Finding::of(Kind::DEVICE_NOT_TOLD)
            .in_file(&table.name)
            .detail("wanted", quoted(wanted)),
    ))
}

/// Several devices in one table.
struct Devices<'a> {
    column: &'a Labelled,
    /// Values of the column, and how many rows have them.
    values: Vec<(usize, usize)>,
    /// Readings and stamps show it, not a name alone.
    certain: bool,
}

impl<'a> Devices<'a> {
    /// The first column that tells devices apart.
    fn find(table: &Table, labels: &'a Labels) -> Option<Self> {
        labels.columns.iter().find_map(|column| {
            let sensors = [&table.accel, &table.gyro];
            let found = sensors.map(|samples| Of::sensor(samples, column, labels));
            let longer = usize::from(found[1].labels.len() > found[0].labels.len());
            let enough = match column.class {
                Class::Given => 1,
                _ => FEWEST,
            };
            let counts = found[longer].counts(column.values.len());
            let values: Vec<(usize, usize)> = counts
                .into_iter()
                .enumerate()
                .filter(|(_, count)| *count >= enough)
                .collect();
            if values.len() < 2 {
                return None;
            }
            let mut values = values;
            values.sort_by(|a, b| column.values[a.0].cmp(&column.values[b.0]));
            let certain = is_certain(&found, longer, values.len());
            is_of_devices(column, &found, longer, values.len()).then_some(Self {
                column,
                values,
                certain,
            })
        })
    }

    /// A finding about the devices.
    fn found(&self, kind: Kind, table: &Table) -> Finding {
        let of = |(value, count): &(usize, usize)| {
            format!(
                "`{}` ({count} rows)",
                shown_cell(&self.column.values[*value])
            )
        };
        let mut listed: Vec<String> = self.values.iter().take(LISTED).map(of).collect();
        if let Some(more) = self.values.len().checked_sub(LISTED + 1) {
            listed.push(format!("{} more", more + 1));
        }
        let name = &self.column.name;
        let column = match name.is_empty() {
            true => format!("column {}", self.column.at + 1),
            false => format!("column {} (`{}`)", self.column.at + 1, shown(name)),
        };
        Finding::of(kind)
            .in_file(&table.name)
            .count("count", self.values.len())
            .detail("column", column)
            .detail("listed", listed.join(", "))
    }

    /// Asks for one of them, or for all where they may be one.
    fn asked(&self, table: &Table) -> Finding {
        let first = self
            .values
            .first()
            .map(|(value, _)| &self.column.values[*value]);
        let first =
            String::from_utf8_lossy(first.map(Vec::as_slice).unwrap_or_default()).into_owned();
        let mut ways = vec![Remedy::such_as(OptionName::Instance, shown(&first))];
        if !self.certain {
            ways.push(Remedy::IfWrong {
                any_of: vec![Setting::to(OptionName::Instance, ALL)],
            });
        }
        self.found(Kind::DEVICES_IN_TABLE, table)
            .only_remedies(ways)
    }
}

/// The rows of one sensor with their labels.
struct Of<'a> {
    samples: &'a Samples,
    labels: Vec<u8>,
}

impl<'a> Of<'a> {
    fn sensor(samples: &'a Samples, column: &Labelled, labels: &Labels) -> Self {
        let label = |i: usize| {
            let row = labels.row(samples.line(i));
            column.of_rows.get(row).copied().unwrap_or_default()
        };
        Self {
            samples,
            labels: (0..samples.t.len()).map(label).collect(),
        }
    }

    fn rows(&self) -> Rows<'_> {
        Rows {
            t: &self.samples.t,
            values: &self.samples.values,
            labels: &self.labels,
        }
    }

    fn counts(&self, values: usize) -> Vec<usize> {
        let mut counts = vec![0; values];
        for label in &self.labels {
            counts[usize::from(*label)] += 1;
        }
        counts
    }
}

/// The larger of what both sensors say.
fn difference(found: &[Of<'_>; 2]) -> f64 {
    found
        .iter()
        .map(|of| of.rows().difference())
        .fold(0.0, f64::max)
}

fn is_certain(found: &[Of<'_>; 2], longer: usize, count: usize) -> bool {
    let order = found[longer].rows().order(count);
    (order.apart || order.in_turn) && difference(found) >= DIFFERENT
}

/// Decides whether the values of a column are devices.
fn is_of_devices(column: &Labelled, found: &[Of<'_>; 2], longer: usize, count: usize) -> bool {
    let Order {
        mixed,
        in_turn,
        apart,
        in_blocks,
        begins_again,
    } = found[longer].rows().order(count);
    // One placement after the other has other readings of gravity, but one bias of the gyroscope.
    let gyro = &found[1];
    let other_bias = || match gyro.labels.is_empty() {
        true => true,
        false => gyro.rows().difference_at_rest(column.values.len()) >= OTHER_BIAS,
    };
    match column.class {
        Class::Given | Class::Device => true,
        Class::Number => {
            ((apart || mixed) && difference(found) >= DIFFERENT)
                || begins_again
                || (in_blocks && other_bias())
        }
        Class::Unknown => {
            // A state that follows from the readings of one sensor leaves those of the other alone.
            let both = || found.iter().all(|of| of.rows().difference() >= DIFFERENT);
            ((apart || in_turn) && difference(found) >= DIFFERENT)
                || (mixed && both())
                || begins_again
        }
        Class::Other => apart && difference(found) >= VERY_DIFFERENT,
    }
}
