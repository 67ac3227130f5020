//! A simulated recording as files.

use std::io::Write;
use std::path::Path;

use output::{Existing, Filled, Folder, Output};
use recording::{Error, Temperature};
use sensor::Sensor;

use super::drift::DriftMeans;
use super::simulation::Simulation;
use super::truth::Truth;

/// The files of a simulated recording; `mag.csv` where there is a magnetic field.
pub const FILES: [&str; 4] = ["acc.csv", "gyro.csv", "mag.csv", "truth.json"];

/// The files of a simulated recording, into any writer, in constant memory.
#[derive(Debug)]
pub struct Files<'a> {
    simulation: &'a Simulation,
    drift: DriftMeans,
}

impl Files<'_> {
    /// Writes the content of `acc.csv` (`t,ax,ay,az`, and `temp` with a thermometer), `gyro.csv` (`t,gx,gy,gz`) or `mag.csv` (in µT).
    ///
    /// # Errors
    /// Those of the writer.
    pub fn readings(&mut self, sensor: Sensor, out: &mut dyn Write) -> std::io::Result<()> {
        let (columns, temperature) = match sensor {
            Sensor::Accelerometer => ("t,ax,ay,az", self.simulation.thermometer()),
            Sensor::Gyroscope => ("t,gx,gy,gz", None),
            Sensor::Magnetometer => ("t,mx (uT),my (uT),mz (uT)", None),
        };
        header(out, columns, temperature.as_ref())?;
        for sample in self.simulation.samples(sensor) {
            self.drift.add(sensor, sample.true_time, &sample.drift);
            row(out, sample.t, sample.value.as_slice(), temperature.as_ref())?;
        }
        Ok(())
    }

    /// Returns the content of `truth.json`. The means of drifting biases are those of the readings that were written.
    pub fn truth(&self) -> Truth {
        self.simulation.truth(&self.drift)
    }
}

impl Simulation {
    /// Its files, none of them written yet.
    pub fn files(&self) -> Files<'_> {
        Files {
            simulation: self,
            drift: self.drift_means(),
        }
    }

    /// Runs it into `dir`, in constant memory: the [`FILES`].
    ///
    /// Every file is written whole or not at all, the truth last.
    ///
    /// # Errors
    /// [`Error::Output`] where a file cannot be written, or exists and `force` is not set.
    pub fn write(&self, dir: &Path, force: bool) -> Result<Truth, Error> {
        let existing = match force {
            true => Existing::Replace,
            false => Existing::Refuse,
        };
        let folder = Folder::make(dir).map_err(refused)?;
        let claim = |name: &str| Output::claim_in(dir, name, existing, &[]).map_err(refused);
        let sensors = Sensor::ALL.into_iter().zip(FILES);
        let sensors = sensors.filter(|(sensor, _)| self.has(*sensor));
        let readings: Vec<(Sensor, Output)> = sensors
            .map(|(sensor, name)| Ok((sensor, claim(name)?)))
            .collect::<Result<_, Error>>()?;
        let json = claim(FILES[3])?;
        let mut files = self.files();
        let mut filled = Vec::new();
        for (sensor, output) in readings {
            let readings = output.fill(|out| files.readings(sensor, out));
            filled.push(readings.map_err(refused)?);
        }
        let truth = files.truth();
        let json = json.fill(|out| {
            serde_json::to_writer_pretty(&mut *out, &truth)?;
            out.write_all(b"\n")
        });
        filled.push(json.map_err(refused)?);
        let mut published = filled.into_iter().map(Filled::publish);
        published.try_for_each(|done| done.map_err(refused))?;
        drop(folder);
        Ok(truth)
    }
}

fn header(
    out: &mut dyn Write,
    columns: &str,
    temperature: Option<&Temperature>,
) -> std::io::Result<()> {
    writeln!(
        out,
        "{columns}{}",
        if temperature.is_some() { ",temp" } else { "" }
    )
}

/// Numbers in the fewest digits that give back the same bits.
fn row(
    out: &mut dyn Write,
    t: f64,
    values: &[f64],
    temperature: Option<&Temperature>,
) -> std::io::Result<()> {
    write!(out, "{t}")?;
    for value in values {
        write!(out, ",{value}")?;
    }
    if let Some(celsius) = temperature.and_then(|c| c.at(t)) {
        write!(out, ",{celsius}")?;
    }
    writeln!(out)
}

fn refused(error: output::Error) -> Error {
    Error::Output {
        path: error.path.clone(),
        source: error.into(),
    }
}

#[cfg(test)]
mod tests {
    use recording::{ReadOptions, Recording};

    use super::*;
    use crate::Spec;

    fn short() -> Simulation {
        let spec = Spec::still(1, 2.0).with_effect("accel_temperature", 1.0);
        Simulation::new(&spec).unwrap()
    }

    #[test]
    fn files_hold_the_samples_and_the_truth_to_the_last_bit() {
        let dir = tempfile::tempdir().unwrap();
        let simulation = short();
        let truth = simulation.write(dir.path(), false).unwrap();
        let session = simulation.run().unwrap();
        assert_eq!(truth, session.truth);
        let read: Truth =
            serde_json::from_slice(&std::fs::read(dir.path().join("truth.json")).unwrap()).unwrap();
        assert_eq!(read, truth);
        let text = std::fs::read_to_string(dir.path().join("gyro.csv")).unwrap();
        let stream = session.recording.gyroscope.unwrap();
        assert_eq!(text.lines().count(), 1 + stream.len());
        for (line, (t, v)) in text
            .lines()
            .skip(1)
            .zip(stream.t.iter().zip(&stream.values))
        {
            let numbers: Vec<f64> = line.split(',').map(|n| n.parse().unwrap()).collect();
            assert_eq!(numbers, [*t, v.x, v.y, v.z]);
        }
        let text = std::fs::read_to_string(dir.path().join("acc.csv")).unwrap();
        assert!(text.starts_with("t,ax,ay,az,temp\n0,"));
        assert!(text.lines().all(|line| line.split(',').count() == 5));
    }

    #[test]
    fn the_folder_reads_back_as_the_recording_it_was() {
        let mut spec = Spec::still(2, 5.0).with_effect("gyro_temperature", 1.0);
        spec.gyroscope.clock.rate = Some(80.0);
        spec.accelerometer.counts = true;
        spec.accelerometer.step = 5e-4;
        let simulation = Simulation::new(&spec).unwrap();
        let dir = tempfile::tempdir().unwrap();
        simulation.write(dir.path(), false).unwrap();
        let read = Recording::read(dir.path(), &ReadOptions::default()).unwrap();
        let session = simulation.run().unwrap();
        assert_eq!(read.accelerometer, session.recording.accelerometer);
        assert_eq!(read.gyroscope, session.recording.gyroscope);
        let (read, made) = (
            read.temperature.unwrap(),
            session.recording.temperature.unwrap(),
        );
        assert!(
            read.t
                .iter()
                .zip(&read.celsius)
                .all(|(t, c)| made.at(*t) == Some(*c))
        );
    }

    #[test]
    fn what_exists_is_left_alone_without_force() {
        let dir = tempfile::tempdir().unwrap();
        std::fs::write(dir.path().join("truth.json"), "old").unwrap();
        let error = short().write(dir.path(), false).unwrap_err();
        assert!(matches!(error, Error::Output { .. }));
        assert_eq!(
            std::fs::read(dir.path().join("truth.json")).unwrap(),
            b"old"
        );
        assert_eq!(std::fs::read_dir(dir.path()).unwrap().count(), 1);
        short().write(dir.path(), true).unwrap();
        assert_eq!(std::fs::read_dir(dir.path()).unwrap().count(), 3);
    }
}
