//! Classes of column names by whether the column may identify a device: `sensor_id`, `mac`, `battery`.

/// Class of a column's name, the likeliest to identify a device first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Class {
    /// The user says so.
    Given,
    /// A device's.
    Device,
    /// A number or name of something, or no name at all.
    Number,
    /// Nothing, or nothing that is known.
    Unknown,
    /// Something else's.
    Other,
}

/// Words of devices.
const DEVICES: [&str; 28] = [
    "device",
    "dev",
    "imu",
    "imus",
    "mac",
    "sensor",
    "sensors",
    "node",
    "mote",
    "tracker",
    "module",
    "board",
    "uuid",
    "serial",
    "serialnumber",
    "sn",
    "tag",
    "address",
    "addr",
    "macaddress",
    "instance",
    "inst",
    "bus",
    "slave",
    "limb",
    "unit",
    "mpu",
    "dot",
];

/// Words of what counts or names things of any kind.
const NUMBERS: [&str; 21] = [
    "id",
    "i",
    "no",
    "nr",
    "num",
    "number",
    "n",
    "name",
    "ch",
    "channel",
    "source",
    "src",
    "port",
    "location",
    "subject",
    "participant",
    "person",
    "user",
    "index",
    "idx",
    "topic",
];

/// Words of what changes from row to row of one device, or from one placement of it to another.
const OTHERS: [&str; 107] = [
    "status",
    "state",
    "flag",
    "flags",
    "label",
    "class",
    "activity",
    "mode",
    "phase",
    "step",
    "steps",
    "count",
    "counter",
    "counts",
    "seq",
    "sequence",
    "frame",
    "packet",
    "pkt",
    "message",
    "msg",
    "event",
    "error",
    "errors",
    "err",
    "battery",
    "batt",
    "bat",
    "volt",
    "voltage",
    "charge",
    "current",
    "temp",
    "temperature",
    "pressure",
    "humidity",
    "hour",
    "hours",
    "minute",
    "minutes",
    "min",
    "second",
    "seconds",
    "overflow",
    "date",
    "day",
    "week",
    "gpsweek",
    "doy",
    "hhmm",
    "month",
    "year",
    "time",
    "timestamp",
    "ts",
    "tick",
    "ticks",
    "gps",
    "lat",
    "lon",
    "alt",
    "sat",
    "fix",
    "quality",
    "accuracy",
    "valid",
    "clip",
    "clipping",
    "gain",
    "range",
    "odr",
    "rate",
    "dt",
    "health",
    "crc",
    "checksum",
    "marker",
    "trigger",
    "sync",
    "pose",
    "position",
    "placement",
    "orientation",
    "face",
    "side",
    "trial",
    "run",
    "session",
    "rep",
    "row",
    "line",
    "version",
    "rssi",
    "sample",
    "offset",
    "file",
    "log",
    "segment",
    "part",
    "test",
    "take",
    "exp",
    "experiment",
    "lap",
    "block",
    "recording",
    "measurement",
];

impl Class {
    /// Returns the class of `name`.
    pub fn of(name: &str) -> Self {
        let words = words(name);
        let any = |list: &[&str]| words.iter().any(|word| list.contains(&word.as_str()));
        // Of `imu_status` the second word is the thing.
        if any(&OTHERS) {
            Self::Other
        } else if any(&DEVICES) {
            Self::Device
        } else if any(&NUMBERS) || name.trim().is_empty() {
            Self::Number
        } else {
            Self::Unknown
        }
    }
}

/// The words of a name in small letters, without digits: `SensorID2` is of `sensor` and `id`.
fn words(name: &str) -> Vec<String> {
    let mut words: Vec<String> = vec![String::new()];
    let mut before = ' ';
    for c in name.chars().take(200) {
        let begins = c.is_uppercase() && before.is_lowercase();
        if !c.is_alphabetic() || begins {
            words.push(String::new());
        }
        if let Some(word) = words.last_mut().filter(|_| c.is_alphabetic()) {
            word.extend(c.to_lowercase());
        }
        before = c;
    }
    words.retain(|word| !word.is_empty());
    // `deviceid`, `imunr`.
    let glued = |word: &String| {
        let ends = ["id", "no", "nr", "num", "name", "address", "index", "idx"];
        let stem = ends.iter().find_map(|end| word.strip_suffix(end));
        stem.filter(|stem| stem.len() > 1).map(str::to_owned)
    };
    let stems: Vec<String> = words.iter().filter_map(glued).collect();
    words.extend(stems);
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_devices_are_told_from_those_of_states() {
        let all = |names: &[&str], class| {
            for name in names {
                assert_eq!(Class::of(name), class, "{name}");
            }
        };
        let devices = [
            "device_id",
            "DeviceID",
            "deviceid",
            "imu",
            "IMU#",
            "mac",
            "MAC address",
            "sensorId",
            "Sensor",
            "node_no",
            "serial",
            "imu_idx",
            "I2C address",
            "device name",
            "DeviceName",
        ];
        all(&devices, Class::Device);
        all(
            &["id", "I", "ID", "no", "name", "Channel", ""],
            Class::Number,
        );
        all(&["foo", "3", "wer"], Class::Unknown);
        let others = [
            "status",
            "battery",
            "imu_status",
            "packet_id",
            "activity_id",
            "sensor_temp",
            "seq",
            "Battery [%]",
            "sync flag",
            "sample_no",
            "PacketCounter",
            "device_state",
            "min",
            "week",
            "GPSWeek",
            "HHMM",
        ];
        all(&others, Class::Other);
    }
}
