//! Raw readings in the ASCII logs of NovAtel receivers: `%RAWIMUSA,week,s;week,s,status,z,-y,x,z,-y,x*crc`.

use std::io::Read;

use crate::formats::texts::TextFormat;
use crate::header::look::Look;
use crate::recording::options::Role;
use crate::rows::parts::Part;
use crate::source::rewrite::rewritten;
use crate::units::TimeUnit;

/// The logs RAWIMUSA and RAWIMUA (NovAtel, "OEM7 Commands and Logs Reference Manual", RAWIMU and RAWIMUS): increments in counts, whose
/// size is the sensor's, of acceleration along z, -y and x and of the turn about z, -y and x.
pub(crate) static NOVATEL: TextFormat = TextFormat {
    name: "novatel",
    about: "an ASCII log of NovAtel with RAWIMUA or RAWIMUSA, in counts",
    parts,
};

const LOGS: [&str; 2] = ["%RAWIMUSA,", "#RAWIMUA,"];
/// Columns of a row that is made of a line.
const ROLES: [Role; 7] = [
    Role::Time,
    Role::Accel(0),
    Role::Accel(1),
    Role::Accel(2),
    Role::Gyro(0),
    Role::Gyro(1),
    Role::Gyro(2),
];

fn parts(look: &Look) -> Option<Vec<Part>> {
    look.lines().find_map(row)?;
    let columns = ROLES.into_iter().zip((1..).map(|at: usize| at.to_string()));
    Some(vec![Part {
        columns: columns.collect(),
        time_unit: Some(TimeUnit::Seconds),
        change: Some(change),
        ..Part::default()
    }])
}

/// The seconds of the week and the counts about x, y and z of a line.
fn row(line: &str) -> Option<String> {
    LOGS.iter().find(|log| line.starts_with(**log))?;
    let (_, body) = line.split_once(';')?;
    let body = body.split('*').next()?;
    let fields: Vec<&str> = body.split(',').collect();
    let [_, seconds, _, fz, fy, fx, wz, wy, wx] = fields[..] else {
        return None;
    };
    let turned = |count: &str| match count.strip_prefix('-') {
        Some(count) => count.to_owned(),
        None => format!("-{count}"),
    };
    let (fy, wy) = (turned(fy), turned(wy));
    Some(format!("{seconds},{fx},{fy},{fz},{wx},{wy},{wz}"))
}

/// The rows of readings; other logs as comments.
fn change(text: Box<dyn Read + Send>) -> Box<dyn Read + Send> {
    rewritten(text, |line, out| {
        match row(&String::from_utf8_lossy(line)) {
            Some(row) => out.extend_from_slice(row.as_bytes()),
            None if line.is_empty() => {}
            None => {
                out.extend_from_slice(b"# ");
                out.extend_from_slice(line);
            }
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::rewrite::changed_by;

    #[test]
    fn the_counts_of_y_have_their_sign_turned() {
        let text = "#BESTPOSA,COM1,0;1,2*3\n%RAWIMUSA,2234,180000.010;2234,180000.010000000,00000077,1,-2,3,4,5,-6*ab12cd34\n";
        assert!(parts(&Look::at(text.as_bytes())).is_some());
        let rows = changed_by(change, text);
        let expected = "# #BESTPOSA,COM1,0;1,2*3\n180000.010000000,3,2,1,-6,-5,4\n";
        assert_eq!(rows, expected);
        assert!(parts(&Look::at(b"#BESTPOSA,COM1,0;1,2*3\n")).is_none());
    }
}
