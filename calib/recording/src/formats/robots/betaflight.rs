//! Betaflight's and INAV's Blackbox as `blackbox_decode` and the Blackbox Explorer write it.

use crate::formats::texts::TextFormat;
use crate::header::look::{Look, numbered};
use crate::recording::options::Role;
use crate::rows::parts::Part;
use crate::units::{GyroUnit, TimeUnit};

/// The table that a decoded Blackbox log is.
pub(crate) static BETAFLIGHT: TextFormat = TextFormat {
    name: "betaflight",
    about: "a decoded Blackbox log of Betaflight or INAV: `loopIteration,time (us),..,gyroADC[0],..,accSmooth[0],..`",
    parts,
};

fn parts(look: &Look) -> Option<Vec<Part>> {
    let begins = |name: &String, stem: &str| name.starts_with(stem);
    let names = look.header(|names| names.iter().any(|name| begins(name, "loopIteration")))?;
    let column = |stem: &str| numbered(&names, names.iter().find(|name| begins(name, stem))?);
    let triad = |stem: &str| [0, 1, 2].map(|axis| column(&format!("{stem}[{axis}]")));
    let whole = |stem: &&str| triad(stem).iter().all(Option::is_some);
    // The readings before the filters, where they are logged.
    let gyro = ["gyroUnfilt", "gyroADC", "gyroData"]
        .into_iter()
        .find(whole);
    let accel = ["accSmooth", "accADC"].into_iter().find(whole);
    let axes = |stem: Option<&str>| stem.map(triad).into_iter().flatten().flatten().enumerate();
    let mut columns = vec![(Role::Time, column("time")?)];
    columns.extend(axes(accel).map(|(axis, column)| (Role::Accel(axis), column)));
    columns.extend(axes(gyro).map(|(axis, column)| (Role::Gyro(axis), column)));
    let stated = names
        .iter()
        .any(|name| begins(name, "gyro") && name.contains("/s"));
    (columns.len() > 3).then(|| {
        vec![Part {
            columns,
            time_unit: Some(TimeUnit::Microseconds),
            gyro_unit: (!stated).then_some(GyroUnit::DegreesPerSecond),
            ..Part::default()
        }]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_unfiltered_gyroscope_is_taken_where_it_is_there() {
        let header = "loopIteration, time (us), gyroADC[0] (deg/s), gyroADC[1] (deg/s), gyroADC[2] (deg/s), gyroUnfilt[0], gyroUnfilt[1], gyroUnfilt[2], accSmooth[0], accSmooth[1], accSmooth[2]\n";
        let part = &parts(&Look::at(header.as_bytes())).unwrap()[0];
        let columns: Vec<&str> = part.columns.iter().map(|(_, at)| at.as_str()).collect();
        assert_eq!(columns, ["2", "9", "10", "11", "6", "7", "8"]);
        assert!(parts(&Look::at(b"t,ax,ay,az,gx,gy,gz\n")).is_none());
    }
}
