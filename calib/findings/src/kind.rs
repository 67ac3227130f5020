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
    /// What another system had corrected was taken off again.
    CorrectionUndone = "correction_undone",
    /// Another system had filtered the readings and taken a mean off.
    FilteredBefore = "filtered_before",
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
    /// Of several sensors in an app's recording some were taken.
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
    /// Of several units in a file the first was read.
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
    /// A bias steps within a static interval.
    BiasStepped = "bias_stepped",
    /// The readings drift while the device should rest.
    Creep = "creep",
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
    /// There are more static intervals than the method takes.
    IntervalsLeftOut = "intervals_left_out",
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
    /// Readings of a recording were corrected before, and others were not.
    CorrectedBefore = "corrected_before",
    /// A recording repeats another.
    SameData = "same_data",
    /// Parameters differ from recording to recording.
    RecordingsDiffer = "recordings_differ",
    /// The gyroscope of one recording differs from the others.
    GyroscopeDiffers = "gyroscope_differs",
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
    /// A recording looks like one of another device.
    ForeignDevice = "foreign_device",
    /// An effect of the user gives no number.
    EffectFault = "effect_fault",
    /// A limit is not kept.
    LimitNotKept = "limit_not_kept",
    /// A sensor is not calibrated.
    NotCalibrated = "not_calibrated",
    /// A time constant was supposed and not fitted.
    TimeConstantSupposed = "time_constant_supposed",
    /// Some recordings have no temperature.
    TemperatureUnknown = "temperature_unknown",
    /// A sensor that is not calibrated is left as it was read.
    LeftAsRead = "left_as_read",
    /// Only the bias of a sensor is known.
    BiasAlone = "bias_alone",
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
    /// The unit of the gyroscope looks like another one.
    ReadingsInDegrees = "readings_in_degrees",
    // Errors: files of any format (crates formats, output, exchange, live, batch).
    /// A file cannot be read.
    Unreadable = "unreadable",
    /// A file cannot be written.
    Unwritable = "unwritable",
    // Errors: text, columns, time and intervals of a recording (crate recording).
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
    /// There is no effect of this name.
    EffectUnknown = "effect_unknown",
    /// There is no parameter of this name.
    ParameterUnknown = "parameter_unknown",
    /// The name of an effect is that of another.
    EffectTaken = "effect_taken",
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
    /// What a recording needs.
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
    /// Readings were corrected before otherwise than those of the calibration.
    CorrectedOtherwise = "corrected_otherwise",
    /// Readings of some recordings were corrected before.
    CorrectedInPart = "corrected_in_part",
    /// What corrects a reading was edited in a calibration.
    NumbersEdited = "numbers_edited",
    /// What a calibration says of its worth was edited.
    BasisEdited = "basis_edited",
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
    /// No sensor has samples enough for its noise.
    NoSamples = "no_samples",
    /// The device was never at rest for long enough to see its noise.
    NeverAtRest = "never_at_rest",
    // Last of all.
    /// A finding of another version, or one with a text of its own.
    Remark = "remark",
}
