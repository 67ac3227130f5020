//! What is read of simulated recordings: arrays as text, and how far two clocks are apart.

use calib::recording::{ReadOptions, Rows, Stream, clock_offset, to_csv};
use calib::simulate::Spec;
use calib::{Error, Recording};
use nalgebra::Vector3;

#[test]
fn clocks_apart_by_a_second_and_a_half_are_seen_and_those_together_are_not() {
    let recording = Spec::hand_held(3).run().unwrap().recording;
    let force = recording.accelerometer.unwrap();
    let mut rate = recording.gyroscope.unwrap();
    rate.t.iter_mut().for_each(|t| *t += 1e-3);
    assert_eq!(clock_offset(&force, &rate), None);
    for offset in [1.5, -7.0, 15.0, 40.0] {
        let mut late = rate.clone();
        late.t.iter_mut().for_each(|t| *t += offset);
        let (found, other) = clock_offset(&force, &late).unwrap();
        assert!((found - offset).abs() < 0.11, "{found}");
        assert_eq!(other, None);
        let (found, _) = clock_offset(&late, &force).unwrap();
        assert!((found + offset).abs() < 0.11, "{found}");
    }
}

fn session() -> Recording {
    let mut spec = Spec::hand_held(5);
    spec.rate = 50.0;
    spec.run().unwrap().recording
}

fn arrays(recording: &Recording) -> (Vec<f64>, [Vec<[f64; 3]>; 2]) {
    let (accel, gyro) = (&recording.accelerometer, &recording.gyroscope);
    let (accel, gyro) = (accel.as_ref().unwrap(), gyro.as_ref().unwrap());
    assert_eq!(accel.t, gyro.t);
    let rows = |values: &[Vector3<f64>]| values.iter().map(|v| (*v).into()).collect();
    (accel.t.clone(), [rows(&accel.values), rows(&gyro.values)])
}

#[test]
fn arrays_are_read_as_a_plain_csv_with_their_numbers() {
    let (t, [accel, gyro]) = arrays(&session());
    let file = tempfile::Builder::new().suffix(".csv").tempfile().unwrap();
    for shift in [0.0, 1_700_000_000.0] {
        let t: Vec<f64> = t.iter().map(|t| t + shift).collect();
        let rows = Rows {
            t: &t,
            accel: &accel,
            gyro: &gyro,
            ..Rows::default()
        };
        let ours = Recording::from_rows("mine", rows).unwrap();
        let text = to_csv(&mut Recording {
            accelerometer: Some(stream(&t, &accel)),
            gyroscope: Some(stream(&t, &gyro)),
            ..Recording::default()
        });
        std::fs::write(file.path(), text).unwrap();
        let read = Recording::read(file.path(), &ReadOptions::default()).unwrap();
        for (ours, read) in [
            (ours.accelerometer, read.accelerometer),
            (ours.gyroscope, read.gyroscope),
        ] {
            let (ours, read) = (ours.unwrap(), read.unwrap());
            assert_eq!(ours.values, read.values, "{shift}");
            // A text keeps the digits of an epoch that a double has lost.
            let mut stamps = ours.t.iter().zip(&read.t);
            assert!(stamps.all(|(a, b)| (a - b).abs() <= shift * f64::EPSILON));
        }
        assert_eq!(ours.warnings.len(), read.warnings.len());
    }
}

fn stream(t: &[f64], values: &[[f64; 3]]) -> Stream {
    Stream {
        t: t.to_vec(),
        values: values.iter().map(|v| Vector3::from(*v)).collect(),
    }
}

type Change<'a> = &'a dyn Fn(&mut Vec<f64>, &mut Vec<[f64; 3]>);

#[test]
fn what_is_wrong_with_arrays_is_named_with_row_and_column() {
    let (t, [accel, gyro]) = arrays(&session());
    let refused = |change: Change<'_>| {
        let (mut t, mut accel) = (t.clone(), accel.clone());
        change(&mut t, &mut accel);
        let rows = Rows {
            t: &t,
            accel: &accel,
            gyro: &gyro,
            ..Rows::default()
        };
        let error = Recording::from_rows("mine", rows).unwrap_err();
        assert!(matches!(error, Error::Input(_)));
        error.to_string()
    };
    let message = refused(&|_, accel| accel[16][1] = f64::NAN);
    assert!(message.starts_with("mine:17:3: accel is NaN"), "{message}");
    let message = refused(&|t, _| t[30] = t[28] - 1e-3);
    assert!(message.starts_with("mine:31: time goes back"), "{message}");
    let message = refused(&|t, _| t[30] = f64::INFINITY);
    assert!(message.starts_with("mine:31:1: t is inf"), "{message}");
    let message = refused(&|_, accel| accel.truncate(9));
    assert!(message.starts_with("mine: accel has 9 rows"), "{message}");
}
