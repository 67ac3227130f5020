//! Stamps such as `22:13:01.123`, `22:13:01:123` and `10:13:01.123 PM` as seconds.

use super::twelve_hours;

/// Periods after which a time of day starts again, s: a minute or an hour where the larger fields stand still, a dial of twelve
/// hours, and a day.
const WRAPS: [f64; 4] = [60.0, 3600.0, HALF_A_DAY, DAY];
/// A day, s.
pub(crate) const DAY: f64 = 86_400.0;

findings::tuning! {
    /// A step over a start is no longer, s.
    STEP: f64 = 5.0;
}

/// A time of day that goes back by more has passed midnight, s.
const HALF_A_DAY: f64 = 43_200.0;

/// Reads times of day that go on after midnight.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct TimeOfDay {
    before: f64,
    last: f64,
}

/// The seconds since midnight of `HH:MM:SS`, with decimals behind a point, a comma or a third colon; those since the hour of
/// `MM:SS.s` and `MM:SS:sss`, as spreadsheets show a time with its decimals. Behind it may stand the half of the day, and before
/// it the days that pandas counts.
pub(crate) fn seconds(text: &str) -> Option<f64> {
    let text = twelve_hours::of_the_day(text.trim());
    if let Some((days, rest)) = text.split_once(" days ") {
        return Some(86_400.0 * f64::from(days.parse::<u16>().ok()?) + seconds(rest)?);
    }
    let (hours, rest) = text.split_once(':')?;
    let (hours, (minutes, rest)) = match rest.split_once(':') {
        Some(parts) => (hours, parts),
        None if rest.contains(['.', ',']) => ("0", (hours, rest)),
        None => return None,
    };
    let (hours, minutes, rest) = match rest.len() {
        // Three digits behind the second colon are milliseconds: `59:59:900`.
        3 if rest.bytes().all(|byte| byte.is_ascii_digit()) => {
            ("0", hours, [minutes, rest].join("."))
        }
        _ => (hours, minutes, rest.to_owned()),
    };
    let (seconds, decimals) = rest.split_once([':', '.', ',']).unwrap_or((&rest, "0"));
    let number = |digits: &str, limit: f64| {
        let whole = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit());
        let value: f64 = digits.parse().ok().filter(|_| whole)?;
        (value < limit).then_some(value)
    };
    let fraction =
        number(&format!("{:0<3}", decimals), 1e18)? / 10f64.powi(decimals.len().max(3) as i32);
    let minutes = number(hours, 24.0)? * 60.0 + number(minutes, 60.0)?;
    Some(minutes * 60.0 + number(seconds, 61.0)? + fraction)
}

impl TimeOfDay {
    /// The same, counted on over midnight.
    pub fn read(&mut self, text: &str) -> Option<f64> {
        Some(self.count_on(seconds(text)?))
    }

    /// The seconds since the first midnight of what is `seconds` since the last.
    pub fn count_on(&mut self, seconds: f64) -> f64 {
        let now = self.before + seconds;
        let onwards = |wrap: &f64| (0.0..=STEP.get()).contains(&(now + wrap - self.last));
        let midnight = || (now + HALF_A_DAY < self.last).then_some(DAY);
        let wrap = WRAPS.into_iter().find(onwards).or_else(midnight);
        let wrap = wrap.filter(|_| now < self.last).unwrap_or_default();
        self.before += wrap;
        self.last = now + wrap;
        self.last
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_of_day_are_seconds_and_go_on_after_midnight() {
        assert_eq!(seconds("01:00:01:010"), Some(3601.01));
        assert_eq!(seconds("1:0:1.5"), Some(3601.5));
        assert_eq!(seconds("59:59.9"), Some(3599.9));
        assert_eq!(seconds("00:60,0"), Some(60.0));
        assert_eq!(seconds("59:59:900"), Some(3599.9));
        assert_eq!(seconds("1 days 00:00:01.500000"), Some(86_401.5));
        for text in [
            "25:00:00",
            "1:2",
            "60:00.0",
            "1:2.x",
            "a:b:c",
            "10:00:-1",
            "2026-01-01",
        ] {
            assert_eq!(seconds(text), None, "{text}");
        }
        let mut clock = TimeOfDay::default();
        let read = ["23:59:50", "00:00:20"].map(|text| clock.read(text).unwrap());
        assert_eq!(read[1] - read[0], 30.0);
        let mut clock = TimeOfDay::default();
        let read = ["23:59:59.5", "00:00:00.5"].map(|text| clock.read(text).unwrap());
        assert_eq!(read[1] - read[0], 1.0);
        assert_eq!(seconds("12:00:01.5 AM"), Some(1.5));
        assert_eq!(seconds("1:00:00 pm"), Some(46_800.0));
        for texts in [
            ["12:59:59.9 PM", "01:00:00.0 PM"],
            ["12:59:59.9", "1:00:00"],
        ] {
            let mut clock = TimeOfDay::default();
            let read = texts.map(|text| clock.read(text).unwrap());
            assert!((read[1] - read[0] - 0.1).abs() < 1e-9, "{texts:?}");
        }
        let mut clock = TimeOfDay::default();
        let read = ["59:59.9", "00:00.0"].map(|text| clock.read(text).unwrap());
        assert!((read[1] - read[0] - 0.1).abs() < 1e-9);
    }
}
