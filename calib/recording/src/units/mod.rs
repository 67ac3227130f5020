//! Units of the columns: as stated in the header or by the user, or told from the size of gravity.

pub(crate) mod decide;
mod direction;
pub(crate) mod field;
pub(crate) mod hand_clock;
mod lost_points;
pub(crate) mod repeated;
pub(crate) mod rests;
pub(crate) mod swapped;
mod thousands;
pub(crate) mod turn_unit;
pub(crate) mod values;

use std::f64::consts::TAU;
use std::str::FromStr;

use findings::{Finding, Kind};

use self::field::FieldUnit;

/// Standard acceleration of free fall, m/s² (exact by definition, 3rd CGPM, 1901).
pub(crate) const STANDARD_GRAVITY: f64 = 9.80665;

/// Clocks that programs write without a unit, beside those of [`TimeUnit::ALL`]: hundredths of seconds, and the crystal of
/// watches, whole and divided by 32, per second.
pub(crate) const CLOCKS: [f64; 3] = [100.0, 1024.0, 32_768.0];

macro_rules! unit {
    ($(#[$doc:meta])* $name:ident { $($(#[$entry:meta])* $variant:ident = $spelling:literal $(| $other:literal)*,)* }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $name { $($(#[$entry])* $variant,)* }

        impl $name {
            /// The usual spelling.
            pub fn name(self) -> &'static str {
                match self { $(Self::$variant => $spelling,)* }
            }

            /// The unit that `text` (lower case, without blanks) spells.
            fn spelled(text: &str) -> Option<Self> {
                match text { $($spelling $(| $other)* => Some(Self::$variant),)* _ => None }
            }
        }

        impl FromStr for $name {
            type Err = Box<Finding>;

            fn from_str(text: &str) -> Result<Self, Box<Finding>> {
                let unknown = || {
                    let known = [$($spelling),*].join(", ");
                    Finding::of(Kind::UNIT_UNKNOWN).detail("known", known).into()
                };
                Self::spelled(&normal(text)).ok_or_else(unknown)
            }
        }
    };
}

unit! {
    /// Unit of time stamps.
    TimeUnit {
        /// Seconds.
        Seconds = "s",
        /// Milliseconds.
        Milliseconds = "ms" | "millis",
        /// Tenths of milliseconds.
        TenthMilliseconds = "0.1ms" | "100us",
        /// Microseconds.
        Microseconds = "us" | "µs" | "micros",
        /// Tenths of microseconds, as Windows and .NET count them.
        TenthMicroseconds = "0.1us" | "0.1µs" | "100ns",
        /// Nanoseconds.
        Nanoseconds = "ns" | "nanos",
        /// Minutes.
        Minutes = "min" | "mins" | "minutes" | "minute" | "minuten" | "minutos" | "minuti" | "分",
        /// Hours.
        Hours = "h" | "hr" | "hours" | "stunden" | "heures",
        /// Days, as spreadsheets and MATLAB count them.
        Days = "d" | "days",
    }
}

unit! {
    /// Unit of an accelerometer.
    AccelUnit {
        /// Metres per second squared.
        MetresPerSecondSquared = "m/s^2" | "m/s2" | "m/s²" | "m/s/s" | "ms^-2" | "ms-2" | "m.s-2" | "m.s^-2" | "m*s^-2" | "ms⁻²" | "mps2" | "ms2",
        /// Standard gravity, 9.80665 m/s².
        G = "g" | "g0" | "gs" | "g's",
        /// Thousandths of standard gravity.
        MilliG = "mg" | "milli-g" | "millig",
        /// Millionths of standard gravity.
        MicroG = "ug" | "µg" | "micro-g" | "microg",
        /// Centimetres per second squared.
        Gal = "cm/s^2" | "cm/s2" | "cm/s²" | "gal" | "cmps2",
        /// Millimetres per second squared.
        MillimetresPerSecondSquared = "mm/s^2" | "mm/s2" | "mm/s²" | "mmps2",
        /// Feet per second squared.
        FeetPerSecondSquared = "ft/s^2" | "ft/s2" | "ft/s²" | "ft/s/s" | "fps2",
        /// Raw counts: kept as they are.
        Counts = "counts" | "lsb" | "raw" | "adc",
    }
}

unit! {
    /// Unit of a gyroscope.
    GyroUnit {
        /// Radians per second.
        RadiansPerSecond = "rad/s" | "rads" | "rads^-1" | "rads-1" | "rad.s-1" | "rad.s^-1" | "rad*s^-1" | "rads⁻¹" | "radps",
        /// Thousandths of radians per second.
        MilliRadiansPerSecond = "mrad/s" | "mradps",
        /// Degrees per second.
        DegreesPerSecond = "deg/s" | "°/s" | "dps" | "degs" | "degs^-1" | "degs-1" | "deg.s-1" | "deg.s^-1" | "º/s" | "d/s" | "degps",
        /// Thousandths of degrees per second.
        MilliDegreesPerSecond = "mdeg/s" | "mdps" | "m°/s",
        /// Degrees per hour.
        DegreesPerHour = "deg/h" | "°/h" | "deg/hr" | "dph",
        /// Degrees per minute.
        DegreesPerMinute = "deg/min" | "°/min",
        /// Turns per minute.
        TurnsPerMinute = "rpm" | "rev/min" | "r/min",
        /// Turns per second.
        TurnsPerSecond = "rev/s",
        /// Raw counts: kept as they are.
        Counts = "counts" | "lsb" | "raw" | "adc",
    }
}

unit! {
    /// Unit of a temperature.
    TemperatureUnit {
        /// Degrees Celsius.
        Celsius = "c" | "°c" | "degc" | "celsius" | "ºc",
        /// Kelvin.
        Kelvin = "k" | "kelvin",
        /// Degrees Fahrenheit.
        Fahrenheit = "f" | "°f" | "degf" | "fahrenheit",
        /// Raw counts of the sensor, which are no temperature until its formula is known.
        Counts = "counts" | "lsb" | "raw" | "adc",
    }
}

/// Parts of units in words, and what stands for them.
const WORDS: [(&str, &str); 33] = [
    ("degrees", "deg"),
    ("degree", "deg"),
    ("grad", "deg"),
    ("radians", "rad"),
    ("radian", "rad"),
    ("sekunden", "s"),
    ("sekunde", "s"),
    ("secondes", "s"),
    ("segundos", "s"),
    ("secondi", "s"),
    ("seconds", "s"),
    ("second", "s"),
    ("secs", "s"),
    ("sec", "s"),
    ("per", "/"),
    ("**", "^"),
    ("毫秒", "ms"),
    ("微秒", "us"),
    ("纳秒", "ns"),
    ("秒", "s"),
    ("分钟", "min"),
    ("小时", "h"),
    ("弧度", "rad"),
    ("度", "deg"),
    ("米", "m"),
    ("초", "s"),
    ("град", "deg"),
    ("рад", "rad"),
    ("мкс", "us"),
    ("мс", "ms"),
    ("м", "m"),
    ("сек", "s"),
    ("с", "s"),
];

/// Lower case without blanks, underscores, brackets and raised dots, words as their signs: `deg per sec` as `deg/s`.
fn normal(text: &str) -> String {
    let text = text.trim().replace('μ', "µ");
    let text = text
        .chars()
        .filter(|c| !c.is_whitespace() && !matches!(c, '_' | '(' | ')' | '·' | '⋅'))
        .flat_map(char::to_lowercase)
        .collect();
    WORDS
        .iter()
        .fold(text, |text: String, (word, sign)| text.replace(word, sign))
}

/// True for what is written as a unit of a sensor is, known or not: `turn/s`, `cdps`, `rpm`.
pub(crate) fn looks_like_unit(text: &str) -> bool {
    let text = normal(text);
    let is_rate = text.ends_with("ps") || text.ends_with("pm") || text.contains("s-1");
    text.contains(['/', '^', '²']) || is_rate || text.ends_with("s2")
}

/// True if `text` spells a unit of any of the quantities; minutes, hours and days only in brackets: `acc_min` is another.
pub(crate) fn is_unit(text: &str) -> bool {
    text.parse::<TimeUnit>()
        .is_ok_and(|unit| unit.per_second() >= 1.0)
        || text.parse::<AccelUnit>().is_ok()
        || text.parse::<GyroUnit>().is_ok()
        || text.parse::<TemperatureUnit>().is_ok()
        || is_of_field(text)
}

/// True if `text` spells a unit of a magnetic field that is no other quantity's: `acc_g` and `dist_mt` are none.
pub(crate) fn is_of_field(text: &str) -> bool {
    let is_plain = matches!(normal(text).as_str(), "t" | "g" | "gs" | "mg" | "mt");
    !is_plain
        && text
            .parse::<FieldUnit>()
            .is_ok_and(|unit| unit.known().is_some())
}

/// True if `text` spells a unit of an accelerometer or a gyroscope.
pub(crate) fn is_of_sensor(text: &str) -> bool {
    text.parse::<AccelUnit>().is_ok() || text.parse::<GyroUnit>().is_ok()
}

/// Units that a header states.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Stated {
    /// Unit of the time column.
    pub time: Option<TimeUnit>,
    /// Unit of the accelerometer columns.
    pub accel: Option<AccelUnit>,
    /// Unit of the gyroscope columns.
    pub gyro: Option<GyroUnit>,
    /// Unit of the temperature column.
    pub temperature: Option<TemperatureUnit>,
    /// Unit of the magnetometer columns.
    pub field: Option<FieldUnit>,
}

impl TimeUnit {
    /// The units that stamps without one may have, the longest first.
    pub const ALL: [Self; 4] = [
        Self::Seconds,
        Self::Milliseconds,
        Self::Microseconds,
        Self::Nanoseconds,
    ];

    /// Returns the number of these units in a second.
    pub fn per_second(self) -> f64 {
        match self {
            Self::Seconds => 1.0,
            Self::Milliseconds => 1e3,
            Self::TenthMilliseconds => 1e4,
            Self::Microseconds => 1e6,
            Self::TenthMicroseconds => 1e7,
            Self::Nanoseconds => 1e9,
            Self::Minutes => 1.0 / 60.0,
            Self::Hours => 1.0 / 3_600.0,
            Self::Days => 1.0 / 86_400.0,
        }
    }
}

impl AccelUnit {
    /// All but counts.
    pub(crate) const PHYSICAL: [Self; 6] = [
        Self::MetresPerSecondSquared,
        Self::G,
        Self::MilliG,
        Self::Gal,
        Self::FeetPerSecondSquared,
        Self::MillimetresPerSecondSquared,
    ];

    /// m/s² per unit; 1 for counts.
    pub fn scale(self) -> f64 {
        match self {
            Self::MetresPerSecondSquared | Self::Counts => 1.0,
            Self::G => STANDARD_GRAVITY,
            Self::MilliG => STANDARD_GRAVITY / 1e3,
            Self::MicroG => STANDARD_GRAVITY / 1e6,
            Self::Gal => 0.01,
            Self::MillimetresPerSecondSquared => 1e-3,
            // The international foot, 0.3048 m by definition.
            Self::FeetPerSecondSquared => 0.3048,
        }
    }
}

impl GyroUnit {
    /// True for the units that the turns between rests tell apart.
    pub(crate) fn is_told(self) -> bool {
        matches!(
            self,
            Self::RadiansPerSecond | Self::DegreesPerSecond | Self::MilliDegreesPerSecond
        )
    }

    /// rad/s per unit; 1 for counts.
    pub fn scale(self) -> f64 {
        match self {
            Self::RadiansPerSecond | Self::Counts => 1.0,
            Self::DegreesPerSecond => 1f64.to_radians(),
            Self::MilliRadiansPerSecond => 1e-3,
            Self::MilliDegreesPerSecond => 1e-3f64.to_radians(),
            Self::DegreesPerHour => 1f64.to_radians() / 3600.0,
            Self::DegreesPerMinute => 1f64.to_radians() / 60.0,
            Self::TurnsPerMinute => TAU / 60.0,
            Self::TurnsPerSecond => TAU,
        }
    }
}

impl TemperatureUnit {
    /// A reading in °C; counts as they are.
    pub fn celsius(self, reading: f64) -> f64 {
        match self {
            Self::Celsius | Self::Counts => reading,
            Self::Kelvin => reading - 273.15,
            Self::Fahrenheit => (reading - 32.0) / 1.8,
        }
    }
}
