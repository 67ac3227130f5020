//! A phone's server that answers one request in its own way.

use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Duration;

use super::kinds::{Answer, ordinary};

/// A phone of a kind, until it is dropped.
pub struct Server {
    pub address: String,
    over: Arc<AtomicBool>,
}

impl Server {
    pub fn start(own: &'static str, how: fn(usize) -> Answer) -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let address = format!("http://{}", listener.local_addr().unwrap());
        let over = Arc::new(AtomicBool::new(false));
        let (ends, requests) = (Arc::clone(&over), Arc::new(AtomicUsize::new(0)));
        std::thread::spawn(move || {
            for stream in listener.incoming().flatten() {
                if ends.load(Ordering::SeqCst) {
                    return;
                }
                let (ends, requests) = (Arc::clone(&ends), Arc::clone(&requests));
                std::thread::spawn(move || {
                    let _ = serve(stream, own, how, &requests, &ends);
                });
            }
        });
        Self { address, over }
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        self.over.store(true, Ordering::SeqCst);
        let _ = TcpStream::connect(self.address.trim_start_matches("http://"));
    }
}

fn serve(
    mut stream: TcpStream,
    own: &str,
    how: fn(usize) -> Answer,
    requests: &AtomicUsize,
    over: &AtomicBool,
) -> std::io::Result<()> {
    let mut request = Vec::new();
    let mut chunk = [0; 4096];
    while !request.windows(4).any(|w| w == b"\r\n\r\n") {
        match stream.read(&mut chunk)? {
            0 => return Ok(()),
            count => request.extend(&chunk[..count]),
        }
    }
    let request = String::from_utf8_lossy(&request).into_owned();
    let path = request.split([' ', '?']).nth(1).unwrap_or("/");
    let n = match path {
        "/get" => requests.fetch_add(1, Ordering::SeqCst),
        _ => requests.load(Ordering::SeqCst),
    };
    let answer = match path == own {
        true => how(n),
        false => ordinary(path, n),
    };
    let goes_on = || !over.load(Ordering::SeqCst);
    let begin = b"HTTP/1.1 200 OK\r\nTransfer-Encoding: chunked\r\n\r\n";
    match answer {
        Answer::Raw(bytes) => stream.write_all(&bytes)?,
        Answer::Body(bytes) => {
            let length = bytes.len();
            let head =
                format!("HTTP/1.1 200 OK\r\nContent-Length: {length}\r\nConnection: close\r\n\r\n");
            stream.write_all(head.as_bytes())?;
            stream.write_all(&bytes)?;
        }
        Answer::Silence => {
            while goes_on() {
                std::thread::sleep(Duration::from_millis(20));
            }
        }
        Answer::Drip => {
            stream.write_all(begin)?;
            while goes_on() {
                stream.write_all(b"1\r\n \r\n")?;
                std::thread::sleep(Duration::from_millis(20));
            }
        }
        Answer::Endless(bytes) => {
            let begin: &[u8] = if bytes.starts_with(b"4") {
                begin
            } else {
                b"HTTP/1.1 200 OK\r\n"
            };
            let begin: &[u8] = if bytes.starts_with(b"HTTP") {
                b""
            } else {
                begin
            };
            stream.write_all(begin)?;
            while goes_on() {
                stream.write_all(bytes)?;
            }
        }
    }
    Ok(())
}
