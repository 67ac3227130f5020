//! Remedies in words.

use crate::remedy::{OptionName, Remedy, Setting};

use super::entry::Front;
use super::shell::quoted;

/// An option's name in plain English, on the command line, in Rust and in Python.
pub(super) fn names(option: OptionName) -> [&'static str; 4] {
    use OptionName as O;
    match option {
        O::AccelUnit => [
            "the accelerometer's unit",
            "--accel-unit",
            "ReadOptions::accel_unit",
            "accel_unit",
        ],
        O::Altitude => [
            "the height above the sea",
            "--altitude",
            "Request::altitude",
            "altitude",
        ],
        O::Columns => [
            "the columns of the axes",
            "--columns",
            "ReadOptions::columns",
            "columns",
        ],
        O::Effects => [
            "the effects of the model",
            "--effects",
            "Request::effects",
            "effects",
        ],
        O::Entry => [
            "the file in the archive",
            "--entry",
            "ReadOptions::entry",
            "entry",
        ],
        O::Field => [
            "the norm of the magnetic field",
            "--field",
            "Request::field",
            "field",
        ],
        O::Flip => [
            "the axes to change the sign of",
            "--flip",
            "ReadOptions::flip",
            "flip",
        ],
        O::ForceDevice => [
            "that the device is the same",
            "--force-device",
            "Request::force_device",
            "force_device",
        ],
        O::Format => ["the format", "--format", "ReadOptions::format", "format"],
        O::Gravity => [
            "the local gravity",
            "--gravity",
            "Request::gravity",
            "gravity",
        ],
        O::GyroUnit => [
            "the gyroscope's unit",
            "--gyro-unit",
            "ReadOptions::gyro_unit",
            "gyro_unit",
        ],
        O::Instance => [
            "the sensor to take",
            "--instance",
            "ReadOptions::device",
            "instance",
        ],
        O::Latitude => [
            "the latitude",
            "--latitude",
            "Request::latitude",
            "latitude",
        ],
        O::LeaveOut => [
            "what to leave out",
            "--leave-out",
            "Request::left_out",
            "leave_out",
        ],
        O::MagUnit => [
            "the magnetometer's unit",
            "--mag-unit",
            "ReadOptions::mag_unit",
            "mag_unit",
        ],
        O::MaxBytes => [
            "the largest size",
            "--max-bytes",
            "ReadOptions::max_bytes",
            "max_bytes",
        ],
        O::MaxRows => [
            "the largest number of rows",
            "--max-rows",
            "ReadOptions::max_rows",
            "max_rows",
        ],
        O::Method => ["the method", "--method", "Request::method", "method"],
        O::MinStatic => [
            "the shortest static interval",
            "--min-static",
            "DetectorOptions::min_static",
            "min_static",
        ],
        O::Multiplier => [
            "the threshold of the detector",
            "--multiplier",
            "DetectorOptions::multiplier",
            "multiplier",
        ],
        O::Na => [
            "how missing values are treated",
            "--na",
            "ReadOptions::na_drop",
            "na",
        ],
        O::Noise => ["the sensor's noise", "--noise", "Request::walks", "noise"],
        O::Part => [
            "the recording to take",
            "--part",
            "ReadOptions::part",
            "part",
        ],
        O::Rate => ["the sampling rate", "--rate", "ReadOptions::rate", "rate"],
        O::Rest => ["the stretch to analyse", "--rest", "rest", "rest"],
        O::Sensor => [
            "the sensor to calibrate alone",
            "--sensor",
            "a recording with only one sensor",
            "sensor",
        ],
        O::SkipBadRows => [
            "that damaged rows are left out",
            "--skip-bad-rows",
            "ReadOptions::skip_bad_rows",
            "skip_bad_rows",
        ],
        O::SortTime => [
            "that rows are sorted by time",
            "--sort-time",
            "ReadOptions::sort_time",
            "sort_time",
        ],
        O::TimeFormat => [
            "the format of the stamps",
            "--time-format",
            "ReadOptions::time_format",
            "time_format",
        ],
        O::TimeUnit => [
            "the unit of the stamps",
            "--time-unit",
            "ReadOptions::time_unit",
            "time_unit",
        ],
        O::Topic => ["the topic", "--topic", "ReadOptions::topics", "topic"],
        O::Window => [
            "the window of the detector",
            "--window",
            "DetectorOptions::window",
            "window",
        ],
    }
}

/// A remedy in words, an imperative.
pub(crate) fn words(remedy: &Remedy, front: Front) -> String {
    let fixed = match remedy {
        Remedy::Set { any_of } => return format!("give {}", settings(any_of, front)),
        Remedy::IfWrong { any_of } => {
            return format!("if that is wrong, give {}", settings(any_of, front));
        }
        Remedy::Example { any_of } => {
            let all: Vec<String> = any_of.iter().map(|s| example(s, front)).collect();
            return format!("give {}", all.join(" or "));
        }
        Remedy::Omit { option } => return format!("do not give {}", omitted(*option, front)),
        Remedy::NameUnit { example } => {
            return format!("write the unit into the column's name, as `{example}`");
        }
        Remedy::AddPlacements { placements } => {
            return format!("add placements: {}", placements.join(", "));
        }
        Remedy::AddTurns { turns } => return format!("add turns: {}", turns.join(", ")),
        Remedy::OtherMethod { method } => return format!("use the method {method}"),
        Remedy::Discover => "search for the missing effect",
        Remedy::Plan => "plan the next recording",
        Remedy::RecordAgain => "record it again",
        Remedy::LeaveOut => "leave it out",
        Remedy::Level => "level the device on each face",
        Remedy::Split => "split the recording there",
        Remedy::SortRows => "sort the rows by their stamps",
        Remedy::FilePerSensor => "name the file of each sensor",
        Remedy::OneSensor => "go on with one sensor and name its columns alone",
        Remedy::LayDown => "lay the device down",
        Remedy::RestLonger => "keep the device still for longer",
        Remedy::TurnSlower => "turn more slowly",
        Remedy::TurnBetween => "turn the device between the placements",
        Remedy::SampleFaster => "record at a higher rate",
        Remedy::LargerRange => "record with a larger range of the sensor",
        Remedy::SensorStamps => "record with the sensor's own stamps",
        Remedy::OneClock => "record all sensors by one clock",
        Remedy::RawReadings => "record readings that are neither rounded nor filtered",
        Remedy::Uncalibrated => "record uncalibrated readings, as the sensor itself gives them",
        Remedy::WriteFolder => "write a folder, which keeps both clocks",
        Remedy::Thermometer => "record the temperature too",
        Remedy::WarmUp => "let the device reach a steady temperature first",
        Remedy::FixSensor => "fix the sensor to its case and record again",
        Remedy::AwayFromIron => "move away from iron and currents",
        Remedy::UpdateBias => "estimate the bias again",
        Remedy::Validate => "check it by a second recording",
        Remedy::LookInto => "look into the file",
        Remedy::ExportAgain => "export the file again",
        Remedy::OwnCalibration => "use the calibration of this device",
        Remedy::Report => "report it as a bug of ours",
    };
    let command = match (front, remedy) {
        (Front::CommandLine, Remedy::Discover) => " (`stillpoint discover`)",
        (Front::CommandLine, Remedy::Plan) => " (`stillpoint plan`)",
        (Front::CommandLine, Remedy::UpdateBias) => " (`stillpoint bias`)",
        (Front::CommandLine, Remedy::Validate) => " (`stillpoint evaluate`)",
        (Front::CommandLine, Remedy::LookInto) => " (`stillpoint info`)",
        (Front::CommandLine, Remedy::LeaveOut) => " (--leave-out)",
        (Front::CommandLine, Remedy::FilePerSensor) => " (--accel-file and --gyro-file)",
        (Front::CommandLine, Remedy::OneSensor) => " (--columns)",
        (Front::Rust, Remedy::FilePerSensor) => " (`Recording::from_pair`)",
        (Front::Python, Remedy::FilePerSensor) => " (`gyro_file`)",
        (Front::Rust, Remedy::OneSensor) => " (`ReadOptions::columns`)",
        (Front::Python, Remedy::OneSensor) => " (`columns`)",
        (Front::CommandLine, Remedy::WriteFolder) => " (-o FOLDER)",
        (Front::Python | Front::Rust, Remedy::Discover) => " (`discover`)",
        _ => "",
    };
    format!("{fixed}{command}")
}

fn settings(any_of: &[Setting], front: Front) -> String {
    let all: Vec<String> = any_of.iter().map(|s| setting(s, front)).collect();
    all.join(" or ")
}

/// `the sampling rate, as in --rate 100`.
fn example(setting: &Setting, front: Front) -> String {
    let [plain, ..] = names(setting.option);
    format!("{plain}, as in {}", setting.text(front))
}

/// `the recording to take (--part)`.
fn omitted(option: OptionName, front: Front) -> String {
    let [plain, flag, field, keyword] = names(option);
    match front {
        Front::Plain => plain.to_owned(),
        Front::CommandLine => format!("{plain} ({flag})"),
        Front::Rust => format!("{plain} (`{field}`)"),
        Front::Python => format!("{plain} (`{keyword}`)"),
    }
}

impl Setting {
    /// The option with its value as a front writes it: `--rate 100`, `rate=100`; for nobody in particular the value.
    pub fn text(&self, front: Front) -> String {
        let [plain, flag, field, keyword] = names(self.option);
        let value = self.value.as_deref();
        match (front, value) {
            (Front::Plain, _) => value.unwrap_or(plain).to_owned(),
            (Front::CommandLine, Some(v)) => format!("{flag} {}", quoted(v)),
            (Front::CommandLine, None) => flag.to_owned(),
            (Front::Rust, Some(v)) => format!("`{field}` {v}"),
            (Front::Rust, None) => format!("`{field}`"),
            (Front::Python, Some(v)) => format!("`{keyword}={v}`"),
            (Front::Python, None) => format!("`{keyword}`"),
        }
    }
}

/// `the local gravity (--gravity 9.81)`.
fn setting(setting: &Setting, front: Front) -> String {
    let [plain, ..] = names(setting.option);
    match (front, &setting.value) {
        (Front::Plain, None) => plain.to_owned(),
        _ => format!("{plain} ({})", setting.text(front)),
    }
}
