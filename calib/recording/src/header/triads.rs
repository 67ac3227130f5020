//! Three columns that differ by their axis alone, and whose they are by the words in their names.

use sensor::Sensor;

use super::names::{compact, sensor_of, take_apart};

/// Three columns of one stem, x y z.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Triad {
    /// Indices of the columns.
    pub columns: [usize; 3],
    /// Common part of the names, in small letters.
    pub stem: String,
}

/// Words of gyroscopes in several languages, as parts of a stem.
const GYRO: [&str; 18] = [
    "gyr",
    "omega",
    "angularv",
    "angularr",
    "angvel",
    "angrate",
    "rotat",
    "rate",
    "dreh",
    "giro",
    "angul",
    "angol",
    "hoeks",
    "vinkel",
    "zyro",
    "угл",
    "角速度",
    "陀螺",
];
/// Words of accelerometers.
const ACCEL: [&str; 11] = [
    "acc",
    "beschl",
    "force",
    "acel",
    "accel",
    "kraft",
    "accél",
    "versnel",
    "przysp",
    "ускор",
    "加速度",
];
/// Words of what is worked out from them, or of neither.
const OTHERS: [&str; 36] = [
    "gravit", "user", "free", "ohne", "without", "sans", "mag", "quat", "orient", "euler", "angle",
    "attitude", "delta", "dvel", "bias", "offset", "cov", "std", "var", "norm", "pos", "lat",
    "lon", "speed", "integr", "motor", "temp", "axisp", "axisi", "axisd", "setpoint", "clip",
    "calib", "线性", "线加", "重力",
];
/// Words that distinguish several sensors of one kind in names.
const QUALIFIERS: [&str; 25] = [
    "filtered",
    "filt",
    "lpf",
    "lp",
    "smoothed",
    "smooth",
    "raw",
    "left",
    "right",
    "uncalibrated",
    "uncal",
    "calibrated",
    "corrected",
    "imu",
    "sensor",
    "low",
    "high",
    "lg",
    "hg",
    "ln",
    "wr",
    "primary",
    "secondary",
    "front",
    "back",
];

/// Words of rates, in the names of which axes are called roll, pitch and yaw: without one they are angles.
const RATES: [&str; 4] = ["rate", "vel", "speed", "gyr"];

/// The axes of a vehicle or a body, in the names of accelerations.
const AHEAD: [[&str; 3]; 4] = [
    ["inline", "lateral", "vertical"],
    ["longitudinal", "lateral", "vertical"],
    ["long", "lat", "vert"],
    ["forward", "side", "up"],
];

/// Every three columns that differ by x y z, by 0 1 2 or 1 2 3, by roll pitch yaw, or by the axes of a vehicle, in one place of their
/// names.
pub(crate) fn triads(names: &[String]) -> Vec<Triad> {
    let lower: Vec<String> = names.iter().map(|name| name.to_lowercase()).collect();
    let mut taken = vec![false; lower.len()];
    let mut found = Vec::new();
    const TURNS: [&str; 3] = ["roll", "pitch", "yaw"];
    let by_letter = [["x", "y", "z"], ["0", "1", "2"], ["1", "2", "3"], TURNS];
    for axes in by_letter.into_iter().chain(AHEAD) {
        for at in 0..lower.len() {
            let Some((columns, stem)) = triad(&lower, &taken, at, axes) else {
                continue;
            };
            let has = |words: &[&str]| words.iter().any(|word| stem.contains(word));
            if (axes == TURNS && !has(&RATES)) || (AHEAD.contains(&axes) && !has(&ACCEL)) {
                continue;
            }
            for column in columns {
                taken[column] = true;
            }
            // The speed of a roll is a rate, and that of anything else is none.
            let stem = match axes == TURNS {
                true => stem.replace("speed", "rate"),
                false => stem,
            };
            found.push(Triad { columns, stem });
        }
    }
    found.sort_by_key(|triad| triad.columns[0]);
    found
}

/// The free columns that differ from `names[at]`, of the first of `axes`, by the other two.
fn triad(
    names: &[String],
    taken: &[bool],
    at: usize,
    axes: [&str; 3],
) -> Option<([usize; 3], String)> {
    if taken[at] {
        return None;
    }
    let name = &names[at];
    let mut places = name.match_indices(axes[0]);
    places.find_map(|(place, _)| {
        let (before, after) = (&name[..place], &name[place + axes[0].len()..]);
        let find = |axis: &str| {
            let is_it = |other: &String| {
                other
                    .strip_prefix(before)
                    .and_then(|rest| rest.strip_prefix(axis))
                    == Some(after)
            };
            (0..names.len()).find(|other| !taken[*other] && is_it(&names[*other]))
        };
        let (y, z) = (find(axes[1])?, find(axes[2])?);
        let stem = || match after.is_empty() && before.ends_with(char::is_alphanumeric) {
            // Of `imu1_gx` the `g` is no unit.
            true => before.replace('_', " "),
            false => format!("{before}{after}"),
        };
        (y != at && z != at).then(|| ([at, y, z], stem()))
    })
}

impl Triad {
    /// The sensor that its words are of; `None` for another quantity's, and for words that are not known.
    pub fn sensor(&self) -> Option<Sensor> {
        let (word, _) = take_apart(&self.stem);
        if OTHERS.iter().any(|part| word.contains(part)) {
            return None;
        }
        let exact = sensor_of(&self.bare());
        let has = |words: &[&str]| words.iter().any(|part| word.contains(part));
        let by_words = || match (has(&ACCEL), has(&GYRO)) {
            // `angular_rate` and `acceleration_rate`: what it is comes before what it is of.
            (false, true) => Some(Sensor::Gyroscope),
            (true, false) => Some(Sensor::Accelerometer),
            _ => None,
        };
        exact.or_else(by_words)
    }

    /// True if nobody would take it for a sensor's reading.
    pub fn is_of_another(&self) -> bool {
        let (word, _) = take_apart(&self.stem);
        OTHERS.iter().any(|part| word.contains(part))
    }

    /// The stem without numbers and without words such as `filtered` and `left`.
    pub fn bare(&self) -> String {
        let (word, _) = take_apart(&self.stem);
        let letters: String = word.chars().filter(|c| !c.is_ascii_digit()).collect();
        QUALIFIERS
            .iter()
            .fold(letters, |word, qualifier| word.replace(qualifier, ""))
    }

    /// True for a stem that is a sensor's but for a number or such a word: `ax2`, `acc_filtered_x`, `left_gyr_x`.
    pub fn is_another_of(&self, sensor: Sensor) -> bool {
        let bare = self.bare();
        // Linear acceleration is worked out of the accelerometer.
        let linear = bare.starts_with("lin");
        !linear && !self.is_of_another() && sensor_of(&bare) == Some(sensor)
    }

    /// Returns the number of letters that both stems begin with.
    pub fn likeness(&self, other: &Self) -> usize {
        let pairs = self.stem.chars().zip(other.stem.chars());
        pairs.take_while(|(a, b)| a == b).count()
    }

    /// Returns the number of letters that both stems end with.
    pub fn ending(&self, other: &Self) -> usize {
        let (a, b) = (compact(&self.stem), compact(&other.stem));
        let pairs = a.chars().rev().zip(b.chars().rev());
        pairs.take_while(|(a, b)| a == b).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(names: &[&str]) -> Vec<([usize; 3], Option<Sensor>)> {
        let names: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
        let found = triads(&names);
        found.iter().map(|t| (t.columns, t.sensor())).collect()
    }

    #[test]
    fn columns_that_differ_by_their_axis_are_found_with_their_sensor() {
        let (accel, gyro) = (Some(Sensor::Accelerometer), Some(Sensor::Gyroscope));
        let names = [
            "t",
            "ang_vel_x",
            "ang_vel_y",
            "ang_vel_z",
            "lin_acc_x",
            "lin_acc_y",
            "lin_acc_z",
        ];
        assert_eq!(of(&names), [([1, 2, 3], gyro), ([4, 5, 6], accel)]);
        let names = ["Acc1", "Acc2", "Acc3", "gyro[0]", "gyro[1]", "gyro[2]"];
        assert_eq!(of(&names), [([0, 1, 2], accel), ([3, 4, 5], gyro)]);
        let names = [
            "X Gyro [x8005]",
            "Y Gyro [x8005]",
            "Z Gyro [x8005]",
            "X Accel [x8004]",
            "Y Accel [x8004]",
            "Z Accel [x8004]",
        ];
        assert_eq!(of(&names), [([0, 1, 2], gyro), ([3, 4, 5], accel)]);
        let names = [
            "Beschleunigung X",
            "Beschleunigung Y",
            "Beschleunigung Z",
            "Drehrate X",
            "Drehrate Y",
            "Drehrate Z",
        ];
        assert_eq!(of(&names), [([0, 1, 2], accel), ([3, 4, 5], gyro)]);
        let names = [
            "gFx",
            "gFy",
            "gFz",
            "delta_angle_x",
            "delta_angle_y",
            "delta_angle_z",
        ];
        assert_eq!(of(&names), [([0, 1, 2], None), ([3, 4, 5], None)]);
        assert!(of(&["ax", "ay", "Tmp", "FreeAcc_X"]).is_empty());
        assert_eq!(
            of(&["Roll Rate", "Pitch Rate", "Yaw Rate"]),
            [([0, 1, 2], gyro)]
        );
        assert!(of(&["roll", "pitch", "yaw"]).is_empty());
        assert_eq!(
            of(&["rollspeed", "pitchspeed", "yawspeed"]),
            [([0, 1, 2], gyro)]
        );
        for names in [
            ["InlineAcc", "LateralAcc", "VerticalAcc"],
            ["G Force Long", "G Force Lat", "G Force Vert"],
            [
                "Acceleration Forward",
                "Acceleration Side",
                "Acceleration Up",
            ],
        ] {
            assert_eq!(of(&names), [([0, 1, 2], accel)]);
        }
        assert!(of(&["GPS Long", "GPS Lat", "GPS Vert"]).is_empty());
    }

    #[test]
    fn a_second_sensor_of_a_kind_is_told_from_what_is_worked_out() {
        let is_another = |names: [&str; 3]| {
            let found = &triads(&names.map(str::to_owned))[0];
            [Sensor::Accelerometer, Sensor::Gyroscope].map(|sensor| found.is_another_of(sensor))
        };
        assert_eq!(is_another(["ax2", "ay2", "az2"]), [true, false]);
        assert_eq!(
            is_another(["acc_filt_x", "acc_filt_y", "acc_filt_z"]),
            [true, false]
        );
        assert_eq!(
            is_another(["left_gyr_x", "left_gyr_y", "left_gyr_z"]),
            [false, true]
        );
        assert_eq!(
            is_another(["acc_std_x", "acc_std_y", "acc_std_z"]),
            [false, false]
        );
        assert_eq!(
            is_another(["LinAccX", "LinAccY", "LinAccZ"]),
            [false, false]
        );
        assert_eq!(
            is_another(["angle_x", "angle_y", "angle_z"]),
            [false, false]
        );
        assert_eq!(
            is_another([
                "userAccelerationX",
                "userAccelerationY",
                "userAccelerationZ"
            ]),
            [false, false]
        );
    }
}
