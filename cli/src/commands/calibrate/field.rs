//! Units of a magnetometer.

use calib::Calibration;
use calib::calibration::MagneticField;

/// Unit of the corrected field.
pub fn field_unit(calibration: &Calibration) -> &'static str {
    let field = calibration.magnetic_field.as_ref();
    in_words(field.map(|field| field.unit.as_str()))
}

/// Unit of the magnetometer's readings.
pub fn field_reading_unit(calibration: &Calibration) -> &'static str {
    let field = calibration.magnetic_field.as_ref();
    in_words(field.map(MagneticField::unit_of_readings))
}

fn in_words(unit: Option<&str>) -> &'static str {
    match unit {
        Some("uT") | None => "µT",
        Some(_) => "reading",
    }
}
