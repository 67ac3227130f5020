//! An accelerometer whose readings are cut off towards zero instead of rounded.

use faer::Mat;
use findings::{Finding, Kind};
use nalgebra::Vector3;
use recording::readings::least_step;
use recording::{Recording, Stream};
use sensor::Sensor;

use crate::methods::joint::{JointFit, Mean};

findings::tuning! {
    /// Log-likelihood by which readings that are half a step larger have to explain all rows better: with nothing fitted, chance makes so
    /// much in one of ten thousand recordings, whatever the step (`√(2 · 6.9)` is exceeded so rarely).
    BETTER: f64 = 6.9;

    /// Half a step explains this share of what the likeliest multiple of it does. Of 23 sessions whose readings were cut off the least was .93;
    /// what is no cut asks for any multiple.
    SHARE: f64 = 0.9;
}

/// Says that readings are cut off towards zero, where readings that are half a step larger explain the rows far better: the size is that of the
/// step, so that chance does not make it. Rests tell lengths, and turns tell the directions between them; `recordings` are those of the fit.
pub fn cut_towards_zero(fit: &JointFit, recordings: &[&Recording]) -> Option<Finding> {
    let cut: Vec<Cut<'_>> = recordings
        .iter()
        .map(|own| Cut::of(own))
        .collect::<Option<_>>()?;
    let scale = fit.force_unit.scale;
    let mut column = vec![0.0; fit.white_residuals.len()];
    for own in fit.sensitivities().means {
        let chunk = &fit.data.chunks[own.chunk];
        let cut = cut.get(fit.data.rests[chunk.rest].recording);
        let (Some(mean), Some(cut)) = (chunk.mean(own.sensor), cut) else {
            continue;
        };
        if own.sensor == Sensor::Accelerometer {
            let shift = cut.shift(&mean) * scale;
            column[own.row..own.row + 3].copy_from_slice(shift.as_slice());
        }
    }
    let column = Mat::from_fn(column.len(), 1, |row, _| column[row]);
    let evidence = *fit.evidence_for(column).first()?;
    let gain = evidence.gain();
    if gain < BETTER.get() || gain < SHARE.get() * evidence.most() {
        return None;
    }
    // An error of the accelerometer that fits better is the cause, though its coefficients follow chance as well.
    if fit.lacks_what_gains_more(recordings, gain) {
        return None;
    }
    let step = cut.first()?.steps.max() * scale;
    Some(
        Finding::of(Kind::CUT_TOWARDS_ZERO)
            .in_recording(&recordings.first()?.name)
            .of_sensor(Sensor::Accelerometer)
            .number("step", step, "m/s^2")
            .affects("corrected_reading", 0.5 * step, "m/s^2"),
    )
}

/// The readings of an accelerometer and their steps.
struct Cut<'a> {
    stream: &'a Stream,
    steps: Vector3<f64>,
}

impl<'a> Cut<'a> {
    /// `None` where an axis never changes.
    fn of(recording: &'a Recording) -> Option<Self> {
        let stream = recording.accelerometer.as_ref()?;
        let step = |axis| least_step(&stream.values, axis);
        let steps = Vector3::new(step(0)?, step(1)?, step(2)?);
        Some(Self { stream, steps })
    }

    /// The shift of a mean by cutting off, in the unit of the readings: half a step against the mean sign. What is cut to zero lies on either side
    /// of it: of an axis that is level, some readings are too large, some too small, and some are right.
    fn shift(&self, mean: &Mean) -> Vector3<f64> {
        let own = &self.stream.values[self.stream.between(mean.span.from, mean.span.to)];
        let sign = |v: f64| if v == 0.0 { 0.0 } else { v.signum() };
        let sum: Vector3<f64> = own.iter().map(|v| v.map(sign)).sum();
        sum.component_mul(&self.steps) * (-0.5 / own.len().max(1) as f64)
    }
}

#[cfg(test)]
mod tests {
    use recording::intervals::Span;

    use super::*;

    #[test]
    fn of_an_axis_that_is_level_only_the_readings_beside_zero_are_too_short() {
        let values = [
            [9.8, -0.01, 0.0],
            [9.8, -0.01, 0.0],
            [9.8, 0.0, 0.01],
            [9.8, -0.01, -0.01],
        ];
        let stream = Stream {
            t: (0..4).map(f64::from).collect(),
            values: values.map(Vector3::from).to_vec(),
        };
        let cut = Cut {
            stream: &stream,
            steps: Vector3::repeat(0.02),
        };
        let mean = Mean {
            span: Span { from: 0.0, to: 4.0 },
            count: 4,
            value: Vector3::zeros(),
            variance: Vector3::zeros(),
            slope: Vector3::zeros(),
            spread: 1.0,
        };
        assert_eq!(cut.shift(&mean), Vector3::new(-0.01, 0.0075, 0.0));
    }
}
