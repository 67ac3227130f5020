//! Warnings about the readings behind an Allan deviation.

use findings::{Finding, Kind, Level, OptionName, Remedy, human};
use recording::intervals::Span;
use sensor::Sensor;

use super::curves::SensorCurves;
use super::samples::changes::{Drift, Step};
use super::terms::identify::NoiseTerms;
use super::terms::term::NoiseTerm;

findings::tuning! {
    /// Steps named in a sentence.
    LISTED: usize = 3;

    /// Share of missing samples from which it is said what they do.
    MANY_MISSING: f64 = 0.02;

    /// Share of held readings below which they are stretches, and above which the sensor is slower than the rows.
    FEW_HELD: f64 = 0.2;
}

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
    all.extend(of.coarse(fits));
    all.extend(of.outliers());
    for (axis, fit) in AXES.iter().zip(fits) {
        let unknown = fit.is_none().then(|| of.finding(Kind::NOISE_UNKNOWN));
        all.extend(unknown.map(|found| found.detail("axis", *axis)));
    }
    all.extend(of.misses(fits));
    all.extend(of.missing());
    for (k, axis) in AXES.iter().enumerate() {
        let drift = curves.drift[k].map(|drift| of.drifted(&drift, fits[k].as_ref()));
        let found = of.stepped(k).into_iter().chain(drift);
        all.extend(found.map(|found| found.detail("axis", *axis)));
    }
    all.extend(of.held());
    all
}

/// Names of the axes for which something holds.
fn axes(holds: impl Fn(usize) -> bool) -> String {
    let named = AXES.iter().enumerate().filter(|(k, _)| holds(*k));
    let names: Vec<&str> = named.map(|(_, axis)| *axis).collect();
    names.join(", ")
}

/// Unit of the readings.
fn unit(sensor: Sensor, in_counts: bool) -> Unit {
    match sensor {
        _ if in_counts => Unit {
            reading: "counts",
            density: "counts/√Hz",
            walk: "counts/√s",
        },
        Sensor::Gyroscope => Unit {
            reading: "rad/s",
            density: "rad/s/√Hz",
            walk: "rad/s/√s",
        },
        Sensor::Accelerometer => Unit {
            reading: "m/s^2",
            density: "m/s^2/√Hz",
            walk: "m/s^2/√s",
        },
        Sensor::Magnetometer => Unit {
            reading: "µT",
            density: "µT/√Hz",
            walk: "µT/√s",
        },
    }
}

/// Units of a sensor's readings, of their density and of their random walk.
#[derive(Clone, Copy)]
struct Unit {
    reading: &'static str,
    density: &'static str,
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

    /// Steps of the readings that are wider than their noise.
    fn coarse(&self, fits: &[Option<NoiseTerms>; 3]) -> Option<Finding> {
        let coarse = self.curves.coarse.iter();
        let widest = coarse.flatten().max_by(|a, b| a.step.total_cmp(&b.step))?;
        let is_coarse = |k: usize| self.curves.coarse[k].is_some();
        let white = (0..3)
            .filter(|&k| is_coarse(k))
            .filter_map(|k| fits[k].as_ref());
        let white = white.map(|fit| fit.get(NoiseTerm::WhiteNoise).interval.upper);
        let error = widest.step / 12f64.sqrt();
        let found = self
            .finding(Kind::QUANTISED)
            .detail("axes", axes(is_coarse))
            .number("step", widest.step, self.unit.reading)
            .number("noise", widest.spread, self.unit.reading)
            .number("error", error, self.unit.reading);
        Some(match white.reduce(f64::max) {
            Some(white) => found.number("white", white, self.unit.density),
            None => found,
        })
    }

    /// Single samples that are left out.
    fn outliers(&self) -> Option<Finding> {
        let outliers = &self.curves.outliers;
        let times: Vec<String> = outliers.times.iter().map(|t| format!("{t:.2}")).collect();
        let more = match outliers.count > times.len() {
            true => " and more",
            false => "",
        };
        (outliers.count > 0).then(|| {
            self.finding(Kind::SPIKES)
                .count("count", outliers.count)
                .detail("axes", axes(|k| outliers.axes[k]))
                .number("largest", outliers.largest, self.unit.reading)
                .detail("times", format!("{} s{more}", times.join(", ")))
        })
    }

    /// The times that the terms miss, of all axes that they miss. Where the readings are coarse, that is the cause.
    fn misses(&self, fits: &[Option<NoiseTerms>; 3]) -> Option<Finding> {
        let step = self.curves.axes[0].step;
        let miss = |k: usize| {
            let fit = fits[k]
                .as_ref()
                .filter(|_| self.curves.coarse[k].is_none())?;
            let misses = fit.model_error > 0.0 || !fit.reach(step) || !fit.is_known;
            misses.then_some(fit)
        };
        let missed: Vec<&NoiseTerms> = (0..3).filter_map(miss).collect();
        let largest =
            |of: fn(&NoiseTerms) -> f64| missed.iter().map(|fit| of(fit)).fold(0.0, f64::max);
        let (error, shortest) = (
            largest(|fit| fit.model_error),
            largest(|fit| fit.shortest_tau),
        );
        let mut found = self
            .finding(Kind::NOISE_MODEL_MISSES)
            .detail("axis", axes(|k| miss(k).is_some()));
        if missed.is_empty() {
            return None;
        }
        if missed.iter().any(|fit| !fit.is_known) {
            let longest = largest(|fit| fit.longest_tau);
            return Some(found.number("longest", longest, "s").at_level(Level::Care));
        }
        if error > 0.0 {
            found = found.number("share", error, "share");
        }
        if missed.iter().any(|fit| !fit.reach(step)) {
            found = found.number("shortest", shortest, "s");
        }
        Some(found)
    }

    fn missing(&self) -> Vec<Finding> {
        let mut all = Vec::new();
        let (bridged, samples) = (self.curves.bridged, self.curves.axes[0].samples);
        if bridged > 0 {
            let share = bridged as f64 / samples as f64;
            let missing = self
                .finding(Kind::NOISE_SAMPLES_MISSING)
                .count("bridged", bridged)
                .count("samples", samples)
                .number("share", share, "share");
            // A bridge adds at most 1.5 times the variance of the samples in whose place it is.
            all.push(match share > MANY_MISSING.get() {
                true => missing
                    .number("excess", 0.75 * share, "share")
                    .at_level(Level::Care),
                false => missing,
            });
        }
        if self.curves.gaps > 0 {
            let gaps = self.finding(Kind::NOISE_GAPS);
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
        let listed: Vec<String> = steps.iter().take(LISTED.get()).map(one).collect();
        let squares: f64 = steps.iter().map(|step| step.size * step.size).sum();
        let longest = longest_between(steps, whole);
        let beside = format!("{:.0},{:.0}", longest.from.ceil(), longest.to.floor());
        let found = self
            .finding(Kind::MEAN_STEPS)
            .count("count", steps.len())
            .number("walk", (squares / whole.length()).sqrt(), self.unit.walk)
            .detail("listed", listed.join(", "))
            .only_remedies([Remedy::set_to(OptionName::Rest, beside)]);
        Some(match steps.len().saturating_sub(LISTED.get()) {
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
            .finding(Kind::MEAN_DRIFTS)
            .number("change", drift.change, self.unit.reading)
            .number("time", drift.span.length(), "s");
        match tau {
            Some(tau) => found.number("tau", tau, "s"),
            None => found,
        }
    }

    fn held(&self) -> Option<Finding> {
        let held = &self.curves.held;
        if !held.stretches.is_empty() && held.share < FEW_HELD.get() {
            let one = |s: &Span| format!("{:.1} to {:.1} s", s.from, s.to);
            let listed: Vec<String> = held.stretches.iter().take(LISTED.get()).map(one).collect();
            let more = match held.stretches.len() > LISTED.get() {
                true => " and more",
                false => "",
            };
            let found = self.finding(Kind::READINGS_HELD);
            return Some(found.detail("listed", listed.join(", ") + more));
        }
        let slower = self.finding(Kind::ROWS_FASTER_THAN_SENSOR);
        (held.share > 0.0).then(|| slower.number("share", held.share, "share"))
    }
}

/// The longest stretch without a step.
fn longest_between(steps: &[Step], whole: Span) -> Span {
    let times = steps.iter().map(|step| step.t);
    let edges: Vec<f64> = std::iter::once(whole.from - BESIDE.get())
        .chain(times)
        .chain([whole.to + BESIDE.get()])
        .collect();
    let between = edges.windows(2).map(|pair| Span {
        from: pair[0] + BESIDE.get(),
        to: pair[1] - BESIDE.get(),
    });
    let longest = between.max_by(|a, b| a.length().total_cmp(&b.length()));
    longest.unwrap_or(whole)
}

findings::tuning! {
    /// Time beside a step that is left out with it, s.
    BESIDE: f64 = 3.0;
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
