//! A calibration against limits.

use super::line::{Bound, Limit, LimitLine};
use super::quantity::{Class, largest_error, parameter, unit};
use super::{Limits, RequiredSensor};
use crate::calibration::{Calibration, Triad};

/// The lines of `limits` for a calibration, in the order of the file's sections.
pub fn judge(limits: &Limits, calibration: &Calibration) -> Vec<LimitLine> {
    lines(limits, calibration, None)
}

/// Residuals of corrected readings.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Residuals {
    /// Length of the specific force at rest less gravity, rms, m/s².
    pub at_rest: Option<f64>,
    /// Direction of gravity after a turn, rms, °.
    pub after_turn: Option<f64>,
}

/// The same with these residuals, as of a recording that the calibration has not seen. The reduced chi² stays that of the calibration.
pub fn judge_on(
    limits: &Limits,
    calibration: &Calibration,
    residuals: Residuals,
) -> Vec<LimitLine> {
    lines(limits, calibration, Some(residuals))
}

fn lines(limits: &Limits, calibration: &Calibration, seen: Option<Residuals>) -> Vec<LimitLine> {
    let mut all = Lines(Vec::new());
    let (force, rate) = (&calibration.accelerometer, &calibration.gyroscope);
    for sensor in &limits.required {
        let (name, there) = match sensor {
            RequiredSensor::Accelerometer => ("required.accelerometer", force.is_some()),
            // A gyroscope of which only the bias is known is not calibrated.
            RequiredSensor::Gyroscope => (
                "required.gyroscope",
                rate.as_ref().is_some_and(|t| t.t_std[0][0].is_some()),
            ),
        };
        let value = Some(f64::from(u8::from(there)));
        all.line(name, "", Bound::Present, Some(1.0), value);
    }
    let own = &limits.accelerometer;
    let residual = match seen {
        Some(seen) => seen.at_rest,
        None => force.as_ref().map(|t| t.residual_rms),
    };
    let name = "accelerometer.residual_mm_s2";
    let residual = residual.map(|v| 1e3 * v);
    all.line(name, "mm/s^2", Bound::AtMost, own.residual_mm_s2, residual);
    let classes = [own.scale, own.misalignment, own.bias];
    let intervals = (
        own.intervals,
        force.as_ref().and_then(|t| t.static_intervals),
    );
    all.triad(
        "accelerometer",
        "m/s^2",
        force.as_ref(),
        own.reduced_chi2,
        classes,
        intervals,
    );
    let own = &limits.gyroscope;
    let residual = match seen {
        Some(seen) => seen.after_turn,
        None => rate.as_ref().map(|t| t.residual_rms),
    };
    let name = "gyroscope.residual_deg";
    all.line(name, "deg", Bound::AtMost, own.residual_deg, residual);
    let classes = [own.scale, own.misalignment, own.bias];
    let intervals = (
        own.intervals,
        rate.as_ref().and_then(|t| t.dynamic_intervals),
    );
    all.triad(
        "gyroscope",
        "rad/s",
        rate.as_ref(),
        own.reduced_chi2,
        classes,
        intervals,
    );
    for (name, most) in &limits.effects {
        let values = calibration.effects.iter().find(|e| &e.name == name);
        let largest = values.map(|e| {
            e.parameters
                .iter()
                .map(|p| p.value.abs())
                .fold(0.0, f64::max)
        });
        let unit = values.and_then(|e| e.parameters.first());
        let unit = unit.map_or("", |p| p.unit.as_str());
        let name = format!("effects.{name}");
        all.line(&name, unit, Bound::AtMost, Some(*most), largest);
    }
    for (name, most) in &limits.standard_errors {
        let error = parameter(calibration, name).and_then(|(_, error)| error);
        let key = format!("standard_errors.{name}");
        let unit = unit(calibration, name);
        all.line(&key, &unit, Bound::AtMost, Some(*most), error);
    }
    for (name, range) in &limits.values {
        let value = parameter(calibration, name).map(|(value, _)| value);
        let (key, unit) = (format!("values.{name}"), unit(calibration, name));
        let line = LimitLine::new(key, unit, Bound::Between, Limit::Range(*range), value);
        all.0.push(line);
    }
    all.0
}

struct Lines(Vec<LimitLine>);

impl Lines {
    /// A line where there is a limit.
    fn line(
        &mut self,
        name: &str,
        unit: &str,
        kind: Bound,
        limit: Option<f64>,
        value: Option<f64>,
    ) {
        let line = |limit| LimitLine::new(name, unit, kind, Limit::One(limit), value);
        self.0.extend(limit.map(line));
    }

    fn triad(
        &mut self,
        sensor: &str,
        unit: &str,
        triad: Option<&Triad>,
        chi2: Option<f64>,
        classes: [Option<f64>; 3],
        (fewest, found): (Option<f64>, Option<usize>),
    ) {
        let value = triad.and_then(|t| t.reduced_chi2);
        let name = format!("{sensor}.reduced_chi2");
        self.line(&name, "", Bound::AtMost, chi2, value);
        let named = [
            ("scale", "1", Class::Scale),
            ("misalignment", "rad", Class::Misalignment),
            ("bias", unit, Class::Bias),
        ];
        for ((name, unit, class), most) in named.into_iter().zip(classes) {
            let value = triad.and_then(|t| largest_error(t, class));
            self.line(
                &format!("{sensor}.{name}"),
                unit,
                Bound::AtMost,
                most,
                value,
            );
        }
        let name = format!("{sensor}.intervals");
        self.line(&name, "", Bound::AtLeast, fewest, found.map(|n| n as f64));
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::super::{built_in, parse_limits};
    use super::*;
    use crate::calibration::{EffectParameter, EffectValues};
    use crate::methods::six_position::{Face, Placement, Six, SixPosition};

    /// Readings with a scale error and a bias on each axis.
    fn calibration() -> Calibration {
        let placements = Face::ALL.map(|face| Placement {
            label: face.name().into(),
            accelerometer: face.direction() * 9.81 + Vector3::new(0.1, 0.2, 0.3),
            gyroscope: None,
        });
        let six = Six::sort(placements.to_vec(), 9.80665).unwrap();
        let solution = SixPosition::solve(&six, 9.80665);
        solution.calibration(false).unwrap()
    }

    fn judged(text: &str, calibration: &Calibration) -> Vec<(String, Option<f64>, bool)> {
        let limits = parse_limits(text, "l.toml").unwrap();
        let lines = judge(&limits, calibration).into_iter();
        lines.map(|l| (l.name, l.value, l.pass)).collect()
    }

    #[test]
    fn errors_of_counts_are_judged_in_si_units() {
        let mut calibration = calibration();
        let triad = calibration.accelerometer.as_mut().unwrap();
        (triad.t, triad.t_std) = ([[0.0; 3]; 3], [[None; 3]; 3]);
        for k in 0..3 {
            triad.t[k][k] = 0.01;
            triad.t_std[k][k] = Some(1e-5);
        }
        triad.bias_std = [Some(2.0), Some(3.0), Some(1.0)];
        let found = judged("[accelerometer]\nscale = 2e-3\nbias = 0.02\n", &calibration);
        assert_eq!(found[0].0, "accelerometer.scale");
        assert!((found[0].1.unwrap() - 1e-3).abs() < 1e-12 && found[0].2);
        assert!((found[1].1.unwrap() - 0.03).abs() < 1e-12 && !found[1].2);
    }

    #[test]
    fn what_is_not_there_fails() {
        let text = "required = [\"gyroscope\"]\n[gyroscope]\nresidual_deg = 1.0\n[effects]\n\
                    gyro_g_sensitivity = 1e-4\n[values]\n\"accel.b_y\" = [0.1, 0.3]\n";
        let mut calibration = calibration();
        let found = judged(text, &calibration);
        let names = [
            "required.gyroscope",
            "gyroscope.residual_deg",
            "effects.gyro_g_sensitivity",
        ];
        for (line, name) in found.iter().zip(names) {
            assert!(line.0 == name && !line.2, "{line:?}");
        }
        assert!(found[3].2, "{:?}", found[3]);
        let parameter = |name: &str, value| EffectParameter {
            name: name.into(),
            value,
            std: None,
            unit: "(rad/s)/(m/s²)".into(),
        };
        calibration.effects.push(EffectValues {
            name: "gyro_g_sensitivity".into(),
            definition: None,
            parameters: vec![parameter("g_xx", 5e-5), parameter("g_xy", -2e-4)],
            outside: None,
        });
        let found = &judged(text, &calibration)[2];
        assert_eq!((found.1, found.2), (Some(2e-4), false));
    }

    #[test]
    fn residuals_are_judged_in_units_and_not_by_the_noise_alone() {
        let mut calibration = calibration();
        let with = |calibration: &mut Calibration, rms: f64, chi2: f64| {
            let triad = calibration.accelerometer.as_mut().unwrap();
            (triad.residual_rms, triad.reduced_chi2) = (rms, Some(chi2));
            built_in(calibration).iter().all(|line| line.pass)
        };
        assert!(with(&mut calibration, 0.00275, 1610.0), "a phone");
        assert!(with(&mut calibration, 0.06, 1.1), "a noisy sensor");
        assert!(!with(&mut calibration, 0.04, 1770.0), "misfit");
        assert!(!with(&mut calibration, 0.2, 1.0), "no calibration");
    }
}
