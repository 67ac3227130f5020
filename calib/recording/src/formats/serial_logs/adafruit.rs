//! The lines of Adafruit's example programs: a line for each sensor, called in words.

use std::io::Read;

use super::log_prefix::{Stamp, by_terminal};
use crate::clock::time_of_day::TimeOfDay;
use crate::formats::texts::TextFormat;
use crate::header::look::Look;
use crate::recording::options::Role;
use crate::rows::parts::Part;
use crate::source::rewrite::rewritten;
use crate::units::{AccelUnit, GyroUnit, TimeUnit};

/// Adafruit's example programs.
pub(crate) static ADAFRUIT: TextFormat = TextFormat {
    name: "adafruit",
    about: "what Adafruit's examples print: `Acceleration X: .., Y: .., Z: .. m/s^2`, `Rotation X: ..`; without stamps of a terminal the rate has to be given",
    parts: blocks,
};

/// The words before the numbers of a sensor, its units behind the numbers ...
const ACCELERATION: [&str; 3] = ["Acceleration X:", "Accel X:", "Acceleration: X:"];
const ROTATION: [&str; 4] = ["Rotation X:", "Gyro X:", "Gyro: X:", "Rotation: X:"];
/// ... and what they begin with where no units follow.
const BARE: [[&str; 1]; 2] = [["Accel:"], ["Gyro:"]];

/// Three numbers of a line and its stamp.
type Triad<'a> = (Option<Stamp>, [&'a str; 3]);

/// The three numbers of `Acceleration X: 1, Y: 2, Z: 3 m/s^2`, called one of `quantity`.
fn triad<'a>(line: &'a str, quantity: &[&str]) -> Option<Triad<'a>> {
    let (stamp, line) = match by_terminal(line) {
        Some((stamp, line)) => (Some(stamp), line),
        None => (None, line),
    };
    let line = line.trim();
    let mut numbers = quantity
        .iter()
        .find_map(|quantity| line.strip_prefix(quantity))?
        .split([' ', ',', ':', '\t'])
        .filter(|word| word.parse::<f64>().is_ok_and(f64::is_finite));
    Some((stamp, [numbers.next()?, numbers.next()?, numbers.next()?]))
}

/// The same of `Accel: x= 1 | y= 2 | z= 3`.
fn bare<'a>(line: &'a str, quantity: &[&str]) -> Option<Triad<'a>> {
    let has_axes = [" |", "x=", "y=", "z="]
        .iter()
        .all(|part| line.contains(part));
    triad(line, quantity).filter(|_| has_axes)
}

fn force(line: &str) -> Option<Triad<'_>> {
    triad(line, &ACCELERATION).or_else(|| bare(line, &BARE[0]))
}

fn rate(line: &str) -> Option<Triad<'_>> {
    triad(line, &ROTATION).or_else(|| bare(line, &BARE[1]))
}

fn blocks(look: &Look) -> Option<Vec<Part>> {
    let (stamp, _) = look.lines().find_map(force)?;
    look.lines().find_map(rate)?;
    let has_units = look
        .lines()
        .any(|line| triad(line, &ACCELERATION).is_some());
    let stamped = usize::from(stamp.is_some());
    let axes = |axis: usize| {
        [
            (Role::Accel(axis), (stamped + axis + 1).to_string()),
            (Role::Gyro(axis), (stamped + axis + 4).to_string()),
        ]
    };
    let time = stamp.map(|_| (Role::Time, "1".to_owned()));
    Some(vec![Part {
        columns: time.into_iter().chain((0..3).flat_map(axes)).collect(),
        time_unit: stamp.map(|_| TimeUnit::Seconds),
        accel_unit: has_units.then_some(AccelUnit::MetresPerSecondSquared),
        gyro_unit: has_units.then_some(GyroUnit::RadiansPerSecond),
        change: Some(rows_of_blocks),
        ..Part::default()
    }])
}

/// A row for each block, with the stamp of its first line.
fn rows_of_blocks(text: Box<dyn Read + Send>) -> Box<dyn Read + Send> {
    let mut clock = TimeOfDay::default();
    let mut first: Option<Vec<String>> = None;
    rewritten(text, move |line, out| {
        let text = std::str::from_utf8(line).unwrap_or_default();
        if let Some((stamp, numbers)) = force(text) {
            let stamp = stamp.map(|stamp| stamp.written(&mut clock));
            let numbers = numbers.into_iter().map(str::to_owned);
            first = Some(stamp.into_iter().chain(numbers).collect());
        } else if let Some((_, rate)) = rate(text)
            && let Some(first) = first.take()
        {
            out.extend_from_slice(format!("{},{}", first.join(","), rate.join(",")).as_bytes());
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::rewrite::changed_by;

    fn rows(block: &'static str) -> String {
        assert!(blocks(&Look::at(block.as_bytes())).is_some(), "{block}");
        changed_by(rows_of_blocks, block).trim().to_owned()
    }

    #[test]
    fn blocks_of_all_kinds_of_words_are_one_row() {
        for block in [
            "Acceleration X: 1.00, Y: 2.00, Z: 3.00 m/s^2\nRotation X: 4.00, Y: 5.00, Z: 6.00 rad/s\n",
            "Acceleration: X:1.00, Y: 2.00, Z: 3.00 m/s^2\nGyro X:4.00, Y: 5.00, Z: 6.00 rad/s\n",
            "\t\tAccel X: 1.00 \tY: 2.00 \tZ: 3.00 m/s^2 \n\t\tGyro X: 4.00 \tY: 5.00 \tZ: 6.00 radians/s \n",
            "Accel:\t\tx= 1.00 |\ty= 2.00 |\tz= 3.00\nGyro:\t\tx= 4.00 |\ty= 5.00 |\tz= 6.00\ntemperature: 25\n",
        ] {
            assert_eq!(rows(block), "1.00,2.00,3.00,4.00,5.00,6.00");
        }
    }

    #[test]
    fn the_stamp_of_a_block_is_that_of_its_first_line() {
        for block in [
            "04:26:40.001 -> Accel X: 1.00\tY: 2.00\tZ: 3.00 m/s^2\n04:26:40.002 -> Gyro X: 4.00\tY: 5.00\tZ: 6.00 radians/s\n",
            "[04:26:40.001] Acceleration X: 1.00, Y: 2.00, Z: 3.00 m/s^2\n[04:26:40.002] Rotation X: 4.00, Y: 5.00, Z: 6.00 rad/s\n",
        ] {
            let expected = "16000.001000,1.00,2.00,3.00,4.00,5.00,6.00";
            assert_eq!(rows(block), expected);
        }
    }
}
