//! A column name taken apart: what it calls, and its unit.

use super::words::{is_field, sensor_of};
use crate::units::field::FieldUnit;
use crate::units::{self, AccelUnit, GyroUnit, TimeUnit};

/// Brackets that open a unit in a name, in the width of letters and in that of signs.
pub(crate) const OPENING: [char; 7] = ['(', '[', '{', '（', '［', '【', '〔'];
/// Brackets that close it.
const CLOSING: [char; 7] = [')', ']', '}', '）', '］', '】', '〕'];

findings::tuning! {
    /// Bytes of the longest name that may have a role: paths of topics take some tens.
    pub(crate) LONGEST: usize = 200;
}

/// A column name taken apart: what it calls, and the unit in brackets or behind an underscore.
pub(crate) fn take_apart(name: &str) -> (String, Option<&str>) {
    let name = without_run(name);
    if let Some((word, unit)) = before_axis(name.trim()) {
        return (word, Some(unit));
    }
    let (word, unit) = match last_bracket(name) {
        Some(at) => {
            let unit = name[at..].trim_start_matches(OPENING);
            let unit = unit.trim_end().trim_end_matches(CLOSING);
            (&name[..at], Some(unit))
        }
        None => behind_in(name)
            .or_else(|| behind_underscores(name.trim()))
            .map_or((name, None), |(word, unit)| (word, Some(unit))),
    };
    (compact(word), unit)
}

/// The name of the last run of an experiment.
const LATEST: &str = "latest";
/// Names of runs that have a number.
const RUNS: [&str; 5] = ["run", "data set", "messreihe", "durchlauf", "essai"];

/// A name without the run that programs of laboratories write around it: `Run 1: Time (s)`, `Latest: Time (s)`, `Time (s) Run #1`.
fn without_run(name: &str) -> &str {
    let own = name
        .split_once(':')
        .filter(|(label, _)| is_run(label) || label.trim().eq_ignore_ascii_case(LATEST));
    let name = own.map_or(name, |(_, own)| own.trim_start());
    let blanks = name.rmatch_indices(' ').take(2);
    let mut ends = blanks.map(|(at, _)| name.split_at(at));
    ends.find(|(_, end)| is_run(end))
        .map_or(name, |(own, _)| own.trim_end())
}

/// True for a run with its number: `Run 1`, `Run #1`.
fn is_run(label: &str) -> bool {
    let Some((word, number)) = label.trim().rsplit_once(' ') else {
        return false;
    };
    let number = number.trim_start_matches('#');
    let is_number = !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit());
    is_number && RUNS.contains(&word.to_lowercase().as_str())
}

/// Returns the index of the brackets at the end of a name, as in `accel(0):X[g]`; `None` if more of the name follows them.
pub(super) fn last_bracket(name: &str) -> Option<usize> {
    let (mut depth, mut begin, mut end) = (0_usize, None, None);
    for (at, c) in name.char_indices() {
        match c {
            _ if OPENING.contains(&c) => {
                if depth == 0 {
                    (begin, end) = (Some(at), None);
                }
                depth += 1;
            }
            _ if CLOSING.contains(&c) => {
                depth = depth.saturating_sub(1);
                end = (depth == 0).then_some(at).or(end);
            }
            _ => {}
        }
    }
    let behind = end.map_or("", |at| &name[at..]);
    begin.filter(|_| !behind.contains(char::is_alphanumeric))
}

/// A name whose unit stands before its axis: `accel_g.x`, `gyro_dps_y`.
fn before_axis(name: &str) -> Option<(String, &str)> {
    let (rest, axis) = name.rsplit_once(['.', '_'])?;
    let is_axis = matches!(axis, "x" | "y" | "z" | "X" | "Y" | "Z");
    let (word, unit) = behind_underscores(rest).filter(|_| is_axis)?;
    let word = compact(word);
    // `gyro_raw_x` says nothing of its unit.
    let is_unit = unit
        .parse()
        .is_ok_and(|unit: AccelUnit| unit != AccelUnit::Counts)
        || unit
            .parse()
            .is_ok_and(|unit: GyroUnit| unit != GyroUnit::Counts);
    let is_sensor = sensor_of(&word).is_some() && is_unit;
    let is_field = is_field(&word) && unit.parse::<FieldUnit>().is_ok();
    (is_sensor || is_field).then(|| (word + &axis.to_lowercase(), unit))
}

/// A name and the unit behind a word that leads to it, or behind a blank: `Beschleunigung_x in m/s²`, `acc_x m/s^2`.
fn behind_in(name: &str) -> Option<(&str, &str)> {
    let name = name.trim();
    let is_unit = |unit: &str| units::is_unit(unit) || unit.parse::<TimeUnit>().is_ok();
    let led_to = name
        .rsplit_once(" in ")
        .filter(|(_, unit)| is_unit(unit.trim()));
    let is_of_sensor = |unit: &str| unit.contains('/') && units::is_of_sensor(unit);
    let bare = || name.rsplit_once(' ').filter(|(_, unit)| is_of_sensor(unit));
    led_to.or_else(bare)
}

/// A name and the unit behind an underscore; one of a sensor may have underscores itself: `gyro_x_deg_per_sec`.
fn behind_underscores(name: &str) -> Option<(&str, &str)> {
    let splits: Vec<(&str, &str)> = name
        .rmatch_indices('_')
        .take(3)
        .map(|(at, _)| (&name[..at], &name[at + 1..]))
        .collect();
    let long = splits.iter().skip(1).rev();
    let of_sensor = long.copied().find(|(_, unit)| units::is_of_sensor(unit));
    let last = splits.first().copied();
    // `mag_x_T` has a unit, `acc_t` has none.
    let of_field = |(word, unit): &(&str, &str)| {
        let word = compact(word);
        let stem = word.strip_suffix(['x', 'y', 'z']).unwrap_or(&word);
        is_field(stem) && unit.parse::<FieldUnit>().is_ok()
    };
    of_sensor.or_else(|| last.filter(|split| units::is_unit(split.1) || of_field(split)))
}

/// The name of a channel behind the label of its sensor, whose number both end with: `ACC.X (g)` of `Avanti sensor 1: ACC.X 1 (g)`.
pub(super) fn behind_label(name: &str) -> Option<String> {
    let (label, rest) = name.split_once(':')?;
    let number = label.trim_end().rsplit(' ').next()?;
    let is_number = !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit());
    let at = last_bracket(rest).unwrap_or(rest.len());
    let (own, unit) = rest.split_at(at);
    let own = own
        .trim()
        .strip_suffix(number)
        .filter(|own| own.ends_with(' '))?;
    is_number.then(|| own.to_owned() + unit)
}

/// A name without punctuation, in small letters.
pub(crate) fn compact(word: &str) -> String {
    word.chars()
        .filter(|c| c.is_alphanumeric())
        .flat_map(char::to_lowercase)
        .collect()
}
