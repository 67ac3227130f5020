//! Remedies in words.

use crate::remedy::{OptionName, Remedy, Setting};

use super::entry::Front;
use super::shell::quoted;
use super::turns;

/// An option in plain English.
fn plain(option: OptionName) -> &'static str {
    use OptionName as O;
    match option {
        O::AccelUnit => "the accelerometer's unit",
        O::Altitude => "the height above the sea",
        O::Columns => "the columns of the axes",
        O::Effects => "the effects (sources of error) of the model",
        O::Entry => "the file in the archive",
        O::Field => "the strength of the magnetic field",
        O::Flip => "the axes whose sign is changed",
        O::ForceDevice => "that the device is the same",
        O::Format => "the format",
        O::Gravity => "the local gravity",
        O::GyroUnit => "the gyroscope's unit",
        O::Instance => "the sensor to take",
        O::Latitude => "the latitude",
        O::LeaveOut => "the static intervals to leave out",
        O::LoggedWith => "the parameters that the vehicle had while it logged",
        O::MagUnit => "the magnetometer's unit",
        O::MaxBytes => "the largest size",
        O::MaxRows => "the largest number of rows",
        O::Method => "the method",
        O::MinStatic => "the shortest static interval",
        O::Motion => "when the motion was",
        O::Multiplier => "the threshold of the search for static intervals",
        O::Na => "how missing values are treated",
        O::Noise => "the sensor's noise",
        O::Part => "the recording to take",
        O::Rate => "the sampling rate",
        O::Rest => "the stretch to analyse",
        O::Sensor => "the sensor to calibrate alone",
        O::SkipBadRows => "that damaged rows are left out",
        O::SortTime => "that rows are sorted by time",
        O::TimeFormat => "the format of the time stamps",
        O::TimeUnit => "the unit of the time stamps",
        O::Validation => "a second recording that confirms it",
        O::Topic => "the topic",
        O::Window => "the window of the search for static intervals",
    }
}

/// The flag of an option, which is Python's keyword with dashes.
pub(super) fn flag(option: OptionName) -> String {
    format!("--{}", option.to_string().replace('_', "-"))
}

/// The field that gives an option in Rust.
fn field(option: OptionName) -> &'static str {
    use OptionName as O;
    match option {
        O::AccelUnit => "ReadOptions::accel_unit",
        O::Altitude => "Request::altitude",
        O::Columns => "ReadOptions::columns",
        O::Effects => "Request::effects",
        O::Entry => "ReadOptions::entry",
        O::Field => "Request::field",
        O::Flip => "ReadOptions::flip",
        O::ForceDevice => "Request::force_device",
        O::Format => "ReadOptions::format",
        O::Gravity => "Request::gravity",
        O::GyroUnit => "ReadOptions::gyro_unit",
        O::Instance => "ReadOptions::device",
        O::Latitude => "Request::latitude",
        O::LeaveOut => "Request::left_out",
        O::LoggedWith => "Settings::logged_with",
        O::MagUnit => "ReadOptions::mag_unit",
        O::MaxBytes => "ReadOptions::max_bytes",
        O::MaxRows => "ReadOptions::max_rows",
        O::Method => "Request::method",
        O::MinStatic => "DetectorOptions::min_static",
        O::Motion => "motion",
        O::Multiplier => "DetectorOptions::multiplier",
        O::Na => "ReadOptions::na_drop",
        O::Noise => "Request::walks",
        O::Part => "ReadOptions::part",
        O::Rate => "ReadOptions::rate",
        O::Rest => "rest",
        O::Sensor => "a recording with only one sensor",
        O::SkipBadRows => "ReadOptions::skip_bad_rows",
        O::SortTime => "ReadOptions::sort_time",
        O::TimeFormat => "ReadOptions::time_format",
        O::TimeUnit => "ReadOptions::time_unit",
        O::Validation => "Request::validation",
        O::Topic => "ReadOptions::topics",
        O::Window => "DetectorOptions::window",
    }
}

/// A remedy in words, an imperative.
pub(crate) fn words(remedy: &Remedy, front: Front) -> String {
    let fixed = match remedy {
        Remedy::Set { any_of } => return given(any_of, front),
        Remedy::IfWrong { any_of } => {
            return format!("if that is wrong, {}", given(any_of, front));
        }
        Remedy::Example { any_of } => {
            let before = std::iter::once(None).chain(any_of.iter().map(|s| Some(s.option)));
            let each = any_of.iter().zip(before);
            let all = each.map(|(s, before)| match before == Some(s.option) {
                true => s.text(front),
                false => example(s, front),
            });
            return format!("give {}", all.collect::<Vec<_>>().join(" or "));
        }
        Remedy::Omit { option } => return omitted(*option, front),
        Remedy::NameUnit { example } => {
            return format!("write the unit into the column's name, as `{example}`");
        }
        Remedy::AddPlacements { placements } => {
            return turns::add_placements(placements);
        }
        Remedy::AddTurns { turns } => return turns::add_turns(turns),
        Remedy::OtherMethod { method } => return other_method(method, front),
        Remedy::ConvertToCsv { by } => return format!("convert the file to CSV, as by `{by}`"),
        Remedy::ExportAs { format } => return format!("export the file as {format}"),
        Remedy::Build { feature } => {
            let flag = match front {
                Front::CommandLine => format!(" (`--features {feature}`)"),
                _ => String::new(),
            };
            return format!("build the program with the feature `{feature}`{flag}");
        }
        Remedy::RunShard { shard } => return run_shard(shard.as_deref(), front),
        Remedy::Discover => "search for the missing source of error",
        Remedy::Plan => "plan the next recording",
        Remedy::RecordAgain => "record again",
        Remedy::LeaveOut => "leave the static interval out",
        Remedy::Level => "level the device on each face",
        Remedy::Split => "split the recording at this place",
        Remedy::SortRows => "sort the rows by their time stamps",
        Remedy::FilePerSensor => "name the file of each sensor",
        Remedy::OneSensor => "calibrate one sensor alone and name only its columns",
        Remedy::LayDown => "lay the device down and record again",
        Remedy::RestLonger => "keep the device still for longer",
        Remedy::TurnSlower => "turn more slowly",
        Remedy::SampleFaster => "record at a higher rate",
        Remedy::FilterFirst => "let the sensor filter its readings before they are sampled",
        Remedy::TemperatureCycles => {
            "record while the temperature rises and falls at least twice, slowly and fast"
        }
        Remedy::WarmAndCool => "warm the device, then let it cool while you turn it",
        Remedy::LongFromSwitchOn => {
            "record twice as long: begin with five minutes at rest right after switching on, and return to the first \
             placement several times"
        }
        Remedy::SpeedsThatDiffer => {
            "turn at very different speeds, from slow (20 °/s) to as fast as the range allows, both ways about every axis"
        }
        Remedy::TiltsBetweenFaces => {
            "add placements between the faces: tilts of 20 to 70 degrees on every axis"
        }
        Remedy::OtherSides => "turn into the same placements from different sides, in mixed order",
        Remedy::LongRests => {
            "rest longer (30 s) in at least twelve orientations, and give the latitude"
        }
        Remedy::OtherOrder => "record a second time with the placements in another order",
        Remedy::LargerRange => "record with a larger range of the sensor",
        Remedy::SensorStamps => {
            "record the time stamps of the sensor itself, where the app or logger offers them"
        }
        Remedy::OneClock => "record all sensors by one clock",
        Remedy::RawReadings => "record readings that are neither rounded nor filtered",
        Remedy::Uncalibrated => {
            "record raw or uncalibrated readings, where the recording app offers them"
        }
        Remedy::WriteFolder => "write a folder, which keeps the clocks of both sensors",
        Remedy::Thermometer => "record the temperature too",
        Remedy::WarmUp => "let the device reach a steady temperature before recording",
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
        Remedy::LoseNoSamples => "record again without losing samples",
        Remedy::FreezeNoRows => "record again without rows that repeat the one before",
        Remedy::BothSensors => "record both sensors at the same time",
        Remedy::UnpackFirst => {
            "unpack it yourself if you trust it, and name the file that comes out"
        }
        Remedy::NameFile => "name the file itself instead of what holds it",
        Remedy::CopyAgain => "copy the file again, for it may be incomplete",
        Remedy::SaveAsCsv => "save the sheet as CSV and name that file",
        Remedy::SaveAsV7 => "save the file in MATLAB with `save -v7`",
        Remedy::OtherName => "choose another name for the output",
        Remedy::Replace => "replace the file",
        Remedy::KeepExisting => "keep the file",
        Remedy::MakeRoom => "make room, or write to another disk",
        Remedy::RaiseFileLimit => "raise the limit on file sizes (ulimit -f)",
        Remedy::MakeFolder => "make the folder first",
        Remedy::OtherFolder => "choose a folder that can be written to",
        Remedy::TryAgain => "try again, or choose a folder on another file system",
        Remedy::AnalyseNoise => {
            "record for hours at rest, analyse the noise, and export with what was found"
        }
    };
    let command = match (front, remedy) {
        (Front::CommandLine, Remedy::Discover) => " (`stillpoint discover`)",
        (Front::CommandLine, Remedy::Plan) => " (`stillpoint plan`)",
        (Front::CommandLine, Remedy::UpdateBias) => " (`stillpoint bias`)",
        (Front::CommandLine, Remedy::ListEffects) => " (`stillpoint effects`)",
        (Front::Python | Front::Rust, Remedy::ListEffects) => " (`Catalogue::names`)",
        (Front::CommandLine, Remedy::LookInto) => " (`stillpoint info`)",
        (Front::CommandLine, Remedy::LeaveOut) => " (--leave-out)",
        (Front::CommandLine, Remedy::Replace) => " (--force)",
        (Front::CommandLine, Remedy::KeepExisting) => " (--skip-existing)",
        (Front::CommandLine, Remedy::AnalyseNoise) => {
            " (`stillpoint allan RECORDING -o noise.json`, then --noise noise.json)"
        }
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

/// `use the joint method (--method joint)`.
fn other_method(method: &str, front: Front) -> String {
    let words = format!("use the {method} method");
    match front {
        Front::Plain => words,
        _ => with_setting(&words, &Setting::to(OptionName::Method, method), front),
    }
}

fn run_shard(shard: Option<&str>, front: Front) -> String {
    let what = shard.map_or("run this part of the batch again", |_| "run this part");
    match (front, shard) {
        (Front::CommandLine, Some(shard)) => format!("{what} with --shard {shard} --resume"),
        (Front::CommandLine, None) => format!("{what} with --resume"),
        _ => what.to_owned(),
    }
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

/// `give the local gravity (--gravity)`, or `sort the rows by time (--sort-time)`.
fn given(any_of: &[Setting], front: Front) -> String {
    let mut all: Vec<String> = Vec::new();
    let mut is_giving = false;
    for each in any_of {
        let own = doing(each);
        all.push(match (&own, is_giving) {
            (Some(doing), _) => with_setting(doing, each, front),
            (None, true) => setting(each, front),
            (None, false) => format!("give {}", setting(each, front)),
        });
        is_giving = own.is_none();
    }
    all.join(" or ")
}

/// Returns the action of an option, an imperative; `None` for an option that is named by the value it gives.
fn doing(setting: &Setting) -> Option<String> {
    use OptionName as O;
    let doing = match (setting.option, setting.value.as_deref()) {
        (O::Flip, _) => "change the sign of axes",
        (O::ForceDevice, _) => "say that the device is the same",
        (O::LeaveOut, _) => "leave static intervals out",
        (O::Method, Some(method)) => return Some(format!("use the {method} method")),
        (O::Na, None) => "say how missing values are treated",
        (O::Na, Some(_)) => "leave missing values out",
        (O::SkipBadRows, _) => "leave damaged rows out",
        (O::SortTime, _) => "sort the rows by time",
        _ => return None,
    };
    Some(doing.to_owned())
}

/// `the sampling rate, as in --rate 100`.
fn example(setting: &Setting, front: Front) -> String {
    let plain = plain(setting.option);
    format!("{plain}, as in {}", setting.text(front))
}

/// `run it again without --part`.
fn omitted(option: OptionName, front: Front) -> String {
    match front {
        Front::Plain => format!("do not give {}", plain(option)),
        Front::CommandLine => format!("run it again without {}", flag(option)),
        Front::Rust => format!("run it again without `{}`", field(option)),
        Front::Python => format!("run it again without `{option}`"),
    }
}

impl Setting {
    /// The option with its value as a front writes it: `--rate 100`, `rate=100`; for nobody in particular the value.
    pub fn text(&self, front: Front) -> String {
        let option = self.option;
        let value = self.value.as_deref();
        match (front, value) {
            (Front::Plain, _) => value.unwrap_or(plain(option)).to_owned(),
            (Front::CommandLine, Some(v)) => format!("{} {}", flag(option), quoted(v)),
            (Front::CommandLine, None) => flag(option),
            (Front::Rust, Some(v)) => format!("`{}` {v}", field(option)),
            (Front::Rust, None) => format!("`{}`", field(option)),
            (Front::Python, Some(v)) => format!("`{option}={v}`"),
            (Front::Python, None) => format!("`{option}`"),
        }
    }
}

/// `the local gravity (--gravity 9.81)`.
fn setting(setting: &Setting, front: Front) -> String {
    let changes = |value: &String| value.contains(['*', '+']);
    match (setting.option, setting.value.as_ref().is_some_and(changes)) {
        (OptionName::Columns, true) => with_setting("the columns with this change", setting, front),
        _ => with_setting(plain(setting.option), setting, front),
    }
}

/// `words (--gravity 9.81)`.
fn with_setting(words: &str, setting: &Setting, front: Front) -> String {
    match (front, &setting.value) {
        (Front::Plain, None) => words.to_owned(),
        _ => format!("{words} ({})", setting.text(front)),
    }
}
