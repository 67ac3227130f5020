//! The recording on disk: every batch is appended before it is looked at.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use calib::recording::Stream;
use output::Growing;

use crate::sources::error::Error;

/// Names and headers of the two files of a plain recording.
const FILES: [(&str, &str); 2] = [("acc", "t,ax,ay,az\n"), ("gyro", "t,gx,gy,gz\n")];

/// A folder with `acc.csv` and `gyro.csv` to which samples are appended.
///
/// A batch is one `write` per file and nothing is held back: a process that is killed leaves every batch that it had
/// taken, in whole lines.
#[derive(Debug)]
pub struct Recorder {
    folder: PathBuf,
    files: [Growing; 2],
    restarts: u32,
}

impl Recorder {
    /// Makes the folder and begins both files.
    ///
    /// # Errors
    /// A folder that cannot be written, or files that are there already.
    pub fn begin(folder: &Path) -> Result<Self, Error> {
        std::fs::create_dir_all(folder).map_err(Error::at(folder))?;
        Ok(Self {
            folder: folder.to_owned(),
            files: [create(folder, 0)?, create(folder, 1)?],
            restarts: 0,
        })
    }

    /// Appends samples.
    ///
    /// # Errors
    /// A disk that takes no more.
    pub fn append(&mut self, accelerometer: &Stream, gyroscope: &Stream) -> Result<(), Error> {
        for (file, stream) in self.files.iter_mut().zip([accelerometer, gyroscope]) {
            if stream.is_empty() {
                continue;
            }
            let mut text = String::with_capacity(64 * stream.len());
            for (t, v) in stream.t.iter().zip(&stream.values) {
                // Writing to memory does not fail.
                let _ = writeln!(text, "{t},{},{},{}", v.x, v.y, v.z);
            }
            file.append(text.as_bytes())?;
        }
        Ok(())
    }

    /// Puts what was recorded aside as `before_1/acc.csv` and so on, and begins anew.
    ///
    /// # Errors
    /// A folder that cannot be written.
    pub fn restart(&mut self) -> Result<(), Error> {
        self.restarts += 1;
        let aside = self.folder.join(format!("before_{}", self.restarts));
        std::fs::create_dir_all(&aside).map_err(Error::at(&aside))?;
        for (k, (name, _)) in FILES.iter().enumerate() {
            let file = format!("{name}.csv");
            let from = self.folder.join(&file);
            std::fs::rename(&from, aside.join(&file)).map_err(Error::at(&from))?;
            self.files[k] = create(&self.folder, k)?;
        }
        Ok(())
    }

    /// The folder.
    pub fn folder(&self) -> &Path {
        &self.folder
    }
}

fn create(folder: &Path, which: usize) -> Result<Growing, Error> {
    let (name, header) = FILES[which];
    let mut file = Growing::begin(&folder.join(format!("{name}.csv")))?;
    file.append(header.as_bytes())?;
    Ok(file)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3;

    #[test]
    fn a_restart_keeps_what_came_before_in_a_folder_of_its_own() {
        let folder = tempfile::tempdir().unwrap();
        let mut recorder = Recorder::begin(folder.path()).unwrap();
        let stream = Stream {
            t: vec![0.25],
            values: vec![Vector3::new(1.0, -2.5, 9.81)],
        };
        recorder.append(&stream, &Stream::default()).unwrap();
        recorder.restart().unwrap();
        let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
        assert_eq!(read("before_1/acc.csv"), "t,ax,ay,az\n0.25,1,-2.5,9.81\n");
        assert_eq!(read("acc.csv"), "t,ax,ay,az\n");
        assert!(
            Recorder::begin(folder.path()).is_err(),
            "an old recording is not overwritten"
        );
    }
}
