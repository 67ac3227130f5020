//! The thread that writes lines as they come, and the end of what it writes.

use std::fs::OpenOptions;
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};
use std::sync::mpsc::Sender;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use output::Growing;

use crate::sources::error::{Error, Limit};

/// Bytes of one read.
const CHUNK: usize = 64 << 10;
/// Wait before a file is asked again whether it has grown.
const AGAIN: Duration = Duration::from_millis(50);
/// A file that has not grown for so long is complete.
const COMPLETE: Duration = Duration::from_secs(30);
/// Most bytes of a session, twenty minutes at 1 kHz: all of them are in memory when they are read.
const MOST: u64 = 128 << 20;
/// Most bytes of a line.
const LONGEST_LINE: usize = 1 << 20;

/// Message of the writing thread: the lines so far, or an error.
pub(super) type Told = Result<Kept, Error>;

/// Content of the file, in whole lines.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Kept {
    pub(super) lines: usize,
    pub(super) bytes: u64,
}

/// The file of lines, written before anybody is told.
#[derive(Debug)]
pub(super) struct Keeper {
    name: String,
    file: Growing,
    /// The beginning of a line whose end has not come.
    open_line: Vec<u8>,
    kept: Kept,
}

impl Keeper {
    /// Writes the whole lines that there are now; nothing new where there are none.
    fn take(&mut self, bytes: &[u8]) -> Result<Option<Kept>, Error> {
        let too_much = |limit| Error::TooMuch {
            name: self.name.clone(),
            limit,
        };
        self.open_line.extend(bytes);
        let Some(end) = self.open_line.iter().rposition(|b| *b == b'\n') else {
            return match self.open_line.len() > LONGEST_LINE {
                true => Err(too_much(Limit::Line(LONGEST_LINE))),
                false => Ok(None),
            };
        };
        let whole: Vec<u8> = self.open_line.drain(..=end).collect();
        if self.kept.bytes + whole.len() as u64 > MOST {
            return Err(too_much(Limit::Text(MOST)));
        }
        self.file.append(&whole)?;
        self.kept.lines += whole.iter().filter(|b| **b == b'\n').count();
        self.kept.bytes += whole.len() as u64;
        Ok(Some(self.kept))
    }

    /// Ends the line that is open.
    fn end(&mut self) -> Result<Option<Kept>, Error> {
        match self.open_line.is_empty() {
            true => Ok(None),
            false => self.take(b"\n"),
        }
    }

    /// The source has failed.
    fn failed(&self, source: std::io::Error) -> Error {
        let name = match self.name.as_str() {
            "-" => "<stdin>",
            name => name,
        };
        let path = PathBuf::from(name);
        Error::Unreadable(calib::Error::Io { path, source })
    }
}

/// The keeper, of which both the thread that writes and the session that ends have a handle; none once it is closed.
#[derive(Clone, Debug)]
pub(super) struct SharedKeeper(Arc<Mutex<Option<Keeper>>>);

impl SharedKeeper {
    /// Begins the file at `path`, for what `name` sends.
    pub(super) fn begin(name: &str, path: &Path) -> Result<Self, Error> {
        Ok(Self(Arc::new(Mutex::new(Some(Keeper {
            name: name.to_owned(),
            file: Growing::begin(path)?,
            open_line: Vec::new(),
            kept: Kept::default(),
        })))))
    }

    /// Closes the file at `path`, with its content on the disk: what is being written is finished, nothing is written after.
    pub(super) fn close(&self, path: &Path) -> Result<(), Error> {
        // A file without a line goes with its keeper, and is the reader's to miss.
        let Some(keeper) = self.keeper().take().filter(|keeper| keeper.kept.bytes > 0) else {
            return Ok(());
        };
        drop(keeper);
        let file = OpenOptions::new().append(true).open(path);
        let synced = file.and_then(|file| file.sync_all());
        synced.map_err(Error::at(path))
    }

    fn is_closed(&self) -> bool {
        self.keeper().is_none()
    }

    /// The answer of `act` on the keeper; nothing where it is closed.
    fn with(&self, act: impl FnOnce(&mut Keeper) -> Result<Option<Kept>, Error>) -> Option<Told> {
        act(self.keeper().as_mut()?).transpose()
    }

    fn keeper(&self) -> MutexGuard<'_, Option<Keeper>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Keeps what `source` gives until it ends, or until a file that `grows` is complete, or nobody listens.
///
/// Where the keeper is closed the source is read on, and what it gives is let go: what sends is neither held up nor ended
/// while the recording is calibrated.
pub(super) fn keep(source: &mut dyn Read, keeper: &SharedKeeper, tell: &Sender<Told>, grows: bool) {
    let mut chunk = vec![0; CHUNK];
    let mut idle = Instant::now();
    let mut stopped = None;
    loop {
        match source.read(&mut chunk) {
            Ok(0) if grows && idle.elapsed() < COMPLETE && !keeper.is_closed() => {
                std::thread::sleep(AGAIN);
            }
            Ok(0) => break,
            Ok(count) => {
                idle = Instant::now();
                let kept = keeper.with(|keeper| keeper.take(&chunk[..count]));
                let failed = matches!(kept, Some(Err(_)));
                if kept.is_some_and(|kept| tell.send(kept).is_err()) || failed {
                    return;
                }
            }
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Err(error) => {
                stopped = Some(error);
                break;
            }
        }
    }
    // Of a source that has failed the line that is open is half a row.
    let last = keeper.with(|keeper| match stopped {
        None => keeper.end(),
        Some(error) => Err(keeper.failed(error)),
    });
    if let Some(last) = last {
        // Nobody listens any more: what came is on disk all the same.
        let _ = tell.send(last);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::mpsc::channel;

    /// A port that is pulled out once a row has come.
    struct Pulled(Option<Vec<u8>>);

    impl Read for Pulled {
        fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
            let bytes = self.0.take().ok_or(ErrorKind::BrokenPipe)?;
            buffer[..bytes.len()].copy_from_slice(&bytes);
            Ok(bytes.len())
        }
    }

    #[test]
    fn a_source_that_fails_is_not_one_that_has_ended() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("lines.txt");
        let keeper = SharedKeeper::begin("port", &path).unwrap();
        let (tell, told) = channel();
        let row = "0,0.1,0.2,9.8,0.001,0.002,0.003\n";
        let sent = format!("{row}0.01,0.1");
        let mut port = Pulled(Some(sent.into_bytes()));
        keep(&mut port, &keeper, &tell, false);
        drop(tell);
        let told: Vec<Told> = told.iter().collect();
        assert_eq!(told.len(), 2);
        let error = told[1].as_ref().unwrap_err();
        assert!(error.ends_a_session() && error.to_string().starts_with("port: "));
        let kept = std::fs::read_to_string(path).unwrap();
        assert_eq!(kept, row, "half a row is none");
    }
}
