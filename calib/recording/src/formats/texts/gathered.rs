//! Tables in which several lines make one row of a sensor.

use std::io::Read;

use sensor::Sensor;

use super::places::may_be_row;
use crate::header::look::cells;
use crate::rows::parts::{Change, Part};
use crate::source::rewrite::rewritten;
use crate::units::{Stated, TimeUnit};

/// Readings of a sensor that are gathered from line to line.
pub(super) trait Gather: Sized + Send + 'static {
    /// Begins below a header; `None` where it is none.
    fn below(header: &[String], sensor: Sensor) -> Option<Self>;

    /// Takes the cells of a line, and returns the row that it completes: the time and the three axes.
    fn next(&mut self, cells: &[String]) -> Option<String>;
}

/// The parts of the sensors that `has` holds for, with the units that the header or the names state; `None` without an accelerometer and a
/// gyroscope.
pub(super) fn parts_of<'a, G: Gather>(
    has: impl Fn(Sensor) -> bool,
    time: Option<TimeUnit>,
    unit: impl Fn(Sensor) -> Option<&'a str>,
) -> Option<Vec<Part>> {
    let change = |sensor: Sensor| -> Option<Change> {
        has(sensor).then_some(match sensor {
            Sensor::Accelerometer => |text| rows_of::<G>(text, Sensor::Accelerometer),
            Sensor::Gyroscope => |text| rows_of::<G>(text, Sensor::Gyroscope),
            Sensor::Magnetometer => |text| rows_of::<G>(text, Sensor::Magnetometer),
        })
    };
    let changes = Sensor::ALL.map(change);
    changes[..2].iter().any(Option::is_some).then_some(())?;
    let stated = Stated {
        time,
        accel: unit(Sensor::Accelerometer).and_then(|unit| unit.parse().ok()),
        gyro: unit(Sensor::Gyroscope).and_then(|unit| unit.parse().ok()),
        ..Stated::default()
    };
    Some(Part::of_each(changes, ["1", "2", "3", "4"], stated).collect())
}

/// The rows of one sensor, each at the line that completes it; the other lines are blank.
fn rows_of<G: Gather>(text: Box<dyn Read + Send>, sensor: Sensor) -> Box<dyn Read + Send> {
    let mut gathered: Option<G> = None;
    rewritten(text, move |line, out| {
        let text = String::from_utf8_lossy(line);
        if !may_be_row(&text) {
            return;
        }
        let cells = cells(&text);
        match &mut gathered {
            None => gathered = G::below(&cells, sensor),
            Some(gathered) => {
                let row = gathered.next(&cells);
                out.extend_from_slice(row.unwrap_or_default().as_bytes());
            }
        }
    })
}
