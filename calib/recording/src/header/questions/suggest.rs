//! Suggested options where column names are not understood.

use findings::{Finding, Kind, OptionName, Remedy};
use sensor::Sensor;

use crate::header::names::{is_like_time, is_of_ticks, role_of, take_apart};
use crate::header::triads::{Triad, triads};
use crate::recording::options::Role;
use crate::shown::shown;
use crate::units::TimeUnit;

/// An example for a table of `width` columns where nothing better is known.
fn by_number(width: usize) -> Remedy {
    let example = match width {
        0..3 => "t=1,ax=2",
        3 => "ax=1,ay=2,az=3",
        4..7 => "t=1,ax=2,ay=3,az=4",
        _ => "t=1,ax=2,ay=3,az=4,gx=5,gy=6,gz=7",
    };
    Remedy::such_as(OptionName::Columns, example)
}

/// True for an error whose example of columns is only by their number in the table.
pub(crate) fn is_by_number(found: &Finding) -> bool {
    let is_example = |remedy: &Remedy| match remedy {
        Remedy::Example { any_of } => any_of.iter().any(|s| s.option == OptionName::Columns),
        _ => false,
    };
    matches!(found.kind, Kind::NO_SENSOR_COLUMNS | Kind::COLUMN_MISSING)
        && found.remedies.iter().any(is_example)
}

/// The name most like `wanted`, if one is.
pub(crate) fn nearest<'a>(wanted: &str, names: &'a [String]) -> Option<&'a String> {
    let likeness =
        |name: &String| strsim::jaro_winkler(&wanted.to_lowercase(), &name.to_lowercase());
    let best = names
        .iter()
        .max_by(|a, b| likeness(a).total_cmp(&likeness(b)))?;
    (likeness(best) > 0.7).then_some(best)
}

/// A `--columns` line ready to paste: columns that have roles, and of `unclear` three for the sensor that has none.
pub(crate) fn completed(
    roles: &[(Role, String)],
    names: &[String],
    unclear: &[String],
    missing: Sensor,
) -> Option<Remedy> {
    let found = triads(unclear);
    let named = found.iter().find(|t| t.sensor() == Some(missing));
    let triad = match (named, found.iter().find(|t| !t.is_of_another()), unclear) {
        (Some(triad), ..) | (None, Some(triad), _) => {
            triad.columns.map(|at| unclear[at].clone()).to_vec()
        }
        (None, None, [_, _, _]) => unclear.to_vec(),
        _ => return None,
    };
    let called = |name: &String| {
        let at = names.iter().position(|other| other == name);
        at.map_or_else(|| name.clone(), |at| entry(names, at))
    };
    // A sum with gravity is found again without being named.
    let is_column = |name: &String| names.contains(name) || name.parse::<usize>().is_ok();
    let known = roles
        .iter()
        .filter(|(role, name)| !matches!(role, Role::Field(_)) && is_column(name));
    let known = known.map(|(role, name)| format!("{}={}", role.name(), called(name)));
    let role = |axis| Role::axis(missing, axis);
    let axes = triad.iter().enumerate();
    let added = axes.map(|(axis, name)| format!("{}={}", role(axis).name(), called(name)));
    let entries: Vec<String> = known.chain(added).collect();
    Some(asked(&entries))
}

/// A `--columns` line ready to paste, as far as words in the names tell what is what.
pub(crate) fn suggestion(names: &[String]) -> Remedy {
    let found = triads(names);
    let first = |sensor| found.iter().find(|t| t.sensor() == Some(sensor));
    let accel = first(Sensor::Accelerometer);
    // Of several the one that is called most like the accelerometer.
    let gyros = found
        .iter()
        .filter(|t| t.sensor() == Some(Sensor::Gyroscope));
    let gyro = gyros.reduce(|best, other| {
        let like = |t: &Triad| accel.map_or(0, |a| a.likeness(t) + a.ending(t));
        match like(other) > like(best) {
            true => other,
            false => best,
        }
    });
    // Where one is known and one other may be a sensor's, it is the other.
    let open: Vec<&Triad> = found
        .iter()
        .filter(|t| t.sensor().is_none() && !t.is_of_another())
        .collect();
    let other = match open[..] {
        [one] => Some(one),
        _ => None,
    };
    let (accel, gyro) = match (accel, gyro) {
        (Some(accel), None) => (Some(accel), other),
        (None, Some(gyro)) => (other, Some(gyro)),
        // Of one alone it is the sensor that nearly every table has.
        (None, None) if time(names).is_some() => (other, None),
        both => both,
    };
    let mut entries: Vec<String> = time(names)
        .map(|at| format!("t={}", entry(names, at)))
        .into_iter()
        .collect();
    for (sensor, triad) in [(Sensor::Accelerometer, accel), (Sensor::Gyroscope, gyro)] {
        for (axis, at) in triad.iter().flat_map(|t| t.columns).enumerate() {
            let role = Role::axis(sensor, axis);
            entries.push(format!("{}={}", role.name(), entry(names, at)));
        }
    }
    match (accel, gyro) {
        (None, None) => by_number(names.len()),
        _ => asked(&entries),
    }
}

/// The column that is the time by its name, or most like it.
pub(crate) fn time(names: &[String]) -> Option<usize> {
    let is = |name: &String| role_of(name, None) == Some(Role::Time);
    let exact = names.iter().position(|name| is(name) && !is_of_ticks(name));
    let in_time = |name: &String| {
        let unit = take_apart(name).1;
        unit.is_some_and(|unit| unit.parse::<TimeUnit>().is_ok())
    };
    // Ticks of a clock are counts of something; a time beside them is one.
    let says_time = |name: &String| {
        let word = name.to_lowercase();
        is_like_time(name) && (word.contains("time") || word.contains("stamp"))
    };
    let ticks = || names.iter().position(is);
    let like = || {
        let named = names.iter().position(says_time);
        named
            .or_else(ticks)
            .or_else(|| names.iter().position(|name| is_like_time(name)))
    };
    exact
        .or_else(like)
        .or_else(|| names.iter().position(in_time))
}

fn asked(entries: &[String]) -> Remedy {
    Remedy::set_to(OptionName::Columns, entries.join(","))
}

/// A word as a shell takes it.
pub(crate) fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || "_-.:/+".contains(c);
    match !word.is_empty() && word.chars().all(plain) && !word.starts_with('-') {
        true => shown(word),
        false => format!("'{}'", shown(word).replace('\'', "")),
    }
}

/// Returns the entry of a column for `--columns`: its name, or its number if the name is not unique or has special characters.
pub(crate) fn entry(names: &[String], at: usize) -> String {
    // A comma or quote in a name would end the entry, and of two of one name it would be the first; its number says
    // which.
    let plain = !names[at].contains([',', '\'', '=']) && !names[at].trim().is_empty();
    let alone = names.iter().filter(|name| **name == names[at]).count() == 1;
    match plain && alone {
        true => shown(&names[at]),
        false => (at + 1).to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(names: &[&str]) -> String {
        let names: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
        match suggestion(&names) {
            Remedy::Set { any_of } | Remedy::Example { any_of } => any_of[0].value.clone().unwrap(),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn a_suggestion_gives_each_sensor_what_is_called_after_it() {
        let names = [
            "id",
            "timestamp",
            "ang_vel_x",
            "ang_vel_y",
            "ang_vel_z",
            "lin_acc_x",
            "lin_acc_y",
            "lin_acc_z",
        ];
        assert!(of(&names).ends_with(
            "t=timestamp,ax=lin_acc_x,ay=lin_acc_y,az=lin_acc_z,gx=ang_vel_x,gy=ang_vel_y,gz=ang_vel_z"
        ));
        let names = [
            "Clock:Tick#",
            "Clock:offsetTime",
            "accelX",
            "accelY",
            "accelZ",
        ];
        assert!(of(&names).starts_with("t=Clock:offsetTime,"));
        let names = ["Tick#", "offsetTime", "u:accelX", "u:accelY", "u:accelZ"];
        assert!(of(&names).starts_with("t=offsetTime,"));
        // Two devices: the gyroscope of the one whose accelerometer is taken.
        let names = [
            "t", "l_acc_x", "l_acc_y", "l_acc_z", "r_gyr_x", "r_gyr_y", "r_gyr_z", "l_gyr_x",
            "l_gyr_y", "l_gyr_z",
        ];
        assert!(of(&names).contains("gx=l_gyr_x"), "{}", of(&names));
        // Temperature and status are no time, and an accelerometer that lacks an axis is none.
        let names = ["Tmp", "ax", "ay", "gx", "gy", "gz"];
        assert!(of(&names).ends_with("gx=gx,gy=gy,gz=gz"), "{}", of(&names));
        assert_eq!(
            of(&["1", "2", "3", "4", "5", "6", "7"]),
            "t=1,ax=2,ay=3,az=4,gx=5,gy=6,gz=7"
        );
        assert!(!of(&["sensor", "t", "x", "y", "z"]).contains("gy="));
        assert_eq!(
            of(&["accuracy", "timestamp", "values.x", "values.y", "values.z"]),
            "t=timestamp,ax=values.x,ay=values.y,az=values.z"
        );
    }
}
