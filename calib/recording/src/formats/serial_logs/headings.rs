//! Three numbers below a line that names their sensor: `Acceleration:` and then `X: 0.1  Y: 0.2 Z: 9.8  m/s^2`, or a line for each.

use std::borrow::Cow;
use std::io::Read;

use sensor::Sensor;

use super::log_prefix::{Stamp, by_terminal};
use super::words::axis_of_letter;
use crate::clock::time_of_day::TimeOfDay;
use crate::formats::texts::TextFormat;
use crate::header::look::Look;
use crate::header::names::{compact, is_field, sensor_of};
use crate::rows::parts::{Change, Part};
use crate::source::rewrite::rewritten;
use crate::units::TimeUnit;

/// Numbers below headings.
pub(crate) static HEADINGS: TextFormat = TextFormat {
    name: "headings",
    about: "three numbers below a line that names their sensor: `Gyro:`, `X: 0.1 Y: 0.2 Z: 0.3 rad/s`; without stamps of a terminal the rate has to be given",
    parts,
};

/// The kinds of lines.
#[derive(Clone, Debug, PartialEq)]
enum Said<'a> {
    /// Words: the sensor that they name first, and the unit behind `in`.
    Heading(Option<Sensor>, &'a str),
    /// Three numbers, and the unit behind them.
    Numbers([&'a str; 3], &'a str),
    /// The number of an axis.
    Axis(usize, &'a str),
    /// Anything else.
    Other,
}

/// The axis of a letter, or of one that a chip's first axes are called by: `X1`.
fn axis(word: &str) -> Option<usize> {
    axis_of_letter(word.strip_suffix('1').unwrap_or(word))
}

fn said(line: &str) -> Said<'_> {
    let separates = |c: char| matches!(c, ' ' | ',' | ':' | '\t' | '=' | '|' | '(' | ')');
    let words: Vec<&str> = line.split(separates).filter(|w| !w.is_empty()).collect();
    let is_number = |word: &&&str| word.parse::<f64>().is_ok_and(f64::is_finite);
    let numbers: Vec<&str> = words.iter().filter(is_number).copied().collect();
    let is_axis = |word: &&str| axis(word).is_some();
    match (&numbers[..], &words[..]) {
        ([], [first, ..]) => {
            let of_field = is_field(&compact(first)).then_some(Sensor::Magnetometer);
            let mut pairs = words.windows(2).filter(|pair| pair[0] == "in");
            let unit = pairs.next().map(|pair| pair[1]);
            Said::Heading(
                of_field.or_else(|| sensor_of(&compact(first))),
                unit.unwrap_or_default(),
            )
        }
        ([x, y, z], words) => {
            let mut others = words
                .iter()
                .filter(|word| !is_number(word) && !is_axis(word));
            let unit = others.next().copied().unwrap_or_default();
            let is_last = words.last() == Some(&unit);
            match others.next().is_none() && (unit.is_empty() || is_last) {
                true => Said::Numbers([x, y, z], unit),
                false => Said::Other,
            }
        }
        ([number], [name, _]) => match axis(name) {
            Some(at) => Said::Axis(at, number),
            None => Said::Other,
        },
        _ => Said::Other,
    }
}

/// The numbers below the last heading.
#[derive(Default)]
struct Below {
    sensor: Option<Sensor>,
    unit: String,
    /// Those of the first axes, a line for each.
    axes: Vec<String>,
}

/// The row of a sensor: its stamp, its numbers and their unit.
struct Row<'a> {
    sensor: Sensor,
    stamp: Option<Stamp>,
    numbers: [Cow<'a, str>; 3],
    unit: String,
}

impl Below {
    /// Takes the next line, and returns the row that it is.
    fn next<'a>(&mut self, line: &'a str) -> Option<Row<'a>> {
        let (stamp, line) = match by_terminal(line) {
            Some((stamp, line)) => (Some(stamp), line),
            None => (None, line),
        };
        match said(line) {
            Said::Axis(at, number) if at == self.axes.len() && self.sensor.is_some() => {
                self.axes.push(number.to_owned());
                let numbers = <[String; 3]>::try_from(self.axes.clone()).ok()?;
                self.axes.clear();
                Some(Row {
                    sensor: self.sensor.take()?,
                    stamp,
                    numbers: numbers.map(Cow::Owned),
                    unit: std::mem::take(&mut self.unit),
                })
            }
            Said::Heading(sensor, unit) => {
                self.axes.clear();
                (self.sensor, self.unit) = (sensor, unit.to_owned());
                None
            }
            Said::Numbers(numbers, unit) => Some(Row {
                sensor: self.sensor.take()?,
                stamp,
                numbers: numbers.map(Cow::Borrowed),
                unit: match unit.is_empty() {
                    true => std::mem::take(&mut self.unit),
                    false => unit.to_owned(),
                },
            }),
            Said::Axis(..) | Said::Other => {
                self.axes.clear();
                self.sensor = None;
                None
            }
        }
    }
}

fn parts(look: &Look) -> Option<Vec<Part>> {
    let mut below = Below::default();
    let lines: Vec<&str> = look.lines().collect();
    let rows: Vec<Row> = lines.iter().filter_map(|line| below.next(line)).collect();
    let of = |sensor: Sensor| rows.iter().filter(move |row| row.sensor == sensor);
    // Most lines are headings and their numbers, which may be a line each.
    if 5 * rows.len() + 5 < lines.len() {
        return None;
    }
    let part = |(sensor, change): (Sensor, Change)| {
        let first = of(sensor).next().filter(|_| of(sensor).count() >= 2)?;
        Some(Part {
            time_unit: first.stamp.map(|_| TimeUnit::Seconds),
            ..Part::of_rows(sensor, first.stamp.is_some(), &first.unit, change)
        })
    };
    let changes: [(Sensor, Change); 2] = [
        (Sensor::Accelerometer, |text| {
            rows_of(text, Sensor::Accelerometer)
        }),
        (Sensor::Gyroscope, |text| rows_of(text, Sensor::Gyroscope)),
    ];
    let parts: Vec<Part> = changes.into_iter().filter_map(part).collect();
    (!parts.is_empty()).then_some(parts)
}

/// The rows of one sensor; the other lines are blank.
fn rows_of(text: Box<dyn Read + Send>, sensor: Sensor) -> Box<dyn Read + Send> {
    let (mut below, mut clock) = (Below::default(), TimeOfDay::default());
    rewritten(text, move |line, out| {
        let text = std::str::from_utf8(line).unwrap_or_default();
        if let Some(row) = below.next(text).filter(|row| row.sensor == sensor) {
            let stamp = row.stamp.map(|stamp| stamp.written(&mut clock));
            let numbers = row.numbers.iter().map(|number| &**number);
            let cells: Vec<&str> = stamp.as_deref().into_iter().chain(numbers).collect();
            out.extend_from_slice(cells.join(",").as_bytes());
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::rewrite::changed_by;

    #[test]
    fn numbers_belong_to_the_heading_above_them() {
        for (block, force, rate) in [
            (
                "Acceleration:\nX: 0.1  Y: 0.2 Z: 9.8  m/s^2\n\nGyro:\nX: 1  Y: 2 Z: 3 rads/s\n\n",
                "0.1,0.2,9.8",
                "1,2,3",
            ),
            (
                "Acceleration in g (x,y,z):\n0.1   0.2   1.0\nResultant g: 1.02\nGyroscope data in degrees/s: \n1   2   3\n*****\n",
                "0.1,0.2,1.0",
                "1,2,3",
            ),
            (
                "Accelerometer:\n X1 = 0.1\n Y1 = 0.2\n Z1 = 9.8\n\nGyroscope:\n X1 = 1\n Y1 = 2\n Z1 = 3\n\nThermometer:\n Degrees C1 = 25.1\n",
                "0.1,0.2,9.8",
                "1,2,3",
            ),
            (
                "Accelerometer data\nx: 0.1\ny: 0.2\nz: 9.8\nGyroscope data\nx: 1\ny: 2\nz: 3\nTemp: 25.1 C\n",
                "0.1,0.2,9.8",
                "1,2,3",
            ),
        ] {
            let log = block.repeat(10);
            let parts = parts(&Look::at(log.as_bytes())).unwrap();
            let rows = |part: &Part| -> Vec<String> {
                let text = changed_by(part.change.unwrap(), &log);
                let rows = text.lines().filter(|line| !line.is_empty());
                rows.map(str::to_owned).collect()
            };
            assert_eq!(rows(&parts[0]), [force; 10], "{block}");
            assert_eq!(rows(&parts[1]), [rate; 10], "{block}");
        }
        for text in [
            "ax,ay,az\n1,2,3\n1,2,3\n",
            "gyro x,gyro y,gyro z\n1,2,3\n4,5,6\n",
        ] {
            assert!(parts(&Look::at(text.as_bytes())).is_none(), "{text}");
        }
    }

    #[test]
    fn units_stand_behind_the_numbers_or_in_the_heading() {
        assert_eq!(
            said("Gyroscope data in degrees/s: "),
            Said::Heading(Some(Sensor::Gyroscope), "degrees/s")
        );
        assert_eq!(
            said("X: 0.1  Y: 0.2 Z: 9.8  m/s^2"),
            Said::Numbers(["0.1", "0.2", "9.8"], "m/s^2")
        );
        assert_eq!(said("Calibration: 3 3 3 of 3"), Said::Other);
    }
}
