//! A line for every axis, which says its name and its number: `>ax:1234:0.05`, `imu/ay 0.1`, `Acceleration [Z]: 9.8 m/s²`,
//! `channel type=0(accel_x) index=0 value=22974328296ns (0.05)`.

use std::collections::HashMap;
use std::io::{Cursor, Read};

use sensor::Sensor;

use super::one_number::{Said, is_of_unknown_axis, said};
use crate::formats::texts::TextFormat;
use crate::header::look::Look;
use crate::rows::parts::{Change, Part};
use crate::source::head::take_head;
use crate::source::rewrite::rewritten;
use crate::units::TimeUnit;

/// Lines of one axis each.
pub(crate) static AXIS_LINES: TextFormat = TextFormat {
    name: "axis_lines",
    about: "a line for every axis, which says its name and its number: `>ax:1234:0.05`, `imu/ay 0.1`; without stamps the rate has to be given",
    parts,
};

findings::tuning! {
    /// Lines looked at from the first one of an axis on.
    LINES: usize = 300;
    /// Lines of an axis that show the format.
    FEWEST: usize = 12;
}

/// The roles of the numbers of a line, by their places.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Layout {
    count: usize,
    value: usize,
    stamp: Option<usize>,
}

impl Layout {
    /// The stamp is what goes up from line to line, and the value the last other number that changes.
    fn of(lines: &[Said<'_>]) -> Option<Self> {
        let axes = lines.iter().filter(|line| line.axis.is_some());
        let numbers: Vec<&[&str]> = axes.map(|line| &line.numbers[..]).collect();
        let count = numbers.first()?.len();
        let are_alike = numbers.iter().filter(|own| own.len() == count).count();
        if numbers.len() < FEWEST.get() || 10 * are_alike < 9 * numbers.len() {
            return None;
        }
        let column = |at: usize| -> Vec<f64> {
            let own = numbers.iter().filter(|own| own.len() == count);
            own.filter_map(|own| own[at].parse().ok()).collect()
        };
        let changes = |at: &usize| {
            let column = column(*at);
            column.iter().any(|number| Some(number) != column.first())
        };
        let goes_up = |at: &usize| column(*at).windows(2).all(|pair| pair[0] <= pair[1]);
        let changing: Vec<usize> = (0..count).filter(changes).collect();
        let stamp = changing.iter().copied().find(goes_up);
        let value = changing.iter().copied().rfind(|at| Some(*at) != stamp)?;
        Some(Self {
            count,
            value,
            stamp,
        })
    }
}

/// The lines from the first one of an axis or of the time on.
fn first_lines(look: &Look) -> Vec<&str> {
    let is_before = |line: &&str| said(line).is_none();
    look.far_lines()
        .skip_while(is_before)
        .take(LINES.get())
        .collect()
}

/// True if the lines of an axis differ in more than their numbers, as those of two devices do.
fn are_of_several(lines: &[Said<'_>]) -> bool {
    let mut names = HashMap::new();
    let mut axes = lines
        .iter()
        .filter_map(|line| Some((line.axis?, &line.names)));
    axes.any(|(axis, own)| *names.entry(axis).or_insert(own) != own)
}

/// The numbers of a sensor since its last row.
struct Gathered {
    sensor: Sensor,
    layout: Layout,
    /// The stamp of a line before those of the axes.
    clock: Option<String>,
    time: Option<String>,
    axes: [Option<String>; 3],
}

impl Gathered {
    fn new(sensor: Sensor, layout: Layout) -> Self {
        Self {
            sensor,
            layout,
            clock: None,
            time: None,
            axes: Default::default(),
        }
    }

    /// Takes a line, and returns the row that it completes; the line itself where its numbers are others.
    fn next(&mut self, line: &str) -> Option<String> {
        let said = said(line)?;
        let Some((sensor, axis)) = said.axis else {
            self.clock = said.numbers.first().map(|&stamp| stamp.to_owned());
            return None;
        };
        if sensor != self.sensor {
            return None;
        }
        if said.numbers.len() != self.layout.count {
            return Some(line.to_owned());
        }
        // An axis that comes again before the others: one of them was lost.
        if self.axes.iter().all(Option::is_none) || self.axes[axis].is_some() {
            let own = self.layout.stamp.map(|at| said.numbers[at].to_owned());
            self.time = own.or_else(|| self.clock.clone());
            self.axes = Default::default();
        }
        self.axes[axis] = Some(said.numbers[self.layout.value].to_owned());
        let [Some(x), Some(y), Some(z)] = &self.axes else {
            return None;
        };
        let time = self.time.iter().map(|time| format!("{time},"));
        let row = time.chain([format!("{x},{y},{z}")]).collect();
        self.axes = Default::default();
        Some(row)
    }
}

fn parts(look: &Look) -> Option<Vec<Part>> {
    let all = first_lines(look);
    let lines: Vec<Said> = all.iter().filter_map(|line| said(line)).collect();
    let layout = Layout::of(&lines)?;
    let has_others = all.iter().any(|line| is_of_unknown_axis(line));
    if 2 * lines.len() < all.len() || has_others || are_of_several(&lines) {
        return None;
    }
    let clock = lines.iter().find(|line| line.axis.is_none());
    let is_stamped = layout.stamp.is_some() || clock.is_some();
    let mut counts: HashMap<(Sensor, usize), usize> = HashMap::new();
    for line in &lines {
        if let Some(axis) = line.axis {
            *counts.entry(axis).or_default() += 1;
        }
    }
    let part = |(sensor, change): (Sensor, Change)| -> Option<Part> {
        let times = |axis: usize| counts.get(&(sensor, axis)).copied().unwrap_or(0);
        (0..3).all(|axis| times(axis) >= 2).then_some(())?;
        let own = lines.iter().find(|line| line.axis == Some((sensor, 0)))?;
        let time_unit = match layout.stamp {
            Some(_) => own.time_unit,
            None => clock.and_then(|clock| clock.time_unit),
        };
        Some(Part {
            time_unit: time_unit.filter(|unit| *unit != TimeUnit::Days),
            ..Part::of_rows(sensor, is_stamped, own.unit, change)
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

/// The rows of one sensor, each at the line that completes it; the other lines are blank.
fn rows_of(mut text: Box<dyn Read + Send>, sensor: Sensor) -> Box<dyn Read + Send> {
    // An error comes again where the text is read.
    let head = take_head("", &mut text).unwrap_or_default();
    let look = Look::at(&head);
    let lines: Vec<Said> = first_lines(&look).into_iter().filter_map(said).collect();
    let layout = Layout::of(&lines);
    let mut gathered = layout.map(|layout| Gathered::new(sensor, layout));
    let whole = Box::new(Cursor::new(head).chain(text));
    rewritten(whole, move |line, out| {
        let text = std::str::from_utf8(line).unwrap_or_default();
        let row = gathered.as_mut().and_then(|gathered| gathered.next(text));
        out.extend_from_slice(row.unwrap_or_default().as_bytes());
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::rewrite::changed_by;

    /// The rows of every sensor in ten blocks of lines; `block` writes one by its number.
    fn rows(block: impl Fn(usize) -> String) -> Option<Vec<Vec<String>>> {
        let log: String = (0..10).map(block).collect();
        let parts = parts(&Look::at(log.as_bytes()))?;
        let rows = |part: &Part| {
            let text = changed_by(part.change.unwrap(), &log);
            let rows = text.lines().filter(|line| !line.is_empty());
            rows.map(str::to_owned).collect()
        };
        Some(parts.iter().map(rows).collect())
    }

    #[test]
    fn lines_of_one_axis_each_are_put_together() {
        let names = ["ax", "ay", "az", "gx", "gy", "gz"];
        let lines = |line: &dyn Fn(usize, &str) -> String| -> String {
            names
                .iter()
                .enumerate()
                .map(|(at, name)| line(at, name))
                .collect()
        };
        // The stamp between name and number, behind both, in a line of its own, and none.
        let read = rows(|k| lines(&|at, name| format!(">{name}:{}:{at}.{k}\n", 1000 + 10 * k)));
        assert_eq!(read.unwrap()[1][1], "1010,3.1,4.1,5.1");
        let read = rows(|k| lines(&|at, name| format!("imu_{name} {at}.{k} {}\n", 1000 + 10 * k)));
        assert_eq!(read.unwrap()[0][2], "1020,0.2,1.2,2.2");
        let read = rows(|k| format!("t={k}0\n") + &lines(&|at, name| format!("{name}={at}.{k}\n")));
        assert_eq!(read.unwrap()[0][2], "20,0.2,1.2,2.2");
        let read = rows(|k| lines(&|at, name| format!("imu/{name} {at}.{k}\n")));
        assert_eq!(
            read.unwrap()[1],
            (0..10)
                .map(|k| format!("3.{k},4.{k},5.{k}"))
                .collect::<Vec<_>>()
        );
    }

    #[test]
    fn of_several_numbers_those_that_stand_still_are_none() {
        let names = ["accel_x", "accel_y", "accel_z"];
        let read = rows(|k| {
            let line = |(at, name): (usize, &&str)| {
                format!(
                    "channel type={at}({name}) index=0 shift=4 value={}ns ({at}.{k})\n",
                    500 + k
                )
            };
            "uart:~$ sensor get a\n".to_owned()
                + &names.iter().enumerate().map(line).collect::<String>()
        });
        assert_eq!(
            read.unwrap(),
            [(0..10)
                .map(|k| format!("{},0.{k},1.{k},2.{k}", 500 + k))
                .collect::<Vec<_>>()]
        );
    }

    #[test]
    fn tables_and_lines_of_all_axes_are_left_alone() {
        for line in ["ax:1 ay:2 az:3\n", "0.1,1,2,3\n", "x: 1\n", "co2 400\n"] {
            assert!(rows(|_| line.repeat(3)).is_none(), "{line}");
        }
        // Two devices, and axes that are not understood.
        let names = ["ax", "ay", "az"];
        let of_device = |k: usize, device: &str| {
            let line = |(at, name): (usize, &&str)| format!("{device} {name} {at}.{k}\n");
            names.iter().enumerate().map(line).collect::<String>()
        };
        assert!(rows(|k| of_device(k, "left") + &of_device(k, "left")).is_some());
        assert!(rows(|k| of_device(k, "left") + &of_device(k, "right")).is_none());
        assert!(rows(|k| of_device(k, "left") + &format!("spin_x 0.{k}\n")).is_none());
        // A number that is missing is for the reader to refuse.
        let read = rows(|k| match k {
            5 => "ax:1.5\nay: --\naz:2.5\n".to_owned(),
            _ => format!("ax:1.{k}\nay:0.{k}\naz:2.{k}\n"),
        });
        assert_eq!(read.unwrap()[0][5], "ay: --");
    }
}
