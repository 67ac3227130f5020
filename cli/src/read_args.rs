//! Options of every command that reads a recording.

use calib::recording::formats::{self, Format};
use calib::recording::{
    AccelUnit, ColumnMap, FieldUnit, GyroUnit, ReadOptions, Role, TimeUnit, figure,
};
use clap::{Args, ValueEnum};

/// How recordings are read; a well-formed file needs none of these.
#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Reading recordings")]
pub struct ReadArgs {
    /// The accelerometer is wanted alone; no option of reading.
    #[arg(skip)]
    pub accelerometer_alone: bool,

    /// The format; recognised from the content when not given.
    #[arg(long, value_name = "NAME", value_parser = formats::by_name)]
    pub format: Option<&'static dyn Format>,

    /// The file to read within a folder or a zip archive that holds several recordings.
    #[arg(long, value_name = "NAME")]
    pub entry: Option<String>,

    /// The topics, messages or variables of the sensors in a log that holds several, as `/imu/data_raw` or
    /// `sensor_combined`.
    #[arg(long, value_name = "TOPIC,...", value_delimiter = ',')]
    pub topic: Vec<String>,

    /// Which of several devices: sensors alike in a log, as `0`, or rows of a table by what its column of devices holds,
    /// as `1` or `left`; `all` takes the rows of a table for those of one device.
    #[arg(long, value_name = "N")]
    pub instance: Option<String>,

    /// Which recording, from 1, of a file in which the clock begins again (a reboot, two logs in one file).
    #[arg(long, value_name = "N")]
    pub part: Option<usize>,

    /// Which column is what, by name or by number from 1: `t=timestamp,ax=acc_x,ay=acc_y,az=acc_z`; roles are t, ax, ay, az,
    /// gx, gy, gz, temp, mx, my, mz, `ta`, `tg` and `tm` for stamps of one sensor, and `device` for what tells devices apart.
    /// A sign, a factor and an offset may go with it: `az=-acc_z`, `temp=raw/340+36.53`; `t=cycles/168e6` gives seconds.
    #[arg(long, value_name = "ROLE=COLUMN,...")]
    pub columns: Option<ColumnMap>,

    /// Leave out up to N broken rows with a warning.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub skip_bad_rows: usize,

    /// What to do with rows that lack a number (empty, NaN, Inf, NULL).
    #[arg(long, value_enum, default_value_t = Na::Refuse)]
    pub na: Na,

    /// Sort rows by time where time goes backwards.
    #[arg(long)]
    pub sort_time: bool,

    /// Sampling rate, Hz: rows are evenly spaced and time stamps are ignored. Example: --rate 100
    #[arg(long, value_name = "HZ")]
    pub rate: Option<f64>,

    /// Unit of the time stamps: s, ms, us or ns.
    #[arg(long, value_name = "UNIT")]
    pub time_unit: Option<TimeUnit>,

    /// Pattern of time stamps that are dates, as in `%d.%m.%Y %H:%M:%S%.f`; ISO 8601 needs none.
    #[arg(long, value_name = "PATTERN")]
    pub time_format: Option<String>,

    /// Unit of the accelerometer: m/s^2, g, mg, cm/s^2, mm/s^2, ft/s^2 or counts.
    #[arg(long, value_name = "UNIT")]
    pub accel_unit: Option<AccelUnit>,

    /// Unit of the gyroscope: rad/s, mrad/s, deg/s, mdeg/s, deg/min, deg/h, rpm, rev/s or counts.
    #[arg(long, value_name = "UNIT")]
    pub gyro_unit: Option<GyroUnit>,

    /// Unit of the magnetometer: uT, nT, mT, T, G, mG or counts.
    #[arg(long, value_name = "UNIT")]
    pub mag_unit: Option<FieldUnit>,

    /// Read these axes with the other sign, as `gx` or `ax,mz`.
    #[arg(long, value_name = "AXIS,...", value_delimiter = ',', value_parser = axis)]
    pub flip: Vec<Role>,

    /// Rows of one file after which it is refused.
    #[arg(long, value_name = "N", default_value_t = ReadOptions::default().max_rows)]
    pub max_rows: u64,

    /// Bytes of one file's text after which it is refused.
    #[arg(long, value_name = "N", default_value_t = ReadOptions::default().max_bytes)]
    pub max_bytes: u64,
}

impl ReadArgs {
    /// Its options with the values that were given; an option without a value has an empty one.
    fn options(&self) -> [(&'static str, Option<String>); 18] {
        let limits = ReadOptions::default();
        let list = |words: Vec<String>| (!words.is_empty()).then(|| words.join(","));
        let other = |value: u64, usual: u64| (value != usual).then(|| value.to_string());
        let unit = |name: Option<&str>| name.map(str::to_owned);
        let axes = self.flip.iter().map(|role| role.name().to_owned());
        [
            ("--format", unit(self.format.map(|format| format.name()))),
            ("--entry", self.entry.clone()),
            ("--topic", list(self.topic.clone())),
            ("--instance", self.instance.clone()),
            ("--part", self.part.map(|part| part.to_string())),
            ("--columns", self.columns.as_ref().map(ColumnMap::to_string)),
            ("--skip-bad-rows", other(self.skip_bad_rows as u64, 0)),
            ("--na", (self.na == Na::Drop).then(|| "drop".to_owned())),
            ("--sort-time", self.sort_time.then(String::new)),
            ("--rate", self.rate.map(figure)),
            ("--time-unit", unit(self.time_unit.map(TimeUnit::name))),
            ("--time-format", self.time_format.clone()),
            ("--accel-unit", unit(self.accel_unit.map(AccelUnit::name))),
            ("--gyro-unit", unit(self.gyro_unit.map(GyroUnit::name))),
            ("--mag-unit", unit(self.mag_unit.map(FieldUnit::name))),
            ("--flip", list(axes.collect())),
            ("--max-rows", other(self.max_rows, limits.max_rows)),
            ("--max-bytes", other(self.max_bytes, limits.max_bytes)),
        ]
    }

    /// The first option that was given.
    pub fn given(&self) -> Option<&'static str> {
        let first = self
            .options()
            .into_iter()
            .find(|(_, value)| value.is_some());
        first.map(|(option, _)| option)
    }

    /// Returns true if no option is given that a well-formed file does not need.
    pub fn are_default(&self) -> bool {
        // These let through what would be refused; a limit does where it is raised.
        let lenient = ["--skip-bad-rows", "--na", "--sort-time"];
        let limits = ["--max-rows", "--max-bytes"];
        let usual = ReadOptions::default();
        let limited = self.max_rows < usual.max_rows || self.max_bytes < usual.max_bytes;
        let is_usual = |(option, value): (&str, Option<String>)| {
            value.is_none() || lenient.contains(&option) || limits.contains(&option)
        };
        !limited && self.options().into_iter().all(is_usual)
    }

    /// The options that were given, as a shell takes them, each with a blank before it.
    pub fn command_line(&self) -> String {
        let mut given = self.options();
        given.sort_by_key(|(option, _)| *option == "--sort-time");
        let written = given
            .into_iter()
            .filter_map(|(option, value)| match value?.as_str() {
                "" => Some(format!(" {option}")),
                // A value that begins like an option has to stand behind the sign of equality.
                value if value.starts_with('-') => Some(format!(" {option}={}", quoted(value))),
                value => Some(format!(" {option} {}", quoted(value))),
            });
        written.collect()
    }
}

/// A word as a shell takes it.
pub fn quoted(word: &str) -> String {
    let plain =
        |c: char| c.is_alphanumeric() || matches!(c, '/' | '.' | '_' | '-' | '+' | '=' | ',');
    match !word.is_empty() && word.chars().all(plain) {
        true => word.to_owned(),
        false => format!("'{}'", word.replace('\'', "'\\''")),
    }
}

/// The axis of a sensor by its column's name.
fn axis(name: &str) -> Result<Role, String> {
    Role::from_name(name.trim())
        .filter(|role| matches!(role, Role::Accel(_) | Role::Gyro(_) | Role::Field(_)))
        .ok_or_else(|| format!("`{name}` is none of ax, ay, az, gx, gy, gz, mx, my, mz"))
}

/// Treatment of rows that lack a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Na {
    /// Refuse the recording, naming the first.
    Refuse,
    /// Leave them out and count them.
    Drop,
}

impl From<ReadArgs> for ReadOptions {
    fn from(args: ReadArgs) -> Self {
        Self {
            instance: args.instance.as_deref().and_then(|n| n.parse().ok()),
            device: args.instance,
            part: args.part,
            format: args.format.map(|format| format.name()),
            columns: args.columns.unwrap_or_default(),
            skip_bad_rows: args.skip_bad_rows,
            na_drop: args.na == Na::Drop,
            sort_time: args.sort_time,
            rate: args.rate,
            time_unit: args.time_unit,
            time_format: args.time_format,
            accel_unit: args.accel_unit,
            gyro_unit: args.gyro_unit,
            mag_unit: args.mag_unit,
            flip: args.flip,
            entry: args.entry,
            topics: args.topic,
            accelerometer_alone: args.accelerometer_alone,
            max_rows: args.max_rows,
            max_bytes: args.max_bytes,
        }
    }
}

#[cfg(test)]
mod tests {
    use clap::{Command, FromArgMatches};

    use super::*;

    fn parsed(words: &[String]) -> ReadArgs {
        let command = ReadArgs::augment_args(Command::new("x"));
        let matches =
            command.try_get_matches_from(std::iter::once("x".to_owned()).chain(words.to_vec()));
        ReadArgs::from_arg_matches(&matches.unwrap()).unwrap()
    }

    #[test]
    fn every_option_that_is_given_is_written_so_that_it_is_read_again() {
        let command = ReadArgs::augment_args(Command::new("x"));
        for arg in command.get_arguments() {
            let option = format!("--{}", arg.get_long().unwrap());
            let value = match arg.get_id().as_str() {
                "format" => Some("csv"),
                "columns" => Some("az=-acc z,t=2"),
                "na" => Some("drop"),
                "time_unit" => Some("ms"),
                "accel_unit" => Some("m/s^2"),
                "gyro_unit" => Some("deg/s"),
                "mag_unit" => Some("nT"),
                "flip" => Some("ax,gz"),
                "time_format" => Some("%H:%M it's"),
                _ if arg.get_action().takes_values() => Some("7"),
                _ => None,
            };
            let words: Vec<String> = std::iter::once(option.as_str())
                .chain(value)
                .map(str::to_owned)
                .collect();
            let given = parsed(&words);
            let line = given.command_line();
            assert!(
                line.starts_with(&format!(" {option}")),
                "{option}: `{line}`"
            );
            let again = shlex(&line);
            assert_eq!(
                format!("{:?}", parsed(&again)),
                format!("{given:?}"),
                "{line}"
            );
        }
        assert_eq!(parsed(&[]).command_line(), "");
    }

    /// The words of a line, quotes taken off.
    fn shlex(line: &str) -> Vec<String> {
        let (mut words, mut word, mut quoted, mut escaped) =
            (Vec::new(), String::new(), false, false);
        for c in line.trim().chars() {
            match c {
                _ if escaped => {
                    word.push(c);
                    escaped = false;
                }
                '\'' => quoted = !quoted,
                '\\' if !quoted => escaped = true,
                ' ' if !quoted => words.extend(Some(std::mem::take(&mut word))),
                c => word.push(c),
            }
        }
        words.extend((!word.is_empty()).then_some(word));
        words
    }
}
