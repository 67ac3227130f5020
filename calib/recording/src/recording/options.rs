//! Options for reading a recording.

use std::fmt;
use std::str::FromStr;

use findings::{Finding, Kind};
use sensor::Sensor;

use crate::Error;
use crate::header::affine;
use crate::shown::{figure, shown};
use crate::units::field::FieldUnit;
use crate::units::{AccelUnit, GyroUnit, TimeUnit};

/// Options for reading a recording. The default reads every well-formed file and guesses nothing silently.
#[derive(Clone, Debug)]
pub struct ReadOptions {
    /// Name of the format ([`formats::by_name`](crate::formats::by_name)); recognised from the content when `None`.
    pub format: Option<&'static str>,
    /// Columns of the quantities; they override the header.
    pub columns: ColumnMap,
    /// Broken rows that are left out with a warning before the file is refused.
    pub skip_bad_rows: usize,
    /// Leave out rows with missing or non-finite numbers instead of refusing them.
    pub na_drop: bool,
    /// Sort by time where time goes backwards instead of refusing.
    pub sort_time: bool,
    /// Sampling rate, Hz: time is sample number / rate and stamps are ignored.
    pub rate: Option<f64>,
    /// Unit of the stamps; from the header, the contract or the rate when `None`.
    pub time_unit: Option<TimeUnit>,
    /// `strptime` pattern of the stamps, such as `%d.%m.%Y %H:%M:%S%.f`; ISO 8601 needs none.
    pub time_format: Option<String>,
    /// Unit of the accelerometer; from the header or the size of gravity when `None`.
    pub accel_unit: Option<AccelUnit>,
    /// Unit of the gyroscope; from the header when `None`, else rad/s.
    pub gyro_unit: Option<GyroUnit>,
    /// Unit of the magnetometer; from the header or the format when `None`.
    pub mag_unit: Option<FieldUnit>,
    /// Axes of sensors to read with the other sign.
    pub flip: Vec<Role>,
    /// The file within a folder or an archive.
    pub entry: Option<String>,
    /// Topics, messages or variables of the sensors in a log.
    pub topics: Vec<String>,
    /// Number of the sensor among several in a log, or of the device among several in a table.
    pub instance: Option<u32>,
    /// Label of the device among several in a table, as in the column that tells them apart; `all` takes all rows as those of one
    /// device.
    pub device: Option<String>,
    /// Number of the recording, from 1, in a file in which the clock begins again.
    pub part: Option<usize>,
    /// Leave out a gyroscope whose readings cannot be used, instead of refusing the recording.
    pub accelerometer_alone: bool,
    /// Rows after which reading is refused.
    pub max_rows: u64,
    /// Bytes of (decompressed) text after which reading is refused.
    pub max_bytes: u64,
}

impl Default for ReadOptions {
    fn default() -> Self {
        Self {
            format: None,
            columns: ColumnMap::default(),
            skip_bad_rows: 0,
            na_drop: false,
            sort_time: false,
            rate: None,
            time_unit: None,
            time_format: None,
            accel_unit: None,
            gyro_unit: None,
            mag_unit: None,
            flip: Vec::new(),
            entry: None,
            topics: Vec::new(),
            instance: None,
            device: None,
            part: None,
            accelerometer_alone: false,
            max_rows: 200_000_000,
            max_bytes: 16 << 30,
        }
    }
}

impl ReadOptions {
    /// Returns the requested device of a table with several.
    pub(crate) fn wanted_device(&self) -> Option<String> {
        let by_number = || self.instance.map(|number| number.to_string());
        self.device.clone().or_else(by_number)
    }

    /// Refuses contradictions before any file is opened.
    ///
    /// # Errors
    /// [`Error::Usage`] for a rate that no recording has.
    pub(crate) fn check(&self) -> Result<(), Error> {
        match self.rate {
            Some(rate) if !(1e-3..=1e7).contains(&rate) => Err(Error::usage(
                Finding::of(Kind::RATE_IMPOSSIBLE).detail("rate", figure(rate)),
            )),
            _ => Ok(()),
        }
    }
}

/// A quantity that a column can hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Role {
    /// Time stamp.
    Time,
    /// Specific force along axis 0, 1 or 2.
    Accel(usize),
    /// Angular rate about axis 0, 1 or 2.
    Gyro(usize),
    /// Temperature.
    Temperature,
    /// Magnetic field along axis 0, 1 or 2.
    Field(usize),
    /// Time stamp of one sensor, where each has its own.
    TimeOf(Sensor),
    /// Label of the row's device, in a table with several.
    Device,
}

impl Role {
    /// Every role, in the order of the plain CSV header.
    pub const ALL: [Self; 15] = [
        Self::Time,
        Self::Accel(0),
        Self::Accel(1),
        Self::Accel(2),
        Self::Gyro(0),
        Self::Gyro(1),
        Self::Gyro(2),
        Self::Temperature,
        Self::Field(0),
        Self::Field(1),
        Self::Field(2),
        Self::TimeOf(Sensor::Accelerometer),
        Self::TimeOf(Sensor::Gyroscope),
        Self::TimeOf(Sensor::Magnetometer),
        Self::Device,
    ];

    /// An axis of a sensor.
    pub fn axis(sensor: Sensor, axis: usize) -> Self {
        match sensor {
            Sensor::Accelerometer => Self::Accel(axis),
            Sensor::Gyroscope => Self::Gyro(axis),
            Sensor::Magnetometer => Self::Field(axis),
        }
    }

    /// The sensor and the axis of a reading; the other way round than [`Self::axis`].
    pub fn reading(self) -> Option<(Sensor, usize)> {
        match self {
            Self::Accel(axis) => Some((Sensor::Accelerometer, axis)),
            Self::Gyro(axis) => Some((Sensor::Gyroscope, axis)),
            Self::Field(axis) => Some((Sensor::Magnetometer, axis)),
            Self::Time | Self::Temperature | Self::TimeOf(_) | Self::Device => None,
        }
    }

    /// The sensor whose rows the column belongs to, a temperature to the accelerometer's; `None` for what all have.
    pub(crate) fn sensor(self) -> Option<Sensor> {
        match self {
            Self::Temperature => Some(Sensor::Accelerometer),
            Self::TimeOf(sensor) => Some(sensor),
            other => other.reading().map(|(sensor, _)| sensor),
        }
    }

    /// The name in the plain CSV header.
    pub fn name(self) -> &'static str {
        const AXES: [[&str; 3]; 3] = [["ax", "ay", "az"], ["gx", "gy", "gz"], ["mx", "my", "mz"]];
        match self {
            Self::Time => "t",
            Self::Accel(axis) => AXES[0][axis.min(2)],
            Self::Gyro(axis) => AXES[1][axis.min(2)],
            Self::Temperature => "temp",
            Self::Field(axis) => AXES[2][axis.min(2)],
            Self::TimeOf(Sensor::Accelerometer) => "ta",
            Self::TimeOf(Sensor::Gyroscope) => "tg",
            Self::TimeOf(Sensor::Magnetometer) => "tm",
            Self::Device => "device",
        }
    }

    /// The role of a plain CSV name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|role| role.name() == name)
    }
}

/// Columns by role, as the user wrote them: `t=timestamp,ax=acc_x` or by number from 1, `t=1,ax=2`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ColumnMap(pub Vec<(Role, String)>);

impl ColumnMap {
    /// True if it makes something of a role's column: a factor, an offset, the other sign.
    pub(crate) fn makes(&self, role: Role) -> bool {
        let makes = |(other, column): &(Role, String)| {
            *other == role && affine::take_apart(column).is_some()
        };
        self.0.iter().any(makes)
    }

    /// True if it names the column of a role.
    pub(crate) fn names(&self, wanted: Role) -> bool {
        self.0.iter().any(|(role, _)| *role == wanted)
    }

    /// True if it names a column of the accelerometer or of the gyroscope.
    pub(crate) fn names_a_sensor(&self) -> bool {
        let is_sensor = |role: &Role| matches!(role, Role::Accel(_) | Role::Gyro(_));
        self.0.iter().any(|(role, _)| is_sensor(role))
    }

    /// True where it names a stamp of one sensor.
    pub(crate) fn has_stamps_of_sensors(&self) -> bool {
        let mut roles = self.0.iter();
        roles.any(|(role, _)| matches!(role, Role::TimeOf(_)))
    }

    /// True if it names the columns of a thermometer and no others.
    pub(crate) fn is_of_a_thermometer(&self) -> bool {
        self.0.len() == 2 && self.names(Role::Time) && self.names(Role::Temperature)
    }
}

impl fmt::Display for ColumnMap {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let entry = |(role, column): &(Role, String)| format!("{}={column}", role.name());
        let entries: Vec<String> = self.0.iter().map(entry).collect();
        f.write_str(&entries.join(","))
    }
}

impl FromStr for ColumnMap {
    type Err = Box<Finding>;

    fn from_str(text: &str) -> Result<Self, Box<Finding>> {
        let of = |kind: Kind, entry: &str| Finding::of(kind).detail("entry", shown(entry));
        let mut map: Vec<(Role, String)> = Vec::new();
        for entry in text.split(',') {
            let (role, column) = entry
                .split_once('=')
                .ok_or_else(|| of(Kind::COLUMN_ENTRY, entry))?;
            let role = Role::from_name(role.trim()).ok_or_else(|| {
                Finding::of(Kind::COLUMN_ROLE)
                    .detail("role", shown(role.trim()))
                    .detail("known", Role::ALL.map(Role::name).join(", "))
            })?;
            if map.iter().any(|(other, _)| *other == role) {
                let twice = Finding::of(Kind::COLUMN_TWICE);
                return Err(twice.detail("role", role.name()).into());
            }
            let column = column.trim().to_owned();
            if column.is_empty() {
                return Err(of(Kind::COLUMN_UNNAMED, entry).into());
            }
            map.push((role, column));
        }
        Ok(Self(map))
    }
}
