//! Connections to the page, none of which waits for another.
//!
//! One thread goes round all of them and does what can be done at once, so that a connection that says nothing, little or
//! too much costs the others nothing. There are at most [`MOST`], the oldest of which makes room, and each lives for
//! [`PATIENCE`].

use std::collections::VecDeque;
use std::io::{ErrorKind, Read, Write};
use std::net::{Shutdown, TcpListener, TcpStream};
use std::time::{Duration, Instant};

/// Connections at a time.
const MOST: usize = 128;
/// Longest request, bytes.
const LONGEST: usize = 8 << 10;
/// Most bytes read and discarded after the answer. A client that still sends would otherwise not see the answer.
const THROWN_AWAY: usize = 256 << 10;
/// Longest life of a connection.
const PATIENCE: Duration = Duration::from_secs(3);
/// Wait where nobody has said anything.
const REST: Duration = Duration::from_millis(4);

/// Everybody who is there.
#[derive(Debug)]
pub(super) struct Visitors {
    door: TcpListener,
    inside: VecDeque<Visitor>,
}

/// One connection.
#[derive(Debug)]
struct Visitor {
    stream: TcpStream,
    since: Instant,
    request: Vec<u8>,
    /// Remaining bytes of the answer; `None` until the request is complete.
    answer: Option<Vec<u8>>,
    thrown_away: usize,
}

/// Result of one step of a connection.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Did {
    Something,
    Nothing,
    Leave,
}

impl Visitors {
    pub(super) fn new(door: TcpListener) -> Self {
        Self {
            door,
            inside: VecDeque::new(),
        }
    }

    /// Answers for as long as the process lives.
    pub(super) fn serve(mut self, answer: impl Fn(&[u8]) -> Vec<u8>) {
        loop {
            let came = self.let_in();
            let mut active = came > 0;
            self.inside.retain_mut(|visitor| {
                let did = visitor.go_on(&answer);
                active |= did == Did::Something;
                did != Did::Leave
            });
            while self.inside.len() > MOST {
                self.inside.pop_front();
            }
            if !active {
                std::thread::sleep(REST);
            }
        }
    }

    /// Lets in who waits at the door; where nobody is inside it is waited for somebody.
    fn let_in(&mut self) -> usize {
        let mut came = 0;
        while came < MOST {
            let waits = self.inside.is_empty();
            if self.door.set_nonblocking(!waits).is_err() {
                break;
            }
            let Ok((stream, _)) = self.door.accept() else {
                break;
            };
            if stream.set_nonblocking(true).is_ok() {
                self.inside.push_back(Visitor::new(stream));
                came += 1;
            }
        }
        came
    }
}

impl Visitor {
    fn new(stream: TcpStream) -> Self {
        Self {
            stream,
            since: Instant::now(),
            request: Vec::new(),
            answer: None,
            thrown_away: 0,
        }
    }

    /// Does one step of the connection without waiting.
    fn go_on(&mut self, answer: &impl Fn(&[u8]) -> Vec<u8>) -> Did {
        if self.since.elapsed() > PATIENCE {
            return Did::Leave;
        }
        let step = match &self.answer {
            None => self.listen(answer),
            Some(left) if left.is_empty() => self.throw_away(),
            Some(_) => self.speak(),
        };
        match step {
            Ok(did) => did,
            Err(error) if error.kind() == ErrorKind::WouldBlock => Did::Nothing,
            Err(error) if error.kind() == ErrorKind::Interrupted => Did::Something,
            // A browser that went away is no loss.
            Err(_) => Did::Leave,
        }
    }

    /// Reads some of the request. Where it is complete or too long, the answer is there.
    fn listen(&mut self, answer: &impl Fn(&[u8]) -> Vec<u8>) -> std::io::Result<Did> {
        let mut chunk = [0; 2048];
        let count = self.stream.read(&mut chunk)?;
        let before = self.request.len().saturating_sub(3);
        self.request.extend(&chunk[..count]);
        let ends = self.request[before..].windows(4).any(|w| w == b"\r\n\r\n");
        if count == 0 || ends || self.request.len() >= LONGEST {
            self.answer = Some(answer(&self.request));
        }
        Ok(Did::Something)
    }

    fn speak(&mut self) -> std::io::Result<Did> {
        let Some(left) = &mut self.answer else {
            return Ok(Did::Leave);
        };
        let count = self.stream.write(left)?;
        if count == 0 {
            return Ok(Did::Leave);
        }
        left.drain(..count);
        if left.is_empty() {
            self.stream.shutdown(Shutdown::Write)?;
        }
        Ok(Did::Something)
    }

    fn throw_away(&mut self) -> std::io::Result<Did> {
        let mut chunk = [0; 16 << 10];
        let count = self.stream.read(&mut chunk)?;
        self.thrown_away += count;
        let is_over = count == 0 || self.thrown_away > THROWN_AWAY;
        Ok(if is_over { Did::Leave } else { Did::Something })
    }
}
