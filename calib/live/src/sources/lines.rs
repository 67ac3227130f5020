//! Lines of text from standard input, a serial port or a file that grows.

use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
use std::time::{Duration, Instant};

use calib::Recording;
use calib::recording::{ReadOptions, Stream};
use output::Growing;

use crate::batch::{Batch, Event};
use crate::sources::error::{Error, Limit};
use crate::sources::serial;
use crate::sources::{Finished, Opening, Source};

/// Bytes of one read.
const CHUNK: usize = 64 << 10;
/// Wait before a file is asked again whether it has grown.
const AGAIN: Duration = Duration::from_millis(50);
/// A file that has not grown for so long is complete.
const COMPLETE: Duration = Duration::from_secs(30);
/// Reading all lines again takes at most this share of the time.
const SHARE: u32 = 4;
/// Nothing is understood of fewer lines.
const FEWEST_LINES: usize = 20;
/// Most bytes of a session, twenty minutes at 1 kHz: all of them are in memory when they are read.
const MOST: u64 = 128 << 20;
/// Most bytes of a line.
const LONGEST_LINE: usize = 1 << 20;

/// Message of the writing thread: the lines so far, or an error.
type Told = Result<Kept, Error>;

/// Text in any layout that [`Recording::read`] knows.
///
/// A thread writes lines to `lines.txt` as they come, however long the last reading takes. They are read from there, all of
/// them each time: layout and units are what the reader decides on the whole text, as it will in the end. Rereading waits
/// where it takes long.
#[derive(Debug)]
pub struct Lines {
    name: String,
    kept: Receiver<Told>,
    path: PathBuf,
    so_far: Kept,
    read: ReadOptions,
    last: [Option<f64>; 2],
    /// Lines have come that were not read.
    unread: bool,
    not_before: Option<Instant>,
    refusal: Option<String>,
    greeted: bool,
    ended: bool,
}

/// Content of the file, in whole lines.
#[derive(Clone, Copy, Debug, Default)]
struct Kept {
    lines: usize,
    bytes: u64,
}

impl Lines {
    /// Opens standard input (`-`), a serial port or a file.
    ///
    /// # Errors
    /// A path that cannot be opened, a folder that cannot be written.
    pub fn open(path: &Path, how: &Opening) -> Result<Self, Error> {
        let name = path.display().to_string();
        if path.as_os_str() == "-" {
            return Self::of(name, std::io::stdin(), false, how);
        }
        let source = serial::open(path, how.baud)?;
        let grows = source.metadata().is_ok_and(|m| m.is_file());
        Self::of(name, source, grows, how)
    }

    fn of(
        name: String,
        mut source: impl Read + Send + 'static,
        grows: bool,
        how: &Opening,
    ) -> Result<Self, Error> {
        let path = how.folder.join("lines.txt");
        let mut keeper = Keeper {
            name: name.clone(),
            file: Growing::begin(&path)?,
            open_line: Vec::new(),
            kept: Kept::default(),
        };
        let (tell, kept) = channel();
        let thread = std::thread::Builder::new().name("lines".into());
        let thread = thread.spawn(move || keep(&mut source, &mut keeper, &tell, grows));
        thread.map_err(Error::at(Path::new("-")))?;
        Ok(Self {
            name,
            kept,
            path,
            so_far: Kept::default(),
            read: how.read.clone(),
            last: [None; 2],
            unread: false,
            not_before: None,
            refusal: None,
            greeted: false,
            ended: false,
        })
    }

    /// Learns what has been written.
    fn catch_up(&mut self) -> Result<(), Error> {
        loop {
            match self.kept.try_recv() {
                Ok(kept) => {
                    self.so_far = kept?;
                    self.unread = true;
                }
                Err(TryRecvError::Empty) => return Ok(()),
                Err(TryRecvError::Disconnected) => {
                    self.ended = true;
                    return Ok(());
                }
            }
        }
    }

    /// The recording that the lines so far are.
    fn recording(&self) -> Result<Recording, Error> {
        let mut text = Vec::new();
        let file = File::open(&self.path).map_err(Error::at(&self.path))?;
        let read = file.take(self.so_far.bytes).read_to_end(&mut text);
        read.map_err(Error::at(&self.path))?;
        let name = self.path.display().to_string();
        Ok(Recording::from_bytes(&name, text, &self.read)?)
    }

    /// Reads the whole text and puts the new samples into the batch.
    fn understood(&mut self, batch: &mut Batch) -> Result<(), Error> {
        let begin = Instant::now();
        let read = self.recording();
        self.not_before = Some(Instant::now() + begin.elapsed() * SHARE);
        self.unread = false;
        match read {
            Ok(recording) => {
                self.refusal = None;
                batch.accelerometer = self.newer(0, recording.accelerometer);
                batch.gyroscope = self.newer(1, recording.gyroscope);
            }
            Err(error @ Error::File { .. }) => return Err(error),
            Err(error) if self.ended => return Err(error),
            Err(error) => {
                let reason = error.to_string();
                if self.refusal.as_ref() != Some(&reason) && self.so_far.lines >= FEWEST_LINES {
                    batch.events.push(Event::NotUnderstood {
                        reason: reason.clone(),
                    });
                }
                self.refusal = Some(reason);
            }
        }
        Ok(())
    }

    fn newer(&mut self, sensor: usize, stream: Option<Stream>) -> Stream {
        let stream = stream.unwrap_or_default();
        let from = self.last[sensor].map_or(0, |last| stream.t.partition_point(|t| *t <= last));
        self.last[sensor] = stream.t.last().copied().or(self.last[sensor]);
        Stream {
            t: stream.t[from..].to_vec(),
            values: stream.values[from..].to_vec(),
        }
    }
}

impl Source for Lines {
    fn poll(&mut self, _now: Duration) -> Result<Batch, Error> {
        let mut batch = Batch::default();
        if !std::mem::replace(&mut self.greeted, true) {
            batch.events.push(Event::Connected {
                name: self.name.clone(),
            });
        }
        self.catch_up()?;
        let is_due = self.ended || self.not_before.is_none_or(|then| Instant::now() >= then);
        if self.unread && is_due && (self.ended || self.so_far.lines >= FEWEST_LINES) {
            self.understood(&mut batch)?;
        }
        if self.ended {
            batch.events.push(Event::Ended);
        }
        Ok(batch)
    }

    fn finish(&mut self) -> Result<Finished, Error> {
        Ok(Finished {
            recording: self.path.clone(),
            fallback: None,
        })
    }
}

/// The file of lines, written before anybody is told.
#[derive(Debug)]
struct Keeper {
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
}

/// Keeps what `source` gives until it ends, or until a file that `grows` is complete, or nobody listens.
fn keep(source: &mut dyn Read, keeper: &mut Keeper, tell: &Sender<Told>, grows: bool) {
    let mut chunk = vec![0; CHUNK];
    let mut idle = Instant::now();
    let mut stopped = None;
    loop {
        match source.read(&mut chunk) {
            Ok(0) if grows && idle.elapsed() < COMPLETE => std::thread::sleep(AGAIN),
            Ok(0) => break,
            Ok(count) => {
                idle = Instant::now();
                let kept = keeper.take(&chunk[..count]).transpose();
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
    let last = match stopped {
        None => keeper.end().transpose(),
        Some(source) => {
            let name = if keeper.name == "-" {
                "<stdin>"
            } else {
                &keeper.name
            };
            let path = PathBuf::from(name);
            Some(Err(Error::Unreadable(calib::Error::Io { path, source })))
        }
    };
    if let Some(last) = last {
        // Nobody listens any more: what came is on disk all the same.
        let _ = tell.send(last);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sources::Waits;
    use std::sync::mpsc::SyncSender;

    /// What a test sends, as a stream of bytes.
    struct Sent(Receiver<Vec<u8>>);

    impl Read for Sent {
        fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
            let Ok(bytes) = self.0.recv() else {
                return Ok(0);
            };
            buffer[..bytes.len()].copy_from_slice(&bytes);
            Ok(bytes.len())
        }
    }

    fn lines(folder: &Path) -> (SyncSender<Vec<u8>>, Lines) {
        // Nothing waits in the channel: what was sent is being kept.
        let (send, sent) = std::sync::mpsc::sync_channel(0);
        let how = Opening {
            folder: folder.to_owned(),
            read: ReadOptions::default(),
            baud: 115_200,
            patience: Duration::ZERO,
            waits: Waits::default(),
        };
        let lines = Lines::of("test".into(), Sent(sent), false, &how).unwrap();
        (send, lines)
    }

    fn rows(from: usize, to: usize) -> String {
        let row = |k: usize| {
            format!(
                "{},0.1,0.2,9.8{},0.001,0.002,0.003\n",
                0.01 * k as f64,
                k % 10
            )
        };
        (from..to).map(row).collect()
    }

    /// Waits until so many bytes are in the file.
    fn wait_for(folder: &Path, bytes: usize) {
        let length = || std::fs::metadata(folder.join("lines.txt")).unwrap().len();
        for _ in 0..2000 {
            if length() >= bytes as u64 {
                // Told right after it is written.
                return std::thread::sleep(Duration::from_millis(20));
            }
            std::thread::sleep(Duration::from_millis(5));
        }
        panic!("{} bytes of {bytes} are kept", length());
    }

    #[test]
    fn a_line_is_kept_without_a_poll_and_read_only_when_its_end_has_come() {
        let folder = tempfile::tempdir().unwrap();
        let (send, mut lines) = lines(folder.path());
        let text = format!("t,ax,ay,az,gx,gy,gz\n{}", rows(0, 50));
        let (head, tail) = text.split_at(text.len() - 5);
        send.send(head.into()).unwrap();
        wait_for(folder.path(), head.rfind('\n').unwrap() + 1);
        let batch = lines.poll(Duration::ZERO).unwrap();
        assert_eq!(batch.accelerometer.len(), 49);
        send.send(tail.into()).unwrap();
        send.send(rows(50, 60).into()).unwrap();
        drop(send);
        let whole = text + &rows(50, 60);
        wait_for(folder.path(), whole.len());
        let batch = lines.poll(Duration::ZERO).unwrap();
        assert_eq!((batch.accelerometer.len(), batch.gyroscope.len()), (11, 11));
        assert_eq!(batch.events, [Event::Ended]);
        let kept = std::fs::read_to_string(lines.finish().unwrap().recording).unwrap();
        assert_eq!(kept, whole, "what came is kept as it came");
    }

    #[test]
    fn text_that_is_no_recording_is_said_while_it_comes_and_an_error_in_the_end() {
        let folder = tempfile::tempdir().unwrap();
        let (send, mut lines) = lines(folder.path());
        let text = "hello, world\n".repeat(30);
        send.send(text.clone().into()).unwrap();
        wait_for(folder.path(), text.len());
        let events = lines.poll(Duration::ZERO).unwrap().events;
        assert!(
            matches!(events.last(), Some(Event::NotUnderstood { .. })),
            "{events:?}"
        );
        send.send(b"hello\n".to_vec()).unwrap();
        drop(send);
        wait_for(folder.path(), text.len() + 6);
        let end = lines.poll(Duration::ZERO);
        assert!(matches!(end, Err(Error::Unreadable(_))), "{end:?}");
    }

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
        let file = Growing::begin(&folder.path().join("lines.txt")).unwrap();
        let mut keeper = Keeper {
            name: "port".into(),
            file,
            open_line: Vec::new(),
            kept: Kept::default(),
        };
        let (tell, told) = channel();
        let sent = rows(0, 1) + "0.01,0.1";
        let mut port = Pulled(Some(sent.into_bytes()));
        keep(&mut port, &mut keeper, &tell, false);
        drop(tell);
        let told: Vec<Told> = told.iter().collect();
        assert_eq!(told.len(), 2);
        let error = told[1].as_ref().unwrap_err();
        assert!(error.ends_a_session() && error.to_string().starts_with("port: "));
        let kept = std::fs::read_to_string(folder.path().join("lines.txt")).unwrap();
        assert_eq!(kept, rows(0, 1), "half a row is none");
    }
}
