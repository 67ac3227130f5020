//! A text that is written on a thread of its own while it is read.

use std::io::{self, Read, Write};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};

use crate::Error;

/// Bytes handed over at a time.
const PIECE: usize = 64 << 10;
/// Pieces written ahead of the reader.
const AHEAD: usize = 2;

type Piece = Result<Vec<u8>, Error>;

/// Returns a reader of the text that `write` writes. `write` runs in a thread and ends early if the reader is dropped. Without
/// threads, in WebAssembly, the whole text is written first.
///
/// # Errors
/// A thread that the system refuses.
pub(super) fn text(
    write: impl FnOnce(&mut dyn Write) -> Result<(), Error> + Send + 'static,
) -> Result<Box<dyn Read + Send>, Error> {
    if cfg!(target_family = "wasm") {
        let mut whole = Vec::new();
        write(&mut whole)?;
        return Ok(Box::new(io::Cursor::new(whole)));
    }
    let (sender, pieces) = sync_channel(AHEAD);
    let run = move || {
        let mut out = Pieces {
            sender,
            piece: Vec::new(),
        };
        let written = write(&mut out).and_then(|()| Ok(out.flush()?));
        if let Err(error) = written {
            // Nobody hears it where nobody reads.
            let _ = out.sender.send(Err(error));
        }
    };
    std::thread::Builder::new()
        .name("table".to_owned())
        .spawn(run)?;
    Ok(Box::new(Text {
        pieces,
        piece: Vec::new(),
        at: 0,
    }))
}

/// The end that is written to.
struct Pieces {
    sender: SyncSender<Piece>,
    piece: Vec<u8>,
}

impl Write for Pieces {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.piece.extend_from_slice(bytes);
        if self.piece.len() >= PIECE {
            self.flush()?;
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        let piece = std::mem::take(&mut self.piece);
        let sent = self.sender.send(Ok(piece));
        sent.map_err(|_| io::Error::from(io::ErrorKind::BrokenPipe))
    }
}

/// The end that is read from.
struct Text {
    pieces: Receiver<Piece>,
    piece: Vec<u8>,
    at: usize,
}

impl Read for Text {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        while self.at == self.piece.len() && !buffer.is_empty() {
            match self.pieces.recv() {
                Ok(Ok(piece)) => (self.piece, self.at) = (piece, 0),
                Ok(Err(error)) => return Err(error.into()),
                Err(_) => return Ok(0),
            }
        }
        let length = buffer.len().min(self.piece.len() - self.at);
        buffer[..length].copy_from_slice(&self.piece[self.at..self.at + length]);
        self.at += length;
        Ok(length)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_arrives_whole_and_an_error_after_what_was_written() {
        let mut all = String::new();
        let lines = |out: &mut dyn Write| {
            (0..100_000).try_for_each(|k| writeln!(out, "{k}"))?;
            Ok(())
        };
        text(lines).unwrap().read_to_string(&mut all).unwrap();
        assert_eq!(all.lines().count(), 100_000);
        let broken = |out: &mut dyn Write| {
            out.write_all(b"t\n")?;
            Err(Error::refused("no more"))
        };
        let error = text(broken).unwrap().read_to_string(&mut all).unwrap_err();
        assert_eq!(error.to_string(), "no more");
    }

    #[test]
    fn a_writer_ends_where_nobody_reads() {
        let (sender, receiver) = std::sync::mpsc::channel();
        let endless = move |out: &mut dyn Write| {
            let error = loop {
                if let Err(error) = out.write_all(b"0,0,0,0\n") {
                    break error;
                }
            };
            sender.send(error.kind()).unwrap();
            Err(error.into())
        };
        drop(text(endless).unwrap());
        assert_eq!(receiver.recv(), Ok(io::ErrorKind::BrokenPipe));
    }
}
