//! Column names to quantities.

use sensor::Sensor;

use super::options::{ColumnMap, Role};
use super::place::shown;
use super::units::Stated;

/// Which column of a table is what.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Layout {
    /// Cells per row.
    pub width: usize,
    /// Names, as far as the file has them.
    pub names: Vec<String>,
    /// Time stamps.
    pub time: Option<usize>,
    /// Specific force, x y z.
    pub accel: Option<[usize; 3]>,
    /// Angular rate, x y z.
    pub gyro: Option<[usize; 3]>,
    /// Temperature.
    pub temperature: Option<usize>,
    /// Units in the names.
    pub stated: Stated,
}

/// Names that mean the time, without unit and punctuation.
const TIME: &[&str] = &[
    "t",
    "time",
    "timestamp",
    "stamp",
    "timestamps",
    "ts",
    "secondselapsed",
    "elapsed",
    "elapsedtime",
    "timeelapsed",
    "seconds",
    "sec",
    "datetime",
    "timems",
    "timeus",
    "timens",
    "times",
    "tms",
    "tus",
    "tns",
    "ts",
    "timestampms",
    "timestampus",
    "timestampns",
    "timestamps",
    "millis",
    "micros",
    "nanos",
    "sampletimefine",
    "timeusec",
    "timeinseconds",
    "timemsec",
    "timensec",
    "loggingtime",
];
/// Names of accelerometer columns without their axis.
const ACCEL: &[&str] = &[
    "a",
    "acc",
    "accel",
    "accelerometer",
    "acceleration",
    "linearacceleration",
    "arss",
    "accelero",
    "specificforce",
    "f",
    "imuacc",
    "imuaccel",
    "rawacc",
    "rawaccel",
    "accraw",
    "accelraw",
    "accelerationg",
    "totalacceleration",
    "accelerometeruncalibrated",
    "abs",
];
/// Names of gyroscope columns without their axis.
const GYRO: &[&str] = &[
    "g",
    "w",
    "gyr",
    "gyro",
    "gyroscope",
    "omega",
    "angularvelocity",
    "angularrate",
    "wrss",
    "rate",
    "rotationrate",
    "angularspeed",
    "imugyr",
    "imugyro",
    "rawgyr",
    "rawgyro",
    "gyrraw",
    "gyroraw",
    "ω",
    "gyroscopeuncalibrated",
];
/// Names of temperature columns.
const TEMPERATURE: &[&str] = &[
    "temp",
    "temperature",
    "tempc",
    "temperaturec",
    "tempdegc",
    "imutemp",
    "imutemperature",
    "tc",
    "celsius",
    "tempk",
    "tempf",
];

/// A column name taken apart: what it calls, and the unit in brackets.
fn take_apart(name: &str) -> (String, Option<&str>) {
    let open = name.find(['(', '[', '{']);
    let (word, unit) = match open {
        Some(at) => {
            let unit = name[at + 1..].trim_end().trim_end_matches([')', ']', '}']);
            (&name[..at], Some(unit))
        }
        None => (name, None),
    };
    let word = word.trim_start_matches(['#', '%', '/', ' ']);
    (
        word.chars()
            .filter(|c| c.is_alphanumeric())
            .flat_map(char::to_lowercase)
            .collect(),
        unit,
    )
}

/// The role that a name has by itself; `only` is what the file is known to hold, so that `x` means
/// something.
fn role_of(name: &str, only: Option<Sensor>) -> Option<Role> {
    let (word, unit) = take_apart(name);
    if TIME.contains(&word.as_str()) {
        return Some(Role::Time);
    }
    if TEMPERATURE.contains(&word.as_str()) {
        return Some(Role::Temperature);
    }
    let axis = match word.chars().next_back()? {
        'x' => 0,
        'y' => 1,
        'z' => 2,
        _ => return None,
    };
    let stem = &word[..word.len() - 1];
    let unit = unit.unwrap_or_default();
    if ACCEL.contains(&stem) || (stem.is_empty() && unit.parse::<super::AccelUnit>().is_ok()) {
        Some(Role::Accel(axis))
    } else if GYRO.contains(&stem) || (stem.is_empty() && unit.parse::<super::GyroUnit>().is_ok()) {
        Some(Role::Gyro(axis))
    } else if stem.is_empty() {
        only.map(|sensor| match sensor {
            Sensor::Accelerometer => Role::Accel(axis),
            Sensor::Gyroscope => Role::Gyro(axis),
        })
    } else {
        None
    }
}

impl Layout {
    /// The layout of a table whose header holds `names`.
    ///
    /// # Errors
    /// What is wrong with the names, in words, with the option that would help.
    pub fn of_names(
        names: Vec<String>,
        map: &ColumnMap,
        only: Option<Sensor>,
    ) -> Result<Self, String> {
        let roles = if map.0.is_empty() {
            roles_by_name(&names, only)?
        } else {
            roles_by_map(&names, map)?
        };
        let mut layout = Self {
            width: names.len(),
            names,
            ..Self::default()
        };
        layout.assign(&roles)?;
        layout.state_units();
        Ok(layout)
    }

    /// Takes over columns by role and checks that triads are whole.
    pub fn assign(&mut self, roles: &[(Role, usize)]) -> Result<(), String> {
        let column = |role: Role| {
            roles
                .iter()
                .find(|(r, _)| *r == role)
                .map(|&(_, column)| column)
        };
        let triad = |axes: [Role; 3]| -> Result<Option<[usize; 3]>, String> {
            match axes.map(column) {
                [Some(x), Some(y), Some(z)] => Ok(Some([x, y, z])),
                [None, None, None] => Ok(None),
                some => {
                    let missing: Vec<_> = (0..3).filter(|&i| some[i].is_none()).collect();
                    let missing: Vec<_> = missing.into_iter().map(|i| axes[i].name()).collect();
                    Err(format!(
                        "no column for {}; {}",
                        missing.join(" and "),
                        suggestion(&self.names)
                    ))
                }
            }
        };
        self.time = column(Role::Time);
        self.accel = triad([0, 1, 2].map(Role::Accel))?;
        self.gyro = triad([0, 1, 2].map(Role::Gyro))?;
        self.temperature = column(Role::Temperature);
        if self.accel.is_none() && self.gyro.is_none() {
            let found: Vec<_> = self.names.iter().map(|name| shown(name)).collect();
            return Err(format!(
                "no accelerometer and no gyroscope columns among `{}`; expected t,ax,ay,az,gx,gy,gz[,temp]; {}",
                found.join("`, `"),
                suggestion(&self.names)
            ));
        }
        Ok(())
    }

    fn state_units(&mut self) {
        let unit = |column: Option<usize>| {
            let name = self.names.get(column?)?;
            take_apart(name).1
        };
        let first = |triad: Option<[usize; 3]>| triad.map(|[x, ..]| x);
        let stated = Stated {
            time: unit(self.time)
                .and_then(|u| u.parse().ok())
                .or_else(|| self.time_suffix()),
            accel: unit(first(self.accel)).and_then(|u| u.parse().ok()),
            gyro: unit(first(self.gyro)).and_then(|u| u.parse().ok()),
            temperature: unit(self.temperature).and_then(|u| u.parse().ok()),
        };
        self.stated = stated;
    }

    /// The unit in names such as `time_ms`.
    fn time_suffix(&self) -> Option<super::TimeUnit> {
        let name = self.names.get(self.time?)?.to_lowercase();
        let (word, suffix) = name
            .trim()
            .rsplit_once(['_', ' ', '.'])
            .unwrap_or(("", name.trim()));
        match suffix {
            "s" | "ms" | "us" | "ns" if !word.is_empty() => suffix.parse().ok(),
            "millis" | "micros" | "nanos" | "seconds" | "sec" => suffix.parse().ok(),
            _ => None,
        }
    }

    /// What a column is called in messages.
    pub fn column(&self, index: usize) -> String {
        match self.names.get(index) {
            Some(name) if !name.is_empty() => format!("column {} (`{}`)", index + 1, shown(name)),
            _ => format!("column {}", index + 1),
        }
    }
}

fn roles_by_name(names: &[String], only: Option<Sensor>) -> Result<Vec<(Role, usize)>, String> {
    let mut roles: Vec<(Role, usize)> = Vec::new();
    for (index, name) in names.iter().enumerate() {
        let Some(role) = role_of(name, only) else {
            continue;
        };
        if let Some(&(_, other)) = roles.iter().find(|(r, _)| *r == role) {
            return Err(format!(
                "columns {} (`{}`) and {} (`{}`) are both {}; say which with --columns, by number, as in {}={}",
                other + 1,
                shown(&names[other]),
                index + 1,
                shown(name),
                role.name(),
                role.name(),
                other + 1
            ));
        }
        roles.push((role, index));
    }
    Ok(roles)
}

/// Columns by name first, then by number from 1.
pub(super) fn roles_by_map(
    names: &[String],
    map: &ColumnMap,
) -> Result<Vec<(Role, usize)>, String> {
    let find = |wanted: &str| {
        let by_name = names.iter().position(|name| name.trim() == wanted);
        let number = wanted.parse::<usize>().ok();
        by_name.or_else(|| {
            number
                .filter(|n| (1..=names.len()).contains(n))
                .map(|n| n - 1)
        })
    };
    let mut roles = Vec::new();
    for (role, wanted) in &map.0 {
        let column = find(wanted).ok_or_else(|| {
            let nearest = nearest(wanted, names).map(|n| format!("; nearest: `{}`", shown(n)));
            format!(
                "--columns {}={}: no such column among {}{}",
                role.name(),
                shown(wanted),
                names.len(),
                nearest.unwrap_or_default()
            )
        })?;
        roles.push((*role, column));
    }
    Ok(roles)
}

fn nearest<'a>(wanted: &str, names: &'a [String]) -> Option<&'a String> {
    let likeness =
        |name: &String| strsim::jaro_winkler(&wanted.to_lowercase(), &name.to_lowercase());
    let best = names
        .iter()
        .max_by(|a, b| likeness(a).total_cmp(&likeness(b)))?;
    (likeness(best) > 0.7).then_some(best)
}

/// A `--columns` line ready to paste, with the names most like the plain ones.
pub(super) fn suggestion(names: &[String]) -> String {
    const LIKE: [(Role, &[&str]); 7] = [
        (Role::Time, &["t", "time", "timestamp"]),
        (
            Role::Accel(0),
            &["ax", "acc_x", "accel_x", "accelerometer x"],
        ),
        (
            Role::Accel(1),
            &["ay", "acc_y", "accel_y", "accelerometer y"],
        ),
        (
            Role::Accel(2),
            &["az", "acc_z", "accel_z", "accelerometer z"],
        ),
        (Role::Gyro(0), &["gx", "gyr_x", "gyro_x", "gyroscope x"]),
        (Role::Gyro(1), &["gy", "gyr_y", "gyro_y", "gyroscope y"]),
        (Role::Gyro(2), &["gz", "gyr_z", "gyro_z", "gyroscope z"]),
    ];
    let mut taken = vec![false; names.len()];
    let mut entries = Vec::new();
    for (role, spellings) in LIKE {
        let likeness = |name: &str| {
            let name = name.to_lowercase();
            spellings
                .iter()
                .map(|s| strsim::jaro_winkler(s, &name))
                .fold(0.0, f64::max)
        };
        let free = (0..names.len()).filter(|&i| !taken[i] && !names[i].is_empty());
        let best = free.max_by(|&a, &b| likeness(&names[a]).total_cmp(&likeness(&names[b])));
        let found = best.filter(|&i| likeness(&names[i]) > 0.6);
        if let Some(i) = found {
            taken[i] = true;
        }
        // A comma in a name would end the entry; its number says the same.
        let value = match found {
            Some(i) if names[i].contains([',', '\'']) => (i + 1).to_string(),
            Some(i) => shown(&names[i]),
            None => "…".to_owned(),
        };
        entries.push(format!("{}={value}", role.name()));
    }
    format!("say which is which: --columns '{}'", entries.join(","))
}
