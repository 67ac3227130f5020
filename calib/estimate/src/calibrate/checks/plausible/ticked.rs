//! Stamps that were taken for milliseconds and may count 1/1024 s, where no gyroscope in a known unit tells.

use findings::{Finding, Kind, OptionName, Remedy};
use recording::Recording;
use sensor::Sensor;

use super::columns::Columns;

findings::tuning! {
    /// Ticks in a second of clocks that come from the crystal of a watch, by 32.
    pub(super) TICKS: f64 = 1024.0;
}

/// Returns the finding about stamps whose rate is a usual one in ticks and not in milliseconds.
pub(super) fn ticked(recordings: &[&Recording]) -> Option<Finding> {
    let rate = |recording: &Recording| {
        let told = recording
            .warnings
            .iter()
            .find(|own| own.kind == Kind::TIME_UNIT_TOLD)?;
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
    Some(clock_of_ticks(recording, Sensor::Accelerometer)?.number("rate", rate, "Hz"))
}

/// The finding about the clock of a sensor that may count so, with the columns that read it as that.
pub(super) fn clock_of_ticks(recording: &Recording, sensor: Sensor) -> Option<Finding> {
    let by_ticks = recording.description.of(sensor)?.by_clock(TICKS.get());
    let found = Finding::of(Kind::CLOCK_OF_TICKS).in_recording(&recording.name);
    Some(found.only_remedies([Remedy::set_to(OptionName::Columns, by_ticks)]))
}
