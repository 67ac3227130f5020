//! Faults of a sensor or of a recording that the readings show before any model is fitted.
//!
//! ```text
//! file ──► Recording (stuck axes refused, an erased tail and frozen rows cut) ──► without_spikes ──► intervals ──► findings
//! ```

mod clipping;
mod dead_zone;
mod excursion;
mod level;
pub mod lone_sample;
mod motion;
mod of_sensor;
mod only_noise;
mod quantisation;
mod quietest;
mod repeated;
mod rezeroing;
mod spikes;
mod symptom;

pub use crate::recording::Frozen;
pub use clipping::Range;
pub(crate) use clipping::cut_off_at;
pub use dead_zone::{DeadZone, dead_zones};
pub(crate) use excursion::Excursion;
pub(crate) use level::{LevelChange, level_change};
pub use motion::hand::{FASTEST_HAND, tremor};
pub use only_noise::only_noise;
pub use quantisation::{COARSE, error_of_steps};
pub use quietest::{Quiet, quietest};
pub(crate) use repeated::erased_tail::cut_erased_tail;
pub(crate) use repeated::failed_reads::without_failed_reads;
pub(crate) use repeated::frozen::{frozen, frozen_finding, without_frozen};
pub(crate) use repeated::stale::without_stale;
pub(crate) use repeated::stopped::refuse_stopped;
pub(crate) use repeated::stuck::stuck;
pub use spikes::without_spikes;
pub use symptom::Symptom;

use sensor::Sensor;

use self::motion::{hand, swing, turning, vibration};
use self::of_sensor::OfSensor;
pub use self::of_sensor::least_step;
use crate::intervals::Segmentation;
use crate::recording::Recording;

/// Returns the fault that hides a gyroscope's true bias, if any: a dead zone, or a zero that the device sets anew.
pub fn altered_bias(recording: &Recording, segmentation: &Segmentation) -> Option<Symptom> {
    let of = OfSensor::new(Sensor::Gyroscope, recording, segmentation)?;
    dead_zone::found(&of).or_else(|| rezeroing::found(&of))
}

/// Everything that the readings show once it is known where the device was still.
pub fn symptoms(recording: &Recording, segmentation: &Segmentation) -> Vec<Symptom> {
    let mut all: Vec<Symptom> = hand::found(recording).into_iter().collect();
    if all.is_empty() {
        all.extend(turning::found(recording, segmentation));
    }
    let lies_still = all.is_empty();
    for sensor in [Sensor::Accelerometer, Sensor::Gyroscope] {
        let Some(of) = OfSensor::new(sensor, recording, segmentation) else {
            continue;
        };
        let dead = dead_zone::found(&of);
        let coarse = quantisation::found(&of, dead.as_ref());
        all.extend(clipping::found(sensor, of.stream, &recording.warnings));
        // Where steps are wide, how much readings scatter says how near a step they are; a device that moves makes them scatter.
        if lies_still && dead.is_none() && coarse.is_none() {
            all.extend(vibration::found(&of));
            all.extend(swing::found(&of));
        }
        all.extend(dead);
        all.extend(coarse);
        if sensor == Sensor::Gyroscope {
            all.extend(rezeroing::found(&of));
        }
    }
    all.extend(clipped_field(recording));
    all
}

/// The axes of a magnetometer that are cut off.
fn clipped_field(recording: &Recording) -> Vec<Symptom> {
    let field = recording.magnetometer.as_ref();
    field.map_or_else(Vec::new, |field| {
        clipping::found(Sensor::Magnetometer, &field.stream, &recording.warnings)
    })
}
