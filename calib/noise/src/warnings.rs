//! What a user should know of the readings that an Allan deviation was made from.

use recording::intervals::Span;
use recording::significant;
use sensor::Sensor;

use super::changes::{Drift, Step};
use super::curves::SensorCurves;
use super::identify::NoiseTerms;
use super::term::NoiseTerm;

/// Steps named in a sentence.
const LISTED: usize = 3;

/// Share of missing samples from which it is said what they do.
const MANY_MISSING: f64 = 0.02;

/// Names of the axes.
const AXES: [&str; 3] = ["x", "y", "z"];

/// A figure in the unit that people use for changes of a sensor's mean.
fn shown(value: f64, sensor: Sensor, in_counts: bool) -> String {
    let (factor, unit) = match sensor {
        _ if in_counts => (1.0, "counts"),
        Sensor::Gyroscope => (1f64.to_degrees() * 3600.0, "°/h"),
        Sensor::Accelerometer => (1e3, "mm/s²"),
        Sensor::Magnetometer => (1.0, "µT"),
    };
    format!("{} {unit}", significant(value * factor, 3))
}

/// Of one sensor, in the order in which it matters.
pub(super) fn of_sensor(
    curves: &SensorCurves,
    fits: &[Option<NoiseTerms>; 3],
    sensor: Sensor,
) -> Vec<String> {
    let mut all = Vec::new();
    for (axis, fit) in AXES.iter().zip(fits) {
        all.extend(of_fit(fit.as_ref()).map(|w| format!("{} {axis}: {w}", sensor.prefix())));
    }
    all.extend(missing(curves, sensor));
    for (k, axis) in AXES.iter().enumerate() {
        let name = format!("{} {axis}", sensor.prefix());
        let counted = |value: f64| shown(value, sensor, curves.in_counts);
        all.extend(stepped(&name, curves, k, counted));
        all.extend(curves.drift[k].map(|drift| drifted(&name, &drift, fits[k].as_ref(), counted)));
    }
    all.extend(held(curves, sensor));
    all
}

/// What is wrong with a fit, if anything.
fn of_fit(fit: Option<&NoiseTerms>) -> Option<String> {
    match fit {
        None => Some("too short, or a signal that never changes: no noise terms".into()),
        Some(fit) if fit.model_error > 0.0 => Some(format!(
            "five noise terms miss the Allan variance by {:.0} % (a filter, a resonance or a motion); \
             the intervals include that",
            100.0 * fit.model_error
        )),
        Some(_) => None,
    }
}

fn missing(curves: &SensorCurves, sensor: Sensor) -> Vec<String> {
    let mut all = Vec::new();
    let (bridged, samples) = (curves.bridged, curves.axes[0].samples);
    if bridged > 0 {
        let share = bridged as f64 / samples as f64;
        // A bridge adds at most 1.5 times the variance of the samples in whose place it is.
        let effect = if share > MANY_MISSING {
            format!(
                "; the white noise may be stated up to {:.0} % too large",
                75.0 * share
            )
        } else {
            String::new()
        };
        all.push(format!(
            "{}: {bridged} of {samples} samples are missing ({} %), singly or a few at a time; they are bridged by straight \
             lines{effect}",
            sensor.prefix(),
            significant(100.0 * share, 3)
        ));
    }
    if curves.gaps > 0 {
        all.push(format!(
            "{}: {} gap{} in the recording; no difference reaches across",
            sensor.prefix(),
            curves.gaps,
            if curves.gaps == 1 { "" } else { "s" }
        ));
    }
    all
}

/// A step looks like a random walk: `(X² τ/3)/T`.
fn stepped(
    name: &str,
    curves: &SensorCurves,
    axis: usize,
    counted: impl Fn(f64) -> String,
) -> Option<String> {
    let steps = &curves.steps[axis];
    let (first, last) = (steps.first()?, steps.last()?);
    let whole = curves.covered;
    let listed: Vec<String> = steps
        .iter()
        .take(LISTED)
        .map(|step| format!("{} at t = {:.0} s", counted(step.size), step.t))
        .collect();
    let more = match steps.len().saturating_sub(LISTED) {
        0 => String::new(),
        more => format!(" and {more} more times"),
    };
    let squares: f64 = steps.iter().map(|step| step.size * step.size).sum();
    let walk = (squares / whole.length()).sqrt();
    let longest = longest_between(steps, whole);
    let what = if first == last {
        "that step looks"
    } else {
        "those steps look"
    };
    Some(format!(
        "{name} steps by {}{more}. {what} like a random walk of {}/√s, and the bias instability includes {}; --rest {:.0},{:.0} \
         leaves {} out",
        listed.join(", "),
        counted(walk),
        if first == last { "it" } else { "them" },
        longest.from.ceil(),
        longest.to.floor(),
        if first == last { "it" } else { "them" },
    ))
}

/// The longest stretch without a step.
fn longest_between(steps: &[Step], whole: Span) -> Span {
    let times = steps.iter().map(|step| step.t);
    let edges: Vec<f64> = std::iter::once(whole.from - BESIDE)
        .chain(times)
        .chain([whole.to + BESIDE])
        .collect();
    let between = edges.windows(2).map(|pair| Span {
        from: pair[0] + BESIDE,
        to: pair[1] - BESIDE,
    });
    let longest = between.max_by(|a, b| a.length().total_cmp(&b.length()));
    longest.unwrap_or(whole)
}

/// Time beside a step that is left out with it, s.
const BESIDE: f64 = 3.0;

/// A drift is a ramp: `σ(τ) = R τ/√2`.
fn drifted(
    name: &str,
    drift: &Drift,
    fit: Option<&NoiseTerms>,
    counted: impl Fn(f64) -> String,
) -> String {
    let rate = drift.change / drift.span.length();
    let is_half = |tau: &f64| {
        NoiseTerm::Ramp.variance(*tau) * rate * rate
            > 0.5 * fit.map_or(0.0, |f| f.deviation(*tau)).powi(2)
    };
    let longest = fit.map_or(drift.span.length() / 4.0, |fit| fit.longest_tau);
    let tau = (0..40)
        .map(|k| longest / f64::from(k).exp2())
        .take_while(is_half)
        .last();
    let effect = match tau {
        Some(tau) => format!(
            "beyond τ = {} s the Allan deviation is mostly that",
            significant(tau, 3)
        ),
        None => "the ramp and the random walk include it".into(),
    };
    format!(
        "{name} drifts by {} in {:.0} s, as smoothly as no noise does: {effect}. Record after the warm-up and at an even \
         temperature, or analyse a steadier stretch with --rest T0,T1",
        counted(drift.change),
        drift.span.length()
    )
}

fn held(curves: &SensorCurves, sensor: Sensor) -> Vec<String> {
    let prefix = sensor.prefix();
    let mut all = Vec::new();
    let stretches = &curves.held.stretches;
    if !stretches.is_empty() && curves.held.share < 0.2 {
        let listed: Vec<String> = stretches
            .iter()
            .take(LISTED)
            .map(|s| format!("{:.1} to {:.1} s", s.from, s.to))
            .collect();
        all.push(format!(
            "{prefix}: the readings stand still at t = {}{}: there nothing was measured, and the noise is stated too small; \
             --rest T0,T1 analyses a stretch beside",
            listed.join(", "),
            if stretches.len() > LISTED { " and more" } else { "" }
        ));
    } else if curves.held.share > 0.0 {
        all.push(format!(
            "{prefix}: {:.0} % of the rows repeat the readings before on all axes: the sensor is slower than the rows. The \
             deviation below a few samples and the quantisation noise are not the sensor's",
            100.0 * curves.held.share
        ));
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_stretch_that_is_offered_has_no_step() {
        let step = |t: f64| Step { t, size: 1.0 };
        let whole = Span {
            from: 0.0,
            to: 3600.0,
        };
        let offered = longest_between(&[step(305.0)], whole);
        assert_eq!(
            offered,
            Span {
                from: 308.0,
                to: 3600.0
            }
        );
        let offered = longest_between(&[step(305.0), step(3000.0), step(3500.0)], whole);
        assert_eq!(
            offered,
            Span {
                from: 308.0,
                to: 2997.0
            }
        );
    }
}
