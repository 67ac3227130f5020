//! Sensors with an axis that reads nothing but noise.

use findings::{Finding, Findings, Kind};
use recording::Recording;
use recording::readings::only_noise;
use sensor::Sensor;

/// Builds a finding of each sensor with an axis that reads nothing but noise while the others turn.
pub(in crate::calibrate) fn dead_axes(recording: &Recording) -> Vec<Finding> {
    let sensors = [Sensor::Accelerometer, Sensor::Gyroscope].into_iter();
    let found = sensors.filter_map(|sensor| {
        let axis = only_noise(&recording.stream(sensor)?.values)?;
        let found = Finding::of(Kind::AXIS_ONLY_NOISE).of_sensor(sensor);
        let found = found.in_recording(&recording.name);
        Some(found.detail("axis", ["x", "y", "z"][axis]))
    });
    found.collect()
}

/// Puts an axis that reads nothing but noise before the gates that it makes fail.
pub(in crate::calibrate) fn say_dead_axes(gates: &mut Findings, recording: &Recording) {
    for axis in dead_axes(recording) {
        let follows = |gate: &Finding| {
            let kinds = [
                Kind::GRAVITY_MISSED,
                Kind::AXES_NOT_SHOWN,
                Kind::LEFT_HANDED,
            ];
            gate.place.sensor == axis.place.sensor && kinds.contains(&gate.kind)
        };
        gates.retain(|gate| !follows(gate));
        gates.push_first(axis);
    }
}
