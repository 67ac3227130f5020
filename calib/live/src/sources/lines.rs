//! Lines of text from standard input, a serial port or a file that grows.

mod keeper;

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::time::{Duration, Instant};

use calib::Recording;
use calib::recording::{ReadOptions, Stream};

use self::keeper::{Kept, SharedKeeper, Told, keep};
use crate::batch::{Batch, Event};
use crate::sources::error::Error;
use crate::sources::serial;
use crate::sources::{Finished, Opening, Source};

/// Reading all lines again takes at most this share of the time.
const SHARE: u32 = 4;
/// Nothing is understood of fewer lines.
const FEWEST_LINES: usize = 20;

/// Text in any layout that [`Recording::read`] knows.
///
/// A thread writes lines to `lines.txt` as they come, however long the last reading takes. They are read from there, all of
/// them each time: layout and units are what the reader decides on the whole text, as it will in the end. Rereading waits
/// where it takes long. Once the session is finished the file does not change any more, even where the source goes on.
#[derive(Debug)]
pub struct Lines {
    name: String,
    keeper: SharedKeeper,
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
        let keeper = SharedKeeper::begin(&name, &path)?;
        let (tell, kept) = channel();
        let thread = std::thread::Builder::new().name("lines".into());
        let of_thread = keeper.clone();
        let thread = thread.spawn(move || keep(&mut source, &of_thread, &tell, grows));
        thread.map_err(Error::at(Path::new("-")))?;
        Ok(Self {
            name,
            keeper,
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
        self.keeper.close(&self.path)?;
        Ok(Finished {
            recording: self.path.clone(),
            fallback: None,
        })
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

    #[test]
    fn a_finished_recording_stays_as_it_is_and_its_source_is_not_held_up() {
        let folder = tempfile::tempdir().unwrap();
        let (send, mut lines) = lines(folder.path());
        let text = format!("t,ax,ay,az,gx,gy,gz\n{}", rows(0, 50));
        // The session ends within a row.
        send.send(format!("{text}0.5,0.1").into()).unwrap();
        wait_for(folder.path(), text.len());
        let recording = lines.finish().unwrap().recording;
        let changed = || std::fs::metadata(&recording).unwrap().modified().unwrap();
        let at_the_end = changed();
        // Nobody takes these unless the source is drained.
        for k in 51..60 {
            send.send(rows(k, k + 1).into()).unwrap();
        }
        drop(send);
        std::thread::sleep(Duration::from_millis(50));
        assert_eq!(std::fs::read_to_string(&recording).unwrap(), text);
        assert_eq!(changed(), at_the_end);
        lines.finish().unwrap();
    }
}
