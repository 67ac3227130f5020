//! Warnings about the readings behind an Allan deviation.

use findings::{Finding, Kind, Level, OptionName, Remedy, human};
use recording::intervals::Span;
use sensor::Sensor;

use super::changes::{Drift, Step};
use super::curves::SensorCurves;
use super::identify::NoiseTerms;
use super::term::NoiseTerm;

/// Steps named in a sentence.
const LISTED: usize = 3;

/// Share of missing samples from which it is said what they do.
const MANY_MISSING: f64 = 0.02;

/// Share of held readings below which they are stretches, and above which the sensor is slower than the rows.
const FEW_HELD: f64 = 0.2;

/// Names of the axes.
const AXES: [&str; 3] = ["x", "y", "z"];

/// Returns the warnings of one sensor, the most important first.
pub(super) fn of_sensor(
    curves: &SensorCurves,
    fits: &[Option<NoiseTerms>; 3],
    sensor: Sensor,
) -> Vec<Finding> {
    let of = Of {
        curves,
        sensor,
        unit: unit(sensor, curves.in_counts),
    };
    let mut all = Vec::new();
    for (axis, fit) in AXES.iter().zip(fits) {
        all.extend(
            of.fit(fit.as_ref())
                .map(|found| found.detail("axis", *axis)),
        );
    }
    all.extend(of.missing());
    for (k, axis) in AXES.iter().enumerate() {
        let drift = curves.drift[k].map(|drift| of.drifted(&drift, fits[k].as_ref()));
        let found = of.stepped(k).into_iter().chain(drift);
        all.extend(found.map(|found| found.detail("axis", *axis)));
    }
    all.extend(of.held());
    all
}

/// Unit of the readings.
fn unit(sensor: Sensor, in_counts: bool) -> Unit {
    match sensor {
        _ if in_counts => Unit {
            reading: "counts",
            walk: "counts/√s",
        },
        Sensor::Gyroscope => Unit {
            reading: "rad/s",
            walk: "rad/s/√s",
        },
        Sensor::Accelerometer => Unit {
            reading: "m/s^2",
            walk: "m/s^2/√s",
        },
        Sensor::Magnetometer => Unit {
            reading: "µT",
            walk: "µT/√s",
        },
    }
}

/// Units of a sensor's readings and of their random walk.
#[derive(Clone, Copy)]
struct Unit {
    reading: &'static str,
    walk: &'static str,
}

/// The curves of a sensor.
struct Of<'a> {
    curves: &'a SensorCurves,
    sensor: Sensor,
    unit: Unit,
}

impl Of<'_> {
    fn finding(&self, kind: Kind) -> Finding {
        Finding::of(kind).of_sensor(self.sensor)
    }

    /// Returns the fault of a fit, if any.
    fn fit(&self, fit: Option<&NoiseTerms>) -> Option<Finding> {
        match fit {
            None => Some(self.finding(Kind::NoiseUnknown)),
            Some(fit) if fit.model_error > 0.0 => {
                let misses = self.finding(Kind::NoiseModelMisses);
                Some(misses.number("share", fit.model_error, "share"))
            }
            Some(_) => None,
        }
    }

    fn missing(&self) -> Vec<Finding> {
        let mut all = Vec::new();
        let (bridged, samples) = (self.curves.bridged, self.curves.axes[0].samples);
        if bridged > 0 {
            let share = bridged as f64 / samples as f64;
            let missing = self
                .finding(Kind::NoiseSamplesMissing)
                .count("bridged", bridged)
                .count("samples", samples)
                .number("share", share, "share");
            // A bridge adds at most 1.5 times the variance of the samples in whose place it is.
            all.push(match share > MANY_MISSING {
                true => missing
                    .number("excess", 0.75 * share, "share")
                    .at_level(Level::Care),
                false => missing,
            });
        }
        if self.curves.gaps > 0 {
            let gaps = self.finding(Kind::NoiseGaps);
            all.push(gaps.count("count", self.curves.gaps));
        }
        all
    }

    /// A step looks like a random walk: `(X² τ/3)/T`.
    fn stepped(&self, axis: usize) -> Option<Finding> {
        let steps = &self.curves.steps[axis];
        if steps.is_empty() {
            return None;
        }
        let whole = self.curves.covered;
        let one = |step: &Step| {
            format!(
                "{} at t = {:.0} s",
                human(step.size, self.unit.reading),
                step.t
            )
        };
        let listed: Vec<String> = steps.iter().take(LISTED).map(one).collect();
        let squares: f64 = steps.iter().map(|step| step.size * step.size).sum();
        let longest = longest_between(steps, whole);
        let beside = format!("{:.0},{:.0}", longest.from.ceil(), longest.to.floor());
        let found = self
            .finding(Kind::MeanSteps)
            .count("count", steps.len())
            .number("walk", (squares / whole.length()).sqrt(), self.unit.walk)
            .detail("listed", listed.join(", "))
            .only_remedies([Remedy::set_to(OptionName::Rest, beside)]);
        Some(match steps.len().saturating_sub(LISTED) {
            0 => found,
            more => found.count("more", more),
        })
    }

    /// A drift is a ramp: `σ(τ) = R τ/√2`.
    fn drifted(&self, drift: &Drift, fit: Option<&NoiseTerms>) -> Finding {
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
        let found = self
            .finding(Kind::MeanDrifts)
            .number("change", drift.change, self.unit.reading)
            .number("time", drift.span.length(), "s");
        match tau {
            Some(tau) => found.number("tau", tau, "s"),
            None => found,
        }
    }

    fn held(&self) -> Option<Finding> {
        let held = &self.curves.held;
        if !held.stretches.is_empty() && held.share < FEW_HELD {
            let one = |s: &Span| format!("{:.1} to {:.1} s", s.from, s.to);
            let listed: Vec<String> = held.stretches.iter().take(LISTED).map(one).collect();
            let more = match held.stretches.len() > LISTED {
                true => " and more",
                false => "",
            };
            let found = self.finding(Kind::ReadingsHeld);
            return Some(found.detail("listed", listed.join(", ") + more));
        }
        let slower = self.finding(Kind::RowsFasterThanSensor);
        (held.share > 0.0).then(|| slower.number("share", held.share, "share"))
    }
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
