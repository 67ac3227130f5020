//! Lines of text from standard input, a serial port or a file that grows.

use std::fs::{File, OpenOptions};
use std::io::{ErrorKind, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, SyncSender, TryRecvError, sync_channel};
use std::time::{Duration, Instant};

use calib::Recording;
use calib::recording::{ReadOptions, Stream};

use crate::error::Error;
use crate::serial;
use crate::source::{Batch, Event, Finished, Opening, Source};

/// Bytes of one read, and reads that may wait to be taken.
const CHUNK: usize = 64 << 10;
const WAITING: usize = 256;
/// Wait before a file is asked again whether it has grown.
const AGAIN: Duration = Duration::from_millis(50);
/// A file that has not grown for so long is complete.
const COMPLETE: Duration = Duration::from_secs(30);
/// Reading all lines again takes at most this share of the time.
const SHARE: u32 = 4;
/// Nothing is understood of fewer lines.
const FEWEST_LINES: usize = 20;

/// Text in any layout that [`Recording::read`] knows.
///
/// Lines are written to `lines.txt` as they come and read from there, all of them each time: layout and units are what
/// the reader decides on the whole text, as it will in the end. Rereading waits where it takes long.
#[derive(Debug)]
pub struct Lines {
    name: String,
    chunks: Receiver<Vec<u8>>,
    path: PathBuf,
    file: File,
    /// The beginning of a line whose end has not come.
    open_line: Vec<u8>,
    lines: usize,
    read: ReadOptions,
    last: [Option<f64>; 2],
    /// Lines have come that were not read.
    unread: bool,
    not_before: Option<Instant>,
    refusal: Option<String>,
    greeted: bool,
    ended: bool,
}

impl Lines {
    /// Opens standard input (`-`), a serial port or a file.
    ///
    /// # Errors
    /// A path that cannot be opened, a folder that cannot be written.
    pub fn open(path: &Path, how: &Opening) -> Result<Self, Error> {
        let (send, chunks) = sync_channel(WAITING);
        if path.as_os_str() == "-" {
            spawn(move || forward(&mut std::io::stdin(), &send, false))?;
        } else {
            let mut source = serial::open(path, how.baud)?;
            let grows = source.metadata().is_ok_and(|m| m.is_file());
            spawn(move || forward(&mut source, &send, grows))?;
        }
        Self::of(path.display().to_string(), chunks, how)
    }

    fn of(name: String, chunks: Receiver<Vec<u8>>, how: &Opening) -> Result<Self, Error> {
        let path = how.folder.join("lines.txt");
        let file = OpenOptions::new().append(true).create_new(true).open(&path);
        Ok(Self {
            name,
            chunks,
            file: file.map_err(Error::at(&path))?,
            path,
            open_line: Vec::new(),
            lines: 0,
            read: how.read.clone(),
            last: [None; 2],
            unread: false,
            not_before: None,
            refusal: None,
            greeted: false,
            ended: false,
        })
    }

    /// Writes what has come, whole lines only.
    fn keep(&mut self) -> Result<(), Error> {
        loop {
            match self.chunks.try_recv() {
                Ok(chunk) => self.open_line.extend(chunk),
                Err(TryRecvError::Empty) => break,
                Err(TryRecvError::Disconnected) => {
                    self.ended = true;
                    if !self.open_line.is_empty() && !self.open_line.ends_with(b"\n") {
                        self.open_line.push(b'\n');
                    }
                    break;
                }
            }
        }
        let Some(end) = self.open_line.iter().rposition(|b| *b == b'\n') else {
            return Ok(());
        };
        let whole: Vec<u8> = self.open_line.drain(..=end).collect();
        self.file.write_all(&whole).map_err(Error::at(&self.path))?;
        self.lines += whole.iter().filter(|b| **b == b'\n').count();
        self.unread = true;
        Ok(())
    }

    /// What is new in the text as a whole.
    fn understood(&mut self, batch: &mut Batch) -> Result<(), Error> {
        let begin = Instant::now();
        let read = Recording::read(&self.path, &self.read);
        self.not_before = Some(Instant::now() + begin.elapsed() * SHARE);
        self.unread = false;
        match read {
            Ok(recording) => {
                self.refusal = None;
                batch.accelerometer = self.newer(0, recording.accelerometer);
                batch.gyroscope = self.newer(1, recording.gyroscope);
            }
            Err(error) if self.ended => return Err(error.into()),
            Err(error) => {
                let reason = error.to_string();
                if self.refusal.as_ref() != Some(&reason) && self.lines >= FEWEST_LINES {
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
    fn poll(&mut self) -> Result<Batch, Error> {
        let mut batch = Batch::default();
        if !std::mem::replace(&mut self.greeted, true) {
            batch.events.push(Event::Connected {
                name: self.name.clone(),
            });
        }
        self.keep()?;
        let is_due = self.ended || self.not_before.is_none_or(|then| Instant::now() >= then);
        if self.unread && is_due && (self.ended || self.lines >= FEWEST_LINES) {
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

fn spawn(run: impl FnOnce() + Send + 'static) -> Result<(), Error> {
    let thread = std::thread::Builder::new().name("lines".into()).spawn(run);
    thread.map(drop).map_err(Error::at(Path::new("-")))
}

/// Hands on what `source` gives until it ends, or until a file that `grows` is complete, or nobody listens.
fn forward(source: &mut dyn Read, send: &SyncSender<Vec<u8>>, grows: bool) {
    let mut chunk = vec![0; CHUNK];
    let mut idle = Instant::now();
    loop {
        match source.read(&mut chunk) {
            Ok(0) if grows && idle.elapsed() < COMPLETE => std::thread::sleep(AGAIN),
            Ok(0) => return,
            Ok(count) => {
                idle = Instant::now();
                if send.send(chunk[..count].to_vec()).is_err() {
                    return;
                }
            }
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Err(_) => return,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(folder: &Path) -> (SyncSender<Vec<u8>>, Lines) {
        let (send, chunks) = sync_channel(WAITING);
        let how = Opening {
            folder: folder.to_owned(),
            read: ReadOptions::default(),
            baud: 115_200,
            attempts: 1,
        };
        (send, Lines::of("test".into(), chunks, &how).unwrap())
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

    #[test]
    fn a_line_is_read_once_and_only_when_its_end_has_come() {
        let folder = tempfile::tempdir().unwrap();
        let (send, mut lines) = lines(folder.path());
        let text = format!("t,ax,ay,az,gx,gy,gz\n{}", rows(0, 50));
        let (head, tail) = text.split_at(text.len() - 5);
        send.send(head.into()).unwrap();
        assert_eq!(lines.poll().unwrap().accelerometer.len(), 49);
        send.send(tail.into()).unwrap();
        send.send(rows(50, 60).into()).unwrap();
        drop(send);
        let batch = lines.poll().unwrap();
        assert_eq!((batch.accelerometer.len(), batch.gyroscope.len()), (11, 11));
        assert_eq!(batch.events, [Event::Ended]);
        let kept = std::fs::read_to_string(lines.finish().unwrap().recording).unwrap();
        assert_eq!(kept, text + &rows(50, 60), "what came is kept as it came");
    }

    #[test]
    fn text_that_is_no_recording_is_said_while_it_comes_and_an_error_in_the_end() {
        let folder = tempfile::tempdir().unwrap();
        let (send, mut lines) = lines(folder.path());
        send.send("hello, world\n".repeat(30).into()).unwrap();
        let events = lines.poll().unwrap().events;
        assert!(
            matches!(events.last(), Some(Event::NotUnderstood { .. })),
            "{events:?}"
        );
        send.send(b"hello\n".to_vec()).unwrap();
        drop(send);
        assert!(matches!(lines.poll(), Err(Error::Unreadable(_))));
    }
}
