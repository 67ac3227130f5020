//! A simulated recording as files.

use std::io::{BufWriter, Write};
use std::path::Path;

use recording::{Error, Temperature};
use sensor::Sensor;
use tempfile::NamedTempFile;

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
    /// What `acc.csv` (`t,ax,ay,az`, and `temp` where there is a thermometer), `gyro.csv` (`t,gx,gy,gz`) or `mag.csv` (in µT) holds.
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

    /// What `truth.json` holds. The means of drifting biases are those of the readings that were written.
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
        let refuse = |name: &str, source| Error::Output {
            path: dir.join(name),
            source,
        };
        std::fs::create_dir_all(dir).map_err(|e| refuse("", e))?;
        if let Some(name) = FILES.iter().find(|name| !force && dir.join(name).exists()) {
            return Err(refuse(name, std::io::ErrorKind::AlreadyExists.into()));
        }
        let mut files = self.files();
        let mut write = |name: &str, sensor: Sensor| {
            into_new_file(dir, |out| files.readings(sensor, out)).map_err(|e| refuse(name, e))
        };
        let sensors = Sensor::ALL.into_iter().zip(FILES);
        let mut written = Vec::new();
        for (sensor, name) in sensors.filter(|(sensor, _)| self.has(*sensor)) {
            written.push((write(name, sensor)?, name));
        }
        let truth = files.truth();
        let json = into_new_file(dir, |out| {
            serde_json::to_writer_pretty(&mut *out, &truth)?;
            out.write_all(b"\n")
        })
        .map_err(|e| refuse(FILES[3], e))?;
        written.push((json, FILES[3]));
        for (file, name) in written {
            publish(file, &dir.join(name), force).map_err(|e| refuse(name, e))?;
        }
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

/// A file beside its target, filled and synced, that disappears unless it is published.
fn into_new_file(
    dir: &Path,
    fill: impl FnOnce(&mut BufWriter<&mut std::fs::File>) -> std::io::Result<()>,
) -> std::io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".stillpoint-");
    // Temporary files are private; the result should have the permissions of any other file.
    #[cfg(unix)]
    let builder = {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666))
    };
    let mut file = builder.tempfile_in(dir)?;
    let mut out = BufWriter::new(file.as_file_mut());
    fill(&mut out)?;
    out.flush()?;
    drop(out);
    file.as_file().sync_all()?;
    Ok(file)
}

fn publish(file: NamedTempFile, path: &Path, force: bool) -> std::io::Result<()> {
    let done = if force {
        file.persist(path)
    } else {
        file.persist_noclobber(path)
    };
    done.map(|_| ()).map_err(|e| e.error)
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
