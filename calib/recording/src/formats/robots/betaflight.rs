//! The blackbox of Betaflight, Cleanflight and INAV as CSV, by `blackbox_decode` or by Blackbox Explorer.
//!
//! Source: betaflight/blackbox-tools, `blackbox_decode.c`: stamps in µs, the gyroscope in deg/s, the accelerometer in counts of
//! which the log's header calls `acc_1G` one g, or in the unit behind its name. The board's frame is forward, left, up.

use findings::{Finding, Kind};
use std::io::Read;

use crate::formats::texts::TextFormat;
use crate::header::look::{Look, cells, numbered};
use crate::header::names::take_apart;
use crate::recording::options::Role;
use crate::rows::parts::Part;
use crate::source::rewrite::rewritten;
use crate::units::{AccelUnit, GyroUnit, TimeUnit};

/// A decoded blackbox.
pub(crate) static BETAFLIGHT: TextFormat = TextFormat {
    name: "betaflight",
    about: "a Betaflight blackbox as CSV: `loopIteration,time (us),..,gyroADC[0],..,accSmooth[0],..`",
    parts,
};

/// The gyroscope before its filters, and behind them.
const GYRO: [&str; 2] = ["gyroUnfilt", "gyroADC"];
/// The accelerometer, by the name of its firmware.
const ACCEL: [&str; 2] = ["accSmooth", "accADC"];

/// The columns called `stem[0]` to `stem[2]`, and the unit behind the first.
fn triad(names: &[String], stem: &str) -> Option<([String; 3], Option<String>)> {
    let find = |axis: usize| {
        let wanted = format!("{stem}[{axis}]");
        names
            .iter()
            .find(|name| name.split(" (").next() == Some(wanted.as_str()))
    };
    let unit = find(0)?
        .split_once(" (")
        .map(|(_, unit)| unit.trim_end_matches(')').to_owned());
    let column = |axis| numbered(names, find(axis)?);
    Some(([column(0)?, column(1)?, column(2)?], unit))
}

fn parts(look: &Look) -> Option<Vec<Part>> {
    let is_header = |names: &[String]| {
        names.iter().any(|name| name == "loopIteration") && triad(names, "gyroADC").is_some()
    };
    let names = look.far_header(is_header)?;
    let is_time = |name: &&String| take_apart(name).0 == "time";
    let mut columns = vec![(Role::Time, numbered(&names, names.iter().find(is_time)?)?)];
    let gyro = GYRO
        .iter()
        .find_map(|stem| Some((stem, triad(&names, stem)?)));
    let accel = ACCEL.iter().find_map(|stem| triad(&names, stem));
    let (stem, (axes, unit)) = gyro?;
    let gyro_unit = match unit.as_deref() {
        None => Some(GyroUnit::DegreesPerSecond),
        Some(unit) => unit.parse().ok(),
    };
    columns.extend((0..3).map(|axis| (Role::Gyro(axis), axes[axis].clone())));
    let mut accel_unit = None;
    if let Some((axes, unit)) = accel {
        let one_g = one_g(look).filter(|_| unit.is_none());
        accel_unit = match (unit.as_deref(), one_g) {
            (Some(unit), _) => unit.parse().ok(),
            (None, Some(_)) => Some(AccelUnit::G),
            (None, None) => Some(AccelUnit::Counts),
        };
        let per_g = one_g.map_or_else(String::new, |counts| format!("/{counts}"));
        let axis = |axis: usize| (Role::Accel(axis), format!("{}{per_g}", axes[axis]));
        columns.extend((0..3).map(axis));
    }
    if let Some((axes, _)) = triad(&names, "magADC") {
        columns.extend((0..3).map(|axis| (Role::Field(axis), axes[axis].clone())));
    }
    Some(vec![Part {
        columns,
        time_unit: Some(TimeUnit::Microseconds),
        change: Some(below_settings),
        accel_unit,
        gyro_unit,
        remark: Some(
            Finding::of(Kind::FILTERED_BEFORE)
                .detail("system", "Betaflight")
                .detail("gyro", *stem)
                .detail("accel", "accSmooth"),
        ),
        ..Part::default()
    }])
}

/// The table without the settings above it, which may be more lines than rows are looked at.
fn below_settings(text: Box<dyn Read + Send>) -> Box<dyn Read + Send> {
    let mut begun = false;
    rewritten(text, move |line, out| {
        begun |= memchr::memmem::find(line, b"loopIteration").is_some();
        if begun {
            out.extend_from_slice(line);
        }
    })
}

/// Counts of one g, as the header above the names says it.
fn one_g(look: &Look) -> Option<f64> {
    let is_it =
        |cells: &[String]| cells.len() >= 2 && cells[0].trim_start_matches("H ") == "acc_1G";
    let line = look
        .far_lines()
        .find(|line| line.contains("acc_1G"))
        .map(cells)?;
    let line = match line.len() {
        1 => line[0].split(':').map(str::to_owned).collect(),
        _ => line,
    };
    let counts = line
        .get(1)
        .filter(|_| is_it(&line))?
        .trim()
        .parse::<f64>()
        .ok()?;
    (1.0..1e6).contains(&counts).then_some(counts)
}

#[cfg(test)]
mod tests {
    use super::*;

    const NAMES: &str = "loopIteration, time (us), axisP[0], gyroADC[0], gyroADC[1], gyroADC[2], accSmooth[0], accSmooth[1], accSmooth[2], flightModeFlags (flags)\n";

    fn part(text: &str) -> Part {
        parts(&Look::at(text.as_bytes())).unwrap().remove(0)
    }

    #[test]
    fn counts_of_one_g_are_those_of_the_header() {
        let found = part(NAMES);
        assert_eq!(
            (found.accel_unit, found.gyro_unit),
            (Some(AccelUnit::Counts), Some(GyroUnit::DegreesPerSecond))
        );
        assert_eq!(found.columns[0], (Role::Time, "2".to_owned()));
        let settings = "\"Product\",\"Blackbox flight data recorder by Nicholas Sherlock\"\n"
            .to_owned()
            + &"\"a\",\"1\"\n".repeat(150)
            + "\"acc_1G\",\"2048\"\n"
            + &NAMES.replace(" (us)", "");
        let found = part(&settings);
        assert_eq!(found.accel_unit, Some(AccelUnit::G));
        assert!(
            found
                .columns
                .contains(&(Role::Accel(2), "9/2048".to_owned()))
        );
    }

    #[test]
    fn units_behind_the_names_are_taken() {
        let names = NAMES.replace("], ", "] (x), ");
        let names = names
            .replace("gyroADC[0] (x)", "gyroADC[0] (rad/s)")
            .replace("accSmooth[0] (x)", "accSmooth[0] (m/s/s)");
        let found = part(&names);
        assert_eq!(found.gyro_unit, Some(GyroUnit::RadiansPerSecond));
        assert_eq!(found.accel_unit, Some(AccelUnit::MetresPerSecondSquared));
        assert!(parts(&Look::at(b"loopIteration,time,ax,ay,az\n1,2,3,4,5\n")).is_none());
    }
}
