//! Doubts about a joint fit, as findings.

use crate::methods::joint::{Flagged, JointFit, Missing, Reason, Scope, Seen};
use findings::{Finding, Findings, Kind};
use recording::averages::median;

findings::tuning! {
    /// A placement off by so much, m/s², though nothing shook it, was not touched: the sensor lies otherwise in its case, or
    /// something lifts it.
    APART: f64 = 0.1;

    /// A rest whose absence moves a parameter by so many of its standard errors is named.
    INFLUENTIAL: f64 = 4.0;

    /// An effect is said to be missing where chance makes the rows speak so for one in fewer recordings than this.
    SPEAKS: f64 = 2e-3;

    /// ... and by so many times what half of the turns miss: where all are spoilt none tells how a placement lies.
    ABOVE_TURNS: f64 = 5.0;
}

/// The placements whose force no touch explains: nothing shook, and they are off by more than [`APART`] and [`ABOVE_TURNS`].
pub fn placements_apart(fit: &JointFit) -> Option<Finding> {
    let missed = fit.gravity * median(fit.chords.iter().copied()).unwrap_or(0.0);
    let apart = |a: &&Flagged| {
        let is_pushed = a.fault.opens_force && a.reason == Reason::Disturbed;
        is_pushed && !a.shook && a.size > APART.get().max(ABOVE_TURNS.get() * missed)
    };
    let all: Vec<String> = fit
        .flagged
        .iter()
        .filter(apart)
        .map(|a| {
            let name = &fit.data.sources[a.recording].name;
            format!(
                "static interval {} of {name} by {:.2} m/s²",
                a.interval + 1,
                a.size
            )
        })
        .collect();
    let places = all.join(", ");
    (!all.is_empty()).then(|| Finding::of(Kind::PLACEMENTS_APART).detail("places", places))
}

/// An effect that the rows speak for though no channel as a whole misfits: its part in the errors is not in them.
pub fn of_missing(missing: &Missing) -> Option<Finding> {
    (missing.p_value < SPEAKS.get()).then(|| {
        let found = Finding::of(Kind::EFFECT_MISSING);
        let found = match missing.explains_most() {
            true => found
                .of_sensor(missing.effect.sensor())
                .detail("effect", missing.effect.name()),
            false => found,
        };
        found
            .number("statistic", missing.statistic, "1")
            .number("dof", missing.dof as f64, "count")
            .detail("p", format!("{:.0e}", missing.p_value))
    })
}

/// Names what was disturbed, with interval and times.
pub fn disturbances(fit: &JointFit, warnings: &mut Findings) {
    let name = |recording: usize| &fit.data.sources[recording].name;
    for lost in &fit.data.lost {
        warnings.push(
            Finding::of(Kind::TURN_LOST)
                .in_recording(name(lost.recording))
                .at_turn(lost.turn)
                .between(lost.span.from, lost.span.to)
                .detail("fault", lost.fault.to_string()),
        );
    }
    for (place, gap) in &fit.data.gaps {
        let rest = &fit.data.rests[*place];
        warnings.push(
            Finding::of(Kind::INTERVAL_GAP)
                .in_recording(name(rest.recording))
                .at_interval(rest.interval)
                .between(rest.span.from, rest.span.to)
                .number("gap", gap.length(), "s")
                .number("gap_from", gap.from, "s"),
        );
    }
    if let Some(shaken) = fit.data.shakes_throughout() {
        warnings.push(
            Finding::of(Kind::SHAKY_INTERVALS)
                .count("shaken", shaken)
                .count("all", fit.data.rests.len()),
        );
    }
    for (place, source) in fit.data.sources.iter().enumerate() {
        if source.sways() {
            warnings.push(Finding::of(Kind::DEVICE_SWAYS).in_recording(name(place)));
        }
    }
    for flagged in &fit.flagged {
        let kind = match flagged.reason {
            Reason::BiasStepped => Kind::BIAS_STEPPED,
            Reason::Disturbed => flagged.fault.kind,
        };
        let found = Finding::of(kind)
            .in_recording(name(flagged.recording))
            .between(flagged.span.from, flagged.span.to);
        let found = match flagged.fault.scope {
            Scope::Turn => found.at_turn(flagged.interval),
            Scope::StaticInterval | Scope::Chunk => found.at_interval(flagged.interval),
        };
        warnings.push(with_what_is_seen(found, flagged.seen));
    }
}

/// The finding with what is known of the disturbance.
fn with_what_is_seen(found: Finding, seen: Seen) -> Finding {
    match seen {
        Seen::Nothing => found,
        Seen::Shaken { time, ratio } => found
            .detail("shaken", format!("{time:.2} s"))
            .detail("times", format!("{ratio:.1}")),
        Seen::Cut => found.detail("cut", "static interval"),
        Seen::Crept { angle, slope } => found
            .number("angle", angle, "rad")
            .number("slope", slope, "m/s³"),
        Seen::Slipped(angle) => found.number("slip", angle, "rad"),
        Seen::Off(force) => found.number("force", force, "m/s^2"),
    }
}

/// Names the rests without which a parameter would be another.
pub fn influences(fit: &JointFit, warnings: &mut Findings) {
    for influence in fit.influential(INFLUENTIAL.get()) {
        let rest = &fit.data.rests[influence.rest];
        warnings.push(
            Finding::of(Kind::INFLUENTIAL_INTERVAL)
                .in_recording(&fit.data.sources[rest.recording].name)
                .at_interval(rest.interval)
                .between(rest.span.from, rest.span.to)
                .detail("parameter", influence.parameter.clone())
                .number("change", influence.change, "1"),
        );
    }
}
