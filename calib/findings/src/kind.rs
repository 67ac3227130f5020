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
    // Last of all.
    /// A finding of another version, or one with a text of its own.
    Remark = "remark",
}
