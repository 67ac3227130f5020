//! Formats of dates that a message offers: only those that read the stamp.

use super::by_pattern;
use super::time_of_day::TimeOfDay;

/// Dates and times as spreadsheets, loggers and phones write them. Of a day and a month that may be either, the usual order
/// of their separator is first.
const PATTERNS: [&str; 17] = [
    "%d.%m.%Y %H:%M:%S%.f",
    "%d.%m.%Y %H:%M:%S,%f",
    "%d.%m.%Y %H:%M:%S:%f",
    "%d.%m.%y %H:%M:%S%.f",
    "%d.%m.%y %H:%M:%S,%f",
    "%m/%d/%Y %I:%M:%S%.f %p",
    "%d/%m/%Y %I:%M:%S%.f %p",
    "%m/%d/%Y %H:%M:%S%.f",
    "%d/%m/%Y %H:%M:%S%.f",
    "%m/%d/%y %H:%M:%S%.f",
    "%d/%m/%y %H:%M:%S%.f",
    "%d-%m-%Y %H:%M:%S%.f",
    "%Y-%m-%d %I:%M:%S%.f %p",
    "%Y-%m-%d %H:%M:%S,%f",
    "%Y.%m.%d %H:%M:%S%.f",
    "%I:%M:%S%.f %p",
    "%Y%m%d %H%M%S%.f",
];

/// The first format that reads the stamp in `cell`; `None` where none does.
pub(crate) fn pattern_of(cell: &[u8]) -> Option<&'static str> {
    let text = std::str::from_utf8(cell).ok()?;
    let reads = |pattern: &&&str| by_pattern(pattern, text, &mut TimeOfDay::default()).is_some();
    PATTERNS.iter().find(reads).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_format_that_is_offered_reads_the_stamp() {
        for (stamp, pattern) in [
            ("27.10.2024 02:59:00,123", "%d.%m.%Y %H:%M:%S,%f"),
            ("27.10.2024 02:59:00.123", "%d.%m.%Y %H:%M:%S%.f"),
            ("27.10.2024 02:59:00", "%d.%m.%Y %H:%M:%S%.f"),
            ("03/03/2025 11:58:40.000 AM", "%m/%d/%Y %I:%M:%S%.f %p"),
            ("13/03/2025 11:58:40.000 PM", "%d/%m/%Y %I:%M:%S%.f %p"),
            ("11:58:40.5 PM", "%I:%M:%S%.f %p"),
        ] {
            assert_eq!(pattern_of(stamp.as_bytes()), Some(pattern), "{stamp}");
        }
        for stamp in ["", "yesterday", "99:99.0", "\u{fffd}"] {
            assert_eq!(pattern_of(stamp.as_bytes()), None, "{stamp}");
        }
    }
}
