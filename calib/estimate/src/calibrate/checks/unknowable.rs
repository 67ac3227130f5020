//! Effects that a calibration cannot know, by what they look at.

use findings::{Finding, Kind};
use recording::intervals::Segmentation;
use recording::{Error, Recording};
use sensor::{EffectRef, Quantity, Sensor};

use crate::methods::RawUnit;
use crate::truth::{Models, Sensing, require, silent_at_static_intervals, without_instant};

/// Refuses effects of which a parameter, or what they look at, cannot be known of these recordings.
pub fn refuse_unknowable<'a>(
    recordings: impl IntoIterator<Item = (&'a Recording, &'a Segmentation)>,
    effects: &[EffectRef],
) -> Result<(), Error> {
    let first = |model| Some(Sensing::first(model, RawUnit::SI));
    let models = Models {
        accelerometer: first(accelerometer::model()),
        gyroscope: first(gyroscope::model()),
        magnetometer: first(magnetometer::model()),
    };
    for effect in effects {
        silent_at_static_intervals(effect)?;
        without_instant(effect)?;
    }
    for (recording, segmentation) in recordings {
        for effect in effects {
            if recording.stream(effect.sensor()).is_some() {
                require(recording, Some(segmentation), &models, effect)?;
            }
        }
    }
    Ok(())
}

/// Refuses effects of the accelerometer that look at the attitude: it comes from the gyroscope, which the stepwise method
/// calibrates after the accelerometer.
pub fn refuse_attitude(effects: &[EffectRef]) -> Result<(), Error> {
    let looks = |effect: &&EffectRef| {
        effect.sensor() == Sensor::Accelerometer && effect.needs().contains(&Quantity::Attitude)
    };
    effects.iter().find(looks).map_or(Ok(()), |effect| {
        let found = Finding::of(Kind::EFFECT_NEEDS_ATTITUDE).detail("effect", effect.name());
        Err(Error::not_enough(found))
    })
}
