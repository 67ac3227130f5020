//! One recording as programs of laboratories write it: several clocks side by side, settings above the rows, arrays.

use std::fmt::Write as _;

use calib::recording::ReadOptions;
use calib::{Error, Recording};
use file_formats::make::{Packing, zip};
use nalgebra::Vector3;
use stillpoint_tests::layouts::Samples;

fn read(name: &str, bytes: Vec<u8>) -> Result<Recording, Error> {
    Recording::from_bytes(name, bytes, &ReadOptions::default())
}

/// Both sensors are those of the session, to `within` m/s² and rad/s.
fn is_it(found: Result<Recording, Error>, samples: &Samples, within: f64) {
    let found = found.unwrap_or_else(|error| panic!("{error}"));
    let pairs = [
        (found.accelerometer.as_ref(), &samples.accel.values),
        (found.gyroscope.as_ref(), &samples.together),
    ];
    for (stream, expected) in pairs {
        let stream = stream.expect("both sensors");
        assert_eq!(stream.len(), expected.len());
        let worst = stream
            .values
            .iter()
            .zip(expected)
            .map(|(a, b)| (a - b).amax());
        assert!(worst.fold(0.0, f64::max) < within);
        let duration = stream.t.last().unwrap() - stream.t[0];
        let expected = samples.accel.t.last().unwrap() - samples.accel.t[0];
        assert!((duration - expected).abs() < 2e-3, "{duration}");
    }
}

fn rows(samples: &Samples) -> impl Iterator<Item = (f64, Vector3<f64>, Vector3<f64>)> {
    let all = samples.accel.t.iter().zip(&samples.accel.values);
    let all = all.zip(&samples.together);
    all.map(|((t, f), w)| (*t - samples.accel.t[0], *f, *w))
}

#[test]
fn segments_of_labview_are_one_recording() {
    let samples = Samples::of_session();
    let mut text = "LabVIEW Measurement\t\nSeparator\tTab\nDecimal_Separator\t.\nX_Columns\tOne\n***End_of_Header***\t\n\t\n".to_owned();
    for (at, (t, f, w)) in rows(&samples).enumerate() {
        if at % 2000 == 0 {
            text += "\nChannels\t6\t\t\t\t\t\t\nSamples\t2000\t2000\t2000\t2000\t2000\t2000\t\n";
            text += "X_Dimension\tTime\tTime\tTime\tTime\tTime\tTime\t\nX0\t0\t0\t0\t0\t0\t0\t\n";
            text += "Delta_X\t0.01\t0.01\t0.01\t0.01\t0.01\t0.01\t\n***End_of_Header***\t\t\t\t\t\t\t\n";
            text += "X_Value\tacc x\tacc y\tacc z\tgyr x\tgyr y\tgyr z\tComment\n";
        }
        let numbers = [f.x, f.y, f.z, w.x, w.y, w.z]
            .map(|n| format!("{n:.8}"))
            .join("\t");
        let _ = writeln!(text, "{t:.4}\t{numbers}");
    }
    is_it(read("r.lvm", text.into_bytes()), &samples, 1e-7);
}

#[test]
fn channels_of_delsys_have_their_own_clocks() {
    let samples = Samples::of_session();
    let channels = [
        "EMG", "ACC.X", "ACC.Y", "ACC.Z", "GYRO.X", "GYRO.Y", "GYRO.Z",
    ];
    let named = channels.map(|name| format!("X[s],Avanti sensor 1: {name} 1"));
    let mut text = named.join(",") + "\n";
    let g = 9.80665;
    let own: Vec<_> = rows(&samples).collect();
    for at in 0..2 * own.len() {
        let _ = write!(text, "{:.5},0.00001", 0.005 * at as f64);
        for axis in 0..6 {
            let _ = match own.get(at) {
                Some((t, f, _)) if axis < 3 => write!(text, ",{t:.5},{:.8}", f[axis] / g),
                Some((t, _, w)) => write!(text, ",{t:.5},{:.8}", w[axis - 3].to_degrees()),
                None => write!(text, ",,"),
            };
        }
        text.push('\n');
    }
    is_it(read("r.csv", text.clone().into_bytes()), &samples, 1e-6);
    // Of two sensors side by side nobody says which is meant.
    let twice: String = text
        .lines()
        .map(|line| {
            format!(
                "{line},{}\n",
                line.replace("sensor 1", "sensor 2").replace(" 1,", " 2,")
            )
        })
        .collect();
    assert!(read("r.csv", twice.into_bytes()).is_err());
}

/// An array of doubles with the header that NumPy writes.
fn npy(shape: &str, numbers: impl Iterator<Item = f64>) -> Vec<u8> {
    let header = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}, }}\n");
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((header.len() as u16).to_le_bytes());
    bytes.extend(header.into_bytes());
    bytes.extend(numbers.flat_map(f64::to_le_bytes));
    bytes
}

#[test]
fn an_array_of_numpy_is_the_table_without_names_that_it_is() {
    let samples = Samples::of_session();
    let numbers = rows(&samples).flat_map(|(t, f, w)| [t, f.x, f.y, f.z, w.x, w.y, w.z]);
    let shape = format!("({}, 7)", samples.together.len());
    is_it(read("r.npy", npy(&shape, numbers)), &samples, 1e-12);
    // The arrays of an archive are called as columns are.
    let count = samples.together.len();
    let (vector, triad) = (format!("({count},)"), format!("({count}, 3)"));
    let stamps = npy(&vector, rows(&samples).map(|(t, ..)| t));
    let force = npy(&triad, rows(&samples).flat_map(|(_, f, _)| [f.x, f.y, f.z]));
    let rate = npy(&triad, rows(&samples).flat_map(|(.., w)| [w.x, w.y, w.z]));
    let archive = zip(&[
        ("acc.npy", &force, Packing::Stored),
        ("gyr.npy", &rate, Packing::Deflated),
        ("t.npy", &stamps, Packing::Deflated),
    ]);
    is_it(read("r.npz", archive), &samples, 1e-12);
}
