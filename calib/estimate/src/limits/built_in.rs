//! Built-in limits of the residuals that hold for any sensor.
//!
//! In units, not in multiples of the noise: a phone's accelerometer reads with 0.04 mm/s² in an interval's mean and is left
//! with 3 mm/s² by hysteresis and table edges, a reduced chi² of 1,600 in a calibration that serves its user. Of eleven
//! recordings of eight real devices the worst sound ones leave 12.5 mm/s² and 0.98°.

use super::line::{Bound, Limit, LimitLine};
use super::quantity::unexplained;
use crate::calibration::Calibration;

findings::tuning! {
    /// A residual above this, one hundredth of gravity, is no calibration, mm/s².
    pub LARGEST_RESIDUAL: f64 = 100.0;
    /// A residual above this that noise does not explain, three thousandths of gravity, mm/s².
    pub LARGEST_UNEXPLAINED_RESIDUAL: f64 = 30.0;
    /// Gravity missed through turns by more than this is no calibration, °.
    pub LARGEST_ANGLE: f64 = 5.0;
    /// The same where noise does not explain it, °.
    pub LARGEST_UNEXPLAINED_ANGLE: f64 = 3.0;
}

/// The lines that hold without a file.
pub fn built_in(calibration: &Calibration) -> Vec<LimitLine> {
    let mut lines = Vec::new();
    let mut line = |name: &str, unit: &str, most: f64, value: Option<f64>| {
        // What cannot be told is no reason to fail.
        lines.extend(value.map(|v| LimitLine {
            built_in: true,
            ..LimitLine::new(name, unit, Bound::AtMost, Limit::One(most), Some(v))
        }));
    };
    if let Some(triad) = &calibration.accelerometer {
        let (name, unit) = ("accelerometer.residual_mm_s2", "mm/s^2");
        line(
            name,
            unit,
            LARGEST_RESIDUAL.get(),
            Some(1e3 * triad.residual_rms),
        );
        let left = unexplained(triad).map(|left| 1e3 * left);
        let name = "accelerometer.unexplained_residual_mm_s2";
        line(name, unit, LARGEST_UNEXPLAINED_RESIDUAL.get(), left);
    }
    let turned = calibration.gyroscope.as_ref();
    if let Some(triad) = turned.filter(|t| t.dynamic_intervals.is_some_and(|n| n > 0)) {
        let name = "gyroscope.residual_deg";
        line(name, "deg", LARGEST_ANGLE.get(), Some(triad.residual_rms));
        let name = "gyroscope.unexplained_residual_deg";
        line(
            name,
            "deg",
            LARGEST_UNEXPLAINED_ANGLE.get(),
            unexplained(triad),
        );
    }
    lines
}
