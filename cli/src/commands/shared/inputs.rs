//! Arguments that commands share, and reading with a spinner.

use ::findings::{Finding, Front, Remedy};
use std::path::{Path, PathBuf};
use std::time::Duration;

use calib::calibration::{check_units, doubts, read_in_unit_of};
use calib::effect_file::{catalogue_with, read_effects};
use calib::gravity::{ACCEPTED, Gravity, NotOnEarth, normal_gravity};
use calib::intervals::{Detector, DetectorOptions};
use calib::methods::joint::ClockMode;
use calib::recording::{ReadOptions, figure};
use calib::{Calibration, Recording};
use indicatif::ProgressBar;
use sensor::EffectRef;

use crate::exit::Failure;
use crate::read_args::ReadArgs;
use crate::show::command_line;
use crate::{show, terminal};

/// Recordings of one device, as files or as a pair of texts.
#[derive(Debug, clap::Args)]
pub struct RecordingArgs {
    /// Files or folders, recordings of one device; `-` reads standard input
    #[arg(value_name = "RECORDING")]
    pub recordings: Vec<PathBuf>,
    /// Accelerometer text of a recording in two files (`t x y z`, no header, any unit)
    #[arg(
        long,
        value_name = "FILE",
        requires = "gyro_file",
        conflicts_with = "recordings"
    )]
    accel_file: Option<PathBuf>,
    /// Gyroscope text of that recording
    #[arg(long, value_name = "FILE", requires = "accel_file")]
    gyro_file: Option<PathBuf>,
}

impl RecordingArgs {
    /// Everything that is read for them.
    pub fn paths(&self) -> Vec<PathBuf> {
        let pair = self.accel_file.iter().chain(&self.gyro_file);
        self.recordings.iter().chain(pair).cloned().collect()
    }

    /// The first recording as a shell takes it.
    pub fn first(&self) -> String {
        let first = self.recordings.first();
        first.map_or("RECORDING".into(), |path| command_line(path))
    }

    /// The recordings as a shell takes them.
    pub fn command_line(&self) -> String {
        let pair = self.accel_file.iter().map(|path| ("--accel-file ", path));
        let pair = pair.chain(self.gyro_file.iter().map(|path| ("--gyro-file ", path)));
        let all = self.recordings.iter().map(|path| ("", path)).chain(pair);
        let words = all.map(|(option, path)| format!("{option}{}", command_line(path)));
        words.collect::<Vec<_>>().join(" ")
    }

    /// Reads them.
    pub fn read(&self, how: &ReadArgs) -> Result<Vec<Recording>, Failure> {
        let mut all = Vec::new();
        match (&self.accel_file, &self.gyro_file) {
            (Some(accel), Some(gyro)) => all = read_pair(accel, gyro, how)?,
            _ => {
                for path in &self.recordings {
                    all.extend(read_all(path, how)?);
                }
            }
        }
        Ok(all.into_iter().map(Recording::decimated).collect())
    }
}

/// A given gravity further from that of the given place than this is doubted, m/s²: five times the largest
/// anomalies of the free air.
const DOUBTFUL: f64 = 0.005;

/// Where the recording was made.
#[derive(Clone, Copy, Debug, clap::Args)]
#[command(next_help_heading = "Place")]
pub struct PlaceArgs {
    /// Local gravity, m/s²; a wrong one goes into the accelerometer's scale factors in full [default: that of
    /// --latitude and --altitude, else 9.80665 with errors that cover the whole earth]
    #[arg(long, value_name = "M/S²")]
    pub gravity: Option<f64>,
    /// Latitude, degrees, north positive: gives gravity and, in the joint fit, the earth's rotation
    #[arg(long, value_name = "DEG", allow_negative_numbers = true)]
    pub latitude: Option<f64>,
    /// Height above sea level, m
    #[arg(
        long,
        value_name = "M",
        requires = "latitude",
        allow_negative_numbers = true
    )]
    pub altitude: Option<f64>,
}

/// Refuses a gravity that is nowhere on the earth.
pub fn check_gravity(gravity: f64) -> Result<(), Failure> {
    Gravity::checked(Some(gravity), None, None).map_err(nowhere)?;
    Ok(())
}

/// Builds the failure for a place that is not on the earth.
fn nowhere(what: NotOnEarth) -> Failure {
    let message = match what {
        NotOnEarth::Gravity(gravity) => format!(
            "--gravity {}: on the earth it lies between {} and {} m/s²; an error of 0.01 changes \
             every scale factor by 0.1 %",
            figure(gravity),
            ACCEPTED.start(),
            ACCEPTED.end()
        ),
        NotOnEarth::Latitude(latitude) => format!(
            "--latitude {}: it lies between -90 and 90 degrees",
            figure(latitude)
        ),
        NotOnEarth::Altitude(altitude) => format!(
            "--altitude {}: metres above sea level, -500 to 9000, expected",
            figure(altitude)
        ),
        NotOnEarth::Place {
            gravity,
            latitude,
            normal,
        } => format!(
            "--gravity {} and --latitude {}: there gravity is {normal:.4} m/s²",
            figure(gravity),
            figure(latitude)
        ),
    };
    let failure = Failure::usage(message);
    match what {
        NotOnEarth::Place { .. } => {
            failure.advise("correct one of them, or give the latitude alone")
        }
        _ => failure,
    }
}

impl PlaceArgs {
    /// Returns the given options of the place for a shell, each preceded by a blank.
    pub fn command_line(&self) -> String {
        let given = [
            ("--gravity", self.gravity),
            ("--latitude", self.latitude),
            ("--altitude", self.altitude),
        ];
        let given = given.into_iter();
        let written =
            given.filter_map(|(option, value)| Some(format!(" {option}={}", figure(value?))));
        written.collect()
    }

    /// Local gravity: as given, else by the place, else assumed.
    pub fn gravity(&self) -> Result<Gravity, Failure> {
        let Self {
            gravity,
            latitude,
            altitude,
        } = *self;
        let found = Gravity::checked(gravity, latitude, altitude).map_err(nowhere)?;
        if let (Some(gravity), Some(latitude)) = (gravity, latitude) {
            let there = normal_gravity(latitude, altitude.unwrap_or(0.0));
            // Below 2 km the height explains so much.
            let height = if altitude.is_some() { 0.0 } else { 0.006 };
            if (gravity - there).abs() > DOUBTFUL + height {
                show::warn(&format!(
                    "--gravity {}: at the latitude {latitude}° it is {there:.4} m/s²; if that is right, every \
                     scale factor of the accelerometer is {:.2} % too {}",
                    figure(gravity),
                    100.0 * (gravity / there - 1.0).abs(),
                    if gravity > there { "large" } else { "small" }
                ));
            }
        }
        Ok(found)
    }
}

/// By which clock the turns are integrated.
#[derive(Clone, Copy, Debug, Default, clap::ValueEnum)]
pub enum ClockArg {
    /// What the data say: the stamps, an even clock behind them, or between (`--method stepwise`: the stamps)
    #[default]
    Auto,
    /// The stamps as they are
    Stamps,
    /// An even clock, where the stamps scatter about one
    Even,
}

impl ClockArg {
    /// The same for the library.
    pub fn mode(self) -> ClockMode {
        match self {
            Self::Auto => ClockMode::Auto,
            Self::Stamps => ClockMode::Stamps,
            Self::Even => ClockMode::Even,
        }
    }
}

/// How the detector of motion is set.
#[derive(Clone, Debug, clap::Args)]
#[command(next_help_heading = "Static intervals")]
pub struct DetectorArgs {
    /// Threshold as a multiple of the level at rest [default: chosen by the accelerometer's fit]
    #[arg(long, value_name = "FACTOR")]
    multiplier: Option<f64>,
    /// Shortest static interval, s, without the ends that the window takes of it [default: 2.5, or down to 0.6 where only that
    /// makes a calibration]
    #[arg(long, value_name = "SECONDS")]
    min_static: Option<f64>,
    /// Shortest motion, s [default: 0.5]
    #[arg(long, value_name = "SECONDS")]
    min_dynamic: Option<f64>,
    /// Window in which the spread is measured, s [default: 1, shorter for shorter static intervals]
    #[arg(long, value_name = "SECONDS")]
    window: Option<f64>,
    /// Length of the rest at the start that gives the level at rest, s [default: the quietest tenth
    /// of the recording]
    #[arg(long, value_name = "SECONDS")]
    initial_static: Option<f64>,
}

impl DetectorArgs {
    /// The first of its options that was given.
    pub fn given(&self) -> Option<&'static str> {
        let given = [
            ("--multiplier", self.multiplier.is_some()),
            ("--min-static", self.min_static.is_some()),
            ("--min-dynamic", self.min_dynamic.is_some()),
            ("--window", self.window.is_some()),
            ("--initial-static", self.initial_static.is_some()),
        ];
        given
            .into_iter()
            .find(|(_, given)| *given)
            .map(|(option, _)| option)
    }

    /// The detector, and whether its multiplier is left to the fit.
    pub fn detector(&self) -> Result<(Detector, bool), Failure> {
        let options = DetectorOptions {
            multiplier: self.multiplier,
            min_static: self.min_static,
            min_dynamic: self.min_dynamic,
            window: self.window,
            initial_static: self.initial_static,
        };
        options.detector().map_err(|name| {
            let flag = name.replace('_', "-");
            Failure::usage(format!("--{flag}: a positive number expected"))
        })
    }
}

/// Reads a calibration, and says so where it was edited since it was written.
pub fn load(path: &Path) -> Result<Calibration, Failure> {
    let calibration = calib::calibration::load(path)?;
    if let Some(edited) = calibration.edited() {
        let found = edited.finding().in_file(show::path(path));
        show::warn(&found.text(Front::CommandLine));
    }
    Ok(calibration)
}

/// Metadata of a file that is only looked at; `None` of one that is not there or is a folder, of which whoever reads
/// it says more.
///
/// # Errors
/// Status 3 with the system's reason.
pub fn looked_at<T>(path: &Path, found: std::io::Result<T>) -> Result<Option<T>, Failure> {
    use std::io::ErrorKind;
    match found {
        Ok(found) => Ok(Some(found)),
        Err(error) if matches!(error.kind(), ErrorKind::NotFound | ErrorKind::IsADirectory) => {
            Ok(None)
        }
        Err(source) => Err(calib::Error::Io {
            path: path.to_owned(),
            source,
        }
        .into()),
    }
}

/// Reads a recording and shows its warnings.
pub fn read(path: &Path, args: &ReadArgs) -> Result<Recording, Failure> {
    let spinner = spinner(&format!("reading {}", show::path(path)));
    let recording = Recording::read(path, &args.clone().into())?;
    spinner.finish_and_clear();
    Ok(recording)
}

/// Reads a recording that a calibration is for: where nothing tells the gyroscope's unit, it is that of the calibration's
/// own recordings.
pub fn read_for(
    calibration: Option<&Calibration>,
    path: &Path,
    args: &ReadArgs,
) -> Result<Recording, Failure> {
    let Some(calibration) = calibration else {
        return read(path, args);
    };
    let spinner = spinner(&format!("reading {}", show::path(path)));
    let recording = read_in_unit_of(calibration, |unit| {
        let options = ReadOptions::from(args.clone());
        let gyro_unit = options.gyro_unit.or(unit);
        Recording::read(
            path,
            &ReadOptions {
                gyro_unit,
                ..options
            },
        )
    })?;
    spinner.finish_and_clear();
    Ok(recording)
}

/// Reads all recordings of a file: several where its clock begins again.
pub fn read_all(path: &Path, args: &ReadArgs) -> Result<Vec<Recording>, Failure> {
    let spinner = spinner(&format!("reading {}", show::path(path)));
    let recordings = Recording::read_all(path, &args.clone().into())?;
    spinner.finish_and_clear();
    Ok(recordings)
}

/// Reads the two files of a recording that keeps its sensors apart.
pub fn read_pair(accel: &Path, gyro: &Path, args: &ReadArgs) -> Result<Vec<Recording>, Failure> {
    let spinner = spinner("reading");
    let recordings = Recording::read_pair_all(accel, gyro, &args.clone().into())?;
    spinner.finish_and_clear();
    Ok(recordings)
}

/// Whether a calibration may be used on a recording of another unit or device.
#[derive(Clone, Copy, Debug, clap::Args)]
pub struct DeviceArgs {
    /// Use the calibration even where the readings seem to be of another unit or device
    #[arg(long)]
    force_device: bool,
}

impl DeviceArgs {
    /// Refuses readings that the calibration is not for; warns of one that failed its gate.
    pub fn check(
        self,
        calibration: &Calibration,
        recordings: &[&Recording],
    ) -> Result<(), Failure> {
        for doubt in self.refuse(calibration, recordings)? {
            show::warn(&doubt);
        }
        Ok(())
    }

    /// Refuses readings that the calibration is not for; doubts about the others, and its gates that failed.
    pub fn refuse(
        self,
        calibration: &Calibration,
        recordings: &[&Recording],
    ) -> Result<Vec<String>, Failure> {
        let doubts = self.doubts(calibration, recordings)?;
        let doubts = doubts.iter().map(|doubt| doubt.text(Front::CommandLine));
        Ok(gates_of(calibration).chain(doubts).collect())
    }

    /// Refuses readings that the calibration is not for; doubts about the others.
    pub fn doubts(
        self,
        calibration: &Calibration,
        recordings: &[&Recording],
    ) -> Result<Vec<Finding>, Failure> {
        let mut said = Vec::new();
        for recording in recordings.iter().filter(|_| !self.force_device) {
            check_units(calibration, recording)?;
            said.extend(doubts(calibration, recording)?);
        }
        Ok(said)
    }
}

/// The gates that a calibration failed, in words.
pub fn gates_of(calibration: &Calibration) -> impl Iterator<Item = String> {
    let gates = calibration.failed_gates.iter();
    gates.map(|gate| {
        let gate = gate.text(Front::CommandLine);
        format!("the calibration failed a gate: {gate}")
    })
}

/// A sign of life on a terminal; nothing elsewhere.
pub fn spinner(what: &str) -> ProgressBar {
    if terminal::is_quiet() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new_spinner().with_message(what.to_owned());
    // Its thread is one that a limit of memory may not allow.
    if !bar.is_hidden() {
        bar.enable_steady_tick(Duration::from_millis(100));
    }
    bar
}

/// Paths as references, for the check that an output is no input.
pub fn as_paths(paths: &[PathBuf]) -> Vec<&Path> {
    paths.iter().map(PathBuf::as_path).collect()
}

/// `a,b,…` as numbers.
pub fn numbers<const N: usize>(text: &str) -> Result<[f64; N], String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse()).collect();
    numbers
        .ok()
        .filter(|numbers| numbers.iter().all(|v: &f64| v.is_finite()))
        .and_then(|numbers| numbers.try_into().ok())
        .ok_or_else(|| format!("{N} numbers separated by commas expected"))
}

/// Name and file of a `--calibration [NAME=]FILE`: without a name, that of the file.
pub fn named_file(named: &str) -> (String, &Path) {
    match named.split_once('=') {
        Some((name, file)) => (name.to_owned(), Path::new(file)),
        None => {
            let path = Path::new(named);
            let stem = path.file_stem().unwrap_or(path.as_os_str());
            (stem.to_string_lossy().into_owned(), path)
        }
    }
}

/// The effect that `--effects` names, of the catalogue or of `own`.
pub fn named_effect(name: &str, own: &[EffectRef]) -> Result<EffectRef, Failure> {
    let found = catalogue_with(own).find(|effect| effect.name() == name);
    found.ok_or_else(|| {
        let names: Vec<String> = catalogue_with(own).map(|e| e.name().to_owned()).collect();
        let known = match Remedy::nearest(name, names.iter().map(String::as_str)) {
            Some(Remedy::Nearest { names }) => {
                format!("did you mean {}?", names.join(" or "))
            }
            _ => names.join(", "),
        };
        Failure::usage(format!("--effects {name}: not in the catalogue ({known})"))
    })
}

/// The effects that `--effect-file` defines, each name once.
pub fn own_effects(files: &[PathBuf]) -> Result<Vec<EffectRef>, Failure> {
    let mut own: Vec<EffectRef> = Vec::new();
    for path in files {
        for effect in read_effects(path)? {
            let name = effect.name();
            if catalogue_with(&own).any(|other| other.name() == name) {
                let message = format!(
                    "--effect-file {}: `{name}` is defined in another of the files too",
                    show::path(path)
                );
                return Err(Failure::usage(message));
            }
            own.push(effect);
        }
    }
    Ok(own)
}
