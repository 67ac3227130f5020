//! Razor AHRS, the firmware of SparkFun's 9DOF boards: `#YPRAG=..`, or a line for each sensor, `#A-R=..`.
//!
//! Source: Razor AHRS Firmware 1.4.2.1, `Razor_AHRS.ino` and `Output.ino`. The firmware keeps the accelerometer's reading
//! with the other sign, 256 to one g, and writes every 20 ms. There are no stamps in the lines; a terminal may have put some
//! before them.

use std::io::Read;

use crate::clock::time_of_day::{TimeOfDay, seconds};
use crate::formats::texts::TextFormat;
use crate::header::look::Look;
use crate::recording::options::Role;
use crate::rows::parts::{Change, Part};
use crate::source::rewrite::rewritten;
use crate::units::{AccelUnit, GyroUnit, TimeUnit};

/// A log of Razor AHRS.
pub(crate) static RAZOR: TextFormat = TextFormat {
    name: "razor_ahrs",
    about: "lines of Razor AHRS: `#YPRAG=..`, or `#A-R=..`, `#M-R=..`, `#G-R=..` for each sensor; the rate has to be given",
    parts,
};

findings::tuning! {
    /// Frames in a second, unless the firmware was changed.
    RATE: f64 = 50.0;
}

/// Counts of one g.
const PER_G: &str = "/256";

/// Content of a line, by the mark at its beginning.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// Angles, accelerometer, gyroscope and perhaps magnetometer.
    All,
    Accel(u8),
    Field(u8),
    Gyro(u8),
}

/// A sensor and its numbers.
type Reading<'a> = (Kind, Vec<&'a str>);

/// The kinds of a line's parts with their numbers, and what stands before the first.
fn split(line: &str) -> Option<(&str, Vec<Reading<'_>>)> {
    let at = line.find('#')?;
    let stamp = line[..at].trim_matches(|c: char| c.is_whitespace() || ",;->[]".contains(c));
    let mut all = Vec::new();
    for part in line[at + 1..].split('#') {
        let (mark, numbers) = part.split_once('=')?;
        let kind = match mark.as_bytes() {
            b"YPRAG" | b"YPRAGM" => Kind::All,
            [b'A', b'-', raw @ (b'R' | b'C')] => Kind::Accel(*raw),
            [b'M', b'-', raw @ (b'R' | b'C')] => Kind::Field(*raw),
            [b'G', b'-', raw @ (b'R' | b'C')] => Kind::Gyro(*raw),
            b"YPR" => continue,
            _ => return None,
        };
        let numbers: Vec<&str> = numbers.split(',').map(str::trim).collect();
        let is_number = |text: &&str| text.parse::<f64>().is_ok_and(f64::is_finite);
        let whole = match kind {
            Kind::All => matches!(numbers.len(), 9 | 12),
            _ => numbers.len() == 3,
        };
        if !whole || !numbers.iter().all(is_number) {
            return None;
        }
        all.push((kind, numbers));
    }
    (!all.is_empty()).then_some((stamp, all))
}

fn parts(look: &Look) -> Option<Vec<Part>> {
    let lines: Vec<_> = look.lines().filter_map(split).collect();
    let kinds = || lines.iter().flat_map(|(_, parts)| parts);
    let stamped = usize::from(lines.len() > 1 && lines.iter().all(|(stamp, _)| !stamp.is_empty()));
    let has = |kind: Kind| kinds().filter(|(other, _)| *other == kind).count() > 1;
    let together = kinds().filter(|(kind, _)| *kind == Kind::All);
    let change: Change;
    let (force, rate, field);
    let frame: [Option<Kind>; 3];
    if has(Kind::All) {
        let with_field = together.clone().all(|(_, numbers)| numbers.len() == 12);
        (force, rate, field) = (4, 7, with_field.then_some(10));
        change = |text| rows(text, |kind| (kind == Kind::All).then_some(0), 1);
        frame = [None; 3];
    } else {
        // Raw before calibrated.
        let is_whole = |raw: &u8| has(Kind::Accel(*raw)) && has(Kind::Gyro(*raw));
        let raw = [b'R', b'C'].into_iter().find(is_whole)?;
        let with_field = has(Kind::Field(raw));
        (force, rate, field) = (1, 4, with_field.then_some(7));
        change = match (raw, with_field) {
            (b'R', true) => |text| rows(text, |kind| place(kind, b'R'), 3),
            (b'R', false) => |text| rows(text, |kind| place(kind, b'R').filter(|at| *at < 2), 2),
            (_, true) => |text| rows(text, |kind| place(kind, b'C'), 3),
            (_, false) => |text| rows(text, |kind| place(kind, b'C').filter(|at| *at < 2), 2),
        };
        frame = [Some(Kind::Accel(raw)), Some(Kind::Gyro(raw)), None];
    }
    let raw = frame[0] == Some(Kind::Accel(b'R'));
    let in_si = frame[0].is_none();
    let column = |at: usize| (at + stamped).to_string();
    let mut columns = Vec::new();
    for axis in 0..3 {
        let of_force = column(force + axis) + if raw { "" } else { PER_G };
        columns.push((Role::Accel(axis), of_force));
        columns.push((Role::Gyro(axis), column(rate + axis)));
        columns.extend(field.map(|field| (Role::Field(axis), column(field + axis))));
    }
    if stamped == 1 {
        columns.push((Role::Time, "1".to_owned()));
    }
    let of_day = stamped == 1 && lines.iter().all(|(stamp, _)| seconds(stamp).is_some());
    Some(vec![Part {
        columns,
        time_unit: of_day.then_some(TimeUnit::Seconds),
        accel_unit: Some(if raw { AccelUnit::Counts } else { AccelUnit::G }),
        gyro_unit: Some(if in_si {
            GyroUnit::RadiansPerSecond
        } else {
            GyroUnit::Counts
        }),
        negated: true,
        usual_rate: (stamped == 0).then_some(RATE.get()),
        change: Some(change),
        remark: Some(
            findings::Finding::of(findings::Kind::SIGN_TURNED).detail("system", "Razor AHRS"),
        ),
        ..Part::default()
    }])
}

/// The place in a row of accelerometer, gyroscope and magnetometer, raw or calibrated.
fn place(kind: Kind, raw: u8) -> Option<usize> {
    let kinds = [Kind::Accel(raw), Kind::Gyro(raw), Kind::Field(raw)];
    kinds.iter().position(|other| *other == kind)
}

/// A row where the last of a frame's `count` parts stands; the other lines are blank.
fn rows(
    text: Box<dyn Read + Send>,
    place: fn(Kind) -> Option<usize>,
    count: usize,
) -> Box<dyn Read + Send> {
    let mut clock = TimeOfDay::default();
    let mut frame: [Option<String>; 3] = [None, None, None];
    rewritten(text, move |line, out| {
        let text = std::str::from_utf8(line).unwrap_or_default();
        let Some((stamp, parts)) = split(text) else {
            return;
        };
        for (kind, numbers) in parts {
            let Some(at) = place(kind) else { continue };
            // One that is there already is of a frame that lost a line.
            if frame[at].is_some() {
                frame = [None, None, None];
            }
            frame[at] = Some(numbers.join(","));
        }
        if frame[..count].iter().any(Option::is_none) {
            return;
        }
        let stamp = match clock.read(stamp) {
            Some(seconds) => format!("{seconds:.6}"),
            None => stamp.to_owned(),
        };
        let stamp = (!stamp.is_empty()).then_some(stamp);
        let cells = frame.iter_mut().filter_map(Option::take);
        let cells: Vec<String> = stamp.into_iter().chain(cells).collect();
        out.extend_from_slice(cells.join(",").as_bytes());
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::rewrite::changed_by;

    fn changed(text: &str) -> (Vec<Part>, String) {
        let parts = parts(&Look::at(text.as_bytes())).unwrap();
        let rows = changed_by(parts[0].change.unwrap(), text);
        (parts, rows)
    }

    #[test]
    fn lines_of_all_sensors_and_of_each_are_rows() {
        let (parts, rows) =
            changed("#YPRAG=1,2,3,0.1,-0.2,256,0.01,0,0\n#YPRAG=1,2,3,0,0,255,0,0.5,0\n");
        assert_eq!(rows, "1,2,3,0.1,-0.2,256,0.01,0,0\n1,2,3,0,0,255,0,0.5,0\n");
        assert_eq!(parts[0].columns[0], (Role::Accel(0), "4/256".to_owned()));
        assert_eq!(parts[0].usual_rate, Some(50.0));
        let frame = "#A-R=1,2,3\n#M-R=7,8,9\n#G-R=4,5,6\n#A-C=0,0,0\n#M-C=0,0,0\n#G-C=0,0,0\n";
        let (parts, rows) = changed(&frame.repeat(3));
        assert_eq!(
            rows.split_whitespace().collect::<Vec<_>>(),
            ["1,2,3,4,5,6,7,8,9"; 3]
        );
        assert_eq!(parts[0].accel_unit, Some(AccelUnit::Counts));
    }

    #[test]
    fn a_lost_line_costs_its_frame_alone_and_stamps_are_kept() {
        let text = "0.00 #A-C=1,1,1 #G-C=1,1,1\n0.02 #A-C=2,2,2\n0.04 #A-C=3,3,3 #G-C=3,3,3\n";
        let (parts, rows) = changed(text);
        assert_eq!(
            rows.split_whitespace().collect::<Vec<_>>(),
            ["0.00,1,1,1,1,1,1", "0.04,3,3,3,3,3,3"]
        );
        assert!(parts[0].columns.contains(&(Role::Time, "1".to_owned())));
        let text = "12:00:00.5 -> #A-R=1,1,1\n12:00:00.5 -> #G-R=1,1,1\n".repeat(2);
        let (parts, rows) = changed(&text);
        assert!(rows.contains("43200.500000,1,1,1,1,1,1"), "{rows}");
        assert_eq!(parts[0].time_unit, Some(TimeUnit::Seconds));
    }

    #[test]
    fn comments_are_no_lines_of_it() {
        for text in [
            "# a=1,2,3\n# b=1,2,3\n",
            "#A-R=1,2\n#A-R=1,2\n",
            "t,ax\n1,2\n",
            "#YPR=1,2,3\n#YPR=1,2,3\n",
        ] {
            assert!(parts(&Look::at(text.as_bytes())).is_none(), "{text}");
        }
    }
}
