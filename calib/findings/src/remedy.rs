//! Remedies as data: settings to give, things to record, commands to run.

use serde::{Deserialize, Serialize};

/// An option of reading or fitting, whatever a front end calls it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum OptionName {
    /// Unit of the accelerometer's readings.
    AccelUnit,
    /// Height above the sea.
    Altitude,
    /// Columns of the axes.
    Columns,
    /// Effects in the model.
    Effects,
    /// File in an archive.
    Entry,
    /// Norm of the magnetic field.
    Field,
    /// Axes whose sign is changed.
    Flip,
    /// No check of the device.
    ForceDevice,
    /// Format of the file.
    Format,
    /// Local gravity.
    Gravity,
    /// Unit of the gyroscope's readings.
    GyroUnit,
    /// Sensor of several of a kind.
    Instance,
    /// Latitude.
    Latitude,
    /// Parameters that were in force while a recording was logged.
    LoggedWith,
    /// Intervals that are left out.
    LeaveOut,
    /// Unit of the magnetometer's readings.
    MagUnit,
    /// Largest number of bytes.
    MaxBytes,
    /// Largest number of rows.
    MaxRows,
    /// Method of calibration.
    Method,
    /// Shortest static interval.
    MinStatic,
    /// Motion of a track.
    Motion,
    /// Threshold of the static detector.
    Multiplier,
    /// Missing values.
    Na,
    /// Noise of the sensor.
    Noise,
    /// Recording of several in a file.
    Part,
    /// Sampling rate.
    Rate,
    /// Stretch of a rest that is analysed.
    Rest,
    /// Sensor that is calibrated alone.
    Sensor,
    /// Damaged rows left out.
    SkipBadRows,
    /// Rows sorted by their stamps.
    SortTime,
    /// Format of the stamps.
    TimeFormat,
    /// Unit of the stamps.
    TimeUnit,
    /// Second recording that confirms what was found.
    Validation,
    /// Topic of a log.
    Topic,
    /// Window of the static detector.
    Window,
}

impl std::fmt::Display for OptionName {
    /// The name in snake case, as documents have it.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.serialize(f)
    }
}

/// An option with the value to give it, where one is known.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Setting {
    /// Option.
    pub option: OptionName,
    /// Value, such as `g` or `az=az*0.5`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<String>,
}

impl Setting {
    /// An option with its value.
    pub fn to(option: OptionName, value: impl Into<String>) -> Self {
        Self {
            option,
            value: Some(value.into()),
        }
    }
}

/// A way out of a finding.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Remedy {
    /// Give an option, or one of several.
    Set {
        /// Options; each alone is a way out.
        any_of: Vec<Setting>,
    },
    /// Give an option where what was decided is wrong.
    IfWrong {
        /// Options; each alone is a way out.
        any_of: Vec<Setting>,
    },
    /// Give an option, of which an example is known, or one of several.
    Example {
        /// Options with an example each; each alone is a way out.
        any_of: Vec<Setting>,
    },
    /// Do not give an option.
    Omit {
        /// The option.
        option: OptionName,
    },
    /// Name the file of each sensor.
    FilePerSensor,
    /// Go on with one sensor and name its columns alone.
    OneSensor,
    /// Write the unit into a column's name.
    NameUnit {
        /// Such a name, as `temp [K]`.
        example: String,
    },
    /// Search for the missing effect.
    Discover,
    /// Add these placements.
    AddPlacements {
        /// Placements as a person makes them.
        placements: Vec<String>,
    },
    /// Add these turns.
    AddTurns {
        /// Turns as a person makes them.
        turns: Vec<String>,
    },
    /// Plan the next recording.
    Plan,
    /// Record the place again, or leave it out of the fit.
    RecordAgain,
    /// Leave the place out of the fit.
    LeaveOut,
    /// Split the recording at the place.
    Split,
    /// Sort the rows by their stamps.
    SortRows,
    /// Level the device on each face.
    Level,
    /// Lay the device down instead of holding it.
    LayDown,
    /// Keep the device still for longer in every placement.
    RestLonger,
    /// Turn more slowly.
    TurnSlower,
    /// Record at a higher rate.
    SampleFaster,
    /// Filter the readings before they are sampled.
    FilterFirst,
    /// Let the temperature rise and fall at least twice, slowly and fast.
    TemperatureCycles,
    /// Warm the device, then let it cool while it is turned.
    WarmAndCool,
    /// Record twice as long, from switching on, and return to the first placement.
    LongFromSwitchOn,
    /// Turn at very different speeds, both ways about every axis.
    SpeedsThatDiffer,
    /// Place the device between its faces.
    TiltsBetweenFaces,
    /// Reach the same placements from different sides.
    OtherSides,
    /// Rest longer in many orientations, the latitude given.
    LongRests,
    /// Record again with the placements in another order.
    OtherOrder,
    /// Record with a larger range of the sensor.
    LargerRange,
    /// Record with the stamps of the sensor itself.
    SensorStamps,
    /// Record all sensors by one clock.
    OneClock,
    /// Record readings without rounding or filtering.
    RawReadings,
    /// Record what the sensor reads, without the device's own corrections.
    Uncalibrated,
    /// Write a folder, which has a clock per sensor.
    WriteFolder,
    /// Record with a thermometer.
    Thermometer,
    /// Let the temperature settle before recording.
    WarmUp,
    /// Fix the sensor to its case.
    FixSensor,
    /// Move away from iron and currents.
    AwayFromIron,
    /// Estimate the bias again.
    UpdateBias,
    /// Check by a second recording.
    Validate,
    /// Look into the file.
    LookInto,
    /// Export the file again.
    ExportAgain,
    /// Use the calibration of this device.
    OwnCalibration,
    /// Use another method.
    OtherMethod {
        /// Name of the method.
        method: String,
    },
    /// Take the name that is nearest to a misspelled one.
    Nearest {
        /// Such names, the likeliest first.
        names: Vec<String>,
    },
    /// See which effects there are.
    ListEffects,
    /// Calibrate again.
    CalibrateAgain,
    /// Look whether two files were swapped.
    SwapFiles,
    /// Look whether two sensors were swapped.
    SwapSensors,
    /// Turn the axes of a recording back.
    TurnBack {
        /// The recording.
        recording: String,
        /// Its columns as they should be read.
        columns: String,
    },
    /// Turn the device about each axis.
    TurnEachAxis,
    /// Record without losing samples.
    LoseNoSamples,
    /// Record without frozen rows.
    FreezeNoRows,
    /// Record both sensors at the same time.
    BothSensors,
    // Of files.
    /// Unpack the file by another program, and name what comes out.
    UnpackFirst,
    /// Name the file instead of what holds it.
    NameFile,
    /// Copy the file again.
    CopyAgain,
    /// Convert the file to CSV by another program.
    ConvertToCsv {
        /// A command or an expression that does it.
        by: String,
    },
    /// Save a sheet as CSV.
    SaveAsCsv,
    /// Save a MATLAB file in the format before 7.3.
    SaveAsV7,
    /// Export the file in another format.
    ExportAs {
        /// The format.
        format: String,
    },
    /// Build the program with a feature.
    Build {
        /// The feature.
        feature: String,
    },
    /// Choose another name for the output.
    OtherName,
    /// Replace the output that is there.
    Replace,
    /// Keep the output that is there.
    KeepExisting,
    /// Make room on the disk.
    MakeRoom,
    /// Raise the limit on the size of files.
    RaiseFileLimit,
    /// Make the folder first.
    MakeFolder,
    /// Choose a folder that can be written to.
    OtherFolder,
    /// Try again, or on another file system.
    TryAgain,
    /// Run a part of a batch again.
    RunShard {
        /// The part, as `3/8`; none where it is known from the file.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        shard: Option<String>,
    },
    /// Analyse the noise of a long rest.
    AnalyseNoise,
}

/// A misspelling has at most this many edits, and one more for every third letter.
const EDITS: usize = 1;

/// A name of at least so many letters that begins another one is that one, however much is missing.
const BEGUN: usize = 4;

impl Remedy {
    /// An option without a value.
    pub fn set(option: OptionName) -> Self {
        Self::Set {
            any_of: vec![Setting {
                option,
                value: None,
            }],
        }
    }

    /// An option with its value.
    pub fn set_to(option: OptionName, value: impl Into<String>) -> Self {
        Self::Set {
            any_of: vec![Setting::to(option, value)],
        }
    }

    /// An option with an example of a value.
    pub fn such_as(option: OptionName, value: impl Into<String>) -> Self {
        Self::examples([(option, value)])
    }

    /// One of several options, each with an example of a value.
    pub fn examples(options: impl IntoIterator<Item = (OptionName, impl Into<String>)>) -> Self {
        let setting = |(option, value): (OptionName, _)| Setting::to(option, value);
        Self::Example {
            any_of: options.into_iter().map(setting).collect(),
        }
    }

    /// One of several options.
    pub fn any_of(options: impl IntoIterator<Item = OptionName>) -> Self {
        Self::Set {
            any_of: without_values(options),
        }
    }

    /// One of several options where what was decided is wrong.
    pub fn if_wrong(options: impl IntoIterator<Item = OptionName>) -> Self {
        Self::IfWrong {
            any_of: without_values(options),
        }
    }

    /// The way out where a system refuses to write.
    pub fn for_writing(refusal: std::io::ErrorKind) -> Self {
        use std::io::ErrorKind as E;
        match refusal {
            E::StorageFull | E::QuotaExceeded => Self::MakeRoom,
            E::FileTooLarge => Self::RaiseFileLimit,
            E::NotFound => Self::MakeFolder,
            E::PermissionDenied | E::ReadOnlyFilesystem => Self::OtherFolder,
            // Network file systems fail now and then, and some cannot rename over a file.
            _ => Self::TryAgain,
        }
    }

    /// The known name that `name` is most likely the beginning or a misspelling of; none where no name is near.
    ///
    /// # Examples
    /// ```
    /// use stillpoint_findings::Remedy;
    /// let names = vec!["rate".to_owned()];
    /// assert_eq!(Remedy::nearest("rtae", ["gravity", "rate"]), Some(Remedy::Nearest { names }));
    /// assert_eq!(Remedy::nearest("zzzzzz", ["gravity", "rate"]), None);
    /// ```
    pub fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<Self> {
        let is_begun = |known: &str| name.len() >= BEGUN && known.starts_with(name);
        let edits = |known| strsim::damerau_levenshtein(name, known);
        let all = known.into_iter();
        let all = all.map(|known| (!is_begun(known), edits(known), known));
        let (is_other, edits, nearest) = all.min()?;
        (!is_other || edits <= EDITS + name.len() / 3).then(|| Self::Nearest {
            names: vec![nearest.to_owned()],
        })
    }

    /// Returns true if the remedy applies only when an automatic decision was wrong.
    pub fn is_if_wrong(&self) -> bool {
        matches!(self, Self::IfWrong { .. })
    }
}

fn without_values(options: impl IntoIterator<Item = OptionName>) -> Vec<Setting> {
    let setting = |option| Setting {
        option,
        value: None,
    };
    options.into_iter().map(setting).collect()
}
