//! Numbers in units that people use.

/// A number with three significant digits and without trailing zeros.
///
/// # Examples
/// ```
/// assert_eq!([0.012345, 1234.5, 100.0].map(|v| findings::significant(v, 3)), ["0.0123", "1230", "100"]);
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
/// | `s` | ms below 0.1 s, else s |
/// | `share` | % |
/// | `count` | whole number |
///
/// # Examples
/// ```
/// assert_eq!(findings::human(0.0028, "m/s^2"), "2.8 mm/s²");
/// assert_eq!(findings::human(1e-4, "rad/s"), "20.6 °/h");
/// assert_eq!(findings::human(0.022, "share"), "2.2 %");
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
        "s" if size < 0.1 => in_unit(1e3, "ms"),
        "share" => in_unit(100.0, "%"),
        "count" => format!("{value:.0}"),
        "1" | "" => significant(value, 3),
        "°" => format!("{}°", significant(value, 3)),
        other => in_unit(1.0, &other.replace("^2", "²")),
    }
}
