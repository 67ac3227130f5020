//! Calibrations of a run: those that its own record names.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use crate::error::Error;
use crate::hash::members;
use crate::merge::{joined, part_files};
use crate::record::{Record, Status};
use crate::store::Store;

/// The files of the calibrations in the output folder of a batch, of the devices that its parts have calibrated. A device that
/// an earlier run has left there, and that is not among the inputs any more, is not of the run, and one that failed a gate or a limit
/// tells nothing of its type. Without a part the run has not ended: then every device there.
///
/// # Errors
/// [`Error::Io`]; [`Error::Parts`] for parts of several runs or damaged ones.
pub fn calibrations_of(folder: &Path) -> Result<Vec<PathBuf>, Error> {
    let parts = part_files(&[folder.to_owned()])?;
    if parts.is_empty() {
        return of_all_devices(folder);
    }
    let store = Store::new(folder);
    let records = joined(&parts, false)?.records;
    let is_sound = |r: &&Record| r.cal_sha256.is_some() && r.status != Status::Fail;
    let calibrated = records.iter().filter(is_sound);
    Ok(calibrated
        .map(|r| store.device(&r.id).join("cal.json"))
        .collect())
}

fn of_all_devices(folder: &Path) -> Result<Vec<PathBuf>, Error> {
    let devices = folder.join("devices");
    let mut files = Vec::new();
    for device in members(&devices).map_err(Error::at(&devices))? {
        let path = device.join("cal.json");
        match path.try_exists() {
            Ok(false) => {}
            Err(error) if error.kind() == ErrorKind::NotADirectory => {}
            // Of one that the system does not tell of, whoever reads it says why.
            _ => files.push(path),
        }
    }
    Ok(files)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::device::empty;
    use crate::manifest::{Device, DeviceOptions};
    use crate::part::{PartHeader, part_name, part_text};
    use crate::shard::Shard;

    fn record(id: &str, index: usize, calibrated: bool) -> Record {
        let device = Device {
            id: id.into(),
            inputs: Vec::new(),
            lot: None,
            station: None,
            time: None,
            options: DeviceOptions::default(),
        };
        Record {
            cal_sha256: calibrated.then(String::new),
            ..empty(&device, index, String::new())
        }
    }

    fn write(folder: &Path, run: &str, shard: Shard, devices: usize, records: &[Record]) {
        let header = PartHeader::new("test 1", run.into(), shard, devices);
        let text = part_text(&header, records);
        std::fs::write(folder.join(part_name(shard)), text).unwrap();
    }

    fn names(folder: &Path) -> Vec<String> {
        let found = calibrations_of(folder).unwrap();
        let name = |path: &PathBuf| path.parent().unwrap().file_name().unwrap().to_owned();
        let names = found.iter().map(name);
        names.map(|name| name.into_string().unwrap()).collect()
    }

    #[test]
    fn a_device_that_the_run_has_no_more_is_not_of_it() {
        let dir = tempfile::tempdir().unwrap();
        for id in ["D00", "D01", "D02"] {
            let folder = dir.path().join("devices").join(id);
            std::fs::create_dir_all(&folder).unwrap();
            std::fs::write(folder.join("cal.json"), "{}").unwrap();
        }
        assert_eq!(names(dir.path()), ["D00", "D01", "D02"]);
        // D00 is gone, and D02 has not been calibrated.
        let records = [record("D01", 0, true), record("D02", 1, false)];
        write(dir.path(), "a", Shard::default(), 2, &records);
        assert_eq!(names(dir.path()), ["D01"]);
    }

    #[test]
    fn one_shard_is_enough_and_parts_of_two_runs_are_refused() {
        let dir = tempfile::tempdir().unwrap();
        let shard = |k| Shard { k, n: 2 };
        write(dir.path(), "a", shard(1), 2, &[record("D00", 0, true)]);
        assert_eq!(names(dir.path()), ["D00"]);
        write(dir.path(), "b", shard(2), 2, &[record("D01", 1, true)]);
        assert!(matches!(calibrations_of(dir.path()), Err(Error::Parts(_))));
    }
}
