//! Units of parameters.

/// The factor from SI and the unit that people use.
pub fn unit_of(name: &str) -> (f64, &'static str) {
    match name {
        "accel.b_x" | "accel.b_y" | "accel.b_z" => (1e3, "mm/s²"),
        "gyro.b_x" | "gyro.b_y" | "gyro.b_z" => (3600_f64.to_degrees(), "°/h"),
        name if name.contains(".s_") => (1e6, "ppm"),
        _ => (1e3, "mrad"),
    }
}
