//! Recordings as a folder of plain CSV, each sensor with stamps of its own.

use std::fmt::Write as _;

use super::stamp::FileStamp;
use super::{field_names, stream_to_csv};
use crate::recording::{Recording, Temperature};

/// One file of a folder.
#[derive(Clone, Copy, Debug)]
pub struct FolderFile {
    /// Its name, by which the reader of folders knows it.
    pub name: &'static str,
    /// Its text, numbers to their last digit; `None` where the recording has nothing for it.
    pub text: fn(&Recording) -> Option<String>,
}

/// The files of a folder: `acc.csv`, `gyro.csv`, `mag.csv` and `temp.csv`.
pub static FOLDER_FILES: [FolderFile; 4] = [
    FolderFile {
        name: "acc.csv",
        text: |recording| {
            let stream = recording.accelerometer.as_ref()?;
            Some(stream_to_csv(stream, "t,ax,ay,az", recording.zero_ns))
        },
    },
    FolderFile {
        name: "gyro.csv",
        text: |recording| {
            let stream = recording.gyroscope.as_ref()?;
            Some(stream_to_csv(stream, "t,gx,gy,gz", recording.zero_ns))
        },
    },
    FolderFile {
        name: "mag.csv",
        text: |recording| {
            let field = recording.magnetometer.as_ref()?;
            let names = format!("t,{}", field_names(field));
            Some(stream_to_csv(&field.stream, &names, recording.zero_ns))
        },
    },
    FolderFile {
        name: "temp.csv",
        text: |recording| {
            let temperature = recording.temperature.as_ref()?;
            Some(temperature_to_csv(temperature, recording.zero_ns))
        },
    },
];

fn temperature_to_csv(temperature: &Temperature, zero_ns: i128) -> String {
    let mut text = "t,temp\n".to_owned();
    for (&t, celsius) in temperature.t.iter().zip(&temperature.celsius) {
        let stamp = FileStamp { zero_ns, t };
        // Writing to a string does not fail.
        let _ = writeln!(text, "{stamp},{celsius}");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recording::{Magnetometer, ReadOptions, Stream};
    use nalgebra::Vector3;

    /// Twenty seconds at 50 Hz from `start`.
    fn stream(start: f64, of: impl Fn(f64) -> Vector3<f64>) -> Stream {
        let t: Vec<f64> = (0..1000).map(|k| start + 0.02 * f64::from(k)).collect();
        let values = t.iter().map(|t| of(*t)).collect();
        Stream { t, values }
    }

    /// Every sensor with a clock and a beginning of its own.
    fn recording() -> Recording {
        let t: Vec<f64> = (0..22).map(|k| 0.3 + 0.97 * f64::from(k)).collect();
        let celsius = t.iter().map(|t| 21.0 + 0.1 * t).collect();
        let wave = |t: f64| Vector3::new(t.sin(), (1.3 * t).cos(), (0.7 * t).sin());
        Recording {
            accelerometer: Some(stream(0.0, |t| {
                Vector3::new(0.1, 0.2, 9.8) + 0.01 * wave(t)
            })),
            gyroscope: Some(stream(0.003, |t| 0.5 * wave(t))),
            magnetometer: Some(Magnetometer::in_microtesla(stream(0.011, |t| {
                40.0 * wave(t)
            }))),
            temperature: Some(Temperature { t, celsius }),
            ..Recording::default()
        }
    }

    #[test]
    fn a_folder_is_read_back_as_it_was_with_its_temperature_and_its_field() {
        let folder = tempfile::tempdir().unwrap();
        let written = recording();
        for file in &FOLDER_FILES {
            let text = (file.text)(&written).unwrap();
            std::fs::write(folder.path().join(file.name), text).unwrap();
        }
        let read = Recording::read(folder.path(), &ReadOptions::default()).unwrap();
        assert_eq!(read.accelerometer, written.accelerometer);
        assert_eq!(read.gyroscope, written.gyroscope);
        assert_eq!(read.temperature, written.temperature);
        let [read, written] = [read, written].map(|recording| recording.magnetometer.unwrap());
        assert_eq!((read.stream, read.unit), (written.stream, written.unit));
    }

    #[test]
    fn nothing_is_written_for_a_sensor_that_is_not_there() {
        let texts = FOLDER_FILES.map(|file| (file.text)(&Recording::default()));
        assert!(texts.iter().all(Option::is_none));
    }
}
