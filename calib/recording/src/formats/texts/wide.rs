//! Tables of two sensors side by side, each with a time of its own: `Time (s),Acceleration x,..,Time (s),Gyroscope x,..`.

use sensor::Sensor;

use super::text_format::TextFormat;
use crate::header::look::Look;
use crate::header::names::{is_message_stamp, role_of, stamps_of};
use crate::recording::options::Role;
use crate::rows::parts::Part;

/// A table of which a row is no instant: the shorter sensor ends before the other does.
pub(crate) static WIDE: TextFormat = TextFormat {
    name: "wide",
    about: "a table with a time before each sensor: `Time (s),Acceleration x,..,Time (s),Gyroscope x,..`",
    parts,
};

fn parts(look: &Look) -> Option<Vec<Part>> {
    let names = look.first();
    let roles: Vec<Option<Role>> = names.iter().map(|name| role_of(name, None)).collect();
    let at = |wanted: Role| roles.iter().position(|role| *role == Some(wanted));
    let is_time = |at: &usize| roles[*at] == Some(Role::Time) || stamps_of(&names[*at]).is_some();
    let times: Vec<usize> = (0..names.len()).filter(is_time).collect();
    let (mut parts, mut stamps): (Vec<Part>, Vec<(usize, bool)>) = (Vec::new(), Vec::new());
    for sensor in [Sensor::Accelerometer, Sensor::Gyroscope] {
        let [Some(x), Some(y), Some(z)] = [0, 1, 2].map(|axis| at(Role::axis(sensor, axis))) else {
            return None;
        };
        // The one called after the sensor, else the last one before it that is not called after the other.
        let called = times
            .iter()
            .find(|at| stamps_of(&names[**at]) == Some(sensor));
        // The stamp of another message's header is no clock of this sensor.
        let of_another = |at: usize| {
            names[at].to_lowercase().contains("header") && !is_message_stamp(&names[at], &names[x])
        };
        let mut before = times.iter().rev().filter(|at| !of_another(**at));
        let before = before.find(|at| **at < x && stamps_of(&names[**at]).is_none());
        let time = *called.or(before)?;
        stamps.push((time, is_message_stamp(&names[time], &names[x])));
        let columns = [time, x, y, z].map(|at| (at + 1).to_string());
        parts.push(Part {
            padded: true,
            ..Part::of(sensor, columns.each_ref().map(String::as_str))
        });
    }
    // One time for both is a table like any other, and so is the stamp of a message beside the time when it arrived.
    let [accel, gyro] = stamps[..] else {
        return None;
    };
    let of_one_message = accel.1 != gyro.1;
    (accel.0 != gyro.0 && !of_one_message).then_some(parts)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn columns(header: &str) -> Option<Vec<Vec<String>>> {
        let parts = parts(&Look::at(header.as_bytes()))?;
        let called = |part: &Part| part.columns.iter().map(|(_, at)| at.clone()).collect();
        Some(parts.iter().map(called).collect())
    }

    #[test]
    fn each_sensor_has_the_time_before_it() {
        let header = "time,accX,accY,accZ,time,gyrX,gyrY,gyrZ\n";
        let expected = [["1", "2", "3", "4"], ["5", "6", "7", "8"]];
        let expected = expected.map(|part| part.map(str::to_owned).to_vec());
        assert_eq!(columns(header), Some(expected.to_vec()));
        let header = "accel_ts,gyro_ts,ax,ay,az,gx,gy,gz\n";
        let expected = [["1", "3", "4", "5"], ["2", "6", "7", "8"]];
        let expected = expected.map(|part| part.map(str::to_owned).to_vec());
        assert_eq!(columns(header), Some(expected.to_vec()));
        assert_eq!(columns("time,ax,ay,az,gx,gy,gz,timestamp\n"), None);
        assert_eq!(columns("timestamp,time,ax,ay,az,gx,gy,gz\n"), None);
        assert_eq!(columns("__time,gx,gy,gz,header/stamp,ax,ay,az\n"), None);
    }
}
