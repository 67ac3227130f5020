//! The accelerometer as the sum of gravity and the acceleration without it, which fusion takes apart.

use findings::{Finding, Kind};

use super::samples::Samples;
use crate::Error;
use crate::averages::median;
use crate::header::gravity::Split;
use crate::rows::table::Table;
use crate::source::place::in_file;

findings::tuning! {
    /// A norm below this is gravity in units of g, m/s².
    LESS_THAN_IN_SI: f64 = 2.0;
    /// Acceleration without gravity is by the median far shorter than gravity.
    SHARE: f64 = 0.5;
}

/// The sum at the stamps that both have.
///
/// # Errors
/// A finding where they share less than half of the stamps.
pub(crate) fn sum(linear: &Samples, gravity: &Samples) -> Result<Samples, Box<Finding>> {
    if linear.t == gravity.t {
        let mut sum = linear.clone();
        let values = sum.values.iter_mut().zip(&gravity.values);
        values.for_each(|(value, gravity)| *value += gravity);
        return Ok(sum);
    }
    let mut sum = Samples::default();
    let mut at = 0;
    for (index, (t, value)) in linear.t.iter().zip(&linear.values).enumerate() {
        while gravity.t.get(at).is_some_and(|other| other < t) {
            at += 1;
        }
        if gravity.t.get(at) == Some(t) {
            sum.push(*t, value + gravity.values[at], linear.line(index));
        }
    }
    if 2 * sum.t.len() < linear.t.len() {
        return Err(Finding::of(Kind::SUM_OF_OTHER_STAMPS).into());
    }
    Ok(sum)
}

/// Adds gravity from its columns to the accelerometer of `table`, with the sign of its system.
///
/// # Errors
/// [`Error::Input`] where the two share too few rows.
pub(crate) fn of_columns(table: &mut Table, split: &Split) -> Result<(), Error> {
    let gravity = std::mem::take(&mut table.gravity);
    let norm = |samples: &Samples| median(samples.values.iter().map(|value| value.norm()));
    let (Some(left), Some(level)) = (norm(&table.accel), norm(&gravity)) else {
        return Ok(());
    };
    let called = |columns: [usize; 3]| table.names.get(columns[0]).cloned().unwrap_or_default();
    let (linear_name, gravity_name) = (called(split.linear), called(split.gravity));
    let file = table.name.clone();
    let of = |kind: Kind| {
        Finding::of(kind)
            .in_recording(&file)
            .detail("linear", &linear_name)
            .detail("gravity", &gravity_name)
    };
    if left > SHARE.get() * level {
        // ROS calls what an accelerometer reads its linear acceleration.
        table.warnings.push(of(Kind::GRAVITY_NOT_ADDED));
        return Ok(());
    }
    let added = of(Kind::GRAVITY_ADDED);
    let sum = sum(&table.accel, &gravity);
    table.accel = sum.map_err(|found| in_file(&table.name, *found))?;
    table.negated = split.is_apples || level < LESS_THAN_IN_SI.get();
    table.warnings.push(added);
    if table.negated {
        let turned = Finding::of(Kind::SIGN_TURNED).in_recording(&table.name);
        table.warnings.push(turned.detail("system", "Apple"));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;

    #[test]
    fn stamps_that_only_one_has_are_left_out_and_too_few_are_refused() {
        let x = |values: &[f64]| -> Vec<Vector3<f64>> {
            values.iter().map(|&v| Vector3::new(v, 0.0, 0.0)).collect()
        };
        let linear = Samples::of(vec![0.0, 1.0, 2.0], x(&[1.0, 2.0, 3.0]));
        let gravity = Samples::of(vec![0.0, 2.0, 3.0], x(&[10.0, 20.0, 30.0]));
        let both = sum(&linear, &gravity).unwrap();
        assert_eq!((both.t, both.values), (vec![0.0, 2.0], x(&[11.0, 23.0])));
        let late = Samples::of(vec![0.5, 1.5, 2.5], x(&[1.0, 2.0, 3.0]));
        let apart = sum(&linear, &late).unwrap_err();
        assert_eq!(apart.kind, Kind::SUM_OF_OTHER_STAMPS);
    }
}
