//! `sensor_msgs/Imu` as text: `rostopic echo -p` with a header, `ros2 topic echo --csv` without.

use std::io::Read;

use crate::formats::texts::TextFormat;
use crate::header::look::{Look, numbered};
use crate::recording::options::Role;
use crate::rows::parts::Part;
use crate::source::rewrite::rewritten;
use crate::units::{AccelUnit, GyroUnit, TimeUnit};

/// `rostopic echo -p`.
pub(crate) static ROSTOPIC: TextFormat = TextFormat {
    name: "rostopic",
    about: "`rostopic echo -p` of sensor_msgs/Imu, stamped by the message's header",
    parts: with_header,
};

/// `ros2 topic echo --csv`.
pub(crate) static ROS2_TOPIC: TextFormat = TextFormat {
    name: "ros2_topic",
    about: "`ros2 topic echo --csv` of sensor_msgs/msg/Imu, stamped by the message's header",
    parts: without_header,
};

/// Cells of an Imu: seconds, nanoseconds, frame, orientation 4 + 9, rate 3 + 9, acceleration 3 + 9.
const IMU: usize = 40;
/// First columns of rate and acceleration, from 1, once seconds and nanoseconds are one cell.
const RATE: usize = 16;
const ACCELERATION: usize = 28;

fn imu(
    columns: Vec<(Role, String)>,
    change: Option<crate::rows::parts::Change>,
    unit: TimeUnit,
) -> Part {
    Part {
        columns,
        time_unit: Some(unit),
        accel_unit: Some(AccelUnit::MetresPerSecondSquared),
        gyro_unit: Some(GyroUnit::RadiansPerSecond),
        change,
        ..Part::default()
    }
}

fn with_header(look: &Look) -> Option<Vec<Part>> {
    let stamp = "field.header.stamp";
    let names = look.header(|names| names.iter().any(|name| name == stamp))?;
    let mut columns = vec![(Role::Time, numbered(&names, stamp)?)];
    for (axis, letter) in ["x", "y", "z"].into_iter().enumerate() {
        let rate = numbered(&names, &format!("field.angular_velocity.{letter}"));
        columns.extend(rate.map(|column| (Role::Gyro(axis), column)));
        let force = numbered(&names, &format!("field.linear_acceleration.{letter}"));
        columns.extend(force.map(|column| (Role::Accel(axis), column)));
    }
    (columns.len() > 3).then(|| vec![imu(columns, None, TimeUnit::Nanoseconds)])
}

fn without_header(look: &Look) -> Option<Vec<Part>> {
    let is_imu = |line: &&str| {
        let cells: Vec<&str> = line.split(',').collect();
        cells.len() == IMU
            && cells[..2].iter().all(|cell| cell.parse::<u64>().is_ok())
            && cells[3..]
                .iter()
                .all(|cell| cell.trim().parse::<f64>().is_ok())
    };
    look.lines().next().filter(is_imu)?;
    let columns = (0..3).flat_map(|axis| {
        [
            (Role::Gyro(axis), (RATE + axis).to_string()),
            (Role::Accel(axis), (ACCELERATION + axis).to_string()),
        ]
    });
    let columns = std::iter::once((Role::Time, "1".to_owned()))
        .chain(columns)
        .collect();
    Some(vec![imu(columns, Some(one_stamp), TimeUnit::Seconds)])
}

/// Seconds and nanoseconds as one number.
fn one_stamp(text: Box<dyn Read + Send>) -> Box<dyn Read + Send> {
    rewritten(text, |line, out| {
        let mut cells = line.splitn(3, |byte| *byte == b',');
        let number =
            |cell: Option<&[u8]>| std::str::from_utf8(cell?).ok()?.trim().parse::<u64>().ok();
        let (seconds, nanoseconds) = (number(cells.next()), number(cells.next()));
        match (seconds, nanoseconds, cells.next()) {
            (Some(seconds), Some(nanoseconds), Some(rest)) => {
                out.extend_from_slice(format!("{seconds}.{nanoseconds:09},").as_bytes());
                out.extend_from_slice(rest);
            }
            _ => out.extend_from_slice(line),
        }
    })
}
