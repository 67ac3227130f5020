//! Gyroflow's log: `GYROFLOW IMU LOG`, its scales, then `t,gx,gy,gz,ax,ay,az` in whole numbers.

use crate::formats::texts::TextFormat;
use crate::header::look::Look;
use crate::recording::options::Role;
use crate::rows::parts::Part;
use crate::units::field::FieldUnit;
use crate::units::{AccelUnit, GyroUnit};

/// Gyroflow's `.gcsv`, whose scales make s, rad/s and g of its numbers (Gyroflow documentation, "GCSV log format").
pub(crate) static GYROFLOW: TextFormat = TextFormat {
    name: "gyroflow",
    about: "Gyroflow's log `.gcsv`: whole numbers below the scales that make seconds, rad/s and g of them",
    parts,
};

/// The first line.
const MARK: &str = "GYROFLOW IMU LOG";

/// The scale of the gyroscope, to rad/s.
const OF_RATE: &str = "gscale";
/// The scale of the accelerometer, to g.
const OF_FORCE: &str = "ascale";
/// The scale of the magnetometer, to gauss.
const OF_FIELD: &str = "mscale";

/// A scale that a log states, with the columns that it is of.
const SCALES: [(&str, &[Role]); 4] = [
    ("tscale", &[Role::Time]),
    (OF_RATE, &[Role::Gyro(0), Role::Gyro(1), Role::Gyro(2)]),
    (OF_FORCE, &[Role::Accel(0), Role::Accel(1), Role::Accel(2)]),
    (OF_FIELD, &[Role::Field(0), Role::Field(1), Role::Field(2)]),
];

fn parts(look: &Look) -> Option<Vec<Part>> {
    let is_mark = |line: &str| line.trim().trim_end_matches(',') == MARK;
    look.lines().next().filter(|line| is_mark(line))?;
    let stated = |wanted: &str| {
        let mut settings = look.far_lines().filter_map(|line| line.split_once(','));
        let (_, value) = settings.find(|(name, _)| name.trim() == wanted)?;
        value.trim().trim_end_matches(',').parse::<f64>().ok()
    };
    let names = look.far_header(|names| names.first().is_some_and(|name| name == "t"))?;
    let mut columns = Vec::new();
    for (setting, roles) in SCALES {
        // Of numbers without a scale the data tell the unit.
        let scale = stated(setting).map_or_else(String::new, |scale| format!("*{scale:?}"));
        for role in roles {
            let at = names.iter().position(|name| name == role.name());
            columns.extend(at.map(|at| (*role, format!("{}{scale}", at + 1))));
        }
    }
    Some(vec![Part {
        columns,
        accel_unit: stated(OF_FORCE).map(|_| AccelUnit::G),
        field_unit: stated(OF_FIELD).map(|_| FieldUnit::Gauss),
        gyro_unit: stated(OF_RATE).map(|_| GyroUnit::RadiansPerSecond),
        ..Part::default()
    }])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_with_the_scales_of_the_log() {
        let log = "GYROFLOW IMU LOG\nversion,1.3\ntscale,0.001\ngscale,0.0012\nascale,0.0005\nt,gx,gy,gz,ax,ay,az\n0,1,2,3,4,5,6\n";
        let parts = parts(&Look::at(log.as_bytes())).unwrap();
        let column = |wanted: Role| {
            let mut columns = parts[0].columns.iter();
            let found = columns.find(|(role, _)| *role == wanted);
            found.map(|(_, column)| column.as_str())
        };
        assert_eq!(column(Role::Time), Some("1*0.001"));
        assert_eq!(column(Role::Gyro(2)), Some("4*0.0012"));
        assert_eq!(column(Role::Accel(0)), Some("5*0.0005"));
        let bare = log.replace("gscale,0.0012\n", "");
        let parts = super::parts(&Look::at(bare.as_bytes())).unwrap();
        assert_eq!(
            (parts[0].gyro_unit, parts[0].accel_unit),
            (None, Some(AccelUnit::G))
        );
    }
}
