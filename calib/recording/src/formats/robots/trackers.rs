//! Xsens and Shimmer tables, whose names leave the unit or the sensor open.

use crate::formats::texts::TextFormat;
use crate::header::look::{Look, numbered};
use crate::recording::options::Role;
use crate::rows::parts::Part;
use crate::units::{AccelUnit, GyroUnit, TimeUnit};
use findings::{Finding, Kind};

/// Xsens MTi (tenths of milliseconds, rad/s) and DOT (microseconds, deg/s).
pub(crate) static XSENS: TextFormat = TextFormat {
    name: "xsens",
    about: "a table of Xsens MTi or DOT: `PacketCounter,SampleTimeFine,Acc_X,..,Gyr_X,..`",
    parts: xsens,
};

/// Shimmer's ConsensysPRO.
pub(crate) static SHIMMER: TextFormat = TextFormat {
    name: "shimmer",
    about: "a table of Shimmer: `Shimmer_5E6F_Timestamp_Unix_CAL`, `.._Accel_LN_X_CAL`, `.._Gyro_X_CAL`",
    parts: shimmer,
};

const AXES: [&str; 3] = ["X", "Y", "Z"];

fn triads(
    names: &[String],
    accel: impl Fn(&str) -> Option<String>,
    gyro: impl Fn(&str) -> Option<String>,
) -> Vec<(Role, String)> {
    let mut columns = Vec::new();
    for (axis, letter) in AXES.into_iter().enumerate() {
        let at = |name: Option<String>| name.and_then(|name| numbered(names, &name));
        columns.extend(at(accel(letter)).map(|column| (Role::Accel(axis), column)));
        columns.extend(at(gyro(letter)).map(|column| (Role::Gyro(axis), column)));
    }
    columns
}

fn xsens(look: &Look) -> Option<Vec<Part>> {
    let names = look.header(|names| names.iter().any(|name| name == "SampleTimeFine"))?;
    let mut columns = triads(
        &names,
        |axis| Some(format!("Acc_{axis}")),
        |axis| Some(format!("Gyr_{axis}")),
    );
    if columns.is_empty() {
        return None;
    }
    columns.push((Role::Time, numbered(&names, "SampleTimeFine")?));
    // Exports of the MTi begin with `// General information`, those of the DOT with `sep=,` or the header.
    let mti = look
        .lines()
        .next()
        .is_some_and(|line| line.starts_with("//"));
    Some(vec![Part {
        columns,
        time_unit: Some(if mti {
            TimeUnit::TenthMilliseconds
        } else {
            TimeUnit::Microseconds
        }),
        accel_unit: Some(AccelUnit::MetresPerSecondSquared),
        gyro_unit: Some(if mti {
            GyroUnit::RadiansPerSecond
        } else {
            GyroUnit::DegreesPerSecond
        }),
        remark: Some(
            Finding::of(Kind::UNITS_OF_FORMAT)
                .detail("system", if mti { "Xsens MTi" } else { "Xsens DOT" })
                .detail("time", if mti { "0.1 ms" } else { "µs" })
                .detail("rate", if mti { "rad/s" } else { "deg/s" }),
        ),
        ..Part::default()
    }])
}

fn shimmer(look: &Look) -> Option<Vec<Part>> {
    let names = look.header(|names| {
        names
            .iter()
            .any(|name| name.starts_with("Shimmer_") && name.ends_with("_CAL"))
    })?;
    let ending = |end: String| names.iter().find(|name| name.ends_with(&end)).cloned();
    let accel = |kind: &'static str| move |axis: &str| ending(format!("_Accel_{kind}_{axis}_CAL"));
    let gyro = |axis: &str| ending(format!("_Gyro_{axis}_CAL"));
    let low_noise = triads(&names, accel("LN"), gyro);
    let wide_range = triads(&names, accel("WR"), gyro);
    let both = accel("LN")("X").is_some() && accel("WR")("X").is_some();
    // Two accelerometers: the user has to say which.
    let mut columns = if both {
        return None;
    } else if low_noise.len() >= wide_range.len() {
        low_noise
    } else {
        wide_range
    };
    let stamps = [
        "Timestamp_Unix_CAL",
        "TimestampSync_Unix_CAL",
        "Timestamp_SyncUnix_CAL",
        "Timestamp_CAL",
        "Timestamp_FormattedUnix_CAL",
    ];
    let stamp = stamps.iter().find_map(|name| ending((*name).to_owned()))?;
    columns.push((Role::Time, numbered(&names, &stamp)?));
    (columns.len() > 3).then(|| {
        vec![Part {
            columns,
            time_unit: Some(TimeUnit::Milliseconds),
            ..Part::default()
        }]
    })
}
