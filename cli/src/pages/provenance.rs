//! Provenance of a result: recordings, gravity, options, version.

use calib::Calibration;
use calib::Recording;
use calib::calibration::{Input, Provenance};
use calib::gravity::GravitySource;

use crate::show;

/// Rows of a calibration.
pub fn rows(calibration: &Calibration) -> Vec<[String; 2]> {
    let mut rows = inputs(&calibration.provenance.inputs);
    rows.push([
        "gravity".into(),
        format!(
            "{} m/s², {}",
            calibration.gravity,
            source(&calibration.gravity_source)
        ),
    ]);
    rows.push(["method".into(), calibration.method.clone()]);
    rows.extend(options(&calibration.provenance));
    for clock in &calibration.clocks {
        rows.push([
            format!("clock of {}", show::name(&clock.recording)),
            format!("{} (chosen by: {})", clock.clock, clock.chosen_by),
        ]);
    }
    rows.push(["program".into(), calibration.created_by.clone()]);
    rows
}

/// Rows of recordings that no calibration was made from.
pub fn of_recordings(recordings: &[Recording]) -> Vec<[String; 2]> {
    let all = recordings.iter().map(|r| Input::of(r, None, [None, None]));
    let mut rows = inputs(&all.collect::<Vec<_>>());
    rows.push([
        "program".into(),
        concat!("stillpoint ", env!("CARGO_PKG_VERSION")).into(),
    ]);
    rows
}

fn inputs(all: &[Input]) -> Vec<[String; 2]> {
    let mut rows = Vec::new();
    for input in all {
        let mut parts = Vec::new();
        for (name, sensor) in [
            ("accelerometer", &input.accelerometer),
            ("gyroscope", &input.gyroscope),
        ] {
            if let Some(sensor) = sensor {
                let rate = sensor
                    .rate
                    .map_or(String::new(), |rate| format!(" at {rate:.2} Hz"));
                parts.push(format!(
                    "{name} {} samples{rate} in {}",
                    sensor.samples, sensor.unit
                ));
            }
        }
        parts.push(match &input.temperature {
            Some(t) => format!("temperature {:.1} to {:.1} °C", t.least, t.greatest),
            None => "no temperature".into(),
        });
        parts.push(format!("t = {:.2} to {:.2} s", input.time_zero, input.end));
        parts.push(format!("SHA-256 of the samples {}", input.samples_sha256));
        rows.push([show::name(&input.recording), parts.join("; ")]);
    }
    rows
}

/// Returns the source of gravity, in words.
pub fn source(source: &GravitySource) -> String {
    match source {
        GravitySource::Given => "given".into(),
        GravitySource::Place { latitude, altitude } => format!(
            "normal gravity at latitude {latitude}°, height {}",
            altitude.map_or("sea level (assumed)".into(), |h| format!("{h} m"))
        ),
        GravitySource::Assumed => "assumed: nothing is known of the place".into(),
    }
}

fn options(provenance: &Provenance) -> Option<[String; 2]> {
    let o = provenance.options.as_ref()?;
    let mut parts = vec![
        format!("frame {}", o.frame),
        format!("integrator {}", o.integrator),
        format!("gyroscope bias {}", o.gyro_bias),
        format!("clock {}", o.clock),
        format!("static intervals of {} s and more", o.min_static),
        format!(
            "multipliers {}",
            o.multipliers
                .iter()
                .map(ToString::to_string)
                .collect::<Vec<_>>()
                .join(", ")
        ),
    ];
    if o.sections {
        parts.push("static intervals given by hand".into());
    }
    if !o.left_out.is_empty() {
        let instants = o
            .left_out
            .iter()
            .map(|i| format!("{} s of recording {}", i.t, i.recording));
        let instants = instants.collect::<Vec<_>>().join(", ");
        parts.push(format!("static intervals left out at {instants}"));
    }
    if !o.effects.is_empty() {
        parts.push(format!("effects {}", o.effects.join(", ")));
    }
    if let Some(latitude) = o.latitude {
        parts.push(format!("latitude {latitude}°"));
    }
    Some(["options".into(), parts.join("; ")])
}
