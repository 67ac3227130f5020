//! Numbers in units that people use.

/// A number with three significant digits and without trailing zeros.
///
/// # Examples
/// ```
/// use stillpoint_findings::significant;
/// assert_eq!([0.012345, 1234.5, 100.0].map(|v| significant(v, 3)), ["0.0123", "1230", "100"]);
/// ```
pub fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    let rounded: f64 = format!("{value:.*e}", digits.saturating_sub(1))
        .parse()
        .unwrap_or(value);
    if (1e-4..1e9).contains(&rounded.abs()) {
        format!("{rounded}")
    } else {
        format!("{rounded:e}")
    }
}

/// A quantity in a unit for people, with three significant digits.
///
/// | SI | shown |
/// |---|---|
/// | `m/s^2` | mm/s² below 0.1 m/s², else m/s² |
/// | `rad/s` | °/h below 0.01 rad/s, else °/s |
/// | `rad` | ° |
/// | `s` | ms below 0.1 s, else s, to a second at least |
/// | `Hz` | Hz with six digits, kHz from 10 kHz on |
/// | `.../√s` | as the unit before |
/// | `file` | a number in the unit of a file |
/// | `share` | % |
/// | `count` | whole number |
///
/// # Examples
/// ```
/// use stillpoint_findings::human;
/// assert_eq!(human(0.0028, "m/s^2"), "2.8 mm/s²");
/// assert_eq!(human(1e-4, "rad/s"), "20.6 °/h");
/// assert_eq!(human(0.022, "share"), "2.2 %");
/// ```
pub fn human(value: f64, unit: &str) -> String {
    let size = value.abs();
    let in_unit = |factor: f64, unit: &str| format!("{} {unit}", significant(value * factor, 3));
    match unit {
        "m/s^2" if size < 0.1 => in_unit(1e3, "mm/s²"),
        "m/s^2" => in_unit(1.0, "m/s²"),
        "rad/s" if size < 0.01 => in_unit(1f64.to_degrees() * 3600.0, "°/h"),
        "rad/s" => in_unit(1f64.to_degrees(), "°/s"),
        "rad" => format!("{}°", significant(value.to_degrees(), 3)),
        "s" if size < 0.1 && size > 0.0 => in_unit(1e3, "ms"),
        "s" if size >= 1000.0 => format!("{value:.0} s"),
        "Hz" if size >= 1e4 => in_unit(1e-3, "kHz"),
        "Hz" => format!("{} Hz", significant(value, 6)),
        "file" => format!("{} (in the file's unit)", significant(value, 6)),
        "share" => in_unit(100.0, "%"),
        "count" => format!("{value:.0}"),
        "1" | "" => significant(value, 3),
        "°" => format!("{}°", significant(value, 3)),
        other => match other.strip_suffix("/√s") {
            Some(of) => format!("{}/√s", human(value, of)),
            None => in_unit(1.0, &other.replace("^2", "²")),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_and_rates_keep_the_digits_that_people_need() {
        for (value, unit, expected) in [
            (1234.6, "s", "1235 s"),
            (0.0, "s", "0 s"),
            (99.7512, "Hz", "99.7512 Hz"),
            (30_000.0, "Hz", "30 kHz"),
            (1e-4, "rad/s/√s", "20.6 °/h/√s"),
            (4.36, "file", "4.36 (in the file's unit)"),
        ] {
            assert_eq!(human(value, unit), expected);
        }
    }
}
