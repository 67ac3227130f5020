//! Kinds of findings: the physical cause or the consequence of each, by a stable name.

/// Declares the kinds with their names; a kind's words stand in [`crate::words`].
macro_rules! kinds {
    ($($(#[$doc:meta])* $kind:ident = $name:literal,)*) => {
        /// Physical cause or consequence that a finding names. The names are stable.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[non_exhaustive]
        pub enum Kind {
            $($(#[$doc])* $kind,)*
        }

        impl Kind {
            /// Every kind, in the order of the manual.
            pub const ALL: &'static [Self] = &[$(Self::$kind,)*];

            /// Name in snake case, as documents have it.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$kind => $name,)*
                }
            }

            /// Kind of a name; [`Kind::Remark`] of a name that this version does not know.
            pub fn named(name: &str) -> Self {
                match name {
                    $($name => Self::$kind,)*
                    _ => Self::Remark,
                }
            }
        }
    };
}

kinds! {
    // Fit and model.
    /// The fit leaves more than the noise explains.
    Misfit = "misfit",
    /// An effect that the model lacks shows in the residuals though no channel misfits as a whole.
    EffectMissing = "effect_missing",
    /// A parameter is known too badly to be used with ease.
    WeakParameter = "weak_parameter",
    /// Directions are missing among the placements.
    PlacementsMissing = "placements_missing",
    /// One static interval alone carries a parameter.
    InfluentialInterval = "influential_interval",
    /// Gravity was assumed.
    GravityAssumed = "gravity_assumed",
    /// The height was assumed.
    AltitudeAssumed = "altitude_assumed",
    // Readings of a sensor.
    /// Readings end at the limit of the sensor's range.
    Saturated = "saturated",
    /// The steps of the readings are wider than the noise.
    Quantised = "quantised",
    /// Small signals read as exactly zero.
    DeadZone = "dead_zone",
    /// Rows repeat one reading for longer than chance makes it.
    Frozen = "frozen",
    /// All readings from a row on repeat one pattern: memory that was never written.
    ErasedTail = "erased_tail",
    /// The magnetometer reads zero throughout.
    MagnetometerDead = "magnetometer_dead",
    /// Single samples are zero on every axis: the sensor was not read.
    FailedReads = "failed_reads",
    /// The device sets its zero anew while it rests.
    Rezeroed = "rezeroed",
    /// Single readings stand far from their neighbours on both sides.
    Spikes = "spikes",
    /// Some static intervals are far noisier than the others.
    Vibration = "vibration",
    /// From one static interval on the readings are far noisier, or up to one.
    NoiseChanged = "noise_changed",
    /// The rate wavers in the quietest stretches as in a hand.
    HandHeld = "hand_held",
    /// A sensor is slower than the rows, and its readings are held between.
    SlowerSensor = "slower_sensor",
    /// The recording lacks a sensor.
    OneSensorOnly = "one_sensor_only",
    /// The recording has no sensor at all.
    NoSensor = "no_sensor",
    /// The accelerometer's sign was turned to the usual one.
    SignTurned = "sign_turned",
    /// Another system had corrected the readings before.
    CorrectedBySystem = "corrected_by_system",
    /// The correction by another system was undone.
    CorrectionUndone = "correction_undone",
    /// Another system had filtered the readings and taken a mean off.
    FilteredBefore = "filtered_before",
    /// The sensor was read before it had a new reading.
    ReadingsStale = "readings_stale",
    /// The accelerometer is the sum of gravity and the acceleration without it.
    GravityAdded = "gravity_added",
    /// A column that seemed to lack gravity has it.
    GravityNotAdded = "gravity_not_added",
    /// A fast sensor was read as means over blocks of samples.
    Averaged = "averaged",
    // Stamps and clocks.
    /// Rows repeat earlier ones.
    RowsRepeated = "rows_repeated",
    /// Rows have the stamp of another, and other values.
    StampsEqual = "stamps_equal",
    /// The stamps are coarser than the rate.
    StampsCoarse = "stamps_coarse",
    /// The stamps are those of arrival: they come in bursts.
    StampsOfArrival = "stamps_of_arrival",
    /// Samples are missing.
    SamplesLost = "samples_lost",
    /// The logger could not keep up and dropped samples.
    LogDropouts = "log_dropouts",
    /// The recording was paused.
    Paused = "paused",
    /// The clock of a log jumps back.
    ClockBack = "clock_back",
    /// The time counter overflows and starts again.
    CounterWraps = "counter_wraps",
    /// A short recording before or after the one that is read was left out.
    SessionLeftOut = "session_left_out",
    /// A file holds several recordings.
    SeveralRecordings = "several_recordings",
    /// The unit of the stamps follows from the stamps.
    TimeUnitTold = "time_unit_told",
    /// The stamps go up by one and may count the rows.
    StampsCountRows = "stamps_count_rows",
    /// A rate was given, and the stamps are not used.
    StampsIgnored = "stamps_ignored",
    /// The stamps tell another rate than the one that was given.
    RateContradicted = "rate_contradicted",
    /// A sensor with a clock of its own was interpolated.
    ClockJoined = "clock_joined",
    /// The thermometer begins late or ends early.
    TemperaturePartlyKnown = "temperature_partly_known",
    /// The thermometer's stamps are of another clock.
    TemperatureOfAnotherClock = "temperature_of_another_clock",
    // Units.
    /// The accelerometer's unit follows from the size of gravity.
    UnitByGravity = "unit_by_gravity",
    /// The gyroscope's unit follows from the turns that the accelerometer saw.
    UnitByTurns = "unit_by_turns",
    /// The gyroscope's unit is a guess from its largest reading.
    UnitBySize = "unit_by_size",
    /// Nothing tells the gyroscope's unit, and rad/s is assumed.
    UnitAssumed = "unit_assumed",
    /// The gyroscope's unit is that of the recording that the calibration was made from.
    UnitOfCalibration = "unit_of_calibration",
    /// The readings are raw counts and kept as they are.
    ReadAsCounts = "read_as_counts",
    /// A given unit is another than the file states.
    UnitOverridden = "unit_overridden",
    /// The units are those that such files usually have.
    UnitsOfFormat = "units_of_format",
    /// Temperatures are so high that they may be °F.
    TemperatureDoubtful = "temperature_doubtful",
    /// Temperatures are counts of the sensor and no °C.
    TemperatureInCounts = "temperature_in_counts",
    /// Temperatures are beyond what a sensor stands.
    TemperatureImpossible = "temperature_impossible",
    // Files and formats.
    /// The text is in another encoding than UTF-8.
    TextEncoding = "text_encoding",
    /// The name of a file is that of another format.
    NameMisleads = "name_misleads",
    /// Numbers are spelt in a way of their own.
    NumberSpelling = "number_spelling",
    /// The first or the last row is cut.
    RowCut = "row_cut",
    /// A logger writes its header again and again.
    HeadersLeftOut = "headers_left_out",
    /// Broken rows were left out.
    RowsBroken = "rows_broken",
    /// Rows lack numbers and were left out.
    RowsWithoutNumbers = "rows_without_numbers",
    /// Columns were taken by the units in their names.
    ColumnsByUnit = "columns_by_unit",
    /// Columns without names were taken by their readings.
    ColumnsByReadings = "columns_by_readings",
    /// The magnetometer could not be read.
    FieldLeftOut = "field_left_out",
    /// Columns look like a magnetometer's and are not read.
    FieldNotRead = "field_not_read",
    /// Only some of several sensors in an app's recording were read.
    StreamsChosen = "streams_chosen",
    /// The file ends too early.
    FileCut = "file_cut",
    /// The recording program did not close the file.
    FileNotClosed = "file_not_closed",
    /// A part of the file is damaged.
    FileDamaged = "file_damaged",
    /// A chunk of a log is damaged and left out.
    ChunkDamaged = "chunk_damaged",
    /// Bytes of a log are no messages.
    BytesSkipped = "bytes_skipped",
    /// A variable is of a class that is not read.
    VariableNotRead = "variable_not_read",
    /// No variable is called as a sensor is.
    VariablesUnknown = "variables_unknown",
    /// A hidden sheet of a workbook was left out.
    SheetHidden = "sheet_hidden",
    /// An entry of an archive lies outside of it.
    EntryOutside = "entry_outside",
    // Calibrations of other tools.
    /// The file states no errors of its parameters.
    ErrorsNotStated = "errors_not_stated",
    /// The file states no biases.
    BiasNotStated = "bias_not_stated",
    /// An exported calibration has no bias of a sensor.
    BiasUnknown = "bias_unknown",
    /// Only the first of several IMUs in the file was read.
    FirstImuTaken = "first_imu_taken",
    /// An entry of the file is not known.
    EntryUnknown = "entry_unknown",
    /// The places of the accelerometer's axes are not read.
    PlacesNotRead = "places_not_read",
    // Noise.
    /// Nothing can be said of the noise of an axis.
    NoiseUnknown = "noise_unknown",
    /// The five noise terms do not describe the Allan variance.
    NoiseModelMisses = "noise_model_misses",
    /// Single samples of a rest are missing.
    NoiseSamplesMissing = "noise_samples_missing",
    /// A rest is interrupted.
    NoiseGaps = "noise_gaps",
    /// The mean of a sensor steps during a rest.
    MeanSteps = "mean_steps",
    /// The mean of a sensor drifts during a rest.
    MeanDrifts = "mean_drifts",
    /// The bias moves within the rest that it is estimated from.
    BiasDrifts = "bias_drifts",
    /// The readings stand still for a while during a rest.
    ReadingsHeld = "readings_held",
    /// Rows repeat the readings before, for the sensor is slower.
    RowsFasterThanSensor = "rows_faster_than_sensor",
    /// The gyroscope's deviation does not turn flat.
    SettlingUnknown = "settling_unknown",
    // Static intervals and turns.
    /// Placements disagree with each other though nothing shook.
    PlacementsApart = "placements_apart",
    /// A turn cannot be used.
    TurnLost = "turn_lost",
    /// Samples are missing within a static interval.
    IntervalGap = "interval_gap",
    /// Most static intervals shake as if held in a hand.
    ShakyIntervals = "shaky_intervals",
    /// The device sways while it should rest.
    DeviceSways = "device_sways",
    /// The readings swing with one period in the static intervals.
    RestsSwing = "rests_swing",
    /// The device turns slowly in many static intervals.
    RestsTurn = "rests_turn",
    /// A bias steps within a static interval.
    BiasStepped = "bias_stepped",
    /// The readings drift while the device should rest.
    Creep = "creep",
    /// The device settles after it was laid down.
    Settling = "settling",
    /// The device moves while it should rest.
    MountSlip = "mount_slip",
    /// Something touched or pushed the device.
    DisturbedInterval = "disturbed_interval",
    /// The mean rate of one static interval is off.
    RateExcursion = "rate_excursion",
    /// A turn misses gravity by more than the noise.
    TurnMissed = "turn_missed",
    /// A turn lasts so long that it may hide a static interval.
    LongTurn = "long_turn",
    /// The device shook in a static interval.
    NotStill = "not_still",
    /// One static interval disagrees with all others.
    IntervalDisagrees = "interval_disagrees",
    /// Static intervals are short.
    ShortIntervals = "short_intervals",
    /// A placement lies on no face.
    OffFace = "off_face",
    /// A face was taken more than once.
    FaceTwice = "face_twice",
    /// The six placements are tilted.
    PlacementsTilted = "placements_tilted",
    // Devices, their recordings and what is known of them.
    /// The rotation of the earth speaks against the given latitude.
    LatitudeDoubtful = "latitude_doubtful",
    /// The recording system has taken the bias off.
    BiasRemovedBefore = "bias_removed_before",
    /// A recording repeats another.
    SameData = "same_data",
    /// The readings are cut off towards zero.
    CutTowardsZero = "cut_towards_zero",
    /// The readings of a sensor still change after each turn.
    SettlesAfterTurns = "settles_after_turns",
    /// The placements cannot show whether a sensor is linear.
    LinearityUntested = "linearity_untested",
    /// A sensor differs from recording to recording.
    RecordingsDiffer = "recordings_differ",
    /// A sensor differs from one part of a recording to another.
    PartsDiffer = "parts_differ",
    /// There is no gyroscope.
    NoGyroscope = "no_gyroscope",
    /// There is no accelerometer.
    NoAccelerometer = "no_accelerometer",
    /// A recording lacks a sensor.
    SensorMissing = "sensor_missing",
    /// The device is not of the type of the prior.
    NotOfType = "not_of_type",
    /// The biases of the recordings of a calibration differ.
    BiasesDiffer = "biases_differ",
    /// An effect of the user gives no number.
    EffectFault = "effect_fault",
    /// A limit is not kept.
    LimitNotKept = "limit_not_kept",
    /// A sensor that the limits require is not calibrated.
    RequiredMissing = "required_missing",
    /// A sensor is not calibrated.
    NotCalibrated = "not_calibrated",
    /// A time constant was supposed and not fitted.
    TimeConstantSupposed = "time_constant_supposed",
    /// The temperature changes, and the model has no effect of it.
    TemperatureChanged = "temperature_changed",
    /// Some recordings have no temperature.
    TemperatureUnknown = "temperature_unknown",
    /// A sensor that is not calibrated is left as it was read.
    LeftAsRead = "left_as_read",
    /// An axis reads nothing but noise while the others turn.
    AxisOnlyNoise = "axis_only_noise",
    /// The bias of a sensor moved during the recording.
    BiasMoved = "bias_moved",
    /// The bias of a sensor wandered during the recording.
    BiasWandered = "bias_wandered",
    /// The bias wanders by less than a corrected reading shows.
    BiasUnsteady = "bias_unsteady",
    /// Static intervals in a part of the recording fit another accelerometer.
    OfAnotherAccelerometer = "of_another_accelerometer",
    /// A recording that the fit did not see disagrees with the calibration, whatever its biases are.
    ValidationDisagrees = "validation_disagrees",
    /// A sensor of one dimension that is not calibrated is left as it was read.
    ScalarLeftAsRead = "scalar_left_as_read",
    /// Only the bias of a sensor is known.
    BiasAlone = "bias_alone",
    /// The calibration is for readings of which axes were flipped.
    ForFlippedAxes = "for_flipped_axes",
    // Clocks that no choice makes right, and of sampling.
    /// Stamps scatter so much that lost samples cannot be counted.
    ClockUncountable = "clock_uncountable",
    /// No clock says when the gyroscope was sampled.
    ClockUnknown = "clock_unknown",
    /// Samples come in bursts with the stamps of their reading.
    StampsInBursts = "stamps_in_bursts",
    /// The clocks of two sensors are apart.
    ClockOffset = "clock_offset",
    /// The clocks of two sensors run at different rates.
    ClockDrift = "clock_drift",
    /// The rate is higher than any turn needs.
    SampledFast = "sampled_fast",
    /// Turns are too fast for the sampling rate.
    TurnsTooFast = "turns_too_fast",
    // What changes part of the way through a recording.
    /// A bias steps part of the way.
    BiasStep = "bias_step",
    /// A scale factor changes part of the way.
    ScaleChange = "scale_change",
    /// The axes turn part of the way.
    AxesTurnPartWay = "axes_turn_part_way",
    /// An axis changes its sign part of the way.
    SignChange = "sign_change",
    /// Two columns change places part of the way.
    ColumnsSwapPartWay = "columns_swap_part_way",
    /// A turn misses gravity where all others meet it.
    TurnOff = "turn_off",
    /// One static interval lies off the direction that the turns carry.
    IntervalOff = "interval_off",
    // The magnetometer and its field.
    /// The magnetic field is off in a static interval.
    FieldDisturbed = "field_disturbed",
    /// The magnetic field differs from place to place.
    FieldUneven = "field_uneven",
    /// The magnetic field differs a little from place to place.
    FieldLittleUneven = "field_little_uneven",
    /// The magnetometer's bias steps part of the way.
    MagneticBiasStepped = "magnetic_bias_stepped",
    /// The magnetic field around the device steps part of the way.
    FieldStepped = "field_stepped",
    /// The magnetometer has an effect that its model lacks.
    MagneticEffect = "magnetic_effect",
    /// Magnetometer and gyroscope disagree about the heading.
    HeadingDisagrees = "heading_disagrees",
    /// The magnetometer is not calibrated.
    MagnetometerNotCalibrated = "magnetometer_not_calibrated",
    /// Signs of the magnetometer's axes are wrong by the latitude.
    FieldSignsWrong = "field_signs_wrong",
    /// The axes of the magnetometer are turned or mirrored.
    FieldTurned = "field_turned",
    /// The unit of the magnetometer is known on one side only.
    UnitUnclear = "magnetometer_unit_unclear",
    // Units, ranges and axes that the fit shows.
    /// One axis reads in another unit or range.
    AxisUnit = "axis_unit",
    /// An axis reads more or less than the others of its sensor, by a factor that no unit or range explains.
    AxisApart = "axis_apart",
    /// Raw counts per unit differ from axis to axis.
    CountsDiffer = "counts_differ",
    /// All axes read too much or too little.
    ScaleOff = "scale_off",
    /// The zero of an axis lies where no sensor has it.
    ZeroOff = "zero_off",
    /// Readings look like units of g.
    ReadingsInG = "readings_in_g",
    /// Readings are raw counts.
    RawCounts = "raw_counts",
    /// The gyroscope misses gravity after the fit.
    GravityMissed = "gravity_missed",
    /// The turns do not show the axes of the gyroscope.
    AxesNotShown = "axes_not_shown",
    /// The axes of the gyroscope are left-handed.
    LeftHanded = "left_handed",
    /// The axes of the gyroscope are turned against the accelerometer.
    AxesTurned = "axes_turned",
    /// The scale of the gyroscope is off on all axes.
    GyroscopeScaleOff = "gyroscope_scale_off",
    /// The gyroscope's scale is that of stamps which count 1/1024 s.
    ClockOfTicks = "clock_of_ticks",
    /// The unit of the gyroscope looks like another one.
    ReadingsInDegrees = "readings_in_degrees",
    // Names, faults and remainders of a search for what is missing.
    /// The base models lack effects that the search names.
    EffectNamed = "effect_named",
    /// Turns miss something because the rate jumps between samples.
    UndersampledMotion = "undersampled_motion",
    /// The stamps of one recording are late in a way of their own.
    StampsApart = "stamps_apart",
    /// Samples are missing in one place.
    SamplesMissing = "samples_missing",
    /// A turn misses gravity where samples are lost.
    TurnWithoutSamples = "turn_without_samples",
    /// Readings stand at the end of the range in a turn or a static interval.
    RangeReached = "range_reached",
    /// The residual has a fine pattern over orientation.
    FineOrientation = "fine_orientation",
    /// The residual changes slowly over time.
    SlowChange = "slow_change",
    /// The residual is periodic in time.
    PeriodicInTime = "periodic_in_time",
    /// The residual is fixed to a horizontal direction of the room.
    RoomDirection = "room_direction",
    /// The residual is fixed to a horizontal direction of the room, as the earth's rotation is near the equator.
    RoomOrEarth = "room_or_earth",
    /// The residual relaxes after each turn.
    RelaxationAfterTurn = "relaxation_after_turn",
    /// The residual is proportional to products of the rates of two axes.
    RateProducts = "rate_products",
    /// A bias moves in one recording of several.
    BiasMoves = "bias_moves",
    /// A bias jumps to and fro between two levels.
    BiasTwoLevels = "bias_two_levels",
    /// A bias differs from static interval to static interval.
    BiasScatters = "bias_scatters",
    /// A bias wanders with a memory.
    BiasWanders = "bias_wanders",
    /// There is more scatter than the noise explains.
    MoreScatter = "more_scatter",
    /// Readings drift within static intervals.
    DriftAtRest = "drift_at_rest",
    /// The search ended before it was through.
    SearchCutShort = "search_cut_short",
    // Errors of a search, and what no recording shows.
    /// The recording lacks an accelerometer.
    AccelerometerNeeded = "accelerometer_needed",
    /// Static intervals are too few for a search.
    TooFewForSearch = "too_few_for_search",
    /// The base models use up all readings.
    NothingToCompare = "nothing_to_compare",
    /// No effects are tied.
    NothingTied = "nothing_tied",
    /// There are no placements to plan with.
    NoPlacements = "no_placements",
    /// One unit was given where several are needed.
    OneUnitOnly = "one_unit_only",
    /// An effect looks at more than one reading tells.
    WholeRecordingNeeded = "whole_recording_needed",
    /// The noise file lacks a sensor.
    NoiseOfOneSensor = "noise_of_one_sensor",
    /// The noise file does not bound a random walk.
    WalkUnbounded = "walk_unbounded",
    /// The noise file has a random walk that no sensor has.
    WalkImpossible = "walk_impossible",
    /// The noise file only bounds a random walk.
    WalkOnlyBounded = "walk_only_bounded",
    /// The file is no noise file.
    NotANoiseFile = "not_a_noise_file",
    /// The file has another schema than is expected.
    OtherSchema = "other_schema",
    /// Local gravity cannot be told from a common scale.
    GravityNeverSeen = "gravity_never_seen",
    /// The rate of a clock cannot be told from a common scale.
    ClockNeverSeen = "clock_never_seen",
    /// The distance between the accelerometer's axes never shows.
    DistanceNeverSeen = "distance_never_seen",
    /// A delay common to the gyroscope's axes never shows.
    DelayNeverSeen = "delay_never_seen",
    /// Isotropic g-sensitivity cannot be told from the earth's rate.
    EarthNeverSeen = "earth_never_seen",
    // Errors: files of any format (crates formats, output, exchange, live, batch).
    /// A file cannot be read.
    Unreadable = "unreadable",
    /// A file cannot be written.
    Unwritable = "unwritable",
    // Errors of files: limits on how much is read.
    /// The system stopped the reading of a file.
    ReadingStopped = "reading_stopped",
    /// A reader gave up at damage that it does not understand.
    ReaderGaveUp = "reader_gave_up",
    /// A piece of a file announces more bytes than any recording has.
    PieceTooLong = "piece_too_long",
    /// A folder or a file has more entries than any recording.
    EntriesTooMany = "entries_too_many",
    /// Something unpacks to more bytes than are read.
    UnpacksTooLarge = "unpacks_too_large",
    /// Something unpacks to more times its size than any recording.
    UnpacksTooMuch = "unpacks_too_much",
    /// A content that is held as a whole is too large.
    ContentTooLarge = "content_too_large",
    /// A stream has more samples than are read.
    SamplesTooMany = "samples_too_many",
    /// A table has more rows than are read.
    TableTooLong = "table_too_long",
    /// A table announces more cells than its file can hold.
    CellsTooMany = "cells_too_many",
    // Errors of files: damage that every format can have.
    /// A part of a file is damaged.
    PartDamaged = "part_damaged",
    /// A part of a file ends too early.
    PartCut = "part_cut",
    /// A packed part of a file cannot be unpacked.
    PartUnpacksNot = "part_unpacks_not",
    /// A part of a file has another length than is stated.
    LengthContradicted = "length_contradicted",
    /// A part of a file unpacks to another length than is stated.
    UnpackedLength = "unpacked_length",
    /// The check sum of a part of a file is wrong.
    CheckSumWrong = "check_sum_wrong",
    /// A part of a file ends within a record.
    EndsWithinRecord = "ends_within_record",
    /// Values within values are deeper than any recording's.
    NestedTooDeep = "nested_too_deep",
    /// The parser of a format refuses a file.
    FormatUnreadable = "format_unreadable",
    /// The writer of a format refuses a recording.
    FormatUnwritable = "format_unwritable",
    /// Columns of one table differ in length.
    ColumnsUnequal = "columns_unequal",
    /// A file is compressed in a way that is not read.
    CompressionUnknown = "compression_unknown",
    // Errors of files: zip archives.
    /// The directory of a zip archive is damaged.
    ZipDirectoryDamaged = "zip_directory_damaged",
    /// A zip archive ends without its directory.
    ZipDirectoryMissing = "zip_directory_missing",
    /// An entry of a zip archive is encrypted.
    ZipEncrypted = "zip_encrypted",
    /// An entry of a zip archive reaches beyond its end.
    ZipEntryBeyond = "zip_entry_beyond",
    /// Entries of a zip archive overlap.
    ZipEntriesOverlap = "zip_entries_overlap",
    /// A zip archive has no entry at the place that its directory names.
    ZipEntryMissing = "zip_entry_missing",
    /// An entry of a zip archive is packed in a way that is not read.
    ZipMethodUnknown = "zip_method_unknown",
    /// An entry of a zip archive is cut short.
    ZipEntryCut = "zip_entry_cut",
    /// An entry is not of the archive that is asked for it.
    EntryElsewhere = "entry_elsewhere",
    // Errors of files: logs of flight controllers and robots, and MATLAB files.
    /// A blackbox of Betaflight is not decoded.
    BlackboxNotDecoded = "blackbox_not_decoded",
    /// A log has a message of a kind that the format does not have.
    MessageKindUnknown = "message_kind_unknown",
    /// A message of ROS 2 is big-endian.
    MessageBigEndian = "message_big_endian",
    /// A message of ROS 2 is compressed by itself.
    MessageCompressed = "message_compressed",
    /// A message of ROS 2 is in an encoding that is not read.
    EncapsulationUnknown = "encapsulation_unknown",
    /// A database states pages of an impossible size.
    PageSizeWrong = "page_size_wrong",
    /// A page of a database is missing.
    PageMissing = "page_missing",
    /// A page of a database is damaged.
    PageDamaged = "page_damaged",
    /// The pages of a database form a circle.
    PagesInCircle = "pages_in_circle",
    /// A database is no bag of ROS 2.
    NoBagTables = "no_bag_tables",
    /// A MATLAB file was written by a big-endian machine.
    MatlabBigEndian = "matlab_big_endian",
    /// A MATLAB file has something else where a matrix is expected.
    ElementUnexpected = "element_unexpected",
    /// A timetable stands before the variable that it belongs to.
    TimetableTooEarly = "timetable_too_early",
    /// The row times of a timetable are of an unknown kind.
    RowTimesUnknown = "row_times_unknown",
    /// A variable named after a sensor is an object that is not read.
    ObjectNotRead = "object_not_read",
    /// The only accelerometer of Sensor Logger is without gravity.
    LoggerWithoutGravity = "logger_without_gravity",
    // Errors of files: files of tables.
    /// This build does not read the format.
    NotInBuild = "not_in_build",
    /// This build does not write the format.
    NotWrittenByBuild = "not_written_by_build",
    /// A text is no JSON from a place on.
    JsonDamaged = "json_damaged",
    /// A JSON file has no list of records or of numbers.
    JsonWithoutTable = "json_without_table",
    /// Records of a JSON file hold lists.
    ListsInRecords = "lists_in_records",
    /// A value of a JSON file is too long.
    ValueTooLong = "value_too_long",
    /// A name is longer than any column's.
    NameTooLong = "name_too_long",
    /// The records of a JSON file have too many names.
    NamesTooMany = "names_too_many",
    /// Some records of a JSON file have names and others have none.
    NamesMixed = "names_mixed",
    /// A table is no longer in the file.
    TableGone = "table_gone",
    /// A file has more rows than it announces.
    RowsBeyondClaim = "rows_beyond_claim",
    /// The columns of a file are longer than the file.
    ColumnsBeyondFile = "columns_beyond_file",
    /// Columns are compressed in a way that this build does not unpack.
    ColumnCompressed = "column_compressed",
    /// The cells of a column are lists.
    CellsAreLists = "cells_are_lists",
    /// The numbers of a column are of a type that is not read.
    NumberTypeUnread = "number_type_unread",
    /// A page holds texts as differences.
    TextsAsDifferences = "texts_as_differences",
    /// An HDF5 file has no dataset of numbers.
    NoDataset = "no_dataset",
    /// A dataset has a shape that is not read.
    DatasetShape = "dataset_shape",
    /// A dataset gives another number of numbers than it states.
    DatasetLength = "dataset_length",
    /// A workbook has no sheet of cells.
    NoSheet = "no_sheet",
    /// A workbook announces more words than it has bytes.
    WordsTooMany = "words_too_many",
    /// A cell of a workbook stands where no cell can be.
    CellImpossible = "cell_impossible",
    /// A cell of a workbook is there twice.
    CellTwice = "cell_twice",
    /// A cell of a workbook is a date among numbers.
    CellIsDate = "cell_is_date",
    // Errors of files: files that are written.
    /// An output is an input or a file of one.
    OutputIsInput = "output_is_input",
    /// A name is given for two outputs.
    OutputTwice = "output_twice",
    /// An output is there already.
    OutputExists = "output_exists",
    /// An output was written by something else meanwhile.
    OutputAppeared = "output_appeared",
    /// An output is a pipe, a device or a folder.
    OutputNoFile = "output_no_file",
    /// An output is write-protected.
    OutputProtected = "output_protected",
    /// The name of an output is that of a folder.
    OutputIsFolder = "output_is_folder",
    /// The name of an output has no last part.
    OutputNameless = "output_nameless",
    /// An output is a link to nothing.
    OutputDangling = "output_dangling",
    /// A link stands where a folder is expected.
    OutputLinked = "output_linked",
    /// Another run writes an output.
    OutputHeld = "output_held",
    /// A folder cannot be made.
    FolderRefused = "folder_refused",
    // Errors of files: calibrations that another tool cannot hold.
    /// A target wants a sensor that is not calibrated.
    SensorLacking = "sensor_lacking",
    /// A target corrects readings in another unit.
    ExportUnit = "export_unit",
    /// A parameter lies beyond those that a target takes.
    ParameterOutside = "parameter_outside",
    /// A target wants right-handed axes.
    ExportLeftHanded = "export_left_handed",
    /// A target keeps no sign of an axis.
    SignNotKept = "sign_not_kept",
    /// Parameters in force would be replaced, and are not given.
    CorrectedInForce = "corrected_in_force",
    /// Some recordings of a calibration were corrected before, and others were not.
    CorrectedPartly = "corrected_partly",
    /// Parameters in force were taken off already.
    CorrectionTakenOff = "correction_taken_off",
    /// A parameter in force turns the readings.
    ReadingsTurned = "readings_turned",
    /// A parameter is not among those in force.
    ParameterMissing = "parameter_missing",
    /// A line of the parameters in force is none.
    ParameterLine = "parameter_line",
    /// A target has no parameters for the sensor.
    InstanceBeyond = "instance_beyond",
    /// A scale factor is zero.
    ScaleZero = "scale_zero",
    /// A scale factor does not fit the integers of a target.
    ScaleBeyondIntegers = "scale_beyond_integers",
    /// A calibration is too large for an archive.
    ArchiveTooLarge = "archive_too_large",
    /// A file of several is missing.
    PieceMissing = "piece_missing",
    // Errors of files: calibrations of other tools that are not read.
    /// A file is too large for a calibration.
    ImportTooLarge = "import_too_large",
    /// A text is no YAML from a place on.
    NoYaml = "no_yaml",
    /// A calibration of another tool is empty.
    ImportEmpty = "import_empty",
    /// A file of Kalibr states no sensors.
    NoSensorsStated = "no_sensors_stated",
    /// A file of Kalibr has no keys and values.
    NoEntries = "no_entries",
    /// A model of Kalibr is not known.
    ModelUnknown = "model_unknown",
    /// A matrix that should be a rotation is none.
    NoRotation = "no_rotation",
    /// An entry is no matrix of three rows.
    MatrixExpected = "matrix_expected",
    /// An entry is no vector.
    VectorExpected = "vector_expected",
    /// A file of Kalibr lacks an entry of its model.
    EntryMissing = "entry_missing",
    /// A matrix of another tool has no inverse.
    EntrySingular = "entry_singular",
    /// A text of imu_tk has a word that is no number.
    MatrixNumberExpected = "matrix_number_expected",
    /// A text of imu_tk has too few numbers or too many.
    NumbersCount = "numbers_count",
    // Errors of files: sources of a guided session.
    /// A source is neither an address nor a file.
    SourceUnknown = "source_unknown",
    /// A phone does not answer.
    PhoneLost = "phone_lost",
    /// The measurement of a phone begins again and again.
    PhoneRestless = "phone_restless",
    /// A source sends a line without an end.
    LineWithoutEnd = "line_without_end",
    /// A source sends more text than a session has.
    TextTooLong = "text_too_long",
    /// A phone sends more samples than a session has.
    SessionTooLong = "session_too_long",
    /// An address answers that is not phyphox.
    NotPhyphox = "not_phyphox",
    /// The experiment on a phone lacks a sensor.
    PhoneWithoutSensor = "phone_without_sensor",
    /// A file of a session cannot be read or written.
    SessionFile = "session_file",
    /// A request to a phone has failed.
    RequestFailed = "request_failed",
    /// The answer of a phone has no samples.
    AnswerWithoutSamples = "answer_without_samples",
    /// A phone states a time that no session lasts.
    TimeImpossible = "time_impossible",
    /// A phone states a reading that no sensor has.
    ReadingImpossible = "reading_impossible",
    /// The exported file of a phone lacks a sensor.
    ExportLacksSamples = "export_lacks_samples",
    /// The exported file of a phone is of another session.
    ExportOfOther = "export_of_other",
    // Errors of files: batches of devices.
    /// A manifest cannot be understood from a line on.
    ManifestDamaged = "manifest_damaged",
    /// A cell of a manifest holds something else.
    CellUnexpected = "cell_unexpected",
    /// A manifest has a column that is not known.
    ColumnUnknown = "column_unknown",
    /// A device of a manifest has no inputs.
    InputsMissing = "inputs_missing",
    /// Two devices have one name.
    DeviceTwice = "device_twice",
    /// No device is in a folder or manifest.
    NoDevice = "no_device",
    /// A manifest names a method that is not known.
    DeviceMethod = "device_method",
    /// A manifest names an effect that is not known.
    DeviceEffect = "device_effect",
    /// A manifest names a unit that is not known.
    DeviceUnit = "device_unit",
    /// Folders of a device are too deep.
    FoldersTooDeep = "folders_too_deep",
    /// An input is neither a file nor a folder.
    NoFileOrFolder = "no_file_or_folder",
    /// A file is no part of a batch.
    NoBatchPart = "no_batch_part",
    /// A part of a batch has no end.
    PartIncomplete = "part_incomplete",
    /// A part of a batch has another hash.
    PartChanged = "part_changed",
    /// A part of a batch is of another version.
    PartOfOtherVersion = "part_of_other_version",
    /// A part is of another run.
    PartForeign = "part_foreign",
    /// A part of a batch is missing.
    BatchPartMissing = "batch_part_missing",
    /// A device is in no part of a batch.
    DeviceInNoPart = "device_in_no_part",
    /// The parts of a batch make no whole.
    PartsIncomplete = "parts_incomplete",
    /// There are no parts of a batch.
    NoParts = "no_parts",
    /// Too few devices have the parameters in common.
    DevicesTooFew = "devices_too_few",
    /// A part of the work is misspelt.
    ShardWrong = "shard_wrong",
    /// No thread can be started.
    NoThread = "no_thread",
    /// The program has a bug.
    BugOfOurs = "bug_of_ours",
    /// A device took longer than it may.
    OverBudget = "over_budget",
    // Remarks on calibrations for other tools.
    /// The frame of Kalibr is turned against that of the calibration.
    FrameTurned = "frame_turned",
    /// A file of Kalibr names no topic.
    TopicToAdd = "topic_to_add",
    /// Noise densities that Kalibr wants are not known.
    DensitiesUnknown = "densities_unknown",
    /// A flight controller measures the gyroscope's offsets at every start.
    OffsetsMeasuredAgain = "offsets_measured_again",
    /// A node takes the gyroscope's bias from its first samples.
    BiasFromStart = "bias_from_start",
    /// A recording may be of readings that a flight controller has corrected.
    MaybeCorrected = "maybe_corrected",
    /// PX4 uses parameters of a sensor by its id.
    SensorsByIds = "sensors_by_ids",
    /// Parameters are on top of an earlier correction.
    OnTopOf = "on_top_of",
    /// The functions of a module leave a part out.
    NotApplied = "not_applied",
    /// A target does not hold a part of a calibration.
    LostInExport = "lost_in_export",
    // Errors: text, columns, time and intervals of a recording (crate recording).
    /// A file is not there.
    FileMissing = "file_missing",
    /// A link leads to nothing.
    LinkToNothing = "link_to_nothing",
    /// A file is empty.
    EmptyFile = "empty_file",
    /// Nothing came on standard input.
    EmptyInput = "empty_input",
    /// Standard input is a terminal.
    InputIsTerminal = "input_is_terminal",
    /// A file is larger than the limit.
    FileTooLarge = "file_too_large",
    /// A text goes on beyond the limit.
    TooManyBytes = "too_many_bytes",
    /// Several files are where one table was expected.
    SeveralFiles = "several_files",
    /// Something else is where a text was expected.
    NoText = "no_text",
    /// A file is of no known format.
    UnknownFormat = "unknown_format",
    /// A format does not exist.
    NoFormat = "no_format",
    /// A file is not what the chosen format reads.
    OtherFormat = "other_format",
    /// A file changed while it was read.
    FileChanged = "file_changed",
    /// A stream that went by would have to be read again.
    ReadTwice = "read_twice",
    /// A folder is where a file was expected.
    FolderAsFile = "folder_as_file",
    /// A small text file is too large to be one.
    TextTooLarge = "text_too_large",
    /// A text is no UTF-8.
    NotUtf8 = "not_utf8",
    /// A text holds bytes that no text has.
    BinaryData = "binary_data",
    /// A line is too long for a recording.
    LineTooLong = "line_too_long",
    /// A text begins with nothing but comments.
    OnlyComments = "only_comments",
    /// A text has nothing but blank and comment lines.
    NoData = "no_data",
    /// A text has no rows.
    NoRows = "no_rows",
    /// A text has more rows than the limit.
    TooManyRows = "too_many_rows",
    /// Rows need more memory than the system grants.
    TooLargeForMemory = "too_large_for_memory",
    /// The memory is used up.
    OutOfMemory = "out_of_memory",
    /// A file is packed.
    PackedFile = "packed_file",
    /// A zip archive or workbook lies within a recording.
    ZipWithin = "zip_within",
    /// A file is an old document of an office.
    OldOffice = "old_office",
    /// A file is a document of this program.
    OwnDocument = "own_document",
    /// A file is of a format that is not read.
    ForeignFile = "foreign_file",
    /// A MATLAB file is of version 4.
    OldMatlab = "old_matlab",
    /// A file is a pointer of git-lfs.
    GitPointer = "git_pointer",
    /// A file is a page of the web.
    HtmlPage = "html_page",
    /// A file is a Blackbox log.
    BlackboxLog = "blackbox_log",
    /// A header stands in a text again.
    HeaderAgain = "header_again",
    /// The names of a sensor's axes state different units.
    AxesInUnits = "axes_in_units",
    /// A header of other columns stands in a text.
    OtherHeader = "other_header",
    /// A row has no reading.
    RowEmpty = "row_empty",
    /// A row has more or fewer cells than the others.
    RowRagged = "row_ragged",
    /// A row ends before a column that is read.
    RowShort = "row_short",
    /// A cell goes on in the next line.
    QuoteOverLines = "quote_over_lines",
    /// A quote is never closed.
    QuoteOpen = "quote_open",
    /// A text ends within a number.
    NumberCut = "number_cut",
    /// A cell has no number.
    NumberMissing = "number_missing",
    /// A number is not finite.
    NumberNotFinite = "number_not_finite",
    /// A number has separators of thousands.
    ThousandsSeparators = "thousands_separators",
    /// Points or commas separate thousands, and were read as decimal marks.
    ThousandsByPoints = "thousands_by_points",
    /// A number has a unit behind it that is not the column's.
    UnitOfCell = "unit_of_cell",
    /// Numbers have lost their decimal points.
    PointsLost = "points_lost",
    /// A number has a comma in a file of points.
    DecimalComma = "decimal_comma",
    /// A number is hexadecimal.
    Hexadecimal = "hexadecimal",
    /// A number is too large for any sensor and clock.
    NumberAbsurd = "number_absurd",
    /// A date is not ISO 8601.
    DateUnknown = "date_unknown",
    /// A date is not of the pattern that was given.
    DateOther = "date_other",
    /// A date is a month behind the one before it, and a day by the other order of day and month.
    DateOtherOrder = "date_other_order",
    /// A cell is not a number.
    NotANumber = "not_a_number",
    /// A cell of a small table is not a number.
    NumberExpected = "number_expected",
    /// A record of a log holds a number that is not finite.
    RecordNotFinite = "record_not_finite",
    /// A sensor lacks columns.
    ColumnMissing = "column_missing",
    /// The columns of a magnetometer in a file of its own are not known.
    FieldColumnsUnknown = "field_columns_unknown",
    /// No columns are a sensor's.
    NoSensorColumns = "no_sensor_columns",
    /// Two columns have one role.
    ColumnsAlike = "columns_alike",
    /// One column was given for two roles.
    ColumnForTwo = "column_for_two",
    /// A column that was given is not there.
    NoSuchColumn = "no_such_column",
    /// No sensor is known by name, and columns may be one.
    ColumnsUnclear = "columns_unclear",
    /// One sensor is not known by name, and columns may be it.
    SensorUnclear = "sensor_unclear",
    /// A table holds a sensor twice.
    SensorTwice = "sensor_twice",
    /// The only accelerometer of a table lacks gravity.
    ColumnsWithoutGravity = "columns_without_gravity",
    /// A row of units holds an unknown one.
    UnitRowUnknown = "unit_row_unknown",
    /// A row of units contradicts the header or itself.
    UnitRowContradicts = "unit_row_contradicts",
    /// A comma is separator and decimal mark.
    CommaTwice = "comma_twice",
    /// The header has another width than the rows.
    HeaderWidth = "header_width",
    /// Columns have no names, and gravity does not tell them.
    NoHeader = "no_header",
    /// Columns have no names, and rest as those of a gyroscope.
    NoHeaderNoForce = "no_header_no_force",
    /// Columns have no names, and one may be a temperature.
    NoHeaderSlow = "no_header_slow",
    /// Columns have no names, and nothing tells them apart.
    NoHeaderUndecided = "no_header_undecided",
    /// A file lacks the sensor that it was named for.
    OtherSensor = "other_sensor",
    /// A recording has a temperature and no sensor.
    OnlyTemperature = "only_temperature",
    /// An entry is no role with its column.
    ColumnEntry = "column_entry",
    /// A role does not exist.
    ColumnRole = "column_role",
    /// A role was given twice.
    ColumnTwice = "column_twice",
    /// A role was given without a column.
    ColumnUnnamed = "column_unnamed",
    /// A table has no static means.
    NoStaticMeans = "no_static_means",
    /// A table of static means has other columns.
    StaticMeansColumns = "static_means_columns",
    /// A table of static means has more or fewer columns.
    StaticMeansWidth = "static_means_width",
    /// A table has no time.
    NoTime = "no_time",
    /// Rows of a program have no time.
    RowsWithoutTime = "rows_without_time",
    /// An expression is made of dates.
    ExpressionOfDates = "expression_of_dates",
    /// An expression lets time stand still.
    ExpressionBackwards = "expression_backwards",
    /// An expression gives a time in an impossible unit.
    ExpressionUnit = "expression_unit",
    /// The file states an impossible unit of the time.
    TimeUnitStated = "time_unit_stated",
    /// The unit of the stamps is not known.
    TimeUnitOpen = "time_unit_open",
    /// In the unit that the rate tells no hand would have turned the device.
    TimeUnitTooFast = "time_unit_too_fast",
    /// Stamps go up by one and tell no unit.
    StampsByOne = "stamps_by_one",
    /// All stamps are the same.
    StampsAllEqual = "stamps_all_equal",
    /// Most rows share their stamp with another.
    StampsTooCoarse = "stamps_too_coarse",
    /// Stamps are too large for a double in seconds.
    StampsTooLarge = "stamps_too_large",
    /// Time goes back.
    TimeGoesBack = "time_goes_back",
    /// The clock of one sensor begins again and that of the other does not.
    ClocksRestartApart = "clocks_restart_apart",
    /// A file holds several recordings, and one has to be chosen.
    PartOpen = "part_open",
    /// A part is asked for of a file with one recording.
    PartMissing = "part_missing",
    /// Two sensors were never on together.
    NeverOverlap = "never_overlap",
    /// Gravity and the acceleration without it have other stamps.
    SumOfOtherStamps = "sum_of_other_stamps",
    /// A sampling rate is impossible.
    RateImpossible = "rate_impossible",
    /// A unit is not known.
    UnitUnknown = "unit_unknown",
    /// Gravity has the size of no unit.
    GravityOfNoUnit = "gravity_of_no_unit",
    /// The file states a unit that is not known.
    UnitStrange = "unit_strange",
    /// The accelerometer lacks gravity.
    GravityRemoved = "gravity_removed",
    /// Forces are given in axes of the room.
    AxesOfTheRoom = "axes_of_the_room",
    /// Angles stand in the columns of the rates.
    AnglesForRates = "angles_for_rates",
    /// The accelerometer was normalised to a direction.
    Normalised = "normalised",
    /// Gravity has the size of another unit.
    GravityInOtherUnit = "gravity_in_other_unit",
    /// Gravity has the size of no unit, and one was stated.
    GravityOff = "gravity_off",
    /// The gyroscope turns too fast for the stated unit.
    TurnsImpossible = "turns_impossible",
    /// Turns have the size of another unit.
    TurnsInOtherUnit = "turns_in_other_unit",
    /// Nothing tells the gyroscope's unit, and that of the calibration's recording was none that can be assumed.
    UnitUntold = "unit_untold",
    /// Turns have the size of no unit.
    TurnsOff = "turns_off",
    /// A gyroscope at rest reads what none reads in its unit.
    RestlessRest = "restless_rest",
    /// The sensors have each other's names.
    SensorsSwapped = "sensors_swapped",
    /// Readings under the names of a gyroscope are those of an accelerometer.
    ForceAsRate = "force_as_rate",
    /// The gyroscope's unit changes within a file.
    RateUnitChanges = "rate_unit_changes",
    /// Axes repeat another one.
    AxisRepeated = "axis_repeated",
    /// An axis never changes.
    AxisConstant = "axis_constant",
    /// An axis stops to change.
    AxisStuck = "axis_stuck",
    /// Readings are too small for any unit.
    ReadingsTiny = "readings_tiny",
    /// The unit changes part of the way.
    UnitChanges = "unit_changes",
    /// The norm of gravity changes part of the way.
    NormChanges = "norm_changes",
    /// Readings overflow 16 bits.
    Overflow = "overflow",
    /// Readings of 16 bits lost their sign.
    SignLost = "sign_lost",
    /// A sensor stops to read while the other goes on.
    SensorStopped = "sensor_stopped",
    /// Rows of one stamp are as far apart as those of several devices.
    RowsOfDevices = "rows_of_devices",
    /// Rows of several devices stand by turns.
    DevicesByTurns = "devices_by_turns",
    /// A table holds rows of several devices.
    DevicesInTable = "devices_in_table",
    /// A device that is asked for has no rows.
    DeviceMissing = "device_missing",
    /// A device is asked for, and no column tells devices apart.
    DeviceNotTold = "device_not_told",
    /// Arrays differ in length.
    ArrayLengths = "array_lengths",
    /// No array of a sensor has rows.
    ArraysEmpty = "arrays_empty",
    /// An array holds a number that is not finite.
    ArrayNotFinite = "array_not_finite",
    /// There is one sample.
    OneSample = "one_sample",
    /// A sensor is missing, and a table beside may hold it.
    SensorUnused = "sensor_unused",
    /// A folder or archive lacks a file.
    NoEntry = "no_entry",
    /// A folder or archive holds no recording.
    NoRecordingInFolder = "no_recording_in_folder",
    /// A folder or archive holds several recordings.
    EntryOpen = "entry_open",
    /// Two files are of one sensor.
    FilesOfOneSensor = "files_of_one_sensor",
    /// A file within was asked for of one file.
    EntryOfOneFile = "entry_of_one_file",
    /// A topic was asked for of a text.
    TopicOfText = "topic_of_text",
    /// Columns were given for a log.
    ColumnsOfLog = "columns_of_log",
    /// A sensor of a log was not given by its number.
    InstanceNotNumber = "instance_not_number",
    /// phyphox has taken gravity off.
    PhyphoxLinear = "phyphox_linear",
    /// An export of phyphox has no sensor.
    PhyphoxEmpty = "phyphox_empty",
    /// Sensor Logger has taken gravity off.
    SensorLoggerLinear = "sensor_logger_linear",
    /// A log holds no sensor.
    LogWithoutSensor = "log_without_sensor",
    /// A log may hold a sensor under another name.
    LogSensorUnclear = "log_sensor_unclear",
    /// A log holds several sensors of a kind.
    LogSensorsOpen = "log_sensors_open",
    /// A sensor is logged too slowly.
    LoggedSlowly = "logged_slowly",
    /// A sensor has no samples.
    NoSamples = "no_samples",
    /// A recording is shorter than the detector's window.
    TooShort = "too_short",
    /// Samples are too few for the detector.
    SampledSlowly = "sampled_slowly",
    /// A table of static intervals has other columns.
    SectionsColumns = "sections_columns",
    /// A table of static intervals cannot be read.
    SectionsUnreadable = "sections_unreadable",
    /// A static interval lies outside the recording.
    SamplesOutside = "samples_outside",
    /// A static interval is empty.
    IntervalEmpty = "interval_empty",
    /// A static interval begins before the end of the one above.
    IntervalsOverlap = "intervals_overlap",
    /// A table has no static interval for a recording.
    NoIntervals = "no_intervals",
    /// An instant that is left out lies within no static interval.
    NoIntervalThere = "no_interval_there",
    /// The device turned at a constant rate in a quiet stretch.
    StretchTurns = "stretch_turns",
    /// The accelerometer is cut off in a quiet stretch.
    StretchClipped = "stretch_clipped",
    /// The device tilts steadily in a quiet stretch.
    StretchTilts = "stretch_tilts",
    /// The device vibrates in a quiet stretch.
    StretchVibrates = "stretch_vibrates",
    /// A sensor has no samples in a quiet stretch.
    StretchEmpty = "stretch_empty",
    /// Samples are missing in a turn.
    TurnGap = "turn_gap",
    /// The gyroscope repeats one reading in a turn.
    TurnFrozen = "turn_frozen",
    /// The gyroscope is saturated in a turn.
    TurnSaturated = "turn_saturated",
    /// A turn has no samples.
    TurnEmpty = "turn_empty",
    // Errors: requests, models, calibrations and fits (crates sensor, effects, simulate, noise, estimate, discover, plan).
    /// An effect looks at a sensor that was not recorded.
    EffectNeedsSensor = "effect_needs_sensor",
    /// An effect looks at a sensor whose errors are not known.
    EffectNeedsErrors = "effect_needs_errors",
    /// An effect of another sensor looks at the magnetic field.
    EffectNeedsField = "effect_needs_field",
    /// An effect looks at the temperature, and none was recorded.
    EffectNeedsTemperature = "effect_needs_temperature",
    /// An effect looks at what static intervals tell, and there are too few.
    EffectNeedsRests = "effect_needs_rests",
    /// An effect looks at more than a file of means has.
    EffectNeedsMeans = "effect_needs_means",
    /// An effect with an instant is used on another recording.
    EffectNeedsStart = "effect_needs_start",
    /// An effect with a heading is used on another recording.
    EffectNeedsHeading = "effect_needs_heading",
    /// An effect of the accelerometer looks at the attitude, which its method does not know yet.
    EffectNeedsAttitude = "effect_needs_attitude",
    /// An effect has an instant, by which a fit has no derivative.
    EffectNeedsInstant = "effect_needs_instant",
    /// A parameter of an effect shows in no static interval.
    EffectSilentAtRest = "effect_silent_at_rest",
    /// Parameters of effects change the norm of specific force alike.
    EffectsAlike = "effects_alike",
    /// An effect of the user takes more steps than it may.
    EffectCostly = "effect_costly",
    /// An effect of the user is no number somewhere.
    EffectNoNumber = "effect_no_number",
    /// An effect of the user may be why a fit fails.
    OwnEffectSuspected = "own_effect_suspected",
    /// A calibration has an effect that this program does not know.
    EffectNotHere = "effect_not_here",
    /// A calibration with effects is to correct single readings.
    EffectsLookFurther = "effects_look_further",
    /// No reading of a sensor of one dimension lies within its recording.
    ScalarOutside = "scalar_outside",
    /// A sensor of one dimension looks at what cannot be known.
    ScalarNeeds = "scalar_needs",
    /// Too few static intervals say what a sensor of one dimension should have read.
    ScalarFewMeans = "scalar_few_means",
    /// The readings of a sensor of one dimension leave a parameter open.
    ScalarUndetermined = "scalar_undetermined",
    /// The model of a sensor of one dimension does not fit, or no signal gives a reading.
    ScalarUnsolved = "scalar_unsolved",
    /// There is no effect of this name.
    EffectUnknown = "effect_unknown",
    /// There is no parameter of this name.
    ParameterUnknown = "parameter_unknown",
    /// The name of an effect is that of another.
    EffectTaken = "effect_taken",
    /// An effect says that it is linear, and is not.
    EffectNotLinear = "effect_not_linear",
    /// A name means something else already.
    NameTaken = "name_taken",
    /// A name is not in snake case.
    NameNotSnakeCase = "name_not_snake_case",
    /// The definition of an effect is that of another.
    DefinitionOfOther = "definition_of_other",
    /// An effect has no parameter.
    ParametersMissing = "parameters_missing",
    /// An effect has no expression.
    ExpressionMissing = "expression_missing",
    /// The expressions of an effect take too many steps.
    ExpressionCostly = "expression_costly",
    /// An effect is not silent in a perfect sensor.
    NotSilent = "not_silent",
    /// An effect is no number in some motion.
    NoNumberInMotion = "no_number_in_motion",
    /// A factor of a formula is to the power of zero.
    PowerOfZero = "power_of_zero",
    /// An expression is too long.
    ExpressionLong = "expression_long",
    /// An expression is nested too deeply.
    ExpressionDeep = "expression_deep",
    /// A number of an expression cannot be read.
    ExpressionNoNumber = "expression_no_number",
    /// A character has no meaning in an expression.
    ExpressionCharacter = "expression_character",
    /// Something else stands where an expression needs an operator.
    OperatorExpected = "operator_expected",
    /// Something else stands where an expression needs an operand.
    OperandExpected = "operand_expected",
    /// Something else stands where an expression needs a bracket.
    SignExpected = "sign_expected",
    /// An exponent is no constant.
    ExponentVaries = "exponent_varies",
    /// An expression calls a function that there is not.
    FunctionUnknown = "function_unknown",
    /// An expression names a variable that there is not.
    VariableUnknown = "variable_unknown",
    /// A value is outside of its range.
    OutOfRange = "out_of_range",
    /// A local gravity is that of no place on the earth.
    GravityNotOnEarth = "gravity_not_on_earth",
    /// A local gravity is that of no height at the latitude that is given.
    GravityNotOfLatitude = "gravity_not_of_latitude",
    /// An end comes before its begin, or a largest value before the least.
    Backwards = "backwards",
    /// A setting means nothing to the method that was asked for.
    NotOfThisMethod = "not_of_this_method",
    /// The joint method is asked for without an accelerometer.
    MethodNeedsForce = "method_needs_force",
    /// No recording is given.
    RecordingsMissing = "recordings_missing",
    /// There are as many lists of sections as neither one nor recordings.
    SectionsDoNotFit = "sections_do_not_fit",
    /// An instant to leave out is in no recording.
    InstantOutside = "instant_outside",
    /// There are more or fewer of something than of its partner.
    CountOther = "count_other",
    /// A direction is zero.
    DirectionZero = "direction_zero",
    /// Counts are asked for without their unit.
    StepMissing = "step_missing",
    /// A filter leaves the noise as it is.
    FilterTooHigh = "filter_too_high",
    /// A fault happens in a placement or a turn that there is not.
    PlaceMissing = "place_missing",
    /// An effect has nothing in a simulation that it shows in.
    EffectSilent = "effect_silent",
    /// One thing is given in two ways.
    GivenTwice = "given_twice",
    /// A simulation has more samples than the memory takes.
    TooLongForMemory = "too_long_for_memory",
    /// A text is not TOML, or has keys that nobody knows.
    NotToml = "not_toml",
    /// A validation recording was in the fit.
    ValidationSeen = "validation_seen",
    /// Requirement on the placements of a recording.
    Requirement = "requirement",
    /// Placements leave a combination of parameters open.
    PlacementsLeaveOpen = "placements_leave_open",
    /// Placements are no more than the parameters.
    PlacementsTooFew = "placements_too_few",
    /// Placements tell some parameters too badly.
    PlacementsTellLittle = "placements_tell_little",
    /// Placements lie near one plane.
    PlacementsInPlane = "placements_in_plane",
    /// Placements repeat too few directions.
    DirectionsTooFew = "directions_too_few",
    /// Turns leave a combination of parameters open.
    TurnsLeaveOpen = "turns_leave_open",
    /// Turns are no more than the parameters.
    TurnsTooFew = "turns_too_few",
    /// Turns tell some parameters too badly.
    TurnsTellLittle = "turns_tell_little",
    /// There is no turn between two static intervals.
    TurnsMissing = "turns_missing",
    /// No turn can be used.
    TurnsUnusable = "turns_unusable",
    /// Too few turns can be used.
    TurnsUsableFew = "turns_usable_few",
    /// The turns that can be used leave a parameter open.
    TurnsUsableOpen = "turns_usable_open",
    /// The device is never still for long enough.
    NeverStill = "never_still",
    /// No stretch is quiet enough for a device at rest.
    NeverQuiet = "never_quiet",
    /// Quiet stretches are no static intervals.
    QuietNotStatic = "quiet_not_static",
    /// The device was not turned.
    AllStatic = "all_static",
    /// A single static interval was found in a recording that moves.
    OneStaticInterval = "one_static_interval",
    /// Static means lie on no sphere.
    NoSphere = "no_sphere",
    /// A static interval shows no gravity.
    NoGravityAtRest = "no_gravity_at_rest",
    /// A recording has no static interval of its sensor.
    NoRest = "no_rest",
    /// A face of the device is in no placement.
    FaceMissing = "face_missing",
    /// No rest is long enough for a bias.
    RestTooShort = "rest_too_short",
    /// There are too few rests for a bias.
    RestsTooFew = "rests_too_few",
    /// Rests do not tell the axes apart.
    RestsInPlane = "rests_in_plane",
    /// The work was cancelled.
    Cancelled = "cancelled",
    /// The solver refused the problem.
    SolverRefused = "solver_refused",
    /// A fit does not come to an end.
    FitStopped = "fit_stopped",
    /// A fit did not converge with the turns, and does without them.
    FitStoppedByTurns = "fit_stopped_by_turns",
    /// A recording has nothing to calibrate.
    NothingToCalibrate = "nothing_to_calibrate",
    /// Two axes of a fit are the same.
    AxesSame = "axes_same",
    /// There is a magnetometer and nothing that tells how it was held.
    MagnetometerAlone = "magnetometer_alone",
    /// Nothing tells how a magnetometer was held.
    AttitudeNotSeen = "attitude_not_seen",
    /// The magnetometers of two recordings have different units.
    FieldUnitsDiffer = "field_units_differ",
    /// Attitudes do not determine a magnetometer.
    AttitudesLeaveOpen = "attitudes_leave_open",
    /// An axis of the magnetometer reads one value.
    FieldAxisConstant = "field_axis_constant",
    /// Too few attitudes have readings of the magnetometer.
    AttitudesTooFew = "attitudes_too_few",
    /// A file was written by a newer version.
    WrittenByNewer = "written_by_newer",
    /// A file is not JSON.
    NotJson = "not_json",
    /// A file does not say its schema.
    SchemaMissing = "schema_missing",
    /// An entry says another thing than expected.
    EntryOther = "entry_other",
    /// The matrix of a sensor has no inverse.
    MatrixSingular = "matrix_singular",
    /// A matrix amplifies its axes as that of no sensor.
    MatrixUnequal = "matrix_unequal",
    /// A bias is that of no sensor.
    BiasBeyond = "bias_beyond",
    /// A prior is used in a frame that it does not hold in.
    PriorFrame = "prior_frame",
    /// A prior has no parameter of the calibration.
    PriorForeign = "prior_foreign",
    /// A prior has sizes or numbers that make no distribution.
    PriorUnusable = "prior_unusable",
    /// The covariances of prior and session are none together.
    PriorDegenerate = "prior_degenerate",
    /// A recording has no readings of a sensor.
    SensorNotRecorded = "sensor_not_recorded",
    /// A calibration has nothing of a sensor.
    SensorNotInCalibration = "sensor_not_in_calibration",
    /// A calibration is for readings in another unit.
    OfOtherUnits = "of_other_units",
    /// A calibration is for readings with other axes flipped.
    FlippedOtherwise = "flipped_otherwise",
    /// Accelerometers of two recordings differ as those of two devices.
    DevicesDiffer = "devices_differ",
    /// The gyroscope of a recording differs as that of another device.
    GyroscopeOfOther = "gyroscope_of_other",
    /// The readings of a recording are in another one too.
    ReadingsTwice = "readings_twice",
    /// A recording is of the same device in turned axes.
    AxesOfOtherTurned = "axes_of_other_turned",
    /// Corrected by a calibration the rate at rest is not zero.
    RateAtRestOff = "rate_at_rest_off",
    /// Corrected by a calibration the gyroscope misses gravity through turns.
    DirectionOff = "direction_off",
    /// Corrected by a calibration the specific force at rest is not gravity.
    NormOff = "norm_off",
    /// The norm of corrected readings is off by more than in the calibration's recordings.
    NormGrown = "norm_grown",
    /// The corrected magnetic field differs from rest to rest.
    FieldOff = "field_off",
    /// Readings were corrected before otherwise than those of the calibration.
    CorrectedOtherwise = "corrected_otherwise",
    /// Readings of some recordings were corrected before.
    CorrectedInPart = "corrected_in_part",
    /// Gravity, a sensor or an effect of a calibration was edited.
    NumbersEdited = "numbers_edited",
    /// An entry beside the parameters of a calibration was edited: method, covariance, limits or inputs.
    BasisEdited = "basis_edited",
    /// An effect counts the time from the start of another recording.
    EffectFromStart = "effect_from_start",
    /// An effect holds in the recordings of a calibration only, and these are not known.
    EffectOfRecordings = "effect_of_recordings",
    /// Only the longest static interval is analysed.
    OnlyRestAnalysed = "only_rest_analysed",
    /// A recording has no motion after a rest.
    MotionMissing = "motion_missing",
    /// A motion lies outside of its recording, or has no rest before it.
    MotionOutside = "motion_outside",
    /// A stretch has too few samples.
    SamplesTooFew = "samples_too_few",
    /// A rest has no samples.
    NoSamplesAtRest = "no_samples_at_rest",
    /// The device was never at rest for long enough to see its noise.
    NeverAtRest = "never_at_rest",
    // Parameters that a recording does not show.
    /// The gyroscope turned without gravity to see its scale factors and misalignments by.
    NotSeenWithoutGravity = "not_seen_without_gravity",
    /// The earth's rate is too small to show the gyroscope's scale factors.
    NotSeenByEarthRate = "not_seen_by_earth_rate",
    /// The earth's rotation is in a bias that is estimated again.
    EarthInBias = "earth_in_bias",
    // Last of all.
    /// A finding of another version, or one with a text of its own.
    Remark = "remark",
}
