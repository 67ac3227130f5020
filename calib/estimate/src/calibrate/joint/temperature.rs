//! A temperature that changes while the model has no effect of it.

use findings::{Finding, Kind};
use recording::Recording;
use sensor::Quantity;

use crate::methods::joint::JointFit;

findings::tuning! {
    /// Temperatures that differ by more than this change scale factors and biases beyond what a walk of the bias stands for, K: by `2e-4`
    /// per K, a usual coefficient, a scale factor by `2e-3`.
    LARGE: f64 = 10.0;

    /// A change beside which the fit misses something or a bias has moved, K: a usual gyroscope's bias moves by `1e-4` to `1e-3` rad/s with it.
    LARGE_BESIDE: f64 = 3.0;
}

/// Temperatures at which the device was at rest, from the lowest to the highest, where they differ by more than [`LARGE`], or than
/// [`LARGE_BESIDE`] where there is a `doubt` of the fit, and the model looks at no temperature.
pub fn changed(fit: &JointFit, recordings: &[&Recording], doubt: bool) -> Option<Finding> {
    let mut effects = fit.models.iter().flat_map(|model| model.effects());
    if effects.any(|effect| effect.needs().into_iter().any(Quantity::is_thermal)) {
        return None;
    }
    let means = fit.data.rests.iter().filter_map(|rest| {
        let thermometer = recordings.get(rest.recording)?.temperature.as_ref()?;
        thermometer.mean(rest.span.from, rest.span.to)
    });
    let (low, high) = means.fold(
        (f64::INFINITY, f64::NEG_INFINITY),
        |(low, high), celsius| (low.min(celsius), high.max(celsius)),
    );
    let large = if doubt {
        LARGE_BESIDE.get()
    } else {
        LARGE.get()
    };
    (high - low > large).then(|| {
        Finding::of(Kind::TEMPERATURE_CHANGED)
            .number("low", low, "°C")
            .number("high", high, "°C")
    })
}

#[cfg(test)]
mod tests {
    use recording::Temperature;
    use recording::intervals::{Detector, segment};
    use simulate::Spec;

    use super::*;
    use crate::methods::joint::{JointRequest, fit_joint};

    #[test]
    fn a_ramp_of_fifteen_kelvin_is_said_and_a_room_of_one_temperature_is_not() {
        let spec = Spec::hand_held(3);
        let mut recording = spec.run().unwrap().recording;
        let segmentation = segment(&recording, &Detector::default()).unwrap();
        let mut found = |rise: f64, doubt: bool| {
            let t = recording.accelerometer.as_ref().unwrap().t.clone();
            let last = t[t.len() - 1];
            let celsius = t.iter().map(|t| 25.0 + rise * t / last).collect();
            recording.temperature = Some(Temperature { t, celsius });
            let request = JointRequest::new(vec![(&recording, &segmentation)], spec.gravity);
            changed(&fit_joint(&request).unwrap(), &[&recording], doubt)
        };
        assert_eq!(found(1.0, true), None);
        assert_eq!(found(5.0, false), None);
        assert!(found(5.0, true).is_some());
        let said = found(15.0, false).unwrap();
        let [low, high] = ["low", "high"].map(|name| said.value(name).unwrap());
        assert!(high - low > 10.0 && low > 25.0 && high < 40.0, "{said:?}");
    }
}
