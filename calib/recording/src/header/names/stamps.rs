//! Names of stamps: which columns may be the time, of which sensor, and the unit that a name says.

use sensor::Sensor;

use super::parts::{LONGEST, OPENING, take_apart};
use super::words::TIME;
use crate::units::TimeUnit;

/// Parts of the names of stamps that are called otherwise.
const LIKE_TIME: [&str; 7] = ["time", "stamp", "tick", "millis", "micros", "clock", "unix"];
/// Parts of names that hold such a part and are no stamps.
const NO_TIME: [&str; 22] = [
    "zone", "valid", "status", "sync", "flag", "out", "diff", "delta", "relative", "latency",
    "period", "interval", "duration", "delay", "age", "speed", "vel", "wind", "exec", "loop",
    "jitter", "dt",
];
/// Endings of names that count a time.
const COUNTS: [&str; 4] = ["minutes", "minuten", "hours", "stunden"];
/// Endings of the names of time columns, with their units.
const UNITS_OF_TIME: [(&str, TimeUnit); 26] = [
    ("millis", TimeUnit::Milliseconds),
    ("millisec", TimeUnit::Milliseconds),
    ("milliseconds", TimeUnit::Milliseconds),
    ("msec", TimeUnit::Milliseconds),
    ("msecs", TimeUnit::Milliseconds),
    ("ms", TimeUnit::Milliseconds),
    ("micros", TimeUnit::Microseconds),
    ("microsec", TimeUnit::Microseconds),
    ("microseconds", TimeUnit::Microseconds),
    ("usec", TimeUnit::Microseconds),
    ("usecs", TimeUnit::Microseconds),
    ("us", TimeUnit::Microseconds),
    ("nanos", TimeUnit::Nanoseconds),
    ("nanosec", TimeUnit::Nanoseconds),
    ("nanoseconds", TimeUnit::Nanoseconds),
    ("nsec", TimeUnit::Nanoseconds),
    ("nsecs", TimeUnit::Nanoseconds),
    ("ns", TimeUnit::Nanoseconds),
    ("seconds", TimeUnit::Seconds),
    ("secs", TimeUnit::Seconds),
    ("sec", TimeUnit::Seconds),
    ("minutes", TimeUnit::Minutes),
    ("minuten", TimeUnit::Minutes),
    ("mins", TimeUnit::Minutes),
    ("min", TimeUnit::Minutes),
    ("hours", TimeUnit::Hours),
];

/// True for a name that has no role and holds a word of the time, or a unit of it: `Time Startup`, `recv_stamp`,
/// `now[ms]`.
pub(crate) fn is_like_time(name: &str) -> bool {
    let (word, unit) = take_apart(name);
    let has = |parts: &[&str]| parts.iter().any(|part| word.contains(part));
    let in_time = || {
        let unit = unit.and_then(|unit| unit.parse::<TimeUnit>().ok());
        let in_brackets = name.contains(OPENING);
        // `gyro_s` may be anything, and days are called as a distance is.
        unit.is_some_and(|unit| unit.per_second() > 1.0 || (in_brackets && unit != TimeUnit::Days))
    };
    // The minutes of a clock have its hours beside them, and neither is the only one then.
    let counts = || COUNTS.iter().any(|end| word.ends_with(end));
    word.len() <= LONGEST.get() && (has(&LIKE_TIME) || in_time() || counts()) && !has(&NO_TIME)
}

/// True for a column called `T` beside one called `t`: the small letter is the time's.
pub(crate) fn is_temperature_beside(name: &str, time: &str) -> bool {
    let is = |name: &str, letter| name.split(OPENING).next().map(str::trim) == Some(letter);
    is(name, "T") && is(time, "t") && stated_unit(name).is_none()
}

/// Parts of what stands in brackets behind a time and is a unit, known or not; a zone of the earth has none.
const IN_UNITS: [&str; 12] = [
    "sec", "sek", "min", "hour", "tick", "jiff", "stund", "uur", "сек", "мин", "秒", "分",
];

/// The unit that the name of a time column says, in brackets or without: `t [ms]`, `time (s since start)`, `millis`, `timeMs`.
pub(crate) fn stated_unit(name: &str) -> Option<TimeUnit> {
    let unit = take_apart(name).1;
    let first = || unit?.split_whitespace().next()?.parse().ok();
    let whole = unit.and_then(|unit| unit.parse().ok());
    // `GPS seconds`, but not `10 ms`.
    let last = || {
        let (before, last) = unit?.rsplit_once(char::is_whitespace)?;
        let has_number = before.contains(|c: char| c.is_ascii_digit() || "/*^".contains(c));
        last.parse().ok().filter(|_| !has_number)
    };
    whole
        .or_else(first)
        .or_else(last)
        .or_else(|| unit_of_time(name))
}

/// True if the name of a time column says a unit that is not known: `time (ticks)`.
pub(crate) fn says_unknown_unit(name: &str) -> bool {
    let unit = take_apart(name).1.unwrap_or_default().to_lowercase();
    let is_one = || IN_UNITS.iter().any(|part| unit.contains(part));
    (per_second(name).is_some() || is_one()) && stated_unit(name).is_none()
}

/// The number in a second of a unit that has a factor: 100 of `t (10 ms)`, 60 of `Time (1/60 sec)`.
pub(crate) fn per_second(name: &str) -> Option<f64> {
    let unit = take_apart(name).1?.trim();
    match unit.to_lowercase().as_str() {
        "cs" => return Some(100.0),
        "ds" => return Some(10.0),
        _ => {}
    }
    let is_factor = |c: char| c.is_ascii_digit() || ".*/^ x".contains(c);
    let at = unit.find(|c| !is_factor(c))?;
    let (factor, unit) = unit.split_at(at);
    let factor = factor.trim_matches([' ', '*', 'x']);
    let factor: f64 = match factor.split_once('/') {
        Some((one, parts)) => one.trim().parse::<f64>().ok()? / parts.trim().parse::<f64>().ok()?,
        None => factor.parse().ok()?,
    };
    let unit: TimeUnit = unit.parse().ok()?;
    let count = unit.per_second() / factor;
    // To the digits of a factor that is no power of two.
    let count = (count * 1e6).round() / 1e6;
    (count.is_finite() && count > 0.0).then_some(count)
}

/// The unit of the time that a name says without brackets: `millis`, `timeMs`.
fn unit_of_time(name: &str) -> Option<TimeUnit> {
    let (word, _) = take_apart(name);
    let says = |(end, _): &&(&str, TimeUnit)| {
        let stem = word.strip_suffix(end);
        // The `ms` of `items` is none, nor the `min` of `vitamin`.
        stem.is_some_and(|stem| {
            end.len() > 3 || stem.is_empty() || TIME.contains(&stem) || is_like_time(stem)
        })
    };
    UNITS_OF_TIME.iter().find(says).map(|(_, unit)| *unit)
}

/// The sensor whose stamps a column holds by its name: `accel_ts`, `gyroTimestamp`, `t_acc`.
pub(crate) fn stamps_of(name: &str) -> Option<Sensor> {
    let (word, _) = take_apart(name);
    let of_one = match (word.contains("acc"), word.contains("gyr")) {
        _ if word == "ta" => Some(Sensor::Accelerometer),
        _ if word == "tg" => Some(Sensor::Gyroscope),
        (true, false) => Some(Sensor::Accelerometer),
        (false, true) => Some(Sensor::Gyroscope),
        _ => None,
    };
    // The unit of a reading has a word of the time: `XGYRO_OUT (deg/sec)`.
    let own = name.split(OPENING).next().unwrap_or(name);
    let words = || own.split(|c: char| !c.is_alphanumeric());
    let is = |wanted: &[&str]| words().any(|word| wanted.contains(&word.to_lowercase().as_str()));
    // `gyro_x_deg_per_sec` is a reading.
    of_one
        .filter(|_| !is(&["x", "y", "z"]))
        .filter(|_| matches!(word.as_str(), "ta" | "tg") || is_like_time(name) || is(TIME))
}

/// True for the name of a counter whose rate nobody states: `Tick#`.
pub(crate) fn is_of_ticks(name: &str) -> bool {
    let (word, unit) = take_apart(name);
    let counts = ["tick", "ticks", "cycles", "jiffies"].iter();
    unit.is_none() && { counts }.any(|end| word.ends_with(end))
}

/// True for the stamp in the header of the message that has the column `reading` too: it says when the readings were taken, and a
/// time beside it when the message arrived.
pub(crate) fn is_message_stamp(name: &str, reading: &str) -> bool {
    let (name, reading) = (name.to_lowercase(), reading.to_lowercase());
    let topic = name.find("header").map(|at| &name[..at]);
    name.contains("stamp") && topic.is_some_and(|topic| reading.starts_with(topic))
}

/// Words of a stamp that says when the readings were taken ...
const OF_SAMPLING: [&str; 10] = [
    "sample", "sampled", "sampling", "sensor", "hw", "hardware", "device", "measured", "captured",
    "header",
];
/// ... and of one that says when they arrived.
const OF_ARRIVAL: [&str; 8] = [
    "recv",
    "received",
    "arrival",
    "host",
    "log",
    "logged",
    "publish",
    "published",
];

/// True for a stamp that by its name says when the readings were taken and in which unit, as a time beside it may not:
/// `sensor_time_ns`, `header_stamp_us`; `timestamp_sample` has the unit of the `timestamp` beside it.
pub(crate) fn is_sampling_stamp(name: &str, beside: &str) -> bool {
    let words = |name: &str| -> Vec<String> {
        let words = name.split(|c: char| !c.is_alphanumeric());
        words.map(str::to_lowercase).collect()
    };
    let own = words(name);
    let has = |parts: &[&str]| own.iter().any(|word| parts.contains(&word.as_str()));
    let says_more = || own.starts_with(&words(beside)) && own.len() > words(beside).len();
    is_like_time(name)
        && has(&OF_SAMPLING)
        && !has(&OF_ARRIVAL)
        && (stated_unit(name).is_some() || says_more())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_stamps_say_their_unit_and_their_sensor() {
        for (name, unit) in [
            ("millis", Some(TimeUnit::Milliseconds)),
            ("micros", Some(TimeUnit::Microseconds)),
            ("timeMs", Some(TimeUnit::Milliseconds)),
            ("uptimeMillis", Some(TimeUnit::Milliseconds)),
            ("seconds", Some(TimeUnit::Seconds)),
            ("sec", Some(TimeUnit::Seconds)),
            ("timestamps", None),
            ("t", None),
            ("items", None),
            ("time_min", Some(TimeUnit::Minutes)),
            ("vitamin", None),
        ] {
            assert_eq!(unit_of_time(name), unit, "{name}");
        }
        assert!(is_like_time("now[ms]") && is_like_time("uptime_us") && is_like_time("clk (s)"));
        assert!(
            is_like_time("minutes") && is_like_time("elapsed (min)") && !is_like_time("ax_min")
        );
        for name in ["时间（分钟）", "Time in minutes"] {
            assert_eq!(stated_unit(name), Some(TimeUnit::Minutes));
        }
        let since = stated_unit("time (s since start)");
        assert_eq!(since, Some(TimeUnit::Seconds));
        assert!(says_unknown_unit("t [cs]") && says_unknown_unit("Time (1/60 sec)"));
        assert!(!says_unknown_unit("time (UTC)") && !says_unknown_unit("t (min)"));
        assert!(says_unknown_unit("t (10 ms)") && !says_unknown_unit("t (100us)"));
        assert_eq!(stated_unit("t (GPS seconds)"), Some(TimeUnit::Seconds));
        for (name, count) in [
            ("t (10 ms)", Some(100.0)),
            ("Time (1/60 sec)", Some(60.0)),
            ("t [cs]", Some(100.0)),
            ("t (0.5 ms)", Some(2000.0)),
            ("t (jiffies)", None),
            ("t (µs)", None),
        ] {
            assert_eq!(per_second(name), count, "{name}");
        }
        assert!(
            !is_like_time("dt[ms]") && !is_like_time("loop time (us)") && !is_like_time("speed_ms")
        );
        for name in ["accel_ts", "t_acc", "accTimestamp", "acc time (ms)", "ta"] {
            assert_eq!(stamps_of(name), Some(Sensor::Accelerometer), "{name}");
        }
        assert_eq!(stamps_of("gyro_t"), Some(Sensor::Gyroscope));
        for (name, beside, is_one) in [
            ("timestamp_sample", "timestamp", true),
            ("sensor_time_ns", "time", true),
            ("header_stamp_us", "t", true),
            // Ticks of a unit that nobody states, an arrival, and no stamps at all.
            ("sensor_time", "time", false),
            ("host_time_us", "time", false),
            ("sample", "t", false),
            ("sampling_interval_ms", "t", false),
        ] {
            assert_eq!(is_sampling_stamp(name, beside), is_one, "{name}");
        }
        assert_eq!(
            stamps_of("gyro_x")
                .or(stamps_of("XGYRO_OUT (deg/sec)"))
                .or(stamps_of("acc_count"))
                .or(stamps_of("time")),
            None
        );
    }
}
