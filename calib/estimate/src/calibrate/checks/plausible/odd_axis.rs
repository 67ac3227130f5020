//! An axis that reads more or less than the other two of its sensor: of another unit or range, or of an unusual sensor.

use findings::{Finding, Kind};
use sensor::Sensor;

use super::Said;
use super::columns::Columns;
use super::scales::{Scales, cause, in_words, undone};

/// A factor without a cause in this range may be the sensor's own, as in a prototype.
const OWN: std::ops::Range<f64> = 0.67..1.5;

/// Says which axis stands apart; true where one does.
pub(super) fn say_odd_axis(
    sensor: Sensor,
    scales: &Scales,
    columns: &Columns,
    is_si: bool,
    said: &mut Said,
) -> bool {
    let Some((axis, factor)) = scales.odd() else {
        return false;
    };
    let is_own = cause(factor).is_none() && OWN.contains(&factor);
    let others = [1, 2].map(|step| columns.roles[(axis + step) % 3]);
    let kind = if is_own {
        Kind::AXIS_APART
    } else {
        Kind::AXIS_UNIT
    };
    let found = Finding::of(kind)
        .of_sensor(sensor)
        .detail("axis", columns.roles[axis])
        .detail("times", in_words(factor))
        .detail("others", others.join(" and "))
        .detail(
            "what",
            if sensor == Sensor::Accelerometer {
                "force"
            } else {
                "rate"
            },
        )
        .only_remedies([columns.scaled(&[(axis, undone(factor))])]);
    match is_si && !is_own {
        true => said.gate(found),
        false => said.warn(found),
    }
    true
}
