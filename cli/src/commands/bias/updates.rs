//! The biases that were estimated again, as rows.

use calib::calibration::Calibration;

use crate::show;

/// A row for each bias that was estimated again: name, before, now, change, standard error, rests.
pub fn updates(new: &Calibration) -> Vec<[String; 6]> {
    let mut rows = Vec::new();
    for update in &new.history {
        let triad = if update.sensor == "gyro" {
            &new.gyroscope
        } else {
            &new.accelerometer
        };
        for (k, axis) in ["x", "y", "z"].iter().enumerate() {
            let std = triad.as_ref().and_then(|t| t.bias_std[k]);
            let (before, now) = (update.bias_before[k], update.bias[k]);
            rows.push([
                format!("{}.b_{axis}", update.sensor),
                show::value(before, std),
                show::value(now, std),
                show::value(now - before, std),
                show::error(std),
                update.rests.to_string(),
            ]);
        }
    }
    rows
}

/// The same in the units that people use, without the change.
pub fn brief(new: &Calibration) -> String {
    let mut lines = vec![format!("  {:<8}  {:>10}  {:>18}", "bias", "before", "now")];
    for update in &new.history {
        let (triad, factor, unit) = match update.sensor.as_str() {
            "gyro" => (&new.gyroscope, 3600.0 * 1f64.to_degrees(), "°/h"),
            _ => (&new.accelerometer, 1e3, "mm/s²"),
        };
        for (k, axis) in ["x", "y", "z"].iter().enumerate() {
            let std = triad.as_ref().and_then(|t| t.bias_std[k]);
            let now = show::with_error(factor * update.bias[k], std.map(|std| factor * std));
            let name = format!("{} {axis}", update.sensor);
            let before = factor * update.bias_before[k];
            lines.push(format!("  {name:<8}  {before:>10.1}  {now:>18} {unit}"));
        }
    }
    lines.join("\n")
}
