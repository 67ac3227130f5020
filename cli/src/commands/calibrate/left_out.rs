//! Table of the standard errors with a possible unmodelled effect.

use calib::Calibration;

use super::field::field_reading_unit;
use crate::show;
use sensor::{BasePart, Sensor, base_part};

/// An effect that makes no standard error so many times as large is not shown.
pub const WORTH_SHOWING: f64 = 2.0;
/// Effects shown at most.
const MOST_SHOWN: usize = 4;

/// Caption of the table.
pub const SENTENCE: &str = "The standard errors hold for sensors without further effects. Where a sensor has one, as large as is \
                            usual in consumer-grade sensors and no larger than this recording would show, errors are larger:";

/// Header of [`rows`].
pub const HEADER: [&str; 5] = [
    "effect left out",
    "parameter",
    "std error",
    "with it",
    "unit",
];

/// The effects that would enlarge a standard error most, with the parameter whose it is; `units` are those of the biases.
pub fn rows(calibration: &Calibration, units: [&str; 2]) -> Vec<[String; 5]> {
    let field = field_reading_unit(calibration);
    let enlarged = calibration.enlarged_by_more_than(WORTH_SHOWING).into_iter();
    let row = |own: calib::calibration::Enlarged<'_>| {
        let unit = match base_part(&own.by.parameter) {
            Some((Sensor::Accelerometer, BasePart::Bias)) => units[0],
            Some((Sensor::Gyroscope, BasePart::Bias)) => units[1],
            Some((Sensor::Magnetometer, BasePart::Bias)) => field,
            _ => "",
        };
        let error = |value: f64| show::error(Some(value));
        [
            own.by.effect.clone(),
            own.by.parameter.clone(),
            error(own.std_error),
            error(own.std_error_with),
            unit.to_owned(),
        ]
    };
    enlarged.take(MOST_SHOWN).map(row).collect()
}

/// The table for people; empty where no standard error would double.
pub fn text(calibration: &Calibration, units: [&str; 2]) -> String {
    let rows = rows(calibration, units);
    if rows.is_empty() {
        return String::new();
    }
    let table = show::table_of(&HEADER, rows);
    format!("\n{SENTENCE}\n{table}\n")
}
