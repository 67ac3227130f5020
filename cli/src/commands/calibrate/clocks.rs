//! The clocks of recordings in words.

use calib::Calibration;
use calib::calibration::RecordingClock;

/// One line for every recording whose clock was a choice or that misses something between samples.
pub fn text(calibration: &Calibration) -> String {
    let lines = calibration.clocks.iter().filter_map(line);
    lines.map(|line| line + "\n").collect()
}

fn line(clock: &RecordingClock) -> Option<String> {
    let mut parts = Vec::new();
    match clock.chosen_by.as_str() {
        "exact" => {}
        "request" if clock.clock == "stamps" => {}
        "request" if clock.step_ms > 0.0 => {
            parts.push(format!("even, as asked for: {}", scatter(clock)))
        }
        "request" => parts.push("even, as asked for".into()),
        "uncountable" => parts.push(format!(
            "the stamps, which scatter by {:.2} ms",
            clock.scatter_ms
        )),
        "undecided" => parts.push(format!(
            "{}, though the turns fit {} as well: {}",
            name(clock),
            other(clock),
            scatter(clock)
        )),
        _ => parts.push(format!("{}: {}", name(clock), scatter(clock))),
    }
    if let (Some(share), Some(std)) = (clock.share_fitted, clock.share_std) {
        parts.push(format!(
            "{share:.2} ± {std:.2} of that scatter is in the samples themselves, taken as {:.2}",
            clock.share
        ));
    }
    if clock.gaps > 0 {
        parts.push(format!(
            "{} of {} steps without a sample, in {} places",
            clock.lost, clock.ticks, clock.gaps
        ));
    }
    if let Some(missing) = &clock.between_samples {
        let [low, high] = missing.share_between;
        parts.push(format!(
            "{:.2} ({low:.2} to {high:.2}) of each jump of the rate between samples is missing in the angle, {:.3}° rms \
             per turn",
            missing.share, missing.degrees
        ));
    }
    let text = parts.join("; ");
    (!parts.is_empty()).then(|| format!("clock of {}: {text}", clock.recording))
}

fn name(clock: &RecordingClock) -> &str {
    match clock.clock.as_str() {
        "stamps" => "the stamps",
        "even" => "an even clock",
        _ => "between the stamps and an even clock",
    }
}

/// The clock that was not taken.
fn other(clock: &RecordingClock) -> &str {
    match clock.clock.as_str() {
        "stamps" => "an even clock",
        _ => "the stamps",
    }
}

fn scatter(clock: &RecordingClock) -> String {
    format!(
        "stamps scatter by {:.2} ms; the usual step is {:.3} ms",
        clock.scatter_ms, clock.step_ms
    )
}
