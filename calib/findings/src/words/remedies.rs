//! Remedies in words.

use crate::remedy::{OptionName, Remedy, Setting};

use super::entry::Front;
use super::shell::quoted;
use super::turns;

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
        O::Motion => ["when the motion was", "--motion", "motion", "motion"],
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
        Remedy::Set { any_of } => return given(any_of, front),
        Remedy::IfWrong { any_of } => {
            return format!("if that is wrong, {}", given(any_of, front));
        }
        Remedy::NameUnit { example } => {
            return format!("write the unit into the column's name, as `{example}`");
        }
        Remedy::AddPlacements { placements } => {
            return turns::add_placements(placements);
        }
        Remedy::AddTurns { turns } => return turns::add_turns(turns),
        Remedy::OtherMethod { method } => return format!("use the method {method}"),
        Remedy::Discover => "search for the missing effect",
        Remedy::Plan => "plan the next recording",
        Remedy::RecordAgain => "record it again",
        Remedy::LeaveOut => "leave it out",
        Remedy::Level => "level the device on each face",
        Remedy::Split => "split the recording there",
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
        Remedy::Nearest { names } => return format!("did you mean `{}`?", names.join("` or `")),
        Remedy::ListEffects => "see which effects there are",
        Remedy::CalibrateAgain => "calibrate again",
        Remedy::SwapFiles => "check whether the two files are swapped",
        Remedy::SwapSensors => "check whether the two sensors are swapped",
        Remedy::TurnBack { recording, columns } => return turn_back(recording, columns, front),
        Remedy::TurnEachAxis => {
            "turn the device about each axis both ways, still before and after each turn"
        }
        Remedy::LoseNoSamples => "record without losing samples",
        Remedy::FreezeNoRows => "record without frozen rows",
        Remedy::BothSensors => "record both sensors at the same time",
        Remedy::Report => "report it as a bug of ours",
    };
    let command = match (front, remedy) {
        (Front::CommandLine, Remedy::Discover) => " (`stillpoint discover`)",
        (Front::CommandLine, Remedy::Plan) => " (`stillpoint plan`)",
        (Front::CommandLine, Remedy::UpdateBias) => " (`stillpoint bias`)",
        (Front::CommandLine, Remedy::Validate) => " (`stillpoint evaluate`)",
        (Front::CommandLine, Remedy::ListEffects) => " (`stillpoint effects`)",
        (Front::Python | Front::Rust, Remedy::ListEffects) => " (`Catalogue::names`)",
        (Front::CommandLine, Remedy::LookInto) => " (`stillpoint info`)",
        (Front::CommandLine, Remedy::LeaveOut) => " (--leave-out)",
        (Front::CommandLine, Remedy::WriteFolder) => " (-o FOLDER)",
        (Front::Python | Front::Rust, Remedy::Discover) => " (`discover`)",
        _ => "",
    };
    format!("{fixed}{command}")
}

/// `turn its axes back (…) and use what comes out`.
fn turn_back(recording: &str, columns: &str, front: Front) -> String {
    let how = match front {
        Front::Plain => columns.to_owned(),
        Front::CommandLine => format!("`{}`", turning_back(recording, columns)),
        Front::Rust | Front::Python => {
            let option = OptionName::Columns;
            let value = Some(columns.to_owned());
            return format!(
                "turn its axes back by {}",
                setting(&Setting { option, value }, front)
            );
        }
    };
    format!("turn its axes back ({how}) and use that")
}

/// The command that turns the axes of a recording back.
pub(super) fn turning_back(recording: &str, columns: &str) -> String {
    let (recording, columns) = (quoted(recording), quoted(columns));
    format!("stillpoint convert {recording} --columns {columns} -o turned.csv")
}

/// `give the local gravity (--gravity)`, or `say that the device is the same (--force-device)`.
fn given(any_of: &[Setting], front: Front) -> String {
    let all: Vec<String> = any_of.iter().map(|s| setting(s, front)).collect();
    let all = all.join(" or ");
    match all.starts_with("that ") {
        true => format!("say {all}"),
        false => format!("give {all}"),
    }
}

/// `the local gravity (--gravity 9.81)`.
fn setting(setting: &Setting, front: Front) -> String {
    let [plain, flag, field, keyword] = names(setting.option);
    let value = setting.value.as_deref();
    let named = match front {
        Front::Plain => {
            return value.map_or_else(|| plain.to_owned(), |v| format!("{plain} ({v})"));
        }
        Front::CommandLine => match value {
            Some(v) => format!("{flag} {}", quoted(v)),
            None => flag.to_owned(),
        },
        Front::Rust => value.map_or_else(|| format!("`{field}`"), |v| format!("`{field}` {v}")),
        Front::Python => {
            value.map_or_else(|| format!("`{keyword}`"), |v| format!("`{keyword}={v}`"))
        }
    };
    format!("{plain} ({named})")
}
