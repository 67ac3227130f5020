//! Options of the motion detector, and the detector built from them.

use crate::intervals::Detector;

/// Options of the motion detector. What is not given follows from the recording.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DetectorOptions {
    /// Factor on the threshold; chosen by the accelerometer's fit where it is not given.
    pub multiplier: Option<f64>,
    /// Shortest static interval, s; 2.5, or down to 0.6 where only that makes a calibration.
    pub min_static: Option<f64>,
    /// Shortest motion, s; 0.5.
    pub min_dynamic: Option<f64>,
    /// Window in which the spread is measured, s; 1, shorter for shorter static intervals.
    pub window: Option<f64>,
    /// Length of the static interval at the start that gives the level at rest, s; the quietest tenth of the recording.
    pub initial_static: Option<f64>,
}

impl DetectorOptions {
    /// The detector, and whether its multiplier is left to the fit.
    ///
    /// # Errors
    /// The name of what is no positive number.
    ///
    /// # Examples
    /// ```
    /// use stillpoint_recording::intervals::DetectorOptions;
    ///
    /// let (detector, is_free) = DetectorOptions::default().detector().unwrap();
    /// assert!(is_free && detector.may_shorten);
    /// let wrong = DetectorOptions { window: Some(-1.0), ..DetectorOptions::default() };
    /// assert_eq!(wrong.detector().unwrap_err(), "window");
    /// ```
    pub fn detector(&self) -> Result<(Detector, bool), &'static str> {
        let positive = [
            ("multiplier", self.multiplier),
            ("min_static", self.min_static),
            ("min_dynamic", self.min_dynamic),
            ("window", self.window),
            ("initial_static", self.initial_static),
        ];
        let wrong = |v: f64| v.is_nan() || v <= 0.0 || v.is_infinite();
        if let Some((name, _)) = positive.into_iter().find(|(_, v)| v.is_some_and(wrong)) {
            return Err(name);
        }
        let default = Detector::default();
        let detector = Detector {
            window: self.window.unwrap_or(default.window),
            multiplier: self.multiplier.unwrap_or(default.multiplier),
            min_dynamic: self.min_dynamic.unwrap_or(default.min_dynamic),
            min_static: self.min_static.unwrap_or(default.min_static),
            initial_static: self.initial_static,
            may_shorten: self.min_static.is_none() && self.window.is_none(),
            ..default
        };
        Ok((detector, self.multiplier.is_none()))
    }
}
