//! Stamps that were taken for milliseconds and may count 1/1024 s, where no gyroscope in a known unit tells.

use findings::{Finding, Kind, OptionName, Remedy};
use recording::Recording;
use sensor::Sensor;

use super::columns::Columns;

/// Ticks in a second.
const TICKS: f64 = 1024.0;

/// Returns the finding about stamps whose rate is a usual one in ticks and not in milliseconds.
pub(super) fn ticked(recordings: &[&Recording]) -> Option<Finding> {
    let rate = |recording: &Recording| {
        let told = recording
            .warnings
            .iter()
            .find(|own| own.kind == Kind::TimeUnitTold)?;
        told.value("rate_in_ticks")
    };
    let (recording, rate) = recordings
        .iter()
        .find_map(|recording| Some((*recording, rate(recording)?)))?;
    let has_rates =
        recording.gyroscope.is_some() && Columns::of(&[recording], Sensor::Gyroscope).is_si(false);
    if has_rates {
        return None;
    }
    let described = recording.description.of(Sensor::Accelerometer)?;
    Some(
        Finding::of(Kind::ClockOfTicks)
            .in_recording(&recording.name)
            .number("rate", rate, "Hz")
            .only_remedies([Remedy::set_to(
                OptionName::Columns,
                described.by_clock(TICKS),
            )]),
    )
}
