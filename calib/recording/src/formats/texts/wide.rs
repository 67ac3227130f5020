//! Tables of two sensors side by side, each with a time of its own: `Time (s),Acceleration x,..,Time (s),Gyroscope x,..`.

use sensor::Sensor;

use super::text_format::TextFormat;
use crate::header::look::Look;
use crate::header::names::role_of;
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
    let times: Vec<usize> = (0..roles.len())
        .filter(|&at| roles[at] == Some(Role::Time))
        .collect();
    let ends = times.iter().skip(1).copied().chain([roles.len()]);
    let mut parts: Vec<Part> = Vec::new();
    for (&time, end) in times.iter().zip(ends) {
        for sensor in [Sensor::Accelerometer, Sensor::Gyroscope] {
            let at =
                |axis: usize| (time..end).find(|&at| roles[at] == Some(Role::axis(sensor, axis)));
            if let (Some(x), Some(y), Some(z)) = (at(0), at(1), at(2)) {
                let columns = [time, x, y, z].map(|at| (at + 1).to_string());
                parts.push(Part {
                    padded: true,
                    ..Part::of(sensor, columns.each_ref().map(String::as_str))
                });
            }
        }
    }
    // One time before both is a table like any other.
    let [first, second] = &parts[..] else {
        return None;
    };
    let stamps = |part: &Part| part.columns.first().cloned();
    (first.only != second.only && stamps(first) != stamps(second)).then_some(parts)
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
        assert_eq!(columns("time,ax,ay,az,gx,gy,gz,timestamp\n"), None);
        assert_eq!(columns("timestamp,time,ax,ay,az,gx,gy,gz\n"), None);
    }
}
