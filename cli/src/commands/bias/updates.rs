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
