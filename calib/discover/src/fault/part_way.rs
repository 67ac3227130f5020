//! Readings that are another part of the way: no law of a sensor follows a range that is switched, or a column with another sign.

use ::findings::Finding;
use estimate::calibrate::{changes_part_way, is_read_otherwise};
use recording::Recording;
use recording::intervals::Segmentation;
use sensor::{Base, Sensor};

use crate::request::Session;
use crate::state::State;

/// Scale factors, signs and columns that change part of the way through a recording, by the gyroscope of the base models.
pub fn read_otherwise(
    session: &Session<'_>,
    base: &State,
    recording: &Recording,
    segmentation: &Segmentation,
) -> Vec<Finding> {
    let fit = &base.fit;
    let gyroscope = fit.has_gyroscope().then(|| {
        let fitted = fit.fitted(Sensor::Gyroscope);
        let t = Base::from_parameters(fitted.parameters.values()).t;
        (t, fit.direction_rms())
    });
    let mut found = changes_part_way(recording, segmentation, session.request.gravity, gyroscope);
    found.retain(is_read_otherwise);
    found
}
